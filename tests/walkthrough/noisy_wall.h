#pragma once
// A grey wall whose noise falls with the root of the paths, as that of path tracing does.

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include "src/core/renderer.h"

namespace promenade::tests {

class NoisyWall final : public Renderer {
 public:
  static constexpr float kGrey = 0.3f;
  using Contrast = std::function<double(int x, int y)>;  ///< of one path; negative: the sample needs none

  NoisyWall(Size samples, Contrast contrast, unsigned seed)
      : contrast_(std::move(contrast)), seed_(seed), paths_(samples) {}

  [[nodiscard]] Visibility visibility(const Camera& camera) const override {
    return {camera, DepthMap(camera.size(), 1.0f), NormalMap(camera.size()), ItemBuffer(camera.size(), 1u)};
  }
  void retrace(Frame&, const Mask&, SampleSource, int) const override {}
  [[nodiscard]] Frame render(const Camera& camera, int) const override {
    return unshaded(visibility(camera));
  }
  [[nodiscard]] Refined refine(Frame& frame, const Mask& mask, PathRange paths, int) const override {
    Refined refined{Mask(mask.size()), 0};
    std::mt19937 random(seed_ * 7919u + static_cast<unsigned>(paths.before));
    std::normal_distribution<double> normal;
    for (int y = 0; y < mask.height(); ++y) {
      for (int x = 0; x < mask.width(); ++x) {
        const double deviation = normal(random);  // drawn for all, so that none depends on the mask
        if (mask(x, y) == 0) continue;
        const double contrast = contrast_(x, y);
        const double now = kGrey * (1.0 + std::max(contrast, 0.0) * deviation / std::sqrt(paths.count));
        const double all = (static_cast<double>(frame.diffuse(x, y).x) * paths.before + now * paths.count) /
                           (paths.before + paths.count);
        frame.diffuse(x, y) = Rgb(static_cast<float>(all));
        refined.open(x, y) = contrast >= 0.0 ? 1 : 0;
        refined.paths += static_cast<std::uint64_t>(paths.count);
        paths_(x, y) += paths.count;
      }
    }
    return refined;
  }
  [[nodiscard]] ItemTraits traits(ItemId) const override { return {}; }
  [[nodiscard]] RayCounts rayCounts() const override { return {}; }

  [[nodiscard]] int pathsOf(int x, int y) const { return paths_(x, y); }

 private:
  Contrast contrast_;
  unsigned seed_;
  mutable Image<int> paths_;
};

}  // namespace promenade::tests
