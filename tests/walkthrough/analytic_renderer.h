#pragma once
// A renderer whose scene is known in closed form: a wall at z = -6 with smooth waves (item 1), a panel on it
// (item 2) that may look different from everywhere, and a column in front of it (item 3). Counts what it
// shades.

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "tests/walkthrough/retracing_renderer.h"

namespace promenade::tests {

inline constexpr ItemId kWall = 1;
inline constexpr ItemId kPanel = 2;
inline constexpr ItemId kColumn = 3;

enum class Panel {
  kMatt,
  kMirrorLike,
  kGlossy,   ///< declared view dependent as well, but its reflection changes slowly over the panel
  kRippled,  ///< like kGlossy, but the reflection changes as fast as a mirror's
  kSheen,    ///< like kMirrorLike, but too rough to be declared view dependent
};

class AnalyticRenderer final : public RetracingRenderer {
 public:
  /// `noise`: standard deviation of a sample's radiance relative to its mean.
  explicit AnalyticRenderer(Panel panel, double noise = 0.0) : panel_(panel), noise_(noise) {}

  [[nodiscard]] Visibility visibility(const Camera& camera) const override {
    const Size size = camera.size();
    Visibility v{camera, DepthMap(size), NormalMap(size), ItemBuffer(size)};
    forEach(size, [&](int x, int y) {
      const Hit hit = trace(camera, x, y);
      v.depth(x, y) = hit.depth;
      v.normal(x, y) = glm::vec3(0.0f, 0.0f, 1.0f);
      v.item(x, y) = hit.item;
    });
    return v;
  }

  void retrace(Frame& frame, const Mask& mask, SampleSource source, int frameIndex) const override {
    forEach(mask.size(), [&](int x, int y) {
      if (mask(x, y) == 0) return;
      const Camera& camera = frame.visibility.camera;
      const Hit hit = trace(camera, x, y);
      const float noisy = noiseOf(x, y, frameIndex);
      frame.diffuse(x, y) = noisy * diffuse(hit);
      frame.viewDependent(x, y) = noisy * viewDependent(hit, camera);
      frame.source(x, y) = source;
      ++shaded_;
    });
  }

  [[nodiscard]] ItemTraits traits(ItemId item) const override {
    if (item != kPanel) return {};
    // Too little noise to hide anything.
    const bool isGlossy = panel_ == Panel::kGlossy || panel_ == Panel::kRippled;
    const float noise = isGlossy ? 1e-4f : 0.0f;
    return {isGlossy || panel_ == Panel::kMirrorLike, noise};
  }
  [[nodiscard]] RayCounts rayCounts() const override { return {0, shaded_, 0, 0}; }
  [[nodiscard]] std::uint64_t shaded() const { return shaded_; }

 private:
  struct Hit {
    float depth = std::numeric_limits<float>::infinity();
    ItemId item = kNoItem;
    glm::dvec3 point{0.0};
  };

  static void forEach(Size size, const std::function<void(int, int)>& body) {
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) body(x, y);
    }
  }

  [[nodiscard]] static Hit trace(const Camera& camera, int x, int y) {
    const glm::dvec3 d = camera.direction({x + 0.5, y + 0.5});
    const glm::dvec3 eye = camera.pose().eye;
    const auto at = [&](double z) { return (z - eye.z) / d.z; };
    const double toColumn = at(-4.0);
    if (toColumn > 0.0) {
      const glm::dvec3 p = eye + toColumn * d;
      if (std::abs(p.x + 1.0) < 0.2) return {static_cast<float>(toColumn), kColumn, p};
    }
    const double toWall = at(-6.0);
    if (!(toWall > 0.0)) return {};
    const glm::dvec3 p = eye + toWall * d;
    const bool onPanel = std::abs(p.x - 1.5) < 0.8 && std::abs(p.y) < 0.8;
    return {static_cast<float>(toWall), onPanel ? kPanel : kWall, p};
  }

  [[nodiscard]] static Rgb diffuse(const Hit& hit) {
    if (hit.item == kNoItem) return Rgb(0.2f);
    if (hit.item == kColumn) return Rgb(0.6f, 0.3f, 0.2f);
    const double wave = 0.5 + 0.2 * std::sin(2.0 * hit.point.x) * std::cos(2.0 * hit.point.y);
    return Rgb(static_cast<float>(wave));
  }

  [[nodiscard]] Rgb viewDependent(const Hit& hit, const Camera& camera) const {
    if (panel_ == Panel::kMatt || hit.item != kPanel) return Rgb(0.0f);
    const glm::dvec3 mirrored = hit.point - camera.pose().eye;
    const double frequency = panel_ == Panel::kGlossy ? 1.5 : 25.0;
    return Rgb(static_cast<float>(0.5 + 0.5 * std::sin(frequency * mirrored.x / mirrored.z)));
  }

  /// Exponentially distributed towards bright values, as the noise of path tracing is skewed.
  [[nodiscard]] float noiseOf(int x, int y, int frameIndex) const {
    if (noise_ == 0.0) return 1.0f;
    std::seed_seq seed{x, y, frameIndex};
    std::minstd_rand random(seed);
    std::exponential_distribution<double> exponential;
    return static_cast<float>(1.0 + noise_ * (exponential(random) - 1.0));
  }

  Panel panel_;
  double noise_;
  mutable std::atomic<std::uint64_t> shaded_{0};
};

}  // namespace promenade::tests
