#include "ibr/source_surface.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace promenade::ibr {
namespace {

// Rounding of the positions a renderer works with: 8 units in the last place of a float coordinate.
constexpr double kRounding = 8.0 / (1 << 23);

double largestCoordinate(const glm::dvec3& point) {
  return std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)});
}

}  // namespace

RayBasis::RayBasis(const Camera& camera)
    : corner_(camera.direction({0.5, 0.5})),
      right_(camera.direction({1.5, 0.5}) - camera.direction({0.5, 0.5})),
      down_(camera.direction({0.5, 1.5}) - camera.direction({0.5, 0.5})) {}

SurfaceTolerance::SurfaceTolerance(const Camera& camera, const glm::dvec3& otherEye)
    : quarterSample_(static_cast<float>(0.25 / camera.focalPixels() + kRounding)),
      rounding_(static_cast<float>(
          kRounding * std::max(largestCoordinate(camera.pose().eye), largestCoordinate(otherEye)))) {}

SampledSurface::SampledSurface(const Visibility& source, const glm::dvec3& otherEye, double creaseDegrees)
    : visibility_(source),
      rays_(source.camera),
      tolerance_(source.camera, otherEye),
      creaseCosine_(static_cast<float>(std::cos(creaseDegrees * std::numbers::pi / 180.0))) {}

SurfacePoint SampledSurface::pointOf(int x, int y) const {
  const ItemId item = visibility_.item(x, y);
  if (item == kNoItem) return {};
  const float depth = visibility_.depth(x, y);
  return {item, depth * rays_.through(x, y), visibility_.normal(x, y), tolerance(depth)};
}

SourceSurface::SourceSurface(const Frame& source, const glm::dvec3& otherEye, double creaseDegrees)
    : SampledSurface(source.visibility, otherEye, creaseDegrees),
      traced_(source.source),
      smoothBlocks_(source.visibility.depth.size()) {
  const Size size = smoothBlocks_.size();
  // A cell is smooth if its 2x2 samples are traced and linked around; a block if its 3x3 cells are.
  Mask cells(size);
  tbb::parallel_for(
      tbb::blocked_range<int>(0, std::max(0, size.height - 1)), [&](const tbb::blocked_range<int>& rows) {
        LinkedRow above = linkedRow(rows.begin());
        for (int y = rows.begin(); y < rows.end(); ++y) {
          LinkedRow below = linkedRow(y + 1);
          const auto out = cells.row(y);
          bool leftIsLinked = linked(above.points[0], below.points[0]);
          for (std::size_t x = 0; x + 1 < out.size(); ++x) {
            const bool rightIsLinked = linked(above.points[x + 1], below.points[x + 1]);
            out[x] = leftIsLinked && rightIsLinked && above.goesOn[x] != 0 && below.goesOn[x] != 0;
            leftIsLinked = rightIsLinked;
          }
          above = std::move(below);
        }
      });
  tbb::parallel_for(1, std::max(1, size.height - 2), [&](int y) {
    const auto above = cells.row(y - 1);
    const auto here = cells.row(y);
    const auto below = cells.row(y + 1);
    const auto out = smoothBlocks_.row(y);
    for (std::size_t x = 1; x + 2 < out.size(); ++x) {
      const auto column = [&](std::size_t i) { return above[i] & here[i] & below[i]; };
      out[x] = static_cast<std::uint8_t>(column(x - 1) & column(x) & column(x + 1));
    }
  });
}

SourceSurface::LinkedRow SourceSurface::linkedRow(int y) const {
  const auto width = static_cast<std::size_t>(smoothBlocks_.width());
  LinkedRow row{std::vector<std::optional<SurfacePoint>>(width), std::vector<std::uint8_t>(width)};
  for (std::size_t x = 0; x < width; ++x) {
    if (isTraced(static_cast<int>(x), y)) row.points[x] = pointOf(static_cast<int>(x), y);
    if (x > 0) row.goesOn[x - 1] = linked(row.points[x - 1], row.points[x]);
  }
  return row;
}

bool SourceSurface::linked(const std::optional<SurfacePoint>& p, const std::optional<SurfacePoint>& q) const {
  if (!p || !q || p->item != q->item) return false;
  if (p->item == kNoItem) return true;
  return glm::dot(p->normal, q->normal) >= creaseCosine() &&
         chordRunsAlong(q->fromSourceEye - p->fromSourceEye, p->normal, q->normal, p->tolerance);
}

}  // namespace promenade::ibr
