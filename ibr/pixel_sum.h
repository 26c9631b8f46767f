#pragma once
// A display pixel, put together from samples at any places in it.

#include <glm/vec2.hpp>
#include <vector>

#include "src/core/image.h"

namespace promenade::ibr {

/// The mean over the square of the pixel. Samples of several frames come close to each other here and leave
/// gaps there, by chance; weighing them alike would converge as slowly as chance does. So the pixel is cut
/// into cells; a sample counts for the up to four cells around it by closeness to their middles, and the
/// pixel is the mean of its cells, as a plane through them has it in the middle of the pixel: what lies to
/// one side stands for that side only. Nothing outside of the pixel enters, so nothing is softened.
class PixelSum {
 public:
  PixelSum() = default;
  /// `edge`: cells along the pixel's edge, >= 1.
  explicit PixelSum(int edge);

  /// A frame of this weight looks at the pixel: the sum of these is what weights of samples that fill it add
  /// up to, each being the area of a sample times the weight of its frame.
  void addWhole(float weight) { whole_ += weight; }
  /// A sample at `place` in [0, 1) along x and y.
  void add(glm::vec2 place, const Rgb& radiance, float weight);

  /// Black if nothing was added; never beyond what the cells have.
  [[nodiscard]] Rgb mean() const;

 private:
  /// Sums of shares of samples.
  struct Cell {
    Rgb radiance{0.0f};
    glm::vec2 place{0.0f};
    float weight = 0.0f;
  };

  int edge_ = 0;
  std::vector<Cell> cells_;
  float whole_ = 0.0f;
};

}  // namespace promenade::ibr
