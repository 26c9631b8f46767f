#pragma once
// Places where the light that falls on a surface is known, and interpolation between them.
// Ward, Rubinstein, Clear, A Ray Tracing Solution for Diffuse Interreflection (SIGGRAPH 1988); weights that
// reach zero at the end of a record's reach: Tabellion, Lamorlette, An Approximate Global Illumination System
// for Computer Generated Films (SIGGRAPH 2004), sec. 4. Not part of the folder's public face.
//
// Departures: a record also keeps the mean direction of its light, so that normal maps, smooth normals and
// curved surfaces shade; gradients come from the neighbouring records' light, not from the rays of one
// record, and the same fit takes the noise out of the light where the neighbours agree within it; records are
// placed before any light is gathered, a level at a time, so that neither their order nor the number of
// threads matters; where a finer level is needed is decided by what the coarser ones say
// (irradiance_solution.h).

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "src/core/image.h"
#include "src/render/basis.h"
#include "src/render/light_field.h"

namespace promenade::render {

struct RecordPlace {
  glm::vec3 position{0.0f};
  glm::vec3 normal{0.0f};  ///< geometric, unit, on the lit side
  float reach = 0.0f;      ///< > 0: the record says nothing farther away than this
};

/// The plane of a wall that stands on the surface of a record, within its reach: what lies behind it, the
/// record does not know.
struct RecordWall {
  glm::vec3 normal{0.0f};  ///< unit, on the record's side
  float offset = 0.0f;     ///< < 0: (place - record) . normal on the wall
};

/// Light on a surface element.
struct SurfaceLight {
  /// Radiance of a white matt surface under it: irradiance / pi.
  Rgb radiance{0.0f};
  /// Integral of L cos w over that of L cos (luminance-weighted), world space, length in [0, 1]: 2/3 of the
  /// normal under a uniform sky, a unit vector for a single small light.
  glm::vec3 meanDirection{0.0f};
  /// Standard error of the luminance of `radiance`.
  float error = 0.0f;
};

/// The same light on an element at the same place that is turned from `normal` to `turned` (both unit). Exact
/// for a uniform sky and for a single small light, plausible between.
[[nodiscard]] Rgb radianceOnTurned(const SurfaceLight& light, const glm::vec3& normal,
                                   const glm::vec3& turned);

class IrradianceRecords {
 public:
  /// What the records say of a place.
  struct Coverage {
    bool covered = false;     ///< a record is so near that another of its kind would add nothing
    bool coveredNew = false;  ///< ... and its light is not known yet
    /// Reach of the finest record near; infinite if there is none.
    float finestReach = std::numeric_limits<float>::infinity();
    /// Luminance that the lit records near the place give it, each by itself.
    float least = std::numeric_limits<float>::infinity();
    float most = 0.0f;
  };
  [[nodiscard]] Coverage coverage(const glm::vec3& position, const glm::vec3& normal) const;

  /// Most that a new record may reach so that it does not look past details that records near it, facing
  /// anywhere, know of: Krivanek, Bouatouch, Pattanaik, Zara, Making Radiance and Irradiance Caching
  /// Practical: Adaptive Caching and Neighbor Clamping (EGSR 2006), sec. 4. `slope`: reach gained per
  /// distance.
  [[nodiscard]] float clampedReach(const glm::vec3& position, float reach, float slope) const;

  void place(const RecordPlace& place, std::span<const RecordWall> walls = {});
  /// In the order of placing.
  [[nodiscard]] const std::vector<RecordPlace>& places() const { return places_; }
  [[nodiscard]] std::span<const RecordWall> wallsOf(std::size_t record) const {
    return std::span(walls_).subspan(firstWall_[record], firstWall_[record + 1] - firstWall_[record]);
  }

  /// What becomes of noise that a record's neighbours do not share. Where many paths bring the light of many
  /// records together, it averages out by itself, and must be left in: a record that is by chance too bright
  /// is also less sure of itself, so that what takes noise out makes the whole too dark (by 1.2 per cent in
  /// the Cornell box).
  enum class Noise { kTakenOut, kLeftIn };
  /// Light of the first records, as many as `light` has, as it was gathered; the others are ignored until
  /// theirs is set. `fields`: the same light by direction, in units of the luminance of its radiance; or
  /// nothing.
  void setLight(std::vector<SurfaceLight> light, std::vector<LightField> fields = {},
                Noise noise = Noise::kTakenOut);
  [[nodiscard]] const std::vector<SurfaceLight>& light() const { return gathered_; }
  [[nodiscard]] const std::vector<LightField>& fields() const { return fields_; }

