#include "ibr/blend.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "ibr/source_surface.h"
#include "src/core/errors.h"

namespace promenade::ibr {
namespace {

/// 1 for a source as fine as the target or finer, then as the density of source samples on the surface,
/// shifted so that it is 0 at the limit.
double quality(float footprint, double limit) {
  const double density = 1.0 / std::max(1.0, static_cast<double>(footprint));
  const double atLimit = 1.0 / std::max(1.0, limit);
  return atLimit < 1.0 ? std::max(0.0, (density - atLimit) / (1.0 - atLimit)) : 1.0;
}

/// Of two samples that see one surface.
float weightOfNext(double previousQuality, double nextQuality, double t) {
  const double previous = (1.0 - t) * previousQuality;
  const double next = t * nextQuality;
  const double sum = previous + next;
  return static_cast<float>(sum > 0.0 ? next / sum : t);
}

Rgb mix(const Rgb& previous, const Rgb& next, float weight) {
  if (weight == 0.0f) return previous;
  if (weight == 1.0f) return next;
  return previous + weight * (next - previous);
}

class DepthAgreement {
 public:
  explicit DepthAgreement(const Visibility& target)
      : target_(target),
        rays_(target.camera),
        halfSample_(static_cast<float>(0.5 / target.camera.focalPixels())) {}

  [[nodiscard]] bool operator()(int x, int y, float a, float b) const {
    if (a == b) return true;  // both infinite, too
    // The nearer one: infinitely far is never within the tolerance of a finite depth.
    const float nearer = std::min(a, b);
    const float across = halfSample_ * nearer;
    const float slope = std::abs(glm::dot(target_.normal(x, y), rays_.through(x, y)));
    return std::abs(a - b) * (slope > 0.0f ? std::min(slope, 1.0f) : 1.0f) <= across;
  }

 private:
  const Visibility& target_;
  RayBasis rays_;
  float halfSample_;
};

void require(bool good, const char* expected) {
  if (!good) throw InputError("blend", std::string("expected ") + expected);
}

bool hasSize(const Warped& warped, Size size) {
  return warped.diffuse.size() == size && warped.viewDependent.size() == size &&
         warped.depth.size() == size && warped.validity.size() == size && warped.footprint.size() == size;
}

}  // namespace

Blended blend(const Warped& previous, const Warped& next, Visibility target, double t) {
  const Size size = target.camera.size();
  require(hasSize(previous, size) && hasSize(next, size) && target.normal.size() == size,
          "two warped frames of the target's size");
  require(t >= 0.0 && t <= 1.0, "t within 0 and 1");

  Blended blended{{{}, RadianceMap(size), RadianceMap(size), SourceMap(size)}, Mask(size)};
  Frame& frame = blended.frame;
  const DepthAgreement sameDepth(target);
  const auto weight = [&](int x, int y) {
    if (next.validity(x, y) != Validity::kValid) return 0.0f;
    if (previous.validity(x, y) != Validity::kValid) return 1.0f;
    if (t == 0.0 || t == 1.0) return static_cast<float>(t);
    const float before = previous.depth(x, y);
    const float after = next.depth(x, y);
    if (!sameDepth(x, y, before, after)) return before < after ? 0.0f : 1.0f;
    return weightOfNext(quality(previous.footprint(x, y), previous.footprintLimit),
                        quality(next.footprint(x, y), next.footprintLimit), t);
  };
  tbb::parallel_for(0, size.height, [&](int y) {
    for (int x = 0; x < size.width; ++x) {
      if (previous.validity(x, y) != Validity::kValid && next.validity(x, y) != Validity::kValid) {
        blended.holes(x, y) = 1;
        frame.source(x, y) = SampleSource::kBlended;  // anything but traced, until it is
        continue;
      }
      const float w = weight(x, y);
      frame.diffuse(x, y) = mix(previous.diffuse(x, y), next.diffuse(x, y), w);
      frame.viewDependent(x, y) = mix(previous.viewDependent(x, y), next.viewDependent(x, y), w);
      frame.source(x, y) = w == 0.0f   ? SampleSource::kWarpedFromPrevious
                           : w == 1.0f ? SampleSource::kWarpedFromNext
                                       : SampleSource::kBlended;
    }
  });
  frame.visibility = std::move(target);
  return blended;
}

Blended fillHoles(Blended blended, const Warped& more, SampleSource source) {
  const Size size = blended.holes.size();
  require(hasSize(more, size), "a warped frame of the blended frame's size");
  tbb::parallel_for(0, size.height, [&](int y) {
    for (int x = 0; x < size.width; ++x) {
      if (blended.holes(x, y) == 0 || more.validity(x, y) != Validity::kValid) continue;
      blended.frame.diffuse(x, y) = more.diffuse(x, y);
      blended.frame.viewDependent(x, y) = more.viewDependent(x, y);
      blended.frame.source(x, y) = source;
      blended.holes(x, y) = 0;
    }
  });
  return blended;
}

}  // namespace promenade::ibr
