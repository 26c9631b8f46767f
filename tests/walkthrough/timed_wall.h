#pragma once
// A grey wall, noisy as path tracing is and wrong as a light solution may be, whose paths take time on a
// clock that nothing else moves.

#include <cmath>
#include <random>

#include "tests/walkthrough/grey_wall.h"

namespace promenade::tests {

struct WallLook {
  double contrast = 0.0;        ///< of a single path
  double gain = 1.0;            ///< of the grey that it should be
  double secondsPerPath = 1.0;  ///< of the whole frame
  unsigned seed = 1;
};

class TimedWall final : public GreyWall {
 public:
  static constexpr double kGrey = 0.2;

  /// `now` must outlive this.
  TimedWall(const WallLook& look, double& now) : look_(look), now_(now) {}

  [[nodiscard]] Refined refine(Frame& frame, const Mask& mask, PathRange paths, int) const override {
    now_ += look_.secondsPerPath * paths.count;
    std::mt19937 random(look_.seed * 7919u + static_cast<unsigned>(paths.before));
    std::normal_distribution<double> normal;
    const double share = static_cast<double>(paths.count) / (paths.before + paths.count);
    Refined refined{Mask(mask.size()), 0};
    for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
      const double deviation = normal(random);
      if (mask.pixels()[i] == 0) continue;
      const double traced = kGrey * look_.gain * (1.0 + look_.contrast * deviation / std::sqrt(paths.count));
      float& value = frame.diffuse.pixels()[i].x;
      value = static_cast<float>((1.0 - share) * value + share * traced);
      frame.diffuse.pixels()[i] = Rgb(value);
      refined.open.pixels()[i] = look_.contrast > 0.0 ? 1 : 0;
    }
    return refined;
  }

 private:
  WallLook look_;
  double& now_;
};

}  // namespace promenade::tests