  /// Nothing where no lit record reaches.
  [[nodiscard]] std::optional<SurfaceLight> at(const glm::vec3& position, const glm::vec3& normal) const;
  /// What one record that covers the place says: several times quicker than at(), and continuous only as far
  /// as neighbouring records agree. Good enough for light that bounces on. Records that reach farther than
  /// `mostReach` are left out.
  [[nodiscard]] std::optional<SurfaceLight> roughlyAt(
      const glm::vec3& position, const glm::vec3& normal,
      float mostReach = std::numeric_limits<float>::infinity()) const;
  /// Weights >= 0 for the cells of a light field in a frame (world space), solid angle included.
  using DirectionWeights = std::function<LightField::Weights(const Basis&)>;
  /// Mean radiance that arrives at a place, weighted by its direction. Nothing where no lit record with a
  /// field reaches, or where no weight is left.
  [[nodiscard]] std::optional<Rgb> meanArriving(const glm::vec3& position, const glm::vec3& normal,
                                                const DirectionWeights& weightsAbout) const;

 private:
  /// Records are filed by the power of two above their reach, in every cell of that size that they may
  /// serve.
  struct Cell {
    std::int32_t level, x, y, z;
    friend bool operator==(const Cell&, const Cell&) = default;
  };
  struct CellHash {
    std::size_t operator()(const Cell& cell) const;
  };
  /// Radiance at the record and its change per distance along the world's axes, within the record's plane.
  struct Fit {
    Rgb radiance{0.0f};
    glm::vec3 r{0.0f}, g{0.0f}, b{0.0f};
  };
  // A look-up's time goes into waiting for memory, and into records that are near but do not reach. All that
  // it needs of one record lies within a line of the cache; what finds records is looked at several at a
  // time.
  struct alignas(64) Known {
    Fit fit;  ///< without the noise that the neighbours do not share
    glm::vec3 meanDirection{0.0f};
  };
  struct Entry {
    RecordPlace place;
    std::uint32_t record;
  };
  static constexpr std::size_t kLanes = 8;
  /// The places of some of a cell's records, a coordinate at a time. Reach 0: there is none.
  struct Places {
    using Lanes = std::array<float, kLanes>;
    alignas(kLanes * sizeof(float)) Lanes x{}, y{}, z{}, normalX{}, normalY{}, normalZ{}, reach{};
    std::array<std::uint32_t, kLanes> record{};

    void set(std::size_t lane, const Entry& entry);
    [[nodiscard]] Entry at(std::size_t lane) const;
    /// weightOf() those that have one, by the bits of the result; the weights of other lanes mean nothing.
    std::uint32_t weigh(const glm::vec3& position, const glm::vec3& normal, Lanes& weights) const;
  };
  struct alignas(32) Slot {
    Cell cell{};
    std::uint32_t begin = 0, end = 0;  ///< of filed_; empty: end of a search
  };

  /// Whether a wall of the record stands before the place.
  [[nodiscard]] bool isBehindWall(std::uint32_t record, const glm::vec3& position) const;
  static Cell cellOf(int level, const glm::vec3& position);
  template <class Visit>
  void forEachNear(const glm::vec3& position, const Visit& visit) const;
  /// visit(places, lane, weight) for those with a weight on such an element, behind walls too; it returns
  /// whether to go on.
  template <class Visit>
  void forEachLitAround(const glm::vec3& position, const glm::vec3& normal, const Visit& visit) const;
  /// visit(entry, weight) for those of them before their walls.
  template <class Visit>
  void forEachLitNear(const glm::vec3& position, const glm::vec3& normal, const Visit& visit) const;
  [[nodiscard]] std::size_t firstSlot(const Cell& cell) const;
  /// Those of the cell whose search begins at that slot.
  [[nodiscard]] std::span<const Places> placesIn(const Cell& cell, std::size_t slot) const;
  [[nodiscard]] SurfaceLight lightOf(std::uint32_t record) const;
  /// On an element that faces where the record does.
  [[nodiscard]] SurfaceLight lightBeside(const Entry& entry, const glm::vec3& position) const;
  [[nodiscard]] Rgb radianceFrom(const Entry& entry, const glm::vec3& position,
                                 const glm::vec3& normal) const;
  [[nodiscard]] Fit fitAround(std::uint32_t record) const;
  void fileLit();

  std::vector<RecordPlace> places_;
  std::vector<RecordWall> walls_;
  std::vector<std::uint32_t> firstWall_ = {0};  // of each record, and one more
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells_;
  std::vector<int> levels_;  // in use, sorted

  // Of the lit records.
  std::vector<SurfaceLight> gathered_;
  std::vector<Known> known_;
  std::vector<LightField> fields_;  // empty, or one for each
  std::vector<Places> filed_;       // cell by cell
  std::vector<Slot> slots_;         // open addressing; a power of two of them
};

}  // namespace promenade::render
