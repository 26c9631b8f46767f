#pragma once
// Random numbers of one path: hash-based Owen-scrambled Sobol points, two dimensions at a time.
// Burley, Practical Hash-based Owen Scrambling (JCGT 9(4), 2020), with the hash of Vegdahl (2021) for the
// scrambling. Each pair of dimensions is the 2D Sobol (0,2)-sequence with its own shuffling of indices and
// its own scrambling ("padding"), so the paths of one pixel are stratified in every pair, for every power of
// two.
//
// Neighbouring pixels share one sequence, in the order of a Z curve: Ahmed and Wonka, Screen-Space Blue-Noise
// Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of Pixels (ACM TOG 39(6), 2020). The
// paths of every aligned block of 2^k by 2^k pixels are then a stratified set too, so that what error is left
// lies in high spatial frequencies, where viewers are least sensitive, and largely cancels when samples are
// filtered to pixels.

#include <cstdint>
#include <glm/vec2.hpp>

namespace promenade::render {

/// A plain value: a counter and two words. The same arguments give the same numbers on every machine.
class Sampler {
 public:
  /// Which part of which sequence. Different frames and seeds get independently scrambled sequences.
  struct Stream {
    glm::uvec2 pixel{0, 0};
    std::uint32_t frame = 0;
    std::uint32_t seed = 0;
    /// How many paths a pixel will ask for, at least 1. A power of two stratifies blocks of pixels best.
    std::uint32_t pathsPerPixel = 1u << 12;
    /// How often so many came before. The further blocks of all pixels continue the sequence, so that what
    /// they share stays stratified.
    std::uint32_t block = 0;
  };

  /// `path` in [0, pathsPerPixel); any aligned block of 2^k of them is a stratified set.
  Sampler(const Stream& stream, std::uint32_t path);

  /// The next dimension, in [0, 1).
  [[nodiscard]] float next1D();
  /// The next pair of dimensions, in [0, 1)^2.
  [[nodiscard]] glm::vec2 next2D();

 private:
  struct Dimension {
    std::uint32_t index;
    std::uint32_t hash;
  };
  Dimension nextDimension();

  std::uint32_t reversedIndex_;
  std::uint32_t streamHash_;
  std::uint32_t dimension_ = 0;
};

}  // namespace promenade::render
