#include "src/render/irradiance_records.h"

#include <hwy/highway.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "src/core/display.h"
#include "src/render/basis.h"

namespace promenade::render {
namespace {

/// A record counts less the more the surface turns away, and nothing beyond 40 degrees: 1 - cos(40 degrees).
/// (Within that, radianceAround says what the turn does.)
constexpr float kMostTurn = 0.234f;
/// ... and nothing where the place lies farther before or behind its surface than this share of its reach
/// (steps, thin walls). Along the mean of both normals: that is 0 on a sphere or cylinder.
constexpr float kMostRise = 0.1f;
/// How far from a record's plane a place with a weight can be, in reaches: where the normals differ by the
/// most turn, half of that above the plane, and the rise.
constexpr float kMostLift = 0.342f + kMostRise / 0.94f;
/// A new record within this share of another's reach would add nothing: every place then has several.
constexpr float kCovered = 0.65f;
/// A gradient is not trusted to change the light by more than this share.
constexpr float kMostChange = 0.5f;
/// ... and fits within this variance of the neighbours' positions (in reaches, squared) are held flat.
constexpr float kRidge = 0.02f;
/// So many reaches behind a wall a record still counts: half as far as records are placed before walls at the
/// least. What is seen under a skirting board lies there, and would shine with the daylight behind it.
constexpr float kInsideWall = 1e-2f;
constexpr int kSmoothings = 2;
/// How many standard errors the neighbours may contradict what was gathered and be believed whole; twice as
/// many, and they are not believed at all.
constexpr float kNoise = 2.5f;

/// Among its neighbours, and for itself, a record counts half if its standard error is this share of its
/// light.
constexpr float kDoubtful = 0.1f;
constexpr float kLeastConfidence = 1e-4f;

/// By its variance: what one path in a million brings must not show as a spot.
float confidenceIn(const SurfaceLight& gathered) {
  if (!(gathered.error > 0.0f)) return 1.0f;
  const float clean = kDoubtful * luminance(gathered.radiance);
  return std::max(kLeastConfidence, clean * clean / (clean * clean + gathered.error * gathered.error));
}

/// As std::ldexp(1, exponent), without a call, for those that a float of full precision has.
float powerOfTwo(int exponent) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(std::clamp(exponent, -126, 127) + 127) << 23);
}

/// 1 at the record, 0 where it ends.
float weightOf(const RecordPlace& record, const glm::vec3& position, const glm::vec3& normal) {
  const glm::vec3 offset = position - record.position;
  const float squared = glm::dot(offset, offset);
  if (squared >= record.reach * record.reach) return 0.0f;
  const float turn = 1.0f - glm::dot(normal, record.normal);
  if (turn >= kMostTurn) return 0.0f;
  const float rise = 0.5f * std::abs(glm::dot(offset, record.normal + normal)) / (kMostRise * record.reach);
  const float distance = std::sqrt(squared) / record.reach;
  const float turned = std::sqrt(std::max(turn, 0.0f) / kMostTurn);
  return std::max(0.0f, 1.0f - std::max(distance, std::max(turned, rise)));
}

/// The light that a surface turned from `normal` to `turned` gets, to first order: what falls below its
/// horizon is made up by what rises above it, as on the neighbouring part of a curved surface. (Ward,
/// Heckbert, Irradiance Gradients (1992), rotation gradient, by the mean direction of the light.)
Rgb radianceAround(const SurfaceLight& light, const glm::vec3& normal, const glm::vec3& turned) {
  const float upright = glm::dot(normal, light.meanDirection);
  if (!(upright > 1e-3f)) return light.radiance;
  const glm::vec3 turn = turned - glm::dot(normal, turned) * normal;
  return light.radiance * std::clamp(1.0f + glm::dot(turn, light.meanDirection) / upright, 0.0f, 2.0f);
}

}  // namespace

Rgb radianceOnTurned(const SurfaceLight& light, const glm::vec3& normal, const glm::vec3& turned) {
  // E(n') / E(n) = (n'.m + k) / (n.m + k): under a uniform sky m = 2/3 n and k = 2/3 give (1 + cos) / 2, the
  // share of the sky above the horizon that is left; for one direction |m| = 1 and k = 0 give the ratio of
  // the cosines.
  const float ambient = 2.0f * std::max(0.0f, 1.0f - glm::length(light.meanDirection));
  const float before = glm::dot(normal, light.meanDirection) + ambient;
  if (!(before > 1e-3f)) return light.radiance;
  const float after = std::max(0.0f, glm::dot(turned, light.meanDirection) + ambient);
  return light.radiance * std::min(after / before, 4.0f);
}

