#include "src/render/bright_surfaces.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "src/render/maths.h"
#include "src/render/ray_offset.h"
#include "src/render/triangle_parts.h"

namespace promenade::render {
namespace {

/// Pieces are at most about this share of the scene's longest side across...
constexpr float kPiecesAlongLongestSide = 64.0f;
/// ... but a triangle is divided into no more than this many along each edge.
constexpr int kMostDivisions = 64;
/// Bright is what sends on more than this many times the mean of all surfaces that are known to be lit.
constexpr float kBright = 3.0f;
/// To see how much of a group comes to a cell.
constexpr int kCellsAlongLongestSide = 40;
constexpr int kRaysPerGroup = 12;
static_assert(kRaysPerGroup <= EmbreeScene::kPacket);
/// Of samples that go by how much would come if nothing stood between.
constexpr float kUnseenShare = 0.3f;
constexpr float kLeastCosine = 1e-6f;

LightBounds boundsOf(const Surfaces::Corners& c, const TrianglePart& part, std::uint32_t divisions,
                     const glm::vec3& axis, float intensity) {
  const glm::vec3 a = positionAt(c, barycentricAt(part, {0.0f, 0.0f}, divisions));
  const glm::vec3 b = positionAt(c, barycentricAt(part, {1.0f, 0.0f}, divisions));
  const glm::vec3 d = positionAt(c, barycentricAt(part, {0.0f, 1.0f}, divisions));
  LightBounds bounds;
  bounds.lower = glm::min(a, glm::min(b, d));
  bounds.upper = glm::max(a, glm::max(b, d));
  bounds.axis = axis;
  bounds.intensity = intensity;
  return bounds;
}

/// What an instance's pieces send on.
struct Lit {
  std::uint32_t triangle, place, divisions;
  float luminance, area;
};

}  // namespace

BrightSurfaces::BrightSurfaces(const Surfaces& surfaces, const EmbreeScene& embree,
                               const Luminance& luminance)
    : surfaces_(surfaces), embree_(embree), views_(embree.bounds(), kCellsAlongLongestSide) {
  const EmbreeScene::Bounds bounds = embree.bounds();
  const glm::vec3 extent = bounds.upper - bounds.lower;
  const float width = std::max(extent.x, std::max(extent.y, extent.z)) / kPiecesAlongLongestSide;
  if (!(width > 0.0f && std::isfinite(width))) return;

  std::vector<std::vector<Lit>> lit(surfaces.instanceCount());
  tbb::parallel_for(std::size_t{0}, lit.size(), [&](std::size_t instance) {
    const auto count = static_cast<std::uint32_t>(surfaces.triangles(instance).triangleCount);
    for (std::uint32_t triangle = 0; triangle < count; ++triangle) {
      const Surfaces::Corners c = surfaces.corners(instance, triangle);
      const float doubleArea = glm::length(c.frontNormal);
      if (!(doubleArea > 0.0f && std::isfinite(doubleArea))) continue;
      const float longest =
          std::max({glm::length(c.b - c.a), glm::length(c.c - c.a), glm::length(c.c - c.b)});
      const auto divisions = static_cast<std::uint32_t>(
          std::clamp(std::ceil(longest / width), 1.0f, static_cast<float>(kMostDivisions)));
      const float area = 0.5f * doubleArea / static_cast<float>(divisions * divisions);
      for (std::uint32_t number = 0; number < 2 * divisions * divisions; ++number) {
        const TrianglePart part = partAt(number, divisions);
        if (part.column + part.row + (part.isUpper ? 1 : 0) >= divisions) continue;
        Hit hit;
        hit.instance = static_cast<std::uint32_t>(instance);
        hit.triangle = triangle;
        hit.barycentric = barycentricAt(part, glm::vec2(1.0f / 3.0f), divisions);
        for (const Side side : {Side::kFront, Side::kBack}) {
          const glm::vec3 out = (side == Side::kFront ? 1.0f : -1.0f) / doubleArea * c.frontNormal;
          const float sent = luminance(hit, -out, std::sqrt(area));
          if (sent > 0.0f && std::isfinite(sent))
            lit[instance].push_back(
                {triangle, 2 * number + static_cast<std::uint32_t>(side), divisions, sent, area});
        }
      }
    }
  });

  double flux = 0.0, area = 0.0;
  for (const auto& pieces : lit) {
    for (const Lit& piece : pieces) {
      flux += double{piece.luminance} * piece.area;
      area += piece.area;
    }
  }
  const auto least = static_cast<float>(area > 0.0 ? kBright * flux / area : 0.0);
  double brightFlux = 0.0;
  std::vector<LightBounds> lights;
  for (std::size_t instance = 0; instance < lit.size(); ++instance) {
    for (const Lit& piece : lit[instance]) {
      if (!(piece.luminance > least)) continue;
      brightFlux += double{piece.luminance} * piece.area;
      const auto index = static_cast<std::uint32_t>(pieces_.size());
      const auto where = static_cast<std::uint32_t>(instance);
      Range& range = ranges_.try_emplace({where, piece.triangle}, Range{index, index}).first->second;
      range.end = index + 1;
      pieces_.push_back({where, piece.triangle, piece.place, piece.divisions});
      const Surfaces::Corners c = surfaces.corners(instance, piece.triangle);
      const float side = piece.place % 2 == static_cast<std::uint32_t>(Side::kFront) ? 1.0f : -1.0f;
      lights.push_back(boundsOf(c, partAt(piece.place / 2, piece.divisions), piece.divisions,
                                side * glm::normalize(c.frontNormal), piece.luminance * piece.area));
    }
  }
  if (flux > 0.0) share_ = static_cast<float>(brightFlux / flux);

  groupOf_.resize(pieces_.size());
  std::array<std::vector<std::uint32_t>, 6> facing;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const glm::vec3 a = glm::abs(lights[i].axis);
    const int dimension = a.x >= a.y && a.x >= a.z ? 0 : (a.y >= a.z ? 1 : 2);
    facing[static_cast<std::size_t>(2 * dimension + (lights[i].axis[dimension] < 0.0f ? 1 : 0))].push_back(i);
  }
  for (auto& pieces : facing) {
    if (!pieces.empty()) gather(std::move(pieces), lights, kMostGroups / facing.size());
  }
}

