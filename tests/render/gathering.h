#pragma once
// What a light record would gather at one place, again and again.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

#include "src/render/path_tracer.h"
#include "src/render/sampler.h"

namespace promenade::tests {

struct Spread {
  double mean = 0.0;
  double deviation = 0.0;  ///< relative to the mean
};

/// Of the green of what 256 paths gather, for so many seeds.
inline Spread gatherOften(const render::PathTracer& tracer, const glm::vec3& position,
                          const glm::vec3& normal, int times) {
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < times; ++i) {
    render::Sampler::Stream stream;
    stream.seed = static_cast<std::uint32_t>(i);
    render::PathRays rays;
    const double value = tracer.gather(position, normal, stream, {256, 1024}, rays).light.radiance.g;
    sum += value;
    squares += value * value;
  }
  const double mean = sum / times;
  return {mean, std::sqrt(std::max(0.0, squares / times - mean * mean)) / mean};
}

}  // namespace promenade::tests
