#pragma once
// How much a rough GGX surface reflects in all, for a direction and a roughness: what energy conservation
// needs. Tables are computed once per process, on first use, from visible-normal quadrature.

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include "src/render/microfacet.h"

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

/// An axis of a table: the entry below a place on it and the fraction of the way to the next.
struct TablePosition {
  std::size_t index;
  float fraction;
  /// `unit` in [0, 1] (clamped) is the place on an axis of `count` entries.
  static TablePosition on(float unit, std::size_t count) {
    const float scaled = std::clamp(unit, 0.0f, 1.0f) * static_cast<float>(count - 1);
    const std::size_t index = std::min(static_cast<std::size_t>(scaled), count - 2);
    return {index, scaled - static_cast<float>(index)};
  }
  [[nodiscard]] float read(const float* entries) const {
    return entries[index] + (entries[index + 1] - entries[index]) * fraction;
  }
};

class SpecularAlbedoTable {
 public:
  SpecularAlbedoTable();

  static constexpr std::size_t kCosines = 48;
  /// whole() of one roughness, over maskingCoordinate().
  using Masking = std::array<float, kCosines>;

  /// The table at one roughness; the table must outlive it.
  class Row {
   public:
    /// `cosine` in [0, 1].
    [[nodiscard]] SpecularAlbedo directional(float cosine) const {
      if (whole_ == nullptr) return {1.0f - schlickWeight(cosine), schlickWeight(cosine)};
      const float whole = read(whole_, maskingCoordinate(cosine, alpha_));
      const float bias = whole * (schlickWeight(cosine) + read(biasShare_, fresnelCoordinate(cosine)));
      return {whole - bias, bias};
    }
    /// For look-ups of many cosines. Not of a smooth surface.
    [[nodiscard]] Masking masking() const {
      assert(whole_ != nullptr);
      Masking entries;
      for (std::size_t i = 0; i < kCosines; ++i) {
        entries[i] = whole_[i] + (whole_[kCosines + i] - whole_[i]) * fraction_;
      }
      return entries;
    }
    /// Cosine-weighted mean of directional() over the hemisphere.
    [[nodiscard]] const SpecularAlbedo& average() const { return average_; }

   private:
    friend class SpecularAlbedoTable;
    [[nodiscard]] float read(const float* row, float coordinate) const {
      const TablePosition c = TablePosition::on(coordinate, kCosines);
      const float low = c.read(row);
      return low + (c.read(row + kCosines) - low) * fraction_;
    }
    const float* whole_ = nullptr;  // the row below and, after it, the one above; null: smooth, known exactly
    const float* biasShare_ = nullptr;
    float fraction_ = 0.0f;
    float alpha_ = 0.0f;
    SpecularAlbedo average_{20.0f / 21.0f, 1.0f / 21.0f};  // of Schlick's weight, where smooth
  };
  /// `roughness` perceptual in [0, 1]; below kSmoothRoughness: a smooth surface.
  [[nodiscard]] Row at(float roughness) const;

  // Masking depends on the cosine over alpha: this axis has its entries where the albedo changes at every
  // roughness (the root, for the steep rise at grazing angles), and between two roughnesses like is mixed
  // with like.
  static float maskingCoordinate(float cosine, float alpha) {
    return std::sqrt(cosine * (1.0f + alpha) / (cosine + alpha));
  }
  // Fresnel's weight depends on the cosine alone, most of all at grazing angles.
  static float fresnelCoordinate(float cosine) { return std::sqrt(cosine); }

 private:
  static constexpr std::size_t kRoughnesses = 48;
  static constexpr std::size_t kAverages = 128;
  using Table = std::array<float, kCosines * kRoughnesses>;
  Table whole_;      // over cosines relative to alpha
  Table biasShare_;  // bias over whole, less Schlick's weight of the cosine (its smooth limit), over cosines
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
