#include "src/render/irradiance_solution.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>
#include <numbers>

#include "src/core/display.h"
#include "src/render/ray_offset.h"

namespace promenade::render {
namespace {

/// Mirrors, glass and blended surfaces followed from the eye to what they show.
constexpr int kMostPassages = 4;
/// Smoother reflections than this show their surroundings clearly enough to be asked for a solution there.
constexpr float kMirrorRoughness = 0.3f;
constexpr float kLeastDiffuse = 0.01f;
constexpr int kProbes = 8 * EmbreeScene::kPacket;

/// A place on a matt surface that the walk looks at.
struct Candidate {
  glm::vec3 position{0.0f};
  glm::vec3 normal{0.0f};
  float pixelWidth = 0.0f;  ///< of a display pixel there
};

float largest(const Rgb& c) {
  return std::max(c.x, std::max(c.y, c.z));
}

/// What one pixel sees, through glass and in mirrors too.
void addCandidates(const PathTracer& tracer, const Camera& camera, glm::dvec2 pixel, float pixelWidth,
                   std::vector<Candidate>& candidates) {
  const Surfaces& surfaces = tracer.surfaces();
  Ray ray;
  ray.origin = glm::vec3(camera.pose().eye);
  ray.direction = glm::normalize(glm::vec3(camera.direction(pixel)));
  float distance = 0.0f;
  for (int passage = 0; passage <= kMostPassages; ++passage) {
    const Hit hit = tracer.embree().intersect(ray);
    if (!hit.found()) return;
    distance += hit.distance;
    const SurfacePoint point = surfaces.pointAt(hit, ray.direction);
    const SurfaceLook look = surfaces.lookAt(point, ray.direction, Footprint{});
    const glm::vec3 facing = point.frontFace ? point.geometricNormal : -point.geometricNormal;
    const BsdfAlbedo albedo = bsdfAlbedo(look.bsdf, std::max(1e-3f, -glm::dot(look.normal, ray.direction)));
    if (!look.unlit && look.alpha > 0.0f && largest(albedo.diffuse) > kLeastDiffuse) {
      candidates.push_back({point.position, facing, pixelWidth * distance});
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

/// Harmonic mean of the distances to what a surface element sees; infinite under the open sky.
float harmonicMeanDistance(const PathTracer& tracer, const Candidate& place, const Sampler::Stream& stream) {
  const glm::vec3 helper = std::abs(place.normal.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  const glm::vec3 x = glm::normalize(glm::cross(helper, place.normal));
  const glm::vec3 y = glm::cross(place.normal, x);
  const glm::vec3 origin = offsetRayOrigin(place.position, place.normal);
  float inverse = 0.0f;
  std::array<Ray, EmbreeScene::kPacket> rays;
  for (int first = 0; first < kProbes; first += EmbreeScene::kPacket) {
    for (int i = 0; i < EmbreeScene::kPacket; ++i) {
      Sampler sampler(stream, static_cast<std::uint32_t>(first + i));
      const glm::vec2 u = sampler.next2D();
      const float radius = std::sqrt(u.x);
      const float phi = 2.0f * std::numbers::pi_v<float> * u.y;
      Ray& ray = rays[static_cast<std::size_t>(i)];
      ray = Ray{};
      ray.origin = origin;
      ray.direction = radius * std::cos(phi) * x + radius * std::sin(phi) * y +
                      std::sqrt(std::max(0.0f, 1.0f - u.x)) * place.normal;
    }
    for (const Hit& hit : tracer.embree().intersect(rays, EmbreeScene::kPacket)) {
      if (hit.found()) inverse += 1.0f / std::max(hit.distance, 1e-6f);
    }
  }
  return inverse > 0.0f ? static_cast<float>(kProbes) / inverse : std::numeric_limits<float>::infinity();
}

Sampler::Stream streamOf(std::size_t number, std::uint32_t frame, const SolutionSettings& settings,
                         int paths) {
  Sampler::Stream stream;
  stream.pixel = {static_cast<std::uint32_t>(number & 0xffffu), static_cast<std::uint32_t>(number >> 16)};
  stream.frame = frame;
  stream.seed = settings.seed;
  stream.pathsPerPixel = static_cast<std::uint32_t>(paths);
  return stream;
}

/// Records for what a camera sees, coarse grid first, so that the finer ones find most of it covered.
void placeRecords(const PathTracer& tracer, const Camera& camera, const SolutionSettings& settings,
                  IrradianceRecords& records) {
  const double pixels = std::min(camera.size().width, settings.mostPixelsAcross);
  const double step = camera.size().width / pixels;
  const auto pixelWidth = static_cast<float>(step / camera.focalPixels());
  for (const int stride : {16, 8, 4, 2}) {
    if (settings.checkpoint) settings.checkpoint();
    const int columns = std::max(1, static_cast<int>(camera.size().width / (step * stride)));
    const int rows = std::max(1, static_cast<int>(camera.size().height / (step * stride)));
    std::vector<std::vector<Candidate>> open(static_cast<std::size_t>(rows));
    tbb::parallel_for(0, rows, [&](int row) {
      std::vector<Candidate> candidates;
      for (int column = 0; column < columns; ++column) {
        addCandidates(tracer, camera, {(column + 0.5) * step * stride, (row + 0.5) * step * stride},
                      pixelWidth, candidates);
      }
      for (const Candidate& c : candidates) {
        if (!records.covers(c.position, c.normal, 2.0f * settings.mostReachPixels * c.pixelWidth)) {
          open[static_cast<std::size_t>(row)].push_back(c);
        }
      }
    });
    std::vector<Candidate> candidates;
    for (const auto& row : open) candidates.insert(candidates.end(), row.begin(), row.end());
    std::vector<float> reaches(candidates.size());
    tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
      const Candidate& c = candidates[i];
      const float surroundings =
          harmonicMeanDistance(tracer, c, streamOf(i, static_cast<std::uint32_t>(stride), settings, kProbes));
      reaches[i] =
          std::clamp(settings.reachOfSurroundings * surroundings, settings.leastReachPixels * c.pixelWidth,
                     settings.mostReachPixels * c.pixelWidth);
    });
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const Candidate& c = candidates[i];
      if (records.covers(c.position, c.normal, 2.0f * settings.mostReachPixels * c.pixelWidth)) continue;
      records.place({c.position, c.normal, reaches[i]});
    }
  }
}

SurfaceLight gatherLight(const PathTracer& tracer, const RecordPlace& place, std::size_t number,
                         const SolutionSettings& settings, PathRays& rays) {
  SurfaceLight sum;
  double mean = 0.0;
  double squares = 0.0;
  int batches = 0;
  while (batches < settings.mostBatches) {
    const SurfaceLight batch = tracer.gather(
        place.position, place.normal,
        streamOf(number, static_cast<std::uint32_t>(batches), settings, settings.pathsPerBatch), rays);
    ++batches;
    sum.radiance += batch.radiance;
    sum.meanDirection += batch.meanDirection * luminance(batch.radiance);
    const double value = luminance(batch.radiance);
    const double difference = value - mean;
    mean += difference / batches;
    squares += difference * (value - mean);
    if (batches < settings.leastBatches) continue;
    const double standardError = std::sqrt(squares / (static_cast<double>(batches) * (batches - 1)));
    if (standardError <= settings.relativeError * mean) break;
  }
  const float whole = luminance(sum.radiance);
  if (whole > 0.0f) sum.meanDirection /= whole;
  sum.radiance /= static_cast<float>(batches);
  return sum;
}

}  // namespace

LightSolution solveIrradiance(const PathTracer& tracer, std::span<const Camera> cameras,
                              const SolutionSettings& settings, const ProgressCallback& progress) {
  LightSolution solution;
  for (const Camera& camera : cameras) placeRecords(tracer, camera, settings, solution.records);

  const auto& places = solution.records.places();
  std::vector<SurfaceLight> light(places.size());
  std::mutex reporting;
  std::size_t done = 0;
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) {
    if (settings.checkpoint) settings.checkpoint();
    PathRays rays;
    light[i] = gatherLight(tracer, places[i], i, settings, rays);
    const std::scoped_lock lock(reporting);
    solution.rays.scattered += rays.scattered;
    solution.rays.shadow += rays.shadow;
    ++done;
    if (progress && (done % 64 == 0 || done == places.size()))
      progress({"light records", done, places.size()});
  });
  solution.records.setLight(std::move(light));
  return solution;
}

}  // namespace promenade::render
