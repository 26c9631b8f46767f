#include "src/render/record_placer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "src/core/display.h"
#include "src/render/path_tracer_internal.h"
#include "src/render/ray_offset.h"

namespace promenade::render {
namespace {

/// Mirrors, glass and blended surfaces followed from the eye to what they show.
constexpr int kMostPassagesOfRecords = 4;
/// Smoother reflections than this show their surroundings clearly enough to be asked for a solution there.
constexpr float kMirrorRoughness = 0.3f;
constexpr int kProbes = 8 * EmbreeScene::kPacket;

/// Matt places that a ray comes to, through glass and by way of mirrors too. `width`: of a display pixel
/// where the ray begins, growing by `spread` per unit distance.
void addCandidates(const PathTracer& tracer, Ray ray, float width, float spread,
                   std::vector<RecordCandidate>& candidates) {
  const Surfaces& surfaces = tracer.surfaces();
  for (int passage = 0; passage <= kMostPassagesOfRecords; ++passage) {
    const Hit hit = tracer.embree().intersect(ray);
    if (!hit.found()) return;
    width += spread * hit.distance;
    const SurfacePoint point = surfaces.pointAt(hit, ray.direction);
    const SurfaceLook look = surfaces.lookAt(point, ray.direction, Footprint{});
    const glm::vec3 facing = point.frontFace ? point.geometricNormal : -point.geometricNormal;
    const BsdfAlbedo albedo = bsdfAlbedo(look.bsdf, std::max(1e-3f, -glm::dot(look.normal, ray.direction)));
    if (!look.unlit && look.alpha > 0.0f &&
        (largest(albedo.diffuse) > kLeastDiffuse || isBroadToTheEye(look.bsdf))) {
      candidates.push_back({point.position, facing, -ray.direction, width});
    }
    const bool passes = look.alpha < 1.0f || (look.bsdf.thinWalled && look.bsdf.transmission > 0.5f);
    const bool mirrors = look.bsdf.roughness < kMirrorRoughness || look.bsdf.clearcoat > 0.0f;
    if (passes) {
      ray.origin = offsetRayOrigin(point.position, -facing);
    } else if (mirrors) {
      ray.direction -= 2.0f * glm::dot(look.normal, ray.direction) * look.normal;
      if (glm::dot(ray.direction, facing) <= 0.0f) return;
      ray.origin = offsetRayOrigin(point.position, facing);
    } else {
      return;
    }
  }
}

/// Cosine-distributed rays from a surface element.
Ray rayFrom(const glm::vec3& position, const Basis& basis, Sampler& sampler) {
  Ray ray;
  ray.origin = offsetRayOrigin(position, basis.z);
  ray.direction = basis.toWorld(sampleCosine(sampler.next2D()));
  return ray;
}

Sampler::Stream streamOf(std::uint32_t use, std::uint32_t seed, int paths) {
  Sampler::Stream stream;
  stream.frame = use;
  stream.seed = seed;
  stream.pathsPerPixel = static_cast<std::uint32_t>(paths);
  return stream;
}
/// As seed of all that is placed.
constexpr std::uint32_t kPlacing = 0;
constexpr std::uint32_t kDistances = 0x10000, kBounces = 0x20000;  ///< uses; or a batch

/// Harmonic mean of the distances to what a surface element sees; infinite under the open sky.
float harmonicMeanDistance(const PathTracer& tracer, const RecordCandidate& place) {
  const Sampler::Stream stream = streamOf(kDistances, kPlacing, kProbes);
  const Basis basis(place.normal);
  float inverse = 0.0f;
  std::array<Ray, EmbreeScene::kPacket> rays;
  for (int first = 0; first < kProbes; first += EmbreeScene::kPacket) {
    for (int i = 0; i < EmbreeScene::kPacket; ++i) {
      Sampler sampler(stream, static_cast<std::uint32_t>(first + i));
      rays[static_cast<std::size_t>(i)] = rayFrom(place.position, basis, sampler);
    }
    for (const Hit& hit : tracer.embree().intersect(rays, EmbreeScene::kPacket).hits) {
      if (hit.found()) inverse += 1.0f / std::max(hit.distance, 1e-6f);
    }
  }
  return inverse > 0.0f ? static_cast<float>(kProbes) / inverse : std::numeric_limits<float>::infinity();
}

/// Rays along the surface that look for walls, and how far toward the viewer they begin, in reaches: on the
/// side of a wall from which the place is seen.
constexpr int kWallRays = EmbreeScene::kPacket;
constexpr float kBeforeSurface = 0.05f;
/// What turns less from a record's surface is that surface itself, as in a vault: cosine.
constexpr float kSameSurface = 0.7f;

/// Nearer to a wall, in the most that a record might reach there, none is placed: half of what it sees is the
/// wall's inside.
constexpr float kLeastFromWall = 0.02f;

/// What stands on the surface within reach. A floor goes on under thin walls, and what is known of it on one
/// side of them is wrong on the other. (Panes are walls, too; and what stands before a part of the surface
/// only hides all beyond its plane, which other records know.) Nothing if the place is in the foot of a wall.
std::optional<std::vector<RecordWall>> wallsAround(const PathTracer& tracer, const RecordCandidate& place,
                                                   float reach) {
  const Basis basis(place.normal);
  std::array<Ray, EmbreeScene::kPacket> rays;
  for (int i = 0; i < kWallRays; ++i) {
    const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / kWallRays;
    Ray& ray = rays[static_cast<std::size_t>(i)];
    ray.origin = offsetRayOrigin(place.position + kBeforeSurface * reach * place.towardViewer, place.normal);
    ray.direction = std::cos(angle) * basis.x + std::sin(angle) * basis.y;
    ray.farthest = reach;
  }
  const auto found = tracer.embree().intersect(rays, kWallRays);
  std::vector<RecordWall> walls;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Hit& hit = found.hits[i];
    if (!hit.found()) continue;
    const SurfacePoint point = tracer.surfaces().pointAt(hit, rays[i].direction);
    const glm::vec3 facing = point.frontFace ? point.geometricNormal : -point.geometricNormal;
    if (glm::dot(facing, place.normal) > kSameSurface) continue;
    const float offset = glm::dot(point.position - place.position, facing);
    const bool isKnown = std::any_of(walls.begin(), walls.end(), [&](const RecordWall& wall) {
      return glm::dot(wall.normal, facing) > 0.99f && std::abs(wall.offset - offset) < 0.05f * reach;
    });
    if (offset > -kLeastFromWall * reach) return std::nullopt;
    if (!isKnown) walls.push_back({facing, offset});
  }
  return walls;
}

constexpr std::uint32_t kRaysPerBounce = 16;
/// Size of a pixel for what is seen by way of a matt surface only, per unit of distance.
constexpr float kSpreadOfBounces = 0.01f;

}  // namespace