/// Halves the pieces' intensity along the longest side of their box until there are that many groups.
void BrightSurfaces::gather(std::vector<std::uint32_t> pieces, std::span<const LightBounds> lights,
                            std::size_t groups) {
  if (groups > 1 && pieces.size() > 1) {
    glm::vec3 lower = lights[pieces[0]].lower, upper = lights[pieces[0]].upper;
    double whole = 0.0;
    for (const std::uint32_t piece : pieces) {
      lower = glm::min(lower, lights[piece].lower);
      upper = glm::max(upper, lights[piece].upper);
      whole += lights[piece].intensity;
    }
    const glm::vec3 extent = upper - lower;
    const int dimension = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    std::sort(pieces.begin(), pieces.end(), [&](std::uint32_t a, std::uint32_t b) {
      const float left = lights[a].lower[dimension], right = lights[b].lower[dimension];
      return left != right ? left < right : a < b;
    });
    std::size_t middle = 0;
    for (double sum = 0.0; middle + 1 < pieces.size() && 2.0 * sum < whole; ++middle) {
      sum += lights[pieces[middle]].intensity;
    }
    middle = std::max(middle, std::size_t{1});
    const auto cut = pieces.begin() + static_cast<std::ptrdiff_t>(middle);
    gather({pieces.begin(), cut}, lights, groups - groups / 2);
    gather({cut, pieces.end()}, lights, groups / 2);
    return;
  }
  std::vector<LightBounds> members;
  std::vector<float> cumulative;
  float sum = 0.0f;
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    groupOf_[pieces[i]] = {static_cast<std::uint32_t>(groups_.size()), i};
    members.push_back(lights[pieces[i]]);
    sum += members.back().intensity;
    cumulative.push_back(sum);
  }
  groups_.push_back({std::move(pieces), LightTree(members), std::move(cumulative)});
}

