#pragma once
// Places where the light that falls on a surface is known, and interpolation between them.
// Ward, Rubinstein, Clear, A Ray Tracing Solution for Diffuse Interreflection (SIGGRAPH 1988); weights that
// reach zero at the end of a record's reach: Tabellion, Lamorlette, An Approximate Global Illumination System
// for Computer Generated Films (SIGGRAPH 2004), sec. 4. Not part of the folder's public face.
//
// Departures: a record also keeps the mean direction of its light, so that normal maps and smooth normals
// shade; records are placed before any light is gathered, so that neither their order nor the number of
// threads matters.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <unordered_map>
#include <vector>

#include "src/core/image.h"

namespace promenade::render {

struct RecordPlace {
  glm::vec3 position{0.0f};
  glm::vec3 normal{0.0f};  ///< geometric, unit, on the lit side
  float reach = 0.0f;      ///< > 0: the record says nothing farther away than this
};

/// Light on a surface element.
struct SurfaceLight {
  /// Radiance of a white matt surface under it: irradiance / pi.
  Rgb radiance{0.0f};
  /// Integral of L cos w over that of L cos (luminance-weighted), world space, length in [0, 1]: 2/3 of the
  /// normal under a uniform sky, a unit vector for a single small light.
  glm::vec3 meanDirection{0.0f};
};

/// The same light on an element at the same place that is turned from `normal` to `turned` (both unit). Exact
/// for a uniform sky and for a single small light, plausible between.
[[nodiscard]] Rgb radianceOnTurned(const SurfaceLight& light, const glm::vec3& normal,
                                   const glm::vec3& turned);

class IrradianceRecords {
 public:
  /// Whether a record of reach at most `mostReach` lies near enough that another would add nothing.
  [[nodiscard]] bool covers(const glm::vec3& position, const glm::vec3& normal, float mostReach) const;
  void place(const RecordPlace& place);

  [[nodiscard]] const std::vector<RecordPlace>& places() const { return places_; }
  /// As many as places(). Records whose light was never set are black.
  void setLight(std::vector<SurfaceLight> light);

  /// Nothing where no record reaches.
  [[nodiscard]] std::optional<SurfaceLight> at(const glm::vec3& position, const glm::vec3& normal) const;

 private:
  /// Records are filed by the power of two above their reach, in every cell of that size that they may touch.
  struct Cell {
    std::int32_t level, x, y, z;
    friend bool operator==(const Cell&, const Cell&) = default;
  };
  struct CellHash {
    std::size_t operator()(const Cell& cell) const;
  };
  static Cell cellOf(int level, const glm::vec3& position);
  template <class Visit>
  void forEachNear(const glm::vec3& position, const Visit& visit) const;

  std::vector<RecordPlace> places_;
  std::vector<SurfaceLight> light_;
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells_;
  std::vector<int> levels_;  // in use, sorted
};

}  // namespace promenade::render
