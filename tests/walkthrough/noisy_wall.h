#pragma once
// A grey wall whose noise falls with the root of the paths, as that of path tracing does.

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include "tests/walkthrough/grey_wall.h"

namespace promenade::tests {

class NoisyWall final : public GreyWall {
 public:
  static constexpr float kGrey = 0.3f;
  using Contrast = std::function<double(int x, int y)>;  ///< of one path; negative: the sample needs none

  NoisyWall(Size samples, Contrast contrast, unsigned seed)
      : contrast_(std::move(contrast)), seed_(seed), paths_(samples) {}

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

  [[nodiscard]] int pathsOf(int x, int y) const { return paths_(x, y); }

 private:
  Contrast contrast_;
  unsigned seed_;
  mutable Image<int> paths_;
};

}  // namespace promenade::tests
