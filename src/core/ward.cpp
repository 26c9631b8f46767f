#include "src/core/ward.h"

#include <cmath>

namespace promenade {

double wardThreshold(double adaptation) {
  return 0.0594 * std::pow(1.219 + std::pow(adaptation, 0.4), 2.5);
}

double wardScale(double worldAdaptation, double displayAdaptation) {
  return wardThreshold(displayAdaptation) / wardThreshold(worldAdaptation);
}

}  // namespace promenade