const BrightSurfaces::View& BrightSurfaces::viewFrom(const glm::vec3& position,
                                                     const glm::vec3& normal) const {
  return views_.at(position, normal, [this](const CellSide& from) { return look(from); });
}

std::unique_ptr<BrightSurfaces::View> BrightSurfaces::look(const CellSide& from) const {
  Jitter jitter(from.number);
  std::array<float, kMostGroups> open{}, seen{};
  float allOpen = 0.0f, allSeen = 0.0f;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Group& group = groups_[g];
    const float intensity = group.cumulative.back();
    std::array<Ray, EmbreeScene::kPacket> rays;
    std::array<float, EmbreeScene::kPacket> values{};
    int count = 0;
    for (int i = 0; i < kRaysPerGroup; ++i) {
      const float which = jitter.next() * intensity;
      const auto found = std::upper_bound(group.cumulative.begin(), group.cumulative.end() - 1, which);
      const std::uint32_t piece = group.pieces[static_cast<std::size_t>(found - group.cumulative.begin())];
      const float u = jitter.next(), v = jitter.next();
      const Point point = pointOn(pieces_[piece], {u, v});
      const glm::vec3 origin = from.point(jitter);
      const glm::vec3 target = offsetRayOrigin(point.position, point.out);
      const float distance = glm::length(target - origin);
      if (!(distance > 0.0f)) continue;
      const glm::vec3 direction = (target - origin) / distance;
      // Normals of this side turn up to 55 degrees from its axis.
      const float cosine = 0.1f + glm::dot(direction, from.axis);
      const float cosineThere = -glm::dot(direction, point.out);
      if (cosine <= -0.6f || cosineThere <= 0.0f) continue;
      const auto k = static_cast<std::size_t>(count++);
      values[k] = intensity * std::max(cosine, 0.1f) * cosineThere /
                  std::max(distance * distance, from.size * from.size);
      rays[k].origin = origin;
      rays[k].direction = target - origin;
      rays[k].farthest = 1.0f - 1e-5f;
    }
    const auto transmittance = embree_.transmittance(rays, count);
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      const Rgb& t = transmittance[k];
      open[g] += values[k];
      seen[g] += values[k] * (t.x + t.y + t.z) / 3.0f;
    }
    allOpen += open[g];
    allSeen += seen[g];
  }
  auto view = std::make_unique<View>();
  if (!(allOpen > 0.0f)) return view;
  view->isDark = false;
  float sum = 0.0f;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    // A few rays may have missed the gap through which a group is seen.
    const float unseen = open[g] / allOpen;
    sum += allSeen > 0.0f ? glm::mix(seen[g] / allSeen, unseen, kUnseenShare) : unseen;
    view->cumulative[g] = sum;
  }
  for (std::size_t g = 0; g < groups_.size(); ++g) view->cumulative[g] /= sum;
  for (std::size_t g = groups_.size() - 1; g < kMostGroups; ++g) view->cumulative[g] = 1.0f;
  return view;
}

BrightSurfaces::Point BrightSurfaces::pointOn(const Piece& piece, glm::vec2 u) const {
  const Surfaces::Corners c = surfaces_.corners(piece.instance, piece.triangle);
  // Uniform over the part: PBRT 4th ed., 6.5.4, SampleUniformTriangle.
  const float least = 0.5f * std::min(u.x, u.y);
  const glm::vec2 inside = u.x < u.y ? glm::vec2(least, u.y - least) : glm::vec2(u.x - least, least);
  const float doubleArea = glm::length(c.frontNormal);
  const float side = piece.place % 2 == static_cast<std::uint32_t>(Side::kFront) ? 1.0f : -1.0f;
  Point point;
  point.barycentric = barycentricAt(partAt(piece.place / 2, piece.divisions), inside, piece.divisions);
  point.position = positionAt(c, point.barycentric);
  point.out = side / doubleArea * c.frontNormal;
  point.area = 0.5f * doubleArea / static_cast<float>(piece.divisions * piece.divisions);
  return point;
}