std::size_t IrradianceRecords::CellHash::operator()(const Cell& cell) const {
  std::uint64_t h = static_cast<std::uint32_t>(cell.x) * 0x9e3779b97f4a7c15ull;
  h = (h ^ (h >> 29)) + static_cast<std::uint32_t>(cell.y) * 0xbf58476d1ce4e5b9ull;
  h = (h ^ (h >> 29)) + static_cast<std::uint32_t>(cell.z) * 0x94d049bb133111ebull;
  h = (h ^ (h >> 29)) + static_cast<std::uint32_t>(cell.level) * 0xd6e8feb86659fd93ull;
  return h ^ (h >> 32);
}

IrradianceRecords::Cell IrradianceRecords::cellOf(int level, const glm::vec3& position) {
  const float scale = powerOfTwo(-level);
  const auto index = [scale](float v) {
    return static_cast<std::int32_t>(std::floor(std::clamp(v * scale, -2e9f, 2e9f)));
  };
  return {level, index(position.x), index(position.y), index(position.z)};
}

template <class Visit>
void IrradianceRecords::forEachNear(const glm::vec3& position, const Visit& visit) const {
  for (const int level : levels_) {
    const auto cell = cells_.find(cellOf(level, position));
    if (cell == cells_.end()) continue;
    for (const std::uint32_t record : cell->second) visit(record);
  }
}

std::size_t IrradianceRecords::firstSlot(const Cell& cell) const {
  return CellHash{}(cell) & (slots_.size() - 1);
}

void IrradianceRecords::Places::set(std::size_t lane, const Entry& entry) {
  const auto& [position, facing, farthest] = entry.place;
  x[lane] = position.x;
  y[lane] = position.y;
  z[lane] = position.z;
  normalX[lane] = facing.x;
  normalY[lane] = facing.y;
  normalZ[lane] = facing.z;
  reach[lane] = farthest;
  record[lane] = entry.record;
}

IrradianceRecords::Entry IrradianceRecords::Places::at(std::size_t lane) const {
  return {{{x[lane], y[lane], z[lane]}, {normalX[lane], normalY[lane], normalZ[lane]}, reach[lane]},
          record[lane]};
}

std::uint32_t IrradianceRecords::Places::weigh(const glm::vec3& position, const glm::vec3& normal,
                                               Lanes& weights) const {
  namespace hn = hwy::HWY_NAMESPACE;
  constexpr hn::CappedTag<float, kLanes> kTag;
  const auto set = [](float value) { return hn::Set(kTag, value); };
  std::uint32_t weighty = 0;
  for (std::size_t i = 0; i < kLanes; i += hn::Lanes(kTag)) {
    const auto load = [i](const Lanes& lanes) { return hn::Load(kTag, lanes.data() + i); };
    // As weightOf(), operation by operation.
    const auto dX = hn::Sub(set(position.x), load(x));
    const auto dY = hn::Sub(set(position.y), load(y));
    const auto dZ = hn::Sub(set(position.z), load(z));
    const auto nX = load(normalX), nY = load(normalY), nZ = load(normalZ);
    const auto farthest = load(reach);
    const auto dot = [](auto aX, auto aY, auto aZ, auto bX, auto bY, auto bZ) {
      return hn::Add(hn::Add(hn::Mul(aX, bX), hn::Mul(aY, bY)), hn::Mul(aZ, bZ));
    };
    const auto squared = dot(dX, dY, dZ, dX, dY, dZ);
    const auto turn = hn::Sub(set(1.0f), dot(set(normal.x), set(normal.y), set(normal.z), nX, nY, nZ));
    const auto reaches = hn::And(hn::Lt(squared, hn::Mul(farthest, farthest)), hn::Lt(turn, set(kMostTurn)));
    const auto along =
        dot(dX, dY, dZ, hn::Add(nX, set(normal.x)), hn::Add(nY, set(normal.y)), hn::Add(nZ, set(normal.z)));
    const auto rise = hn::Div(hn::Mul(set(0.5f), hn::Abs(along)), hn::Mul(set(kMostRise), farthest));
    const auto distance = hn::Div(hn::Sqrt(squared), farthest);
    const auto turned = hn::Sqrt(hn::Div(hn::Max(turn, set(0.0f)), set(kMostTurn)));
    const auto weight = hn::Sub(set(1.0f), hn::Max(distance, hn::Max(turned, rise)));
    hn::StoreU(weight, kTag, weights.data() + i);
    const auto counts = hn::And(reaches, hn::Gt(weight, set(0.0f)));
    std::array<std::uint8_t, 8> bits{};
    hn::StoreMaskBits(kTag, counts, bits.data());
    weighty |= std::uint32_t{bits[0]} << i;
  }
  return weighty;
}

