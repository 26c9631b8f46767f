#pragma once
// The light that falls on a surface element, by direction: what reflections too broad to be traced from
// every sample need to know (radiance caching: Krivanek, Gautron, Pattanaik, Bouatouch, Radiance Caching for
// Efficient Global Illumination Computation, IEEE TVCG 11(5), 2005). Directions are the cells of a map of the
// hemisphere instead of spherical harmonics: they never ring below zero, a lamp stays where it is, and they
// can be finest near the horizon, where Fresnel's reflection changes fast. Not part of the folder's public
// face.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "src/core/image.h"

namespace promenade::render {

/// Mean radiance in each cell, as a multiple of a unit that its owner keeps.
class LightField {
 public:
  /// The concentric map from square to disk, whose radius r then becomes height z = (1 - r^2)^2.
  static constexpr int kSide = 16;
  static constexpr std::size_t kCells = std::size_t{kSide} * kSide;

  /// A number for each cell, aligned for kLanes at a time.
  static constexpr std::size_t kLanes = 8;
  static_assert(kCells % kLanes == 0);
  struct Weights {
    alignas(kLanes * sizeof(float)) std::array<float, kCells> cell;
    [[nodiscard]] float* at(std::size_t i) { return cell.data() + i; }
    [[nodiscard]] const float* at(std::size_t i) const { return cell.data() + i; }
    [[nodiscard]] float sum() const;
  };

  /// Unit vectors of the middles of the cells; z along the surface's normal.
  [[nodiscard]] static const std::array<glm::vec3, kCells>& directions();
  /// Their solid angles; the sum is 2 pi.
  [[nodiscard]] static const std::array<float, kCells>& solidAngles();
  /// A point of the unit square as a direction: all cells are equally likely. Density per solid angle.
  [[nodiscard]] static glm::vec3 sample(glm::vec2 u);
  [[nodiscard]] static float pdf(const glm::vec3& direction);

  [[nodiscard]] Rgb at(std::size_t cell) const;
  void set(std::size_t cell, const Rgb& radiance);
  /// Sum of the cells, each times its weight.
  [[nodiscard]] Rgb weighted(const Weights& weights) const;

  /// For files: nine bits a channel and a shared exponent.
  [[nodiscard]] std::array<std::uint32_t, kCells>& packed() { return packed_; }
  [[nodiscard]] const std::array<std::uint32_t, kCells>& packed() const { return packed_; }

 private:
  alignas(kLanes * sizeof(std::uint32_t)) std::array<std::uint32_t, kCells> packed_{};
};

/// Collects what paths and light samples bring to a surface element. Directions are local, z > 0.
class FieldSums {
 public:
  /// Kinds of light that may be sampled differently often.
  static constexpr std::size_t kKinds = 3;

  /// `radiance` arrived along a direction, however that was chosen.
  void addPath(const glm::vec3& direction, const Rgb& radiance);
  /// `share` of the radiance of a white matt surface (its mean is taken over the samples of that kind, below)
  /// is due to a light in this direction.
  void addLight(std::size_t kind, const glm::vec3& direction, const Rgb& share);
  /// `samples`: what the shares of each kind are divided by; 0 where it has none. `unit` > 0.
  [[nodiscard]] LightField finish(const std::array<int, kKinds>& samples, float unit) const;

 private:
  /// Mean radiance of the paths in each cell.
  [[nodiscard]] std::array<Rgb, LightField::kCells> seen() const;

  std::array<Rgb, LightField::kCells> paths_{};
  std::array<float, LightField::kCells> weights_{};
  std::array<std::array<Rgb, LightField::kCells>, kKinds> lights_{};
};

}  // namespace promenade::render