std::optional<BrightSurfaces::Chosen> BrightSurfaces::sample(const glm::vec3& position,
                                                             const glm::vec3& normal, float choose,
                                                             glm::vec2 u) const {
  if (groups_.empty()) return std::nullopt;
  const View& view = viewFrom(position, normal);
  if (view.isDark) return std::nullopt;
  const auto last = view.cumulative.begin() + static_cast<std::ptrdiff_t>(groups_.size()) - 1;
  const auto g = static_cast<std::size_t>(std::upper_bound(view.cumulative.begin(), last, choose) -
                                          view.cumulative.begin());
  const float before = g > 0 ? view.cumulative[g - 1] : 0.0f;
  const float share = view.cumulative[g] - before;
  if (!(share > 0.0f)) return std::nullopt;
  const std::optional<LightTree::Choice> choice =
      groups_[g].tree.choose(position, normal, std::clamp((choose - before) / share, 0.0f, kOneBelow));
  if (!choice) return std::nullopt;
  const Piece& piece = pieces_[groups_[g].pieces[choice->light]];
  const Point point = pointOn(piece, u);
  Chosen chosen;
  chosen.hit.instance = piece.instance;
  chosen.hit.triangle = piece.triangle;
  chosen.hit.barycentric = point.barycentric;
  const float distance = glm::length(point.position - position);
  if (!(distance > 0.0f)) return std::nullopt;
  chosen.hit.distance = distance;
  chosen.direction = (point.position - position) / distance;
  const float cosine = -glm::dot(point.out, chosen.direction);
  if (!(cosine > kLeastCosine)) return std::nullopt;
  chosen.target = offsetRayOrigin(point.position, point.out);
  chosen.pdf = share * choice->probability * distance * distance / (point.area * cosine);
  return chosen;
}

float BrightSurfaces::pdf(const Hit& hit, const glm::vec3& direction, float distance,
                          const glm::vec3& position, const glm::vec3& normal) const {
  const auto range = ranges_.find({hit.instance, hit.triangle});
  if (range == ranges_.end()) return 0.0f;
  const glm::vec3 frontNormal = surfaces_.corners(hit.instance, hit.triangle).frontNormal;
  const float doubleArea = glm::length(frontNormal);
  const float cosine = glm::dot(frontNormal, direction) / doubleArea;
  if (!(std::abs(cosine) > kLeastCosine)) return 0.0f;
  const auto begin = pieces_.begin() + range->second.begin, end = pieces_.begin() + range->second.end;
  const std::uint32_t divisions = begin->divisions;
  const auto side = static_cast<std::uint32_t>(cosine < 0.0f ? Side::kFront : Side::kBack);
  const std::uint32_t place = 2 * numberOf(partOf(hit.barycentric, divisions), divisions) + side;
  const auto piece = std::lower_bound(begin, end, place,
                                      [](const Piece& p, std::uint32_t wanted) { return p.place < wanted; });
  if (piece == end || piece->place != place) return 0.0f;
  const View& view = viewFrom(position, normal);
  if (view.isDark) return 0.0f;
  const Membership& member = groupOf_[static_cast<std::size_t>(piece - pieces_.begin())];
  const std::size_t g = member.group;
  const float share = view.cumulative[g] - (g > 0 ? view.cumulative[g - 1] : 0.0f);
  const float probability = groups_[g].tree.probability(member.index, position, normal);
  const float area = 0.5f * doubleArea / static_cast<float>(divisions * divisions);
  return share * probability * distance * distance / (area * std::abs(cosine));
}

}  // namespace promenade::render
