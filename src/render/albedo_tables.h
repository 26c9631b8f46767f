#pragma once
// How much a rough GGX surface reflects in all, for a direction and a roughness: what energy conservation
// needs. Tables are computed once per process, on first use, from visible-normal quadrature.

#include <array>
#include <cstddef>
#include <vector>

namespace promenade::render {

/// Single-scattering albedo of a GGX reflection whose Fresnel term is Schlick's is f0 * scale + f90 * bias
/// (Karis, Real Shading in Unreal Engine 4, SIGGRAPH 2013 course, eq. 8).
struct SpecularAlbedo {
  float scale = 1.0f;
  float bias = 0.0f;
  /// With a Fresnel term of 1.
  [[nodiscard]] float whole() const { return scale + bias; }
  [[nodiscard]] float of(float f0, float f90) const { return f0 * scale + f90 * bias; }
};

class SpecularAlbedoTable {
 public:
  SpecularAlbedoTable();
  /// `cosine` in [0, 1], `roughness` perceptual in [0, 1].
  [[nodiscard]] SpecularAlbedo directional(float cosine, float roughness) const;
  /// Cosine-weighted mean of directional() over the hemisphere.
  [[nodiscard]] SpecularAlbedo average(float roughness) const;

 private:
  static constexpr std::size_t kCosines = 48;
  static constexpr std::size_t kRoughnesses = 48;
  static constexpr std::size_t kAverages = 128;
  using Table = std::array<std::array<float, kCosines>, kRoughnesses>;
  Table whole_;      ///< over cosines relative to alpha
  Table biasShare_;  ///< bias over whole, over cosines
  std::array<SpecularAlbedo, kAverages> average_;
};

/// The share of light that a rough dielectric boundary reflects and refracts together in single scattering;
/// the rest is what masking and shadowing lose.
class BoundaryAlbedoTable {
 public:
  BoundaryAlbedoTable();
  /// `relativeIor`: far side over near side; outside [1/3, 3] the nearest of the two ends is read.
  [[nodiscard]] float directional(float cosine, float roughness, float relativeIor) const;

 private:
  static constexpr std::size_t kCosines = 24;
  static constexpr std::size_t kRoughnesses = 20;
  static constexpr std::size_t kIors = 10;
  std::vector<float> values_;
};

[[nodiscard]] const SpecularAlbedoTable& specularAlbedoTable();
[[nodiscard]] const BoundaryAlbedoTable& boundaryAlbedoTable();

}  // namespace promenade::render
