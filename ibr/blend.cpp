#include "ibr/blend.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "ibr/angle.h"
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

Rgb mix(const Rgb& previous, const Rgb& next, float weight) {
  return weight == 1.0f ? next : previous + weight * (next - previous);
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

/// How a source looks at a surface, beside how the target does.
struct OtherLook {
  float slantChange = 0.0f;  ///< Blended::slantChange
  float turn = 0.0f;         ///< Blended::turn
};

/// How surfaces of the target lie to the eyes that look at them.
class LinesOfSight {
 public:
  explicit LinesOfSight(const Visibility& target)
      : target_(target), rays_(target.camera), eye_(target.camera.pose().eye) {}

  [[nodiscard]] OtherLook from(const glm::dvec3& sourceEye, int x, int y) const {
    const glm::vec3 fromHere = target_.depth(x, y) * rays_.through(x, y);
    const glm::vec3 fromThere = fromHere + glm::vec3(eye_ - sourceEye);
    return {std::abs(std::log(cosine(fromThere, x, y) / cosine(fromHere, x, y))),
            angleBetween(fromHere, fromThere)};
  }

 private:
  [[nodiscard]] float cosine(const glm::vec3& toPoint, int x, int y) const {
    return glm::dot(target_.normal(x, y), toPoint) / glm::length(toPoint);
  }

  const Visibility& target_;
  RayBasis rays_;
  glm::dvec3 eye_;
};

struct Mean {
  Rgb diffuse{0.0f};
  Rgb viewDependent{0.0f};
  SampleSource source = SampleSource::kBlended;
  OtherLook look{};  ///< 0 where both sides count
};

/// What one source shows at one sample.
struct Shown {
  WarpedSample sample;
  float depth = 0.0f;
  double footprintLimit = 0.0;
  double time = 0.0;
  glm::dvec3 eye{0.0};
  double weight = 0.0;  ///< as it counts; 0: it does not
};

Shown shownBy(const BlendSource& source, const Visibility& target, int x, int y) {
  if (const auto* gather = std::get_if<const SampleGather*>(&source.warped)) {
    return {(**gather)(x, y), target.depth(x, y), (*gather)->footprintLimit(), source.time, (*gather)->eye()};
  }
  const Warped& warped = *std::get<const Warped*>(source.warped);
  return {{warped.validity(x, y), warped.footprint(x, y), warped.diffuse(x, y), warped.viewDependent(x, y)},
          warped.depth.empty() ? target.depth(x, y) : warped.depth(x, y),
          warped.footprintLimit,
          source.time,
          warped.eye};
}

/// The sources that count at one sample: those that are `wanted` there.
class Counting {
 public:
  Counting(std::span<Shown> sources, const DepthAgreement& sameDepth, const LinesOfSight& lines, double time,
           int x, int y, Validity wanted)
      : sources_(sources), sameDepth_(sameDepth), lines_(lines), time_(time), x_(x), y_(y), wanted_(wanted) {
    for (const Shown& source : sources_) {
      if (source.sample.validity != wanted) continue;
      if (source.time == time) exact_ = &source;
      if (isNone_ || source.depth < nearest_) nearest_ = source.depth;
      isNone_ = false;
    }
  }
  [[nodiscard]] bool none() const { return isNone_; }

  /// Precondition: not none().
  [[nodiscard]] Mean mean() {
    if (exact_ != nullptr) {
      return {
          exact_->sample.diffuse, exact_->sample.viewDependent,
          exact_ == &sources_.front() ? SampleSource::kWarpedFromPrevious : SampleSource::kWarpedFromNext};
    }
    const auto qualityOf = [&](const Shown& source) {
      const float footprint = source.sample.footprint;
      return wanted_ == Validity::kValid ? quality(footprint, source.footprintLimit)
                                         : 1.0 / static_cast<double>(footprint);
    };
    const auto [mean, weight] = weighted(qualityOf);
    // All at their limit: none is better.
    return weight > 0.0 ? mean : weighted([](const Shown&) { return 1.0; }).mean;
  }

 private:
  struct Weighted {
    Mean mean;
    double weight = 0.0;
  };
  template <class QualityOf>
  [[nodiscard]] Weighted weighted(const QualityOf& qualityOf) {
    Weighted sum;
    bool earlier = false;
    bool later = false;
    for (Shown& source : sources_) {
      const bool counts = source.sample.validity == wanted_ && sameDepth_(x_, y_, nearest_, source.depth);
      source.weight = counts ? qualityOf(source) / std::abs(time_ - source.time) : 0.0;
      if (!(source.weight > 0.0)) continue;
      sum.weight += source.weight;
      (source.time < time_ ? earlier : later) = true;
      // One after the other: sources that agree to the bit give that value to the bit.
      const auto part = static_cast<float>(source.weight / sum.weight);
      sum.mean.diffuse = mix(sum.mean.diffuse, source.sample.diffuse, part);
      sum.mean.viewDependent = mix(sum.mean.viewDependent, source.sample.viewDependent, part);
    }
    sum.mean.source = earlier && later ? SampleSource::kBlended
                      : earlier        ? SampleSource::kWarpedFromPrevious
                                       : SampleSource::kWarpedFromNext;
    if (earlier != later && wanted_ == Validity::kValid && std::isfinite(nearest_))
      sum.mean.look = otherLook();
    return sum;
  }

  /// By the weights of weighted().
  [[nodiscard]] OtherLook otherLook() const {
    double slantChange = 0.0;
    double turn = 0.0;
    double weights = 0.0;
    for (const Shown& source : sources_) {
      if (!(source.weight > 0.0)) continue;
      const OtherLook look = lines_.from(source.eye, x_, y_);
      slantChange += source.weight * static_cast<double>(look.slantChange);
      turn += source.weight * static_cast<double>(look.turn);
      weights += source.weight;
    }
    return {static_cast<float>(slantChange / weights), static_cast<float>(turn / weights)};
  }

  std::span<Shown> sources_;
  const DepthAgreement& sameDepth_;
  const LinesOfSight& lines_;
  double time_;
  int x_;
  int y_;
  Validity wanted_;
  const Shown* exact_ = nullptr;  ///< that of this very time
  float nearest_ = 0.0f;          ///< depth
  bool isNone_ = true;
};

void requireForBlend(bool good, const char* expected) {
  if (!good) throw InputError("blend", std::string("expected ") + expected);
}

bool hasSize(const BlendSource& source, Size size) {
  if (const auto* gather = std::get_if<const SampleGather*>(&source.warped)) return (*gather)->size() == size;
  const Warped& warped = *std::get<const Warped*>(source.warped);
  return warped.diffuse.size() == size && warped.viewDependent.size() == size &&
         (warped.depth.empty() || warped.depth.size() == size) && warped.validity.size() == size &&
         warped.footprint.size() == size;
}

}  // namespace