void RecordPlacer::placeSeen(const Camera& camera, int stride) {
  const double pixels = std::min(camera.size().width, settings_.mostPixelsAcross);
  const double step = stride * camera.size().width / pixels;
  const auto spread = static_cast<float>(camera.size().width / pixels / camera.focalPixels());
  const int columns = std::max(1, static_cast<int>(camera.size().width / step));
  const int rows = std::max(1, static_cast<int>(camera.size().height / step));
  place(static_cast<std::size_t>(rows), [&](std::size_t row, std::vector<RecordCandidate>& candidates) {
    for (int column = 0; column < columns; ++column) {
      Ray ray;
      ray.origin = glm::vec3(camera.pose().eye);
      ray.direction = glm::normalize(
          glm::vec3(camera.direction({(column + 0.5) * step, (static_cast<double>(row) + 0.5) * step})));
      addCandidates(tracer_, ray, 0.0f, spread, candidates);
    }
  });
}

void RecordPlacer::placeBounces(std::size_t first, std::size_t last) {
  const std::vector<RecordPlace> places = records_.places();
  place(last - first, [&](std::size_t i, std::vector<RecordCandidate>& candidates) {
    const RecordPlace& from = places[first + i];
    const Basis basis(from.normal);
    const Sampler::Stream stream = streamOf(kBounces, kPlacing, kRaysPerBounce);
    for (std::uint32_t k = 0; k < kRaysPerBounce; ++k) {
      Sampler sampler(stream, k);
      addCandidates(tracer_, rayFrom(from.position, basis, sampler), from.reach / spacing_.leastReachPixels,
                    kSpreadOfBounces, candidates);
    }
  });
}

std::optional<float> RecordPlacer::wanted(const RecordCandidate& c) const {
  const IrradianceRecords::Coverage known = records_.coverage(c.position, c.normal);
  const float most = spacing_.mostReachPixels * c.pixelWidth;
  if (!known.covered) return most;
  if (known.coveredNew) return std::nullopt;
  // A walk comes nearer to what was first seen from afar.
  if (known.finestReach > 2.0f * most) return most;
  const float half = 0.5f * known.finestReach;
  if (half < spacing_.leastReachPixels * c.pixelWidth) return std::nullopt;
  if (known.most - known.least <= settings_.disagreement * std::max(known.most, darkness_)) {
    return std::nullopt;
  }
  return half;
}

void RecordPlacer::place(std::size_t count, const Find& find) {
  darkness_ = settings_.darkness * meanLuminance();
  std::vector<std::vector<Open>> open(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    if (settings_.checkpoint) settings_.checkpoint();
    std::vector<RecordCandidate> candidates;
    find(i, candidates);
    for (const RecordCandidate& c : candidates) {
      const std::optional<float> most = wanted(c);
      if (!most) continue;
      const float surroundings = spacing_.reachOfSurroundings * harmonicMeanDistance(tracer_, c);
      const float least = std::min(spacing_.leastReachPixels * c.pixelWidth, *most);
      const float reach = std::clamp(surroundings, least, *most);
      std::optional<std::vector<RecordWall>> walls = wallsAround(tracer_, c, reach);
      if (walls) open[i].push_back({c, reach, std::move(*walls)});
    }
  });
  for (const auto& group : open) {
    for (const Open& o : group) {
      // Its neighbours may have come to cover it since.
      const std::optional<float> most = wanted(o.place);
      if (!most) continue;
      const float least = std::min(spacing_.leastReachPixels * o.place.pixelWidth, *most);
      const float reach =
          records_.clampedReach(o.place.position, std::min(o.mostReach, *most), spacing_.reachOfSurroundings);
      records_.place({o.place.position, o.place.normal, std::max(least, reach)}, o.walls);
    }
  }
}

float RecordPlacer::meanLuminance() const {
  if (records_.light().empty()) return 0.0f;
  double sum = 0.0;
  for (const SurfaceLight& light : records_.light()) sum += luminance(light.radiance);
  return static_cast<float>(sum / static_cast<double>(records_.light().size()));
}

}  // namespace promenade::render
