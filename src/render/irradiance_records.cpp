#include "src/render/irradiance_records.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace promenade::render {
namespace {

/// A record counts less the more the surface turns away, and nothing beyond 25 degrees: 1 - cos(25 degrees).
constexpr float kMostTurn = 0.0937f;
/// ... and nothing where the place lies farther from its plane than this share of its reach (steps, thin
/// walls).
constexpr float kMostRise = 0.25f;
/// A new record within this share of another's reach would add nothing: every place then has several.
constexpr float kCovered = 0.65f;

/// 1 at the record, 0 where it ends.
float weightOf(const RecordPlace& record, const glm::vec3& position, const glm::vec3& normal) {
  const glm::vec3 offset = position - record.position;
  const float squared = glm::dot(offset, offset);
  if (squared >= record.reach * record.reach) return 0.0f;
  const float turn = 1.0f - glm::dot(normal, record.normal);
  if (turn >= kMostTurn) return 0.0f;
  const float rise = std::abs(glm::dot(offset, record.normal)) / (kMostRise * record.reach);
  const float distance = std::sqrt(squared) / record.reach;
  const float turned = std::sqrt(std::max(turn, 0.0f) / kMostTurn);
  return std::max(0.0f, 1.0f - std::max(distance, std::max(turned, rise)));
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
  const float scale = std::ldexp(1.0f, -level);
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

bool IrradianceRecords::covers(const glm::vec3& position, const glm::vec3& normal, float mostReach) const {
  bool covered = false;
  forEachNear(position, [&](std::uint32_t record) {
    const RecordPlace& place = places_[record];
    covered = covered || (place.reach <= mostReach && weightOf(place, position, normal) > 1.0f - kCovered);
  });
  return covered;
}

void IrradianceRecords::place(const RecordPlace& place) {
  const auto record = static_cast<std::uint32_t>(places_.size());
  places_.push_back(place);
  const int level = static_cast<int>(std::ceil(std::log2(2.0f * place.reach)));
  const auto at = std::lower_bound(levels_.begin(), levels_.end(), level);
  if (at == levels_.end() || *at != level) levels_.insert(at, level);
  // A cell is at least twice as wide as the reach: two cells an axis hold all that the record touches.
  const Cell low = cellOf(level, place.position - glm::vec3(place.reach));
  const Cell high = cellOf(level, place.position + glm::vec3(place.reach));
  for (std::int32_t z = low.z; z <= high.z; ++z) {
    for (std::int32_t y = low.y; y <= high.y; ++y) {
      for (std::int32_t x = low.x; x <= high.x; ++x) cells_[{level, x, y, z}].push_back(record);
    }
  }
}

void IrradianceRecords::setLight(std::vector<SurfaceLight> light) {
  light_ = std::move(light);
  light_.resize(places_.size());
}

std::optional<SurfaceLight> IrradianceRecords::at(const glm::vec3& position, const glm::vec3& normal) const {
  SurfaceLight sum;
  float weights = 0.0f;
  forEachNear(position, [&](std::uint32_t record) {
    const RecordPlace& place = places_[record];
    // Where fine and coarse records overlap the fine ones know better.
    const float weight = weightOf(place, position, normal) / place.reach;
    if (!(weight > 0.0f)) return;
    sum.radiance += light_[record].radiance * weight;
    sum.meanDirection += light_[record].meanDirection * weight;
    weights += weight;
  });
  if (!(weights > 0.0f)) return std::nullopt;
  return SurfaceLight{sum.radiance / weights, sum.meanDirection / weights};
}

}  // namespace promenade::render
