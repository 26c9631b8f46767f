#include "ibr/view_layer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <optional>

#include "ibr/source_surface.h"
#include "src/core/display.h"
#include "src/core/errors.h"

namespace promenade::ibr {
namespace {

constexpr int kFewest = 3;  ///< a plane through fewer is a guess
/// Between the largest and the smallest of the 8 samples that are usually known around one, in standard
/// deviations of normal noise: exceeded by one in thirty (the mean is 2.85; Tippett 1925).
constexpr float kRangeOfNoise = 4.5f;

/// Weighted least squares of value = c + g.d for c, the value at d = 0, with a little ridge on g: c = sum w_k
/// (q . (1, d_k)) v_k, with M q = (1, 0, 0), M the matrix of moments. Here sums are kept as they are, since
/// values are few.
class PlaneFit {
 public:
  void add(glm::vec2 d, const Rgb& value) {
    const float w = 1.0f / (d.x * d.x + d.y * d.y);  // never 0: the position itself is not known
    s_ += w;
    s1_ += w * d;
    sxx_ += w * d.x * d.x;
    sxy_ += w * d.x * d.y;
    syy_ += w * d.y * d.y;
    v_ += w * value;
    vx_ += w * d.x * value;
    vy_ += w * d.y * value;
    low_ = glm::min(low_, value);
    high_ = glm::max(high_, value);
  }
  [[nodiscard]] Rgb value() const {
    const float ridge = 0.01f * s_;
    const float sxx = sxx_ + ridge;
    const float syy = syy_ + ridge;
    // q by Cramer's rule; the determinant is positive, since M is positive definite.
    const float q0 = sxx * syy - sxy_ * sxy_;
    const glm::vec2 q(sxy_ * s1_.y - s1_.x * syy, sxy_ * s1_.x - s1_.y * sxx);
    const float determinant = s_ * q0 + s1_.x * q.x + s1_.y * q.y;
    return glm::clamp((q0 * v_ + q.x * vx_ + q.y * vy_) / determinant, low_, high_);
  }

 private:
  float s_ = 0.0f;
  glm::vec2 s1_{0.0f};
  float sxx_ = 0.0f;
  float sxy_ = 0.0f;
  float syy_ = 0.0f;
  Rgb v_{0.0f};
  Rgb vx_{0.0f};
  Rgb vy_{0.0f};
  Rgb low_{std::numeric_limits<float>::max()};
  Rgb high_{std::numeric_limits<float>::lowest()};
};

class Interpolation {
 public:
  Interpolation(const Frame& frame, const Mask& known, const ViewLayerSettings& settings)
      : frame_(frame),
        known_(known),
        settings_(settings),
        surface_(frame.visibility, frame.visibility.camera.pose().eye, settings.creaseDegrees) {}

  [[nodiscard]] std::optional<Rgb> at(int x, int y) const {
    const SurfacePoint point = surface_.pointOf(x, y);
    PlaneFit fit;
    int count = 0;
    float low = std::numeric_limits<float>::max();
    float high = 0.0f;
    float whole = 0.0f;
    for (int j = y - settings_.reach; j <= y + settings_.reach; ++j) {
      for (int i = x - settings_.reach; i <= x + settings_.reach; ++i) {
        if (!known_.contains(i, j) || known_(i, j) == 0 || !surface_.agrees(i, j, point)) continue;
        const Rgb& value = frame_.viewDependent(i, j);
        const float bright = luminance(value);
        low = std::min(low, bright);
        high = std::max(high, bright);
        whole += bright + luminance(frame_.diffuse(i, j));
        fit.add(glm::vec2(i - x, j - y), value);
        ++count;
      }
    }
    if (count < kFewest) return std::nullopt;
    const float mean = whole / static_cast<float>(count);
    const float noise = settings_.noise ? settings_.noise(frame_.visibility.item(x, y)) : 0.0f;
    const float largestRange = static_cast<float>(settings_.largestRange) + kRangeOfNoise * noise;
    if (high - low > largestRange * mean) return std::nullopt;
    return fit.value();
  }

 private:
  const Frame& frame_;
  const Mask& known_;
  const ViewLayerSettings& settings_;
  SampledSurface surface_;
};

}  // namespace

ViewLayer interpolateViewLayer(const Frame& frame, const Mask& known, const Mask& wanted,
                               const ViewLayerSettings& settings) {
  const Size size = frame.visibility.camera.size();
  if (known.size() != size || wanted.size() != size) {
    throw InputError("view-dependent layer", "expected masks of the frame's size");
  }
  if (settings.reach < 1 || !(settings.largestRange > 0.0)) {
    throw InputError("view-dependent layer", "expected a reach of at least 1 and a range above 0");
  }
  ViewLayer layer{RadianceMap(size), Mask(size)};
  const Interpolation interpolation(frame, known, settings);
  tbb::parallel_for(0, size.height, [&](int y) {
    for (int x = 0; x < size.width; ++x) {
      if (wanted(x, y) == 0 || known(x, y) != 0) continue;
      const std::optional<Rgb> found = interpolation.at(x, y);
      if (!found) continue;
      layer.viewDependent(x, y) = *found;
      layer.found(x, y) = 1;
    }
  });
  return layer;
}

}  // namespace promenade::ibr
