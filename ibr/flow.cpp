#include "ibr/flow.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include "ibr/reprojection.h"
#include "src/core/errors.h"

namespace promenade::ibr {
namespace {

bool isValid(glm::vec2 flow) {
  return std::isfinite(flow.x) && std::isfinite(flow.y);
}

/// Pixels per frame. `previous` and `next` are displacements to those frames, both measured from this one.
glm::vec2 meanMotion(glm::vec2 previous, glm::vec2 next) {
  if (!isValid(previous)) return isValid(next) ? next : glm::vec2(0.0f);
  if (!isValid(next)) return -previous;
  // In double: the square of a displacement may exceed float.
  const glm::dvec2 before(previous);
  const glm::dvec2 after(next);
  const double speed = 0.5 * (glm::length(before) + glm::length(after));
  const glm::dvec2 mean = 0.5 * (after - before);
  const glm::dvec2 along = glm::length(mean) > 0.0 ? mean : after;
  const double length = glm::length(along);
  return length > 0.0 ? glm::vec2(along * (speed / length)) : glm::vec2(0.0f);
}

std::string text(Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace

PixelFlow pixelFlow(const Visibility& from, const Camera& to) {
  const Size size = from.camera.size();
  if (!(to.size() == size)) {
    throw InputError("pixel flow", "expected two cameras of one resolution, found " + text(size) + " and " +
                                       text(to.size()));
  }
  if (!(from.depth.size() == size)) {
    throw InputError("pixel flow", "expected a depth map of the camera's " + text(size) + ", found " +
                                       text(from.depth.size()));
  }
  const Reprojection reproject(from.camera, to);
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  PixelFlow flow(size);
  tbb::parallel_for(0, size.height, [&](int y) {
    const auto depth = from.depth.row(y);
    const auto out = flow.row(y);
    for (int x = 0; x < size.width; ++x) {
      const auto i = static_cast<std::size_t>(x);
      const glm::vec2 pixel(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const auto shift = reproject(pixel, 1.0f / depth[i]);
      const bool inFront = shift.depthRatio > 0.0f && isValid(shift.pixels);
      out[i] = inFront ? shift.pixels : glm::vec2(kNaN);
    }
  });
  return flow;
}

VelocityMap imageVelocity(const PixelFlow& toPrevious, const PixelFlow& toNext, double framesPerSecond,
                          double pixelsPerDegree) {
  if (!(framesPerSecond > 0.0) || !std::isfinite(framesPerSecond)) {
    throw InputError("image velocity",
                     "expected a positive frame rate, found " + std::to_string(framesPerSecond));
  }
  if (!(pixelsPerDegree > 0.0) || !std::isfinite(pixelsPerDegree)) {
    throw InputError("image velocity",
                     "expected positive pixels per degree, found " + std::to_string(pixelsPerDegree));
  }
  if (!toPrevious.empty() && !toNext.empty() && !(toPrevious.size() == toNext.size())) {
    throw InputError("image velocity", "expected flows of one size, found " + text(toPrevious.size()) +
                                           " and " + text(toNext.size()));
  }
  const Size size = toPrevious.empty() ? toNext.size() : toPrevious.size();
  const double degreesPerSecond = framesPerSecond / pixelsPerDegree;
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr double kFloatMax = std::numeric_limits<float>::max();
  VelocityMap velocity(size);
  tbb::parallel_for(0, size.height, [&](int y) {
    const auto out = velocity.row(y);
    for (int x = 0; x < size.width; ++x) {
      const glm::vec2 previous = toPrevious.empty() ? glm::vec2(kNaN) : toPrevious(x, y);
      const glm::vec2 next = toNext.empty() ? glm::vec2(kNaN) : toNext(x, y);
      const glm::dvec2 motion = glm::dvec2(meanMotion(previous, next)) * degreesPerSecond;
      out[static_cast<std::size_t>(x)] = glm::vec2(glm::clamp(motion, -kFloatMax, kFloatMax));
    }
  });
  return velocity;
}

}  // namespace promenade::ibr