Blended blend(std::span<const BlendSource> sources, Visibility&& target, double time) {
  const Size size = target.camera.size();
  requireForBlend(!sources.empty() && target.normal.size() == size,
                  "a source and a target with all its maps");
  for (std::size_t i = 0; i < sources.size(); ++i) {
    requireForBlend(hasSize(sources[i], size), "warped frames of the target's size");
    requireForBlend(i == 0 || sources[i - 1].time < sources[i].time, "sources in the order of time");
  }
  requireForBlend(time >= sources.front().time && time <= sources.back().time,
                  "a time between those of the sources");

  Blended blended{{{}, RadianceMap(size), RadianceMap(size), SourceMap(size)},
                  Mask(size),
                  decltype(Blended::slantChange)(size),
                  decltype(Blended::turn)(size)};
  const DepthAgreement sameDepth(target);
  const LinesOfSight lines(target);
  tbb::parallel_for(0, size.height, [&](int y) {
    std::vector<Shown> shown(sources.size());
    for (int x = 0; x < size.width; ++x) {
      for (std::size_t i = 0; i < sources.size(); ++i) shown[i] = shownBy(sources[i], target, x, y);
      const auto put = [&](const Mean& mean) {
        blended.frame.diffuse(x, y) = mean.diffuse;
        blended.frame.viewDependent(x, y) = mean.viewDependent;
        blended.frame.source(x, y) = mean.source;
        blended.slantChange(x, y) = mean.look.slantChange;
        blended.turn(x, y) = mean.look.turn;
      };
      Counting fine(shown, sameDepth, lines, time, x, y, Validity::kValid);
      if (!fine.none()) {
        put(fine.mean());
        continue;
      }
      blended.holes(x, y) = 1;
      Counting coarse(shown, sameDepth, lines, time, x, y, Validity::kUndersampled);
      put(coarse.none() ? Mean{Rgb(0.0f), Rgb(0.0f), SampleSource::kUnknown, {}} : coarse.mean());
    }
  });
  blended.frame.visibility = std::move(target);
  return blended;
}

Blended blend(const Warped& previous, const Warped& next, Visibility target, double t) {
  const std::array<BlendSource, 2> sources{{{&previous, 0.0}, {&next, 1.0}}};
  return blend(sources, std::move(target), t);
}

}  // namespace promenade::ibr
