#include "src/core/frame.h"

#include <cassert>

namespace promenade {

RadianceMap combinedRadiance(const Frame& frame) {
  assert(frame.diffuse.size() == frame.viewDependent.size());
  RadianceMap sum(frame.diffuse.size());
  const auto diffuse = frame.diffuse.pixels();
  const auto viewDependent = frame.viewDependent.pixels();
  const auto out = sum.pixels();
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = diffuse[i] + viewDependent[i];
  return sum;
}

}  // namespace promenade
