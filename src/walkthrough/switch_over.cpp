#include "src/walkthrough/switch_over.h"

#include <algorithm>

namespace promenade::walkthrough {

double SwitchOver::samplingSeconds(double firstComputed) const {
  return std::max(alpha * firstComputed, leastSamplingSeconds);
}

double SwitchOver::seconds(double sampling, double error, double firstComputed) const {
  const double toThreshold = sampling * error * error / (errorThreshold * errorThreshold);
  return std::min(toThreshold, firstComputed);
}

}  // namespace promenade::walkthrough