std::span<const IrradianceRecords::Places> IrradianceRecords::placesIn(const Cell& cell,
                                                                       std::size_t slot) const {
  for (std::size_t i = slot; slots_[i].begin < slots_[i].end; i = (i + 1) & (slots_.size() - 1)) {
    if (slots_[i].cell == cell)
      return std::span(filed_).subspan(slots_[i].begin, slots_[i].end - slots_[i].begin);
  }
  return {};
}

template <class Visit>
void IrradianceRecords::forEachLitAround(const glm::vec3& position, const glm::vec3& normal,
                                         const Visit& visit) const {
  if (slots_.empty()) return;
  // What several levels need is asked of memory at once.
  constexpr std::size_t kAtOnce = 8;
  std::array<Cell, kAtOnce> cells;
  std::array<std::size_t, kAtOnce> slots;
  std::array<std::span<const Places>, kAtOnce> found;
  for (std::size_t first = 0; first < levels_.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, levels_.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      cells[i] = cellOf(levels_[first + i], position);
      slots[i] = firstSlot(cells[i]);
      __builtin_prefetch(&slots_[slots[i]]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      found[i] = placesIn(cells[i], slots[i]);
      __builtin_prefetch(found[i].data());
    }
    for (std::size_t i = 0; i < count; ++i) {
      for (const Places& places : found[i]) {
        Places::Lanes weights;
        for (std::uint32_t left = places.weigh(position, normal, weights); left != 0; left &= left - 1) {
          const auto lane = static_cast<std::size_t>(std::countr_zero(left));
          if (!visit(places, lane, weights[lane])) return;
        }
      }
    }
  }
}

template <class Visit>
void IrradianceRecords::forEachLitNear(const glm::vec3& position, const glm::vec3& normal,
                                       const Visit& visit) const {
  forEachLitAround(position, normal, [&](const Places& places, std::size_t lane, float weight) {
    return isBehindWall(places.record[lane], position) || visit(places.at(lane), weight);
  });
}

bool IrradianceRecords::isBehindWall(std::uint32_t record, const glm::vec3& position) const {
  const std::span<const RecordWall> walls = wallsOf(record);
  if (walls.empty()) return false;
  const RecordPlace& place = places_[record];
  const glm::vec3 offset = position - place.position;
  return std::any_of(walls.begin(), walls.end(), [&](const RecordWall& wall) {
    return glm::dot(offset, wall.normal) < wall.offset - kInsideWall * place.reach;
  });
}

SurfaceLight IrradianceRecords::lightOf(std::uint32_t record) const {
  return {known_[record].fit.radiance, known_[record].meanDirection};
}

SurfaceLight IrradianceRecords::lightBeside(const Entry& entry, const glm::vec3& position) const {
  const Fit& fit = known_[entry.record].fit;
  const glm::vec3 offset = position - entry.place.position;
  const Rgb change(glm::dot(fit.r, offset), glm::dot(fit.g, offset), glm::dot(fit.b, offset));
  return {fit.radiance + glm::clamp(change, -kMostChange * fit.radiance, kMostChange * fit.radiance),
          known_[entry.record].meanDirection};
}

Rgb IrradianceRecords::radianceFrom(const Entry& entry, const glm::vec3& position,
                                    const glm::vec3& normal) const {
  return radianceAround(lightBeside(entry, position), entry.place.normal, normal);
}

IrradianceRecords::Coverage IrradianceRecords::coverage(const glm::vec3& position,
                                                        const glm::vec3& normal) const {
  Coverage result;
  forEachNear(position, [&](std::uint32_t record) {
    const RecordPlace& place = places_[record];
    const float weight = weightOf(place, position, normal);
    if (!(weight > 0.0f) || isBehindWall(record, position)) return;
    const bool lit = record < known_.size();
    result.finestReach = std::min(result.finestReach, place.reach);
    result.covered = result.covered || weight > 1.0f - kCovered;
    result.coveredNew = result.coveredNew || (!lit && weight > 1.0f - kCovered);
    if (!lit) return;
    const float value = luminance(radianceFrom({place, record}, position, normal));
    result.least = std::min(result.least, value);
    result.most = std::max(result.most, value);
  });
  return result;
}

float IrradianceRecords::clampedReach(const glm::vec3& position, float reach, float slope) const {
  forEachNear(position, [&](std::uint32_t record) {
    const RecordPlace& place = places_[record];
    reach = std::min(reach, place.reach + slope * glm::length(position - place.position));
  });
  return reach;
}

void IrradianceRecords::place(const RecordPlace& place, std::span<const RecordWall> walls) {
  const auto record = static_cast<std::uint32_t>(places_.size());
  places_.push_back(place);
  walls_.insert(walls_.end(), walls.begin(), walls.end());
  firstWall_.push_back(static_cast<std::uint32_t>(walls_.size()));
  const int level = static_cast<int>(std::ceil(std::log2(place.reach)));
  const auto at = std::lower_bound(levels_.begin(), levels_.end(), level);
  if (at == levels_.end() || *at != level) levels_.insert(at, level);
  const float size = std::ldexp(1.0f, level);
  const Cell low = cellOf(level, place.position - glm::vec3(place.reach));
  const Cell high = cellOf(level, place.position + glm::vec3(place.reach));
  // Between the planes that hold every place with a weight, as far as a cell's corners may lie outside.
  const float thickness =
      kMostLift * place.reach +
      0.5f * size * (std::abs(place.normal.x) + std::abs(place.normal.y) + std::abs(place.normal.z));
  for (std::int32_t z = low.z; z <= high.z; ++z) {
    for (std::int32_t y = low.y; y <= high.y; ++y) {
      for (std::int32_t x = low.x; x <= high.x; ++x) {
        const glm::vec3 centre = size * (glm::vec3(x, y, z) + 0.5f);
        if (std::abs(glm::dot(centre - place.position, place.normal)) > thickness) continue;
        cells_[{level, x, y, z}].push_back(record);
      }
    }
  }
}

void IrradianceRecords::setLight(std::vector<SurfaceLight> light, std::vector<LightField> fields,
                                 Noise noise) {
  assert(light.size() <= places_.size());
  assert(fields.empty() || fields.size() == light.size());
  fields_ = std::move(fields);
  gathered_ = std::move(light);
  known_.resize(gathered_.size());
  for (std::size_t i = 0; i < known_.size(); ++i) {
    known_[i] = {{gathered_[i].radiance}, gathered_[i].meanDirection};
  }
  fileLit();
  std::vector<Fit> fits(known_.size());
  const auto fitAll = [this, &fits] {
    tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(fits.size()),
                      [this, &fits](std::uint32_t i) { fits[i] = fitAround(i); });
  };
  for (int pass = 0; noise == Noise::kTakenOut && pass < kSmoothings; ++pass) {
    fitAll();
    for (std::size_t i = 0; i < fits.size(); ++i) {
      // What the neighbours expect here is taken as far as it explains what was gathered by its noise.
      const float gathered = luminance(gathered_[i].radiance);
      const float surprise = std::abs(luminance(fits[i].radiance) - gathered);
      const float expected = kNoise * gathered_[i].error;
      const float trust = expected > 0.0f ? std::clamp(2.0f - surprise / expected, 0.0f, 1.0f) : 0.0f;
      known_[i].fit.radiance = glm::mix(gathered_[i].radiance, glm::max(fits[i].radiance, Rgb(0.0f)), trust);
    }
  }
  fitAll();
  for (std::size_t i = 0; i < fits.size(); ++i) {
    fits[i].radiance = known_[i].fit.radiance;
    known_[i].fit = fits[i];
  }
}

void IrradianceRecords::fileLit() {
  filed_.clear();
  slots_.assign(std::bit_ceil(2 * cells_.size() + 1), {});
  const std::size_t mask = slots_.size() - 1;
  for (const auto& [cell, records] : cells_) {
    Slot slot{cell, static_cast<std::uint32_t>(filed_.size()), 0};
    std::size_t count = 0;
    for (const std::uint32_t record : records) {
      if (record >= known_.size()) continue;
      if (count % kLanes == 0) filed_.emplace_back();
      filed_.back().set(count++ % kLanes, {places_[record], record});
    }
    slot.end = static_cast<std::uint32_t>(filed_.size());
    if (slot.begin == slot.end) continue;
    std::size_t i = firstSlot(cell);
    while (slots_[i].begin < slots_[i].end) i = (i + 1) & mask;
    slots_[i] = slot;
  }
}

/// Weighted least squares of a linear change over the record's plane, the record itself included.
IrradianceRecords::Fit IrradianceRecords::fitAround(std::uint32_t record) const {
  const RecordPlace& here = places_[record];
  const glm::vec3 helper = std::abs(here.normal.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  const glm::vec3 x = glm::normalize(glm::cross(helper, here.normal));
  const glm::vec3 y = glm::cross(here.normal, x);
  float w = 0.0f, wx = 0.0f, wy = 0.0f, xx = 0.0f, xy = 0.0f, yy = 0.0f;
  Rgb wv(0.0f), xv(0.0f), yv(0.0f);
  forEachLitNear(here.position, here.normal, [&](const Entry& entry, float near) {
    const float weight = near * confidenceIn(gathered_[entry.record]);
    const glm::vec3 offset = (entry.place.position - here.position) / here.reach;
    const Rgb value = radianceAround(lightOf(entry.record), entry.place.normal, here.normal);
    const float u = glm::dot(offset, x);
    const float v = glm::dot(offset, y);
    w += weight;
    wx += weight * u;
    wy += weight * v;
    xx += weight * u * u;
    xy += weight * u * v;
    yy += weight * v * v;
    wv += weight * value;
    xv += weight * u * value;
    yv += weight * v * value;
    return true;
  });
  // About the mean of the neighbours. A little ridge: neighbours on a line say nothing of the other
  // direction.
  const float meanX = wx / w;
  const float meanY = wy / w;
  const Rgb mean = wv / w;
  const float a = xx / w - meanX * meanX + kRidge;
  const float b = xy / w - meanX * meanY;
  const float c = yy / w - meanY * meanY + kRidge;
  const Rgb p = xv / w - meanX * mean;
  const Rgb q = yv / w - meanY * mean;
  const float determinant = a * c - b * b;
  const Rgb alongX = (c * p - b * q) / determinant;
  const Rgb alongY = (a * q - b * p) / determinant;
  Fit fit;
  fit.radiance = mean - meanX * alongX - meanY * alongY;
  const glm::vec3 worldX = x / here.reach;
  const glm::vec3 worldY = y / here.reach;
  fit.r = alongX.r * worldX + alongY.r * worldY;
  fit.g = alongX.g * worldX + alongY.g * worldY;
  fit.b = alongX.b * worldX + alongY.b * worldY;
  return fit;
}

std::optional<SurfaceLight> IrradianceRecords::at(const glm::vec3& position, const glm::vec3& normal) const {
  SurfaceLight sum;
  float weights = 0.0f;
  forEachLitNear(position, normal, [&](const Entry& entry, float near) {
    // Where fine and coarse records overlap the fine ones know better.
    const float weight = near / (entry.place.reach * entry.place.reach);
    sum.radiance += radianceFrom(entry, position, normal) * weight;
    sum.meanDirection += known_[entry.record].meanDirection * weight;
    weights += weight;
    return true;
  });
  if (!(weights > 0.0f)) return std::nullopt;
  return SurfaceLight{sum.radiance / weights, sum.meanDirection / weights};
}

std::optional<SurfaceLight> IrradianceRecords::roughlyAt(const glm::vec3& position, const glm::vec3& normal,
                                                         float mostReach) const {
  float best = 0.0f;
  Entry nearest;
  forEachLitAround(position, normal, [&](const Places& places, std::size_t lane, float weight) {
    if (weight <= best || places.reach[lane] > mostReach || isBehindWall(places.record[lane], position))
      return true;
    best = weight;
    nearest = places.at(lane);
    return best <= 1.0f - kCovered;
  });
  if (!(best > 0.0f)) return std::nullopt;
  return SurfaceLight{radianceFrom(nearest, position, normal), known_[nearest.record].meanDirection};
}

std::optional<Rgb> IrradianceRecords::meanArriving(const glm::vec3& position, const glm::vec3& normal,
                                                   const DirectionWeights& weightsAbout) const {
  if (fields_.empty()) return std::nullopt;
  // Neighbouring records often lie in one plane, and their cells point the same way.
  glm::vec3 facing(0.0f);
  LightField::Weights lobe;
  float wholeLobe = 0.0f;
  Rgb sum(0.0f);
  float weights = 0.0f;
  forEachLitNear(position, normal, [&](const Entry& entry, float near) {
    const float share = near / (entry.place.reach * entry.place.reach);
    if (entry.place.normal != facing) {
      facing = entry.place.normal;
      lobe = weightsAbout(Basis(facing));
      wholeLobe = lobe.sum();
    }
    // Noise and change of the light as a whole are known better than those of its parts.
    const float known = luminance(lightBeside(entry, position).radiance);
    sum += share * known * fields_[entry.record].weighted(lobe);
    weights += share * wholeLobe;
    return true;
  });
  if (!(weights > 0.0f)) return std::nullopt;
  return sum / weights;
}

}  // namespace promenade::render
