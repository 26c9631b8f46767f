#include "src/render/irradiance_solution.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>

#include "src/core/display.h"
#include "src/core/fnv1a.h"
#include "src/render/path_tracer_internal.h"
#include "src/render/ray_offset.h"

namespace promenade::render {
namespace {

/// Mirrors, glass and blended surfaces followed from the eye to what they show.
constexpr int kMostPassagesOfRecords = 4;
/// Smoother reflections than this show their surroundings clearly enough to be asked for a solution there.
constexpr float kMirrorRoughness = 0.3f;
constexpr int kProbes = 8 * EmbreeScene::kPacket;

/// A place on a matt surface that the walk looks at.
struct Candidate {
  glm::vec3 position{0.0f};
  glm::vec3 normal{0.0f};
  float pixelWidth = 0.0f;  ///< of a display pixel there
};

/// Matt places that a ray comes to, through glass and by way of mirrors too. `width`: of a display pixel
/// where the ray begins, growing by `spread` per unit distance.
void addCandidates(const PathTracer& tracer, Ray ray, float width, float spread,
                   std::vector<Candidate>& candidates) {
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
      candidates.push_back({point.position, facing, width});
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
/// Where records are does not depend on the seed: that is the error of their light alone.
constexpr std::uint32_t kPlacing = 0;
constexpr std::uint32_t kDistances = 0x10000, kBounces = 0x20000;  ///< uses; or a batch

/// Harmonic mean of the distances to what a surface element sees; infinite under the open sky.
float harmonicMeanDistance(const PathTracer& tracer, const Candidate& place) {
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

/// Places the records of one spacing and gathers their light.
class Placer {
 public:
  Placer(const PathTracer& tracer, const SolutionSettings& settings, const RecordSpacing& spacing,
         IrradianceRecords& records)
      : tracer_(tracer), settings_(settings), spacing_(spacing), records_(records) {}

  /// What a camera sees on a grid of that many display pixels.
  void placeSeen(const Camera& camera, int stride) {
    const double pixels = std::min(camera.size().width, settings_.mostPixelsAcross);
    const double step = stride * camera.size().width / pixels;
    const auto spread = static_cast<float>(camera.size().width / pixels / camera.focalPixels());
    const int columns = std::max(1, static_cast<int>(camera.size().width / step));
    const int rows = std::max(1, static_cast<int>(camera.size().height / step));
    place(static_cast<std::size_t>(rows), [&](std::size_t row, std::vector<Candidate>& candidates) {
      for (int column = 0; column < columns; ++column) {
        Ray ray;
        ray.origin = glm::vec3(camera.pose().eye);
        ray.direction = glm::normalize(
            glm::vec3(camera.direction({(column + 0.5) * step, (static_cast<double>(row) + 0.5) * step})));
        addCandidates(tracer_, ray, 0.0f, spread, candidates);
      }
    });
  }

  /// What sends light to the records from `first` to `last`.
  void placeBounces(std::size_t first, std::size_t last) {
    const std::vector<RecordPlace> places = records_.places();
    place(last - first, [&](std::size_t i, std::vector<Candidate>& candidates) {
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

 private:
  static constexpr int kRaysPerBounce = 16;
  /// Size of a pixel for what is seen by way of a matt surface only, per unit of distance.
  static constexpr float kSpreadOfBounces = 0.01f;

  struct Open {
    Candidate place;
    float mostReach;
  };

  /// Farthest that a new record at a place may reach; nothing if what is known there is good enough.
  [[nodiscard]] std::optional<float> wanted(const Candidate& c) const {
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

  /// `find(i, candidates)` adds the i-th of `count` groups of candidates.
  template <class Find>
  void place(std::size_t count, const Find& find) {
    if (settings_.checkpoint) settings_.checkpoint();
    darkness_ = settings_.darkness * meanLuminance();
    std::vector<std::vector<Open>> open(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      std::vector<Candidate> candidates;
      find(i, candidates);
      for (const Candidate& c : candidates) {
        const std::optional<float> most = wanted(c);
        if (!most) continue;
        const float surroundings = spacing_.reachOfSurroundings * harmonicMeanDistance(tracer_, c);
        const float least = std::min(spacing_.leastReachPixels * c.pixelWidth, *most);
        open[i].push_back({c, std::clamp(surroundings, least, *most)});
      }
    });
    for (const auto& group : open) {
      for (const Open& o : group) {
        // Its neighbours may have come to cover it since.
        const std::optional<float> most = wanted(o.place);
        if (!most) continue;
        const float least = std::min(spacing_.leastReachPixels * o.place.pixelWidth, *most);
        const float reach = records_.clampedReach(o.place.position, std::min(o.mostReach, *most),
                                                  spacing_.reachOfSurroundings);
        records_.place({o.place.position, o.place.normal, std::max(least, reach)});
      }
    }
  }

  [[nodiscard]] float meanLuminance() const {
    if (records_.light().empty()) return 0.0f;
    double sum = 0.0;
    for (const SurfaceLight& light : records_.light()) sum += luminance(light.radiance);
    return static_cast<float>(sum / static_cast<double>(records_.light().size()));
  }

  const PathTracer& tracer_;
  const SolutionSettings& settings_;
  const RecordSpacing& spacing_;
  IrradianceRecords& records_;
  float darkness_ = 0.0f;
};

/// Gathers the light of records.
class Gatherer {
 public:
  Gatherer(PathTracer& tracer, const SolutionSettings& settings, const ProgressCallback& progress)
      : tracer_(tracer), settings_(settings), progress_(progress) {}

  struct Effort {
    int pathsPerBatch, leastBatches, mostBatches;
    bool byDirection;
  };
  [[nodiscard]] Effort coarse() const { return {settings_.coarsePaths, 1, 1, false}; }
  [[nodiscard]] Effort noisyCoarse() const { return {settings_.noisyCoarsePaths, 1, 1, false}; }
  [[nodiscard]] Effort fine() const {
    return {settings_.pathsPerBatch, settings_.leastBatches, settings_.mostBatches, true};
  }

  /// Light of the records from `first` on.
  void gather(IrradianceRecords& records, std::size_t first, const Effort& effort) {
    const auto& places = records.places();
    std::vector<SurfaceLight> light = records.light();
    light.resize(places.size());
    std::vector<LightField> fields = records.fields();
    if (effort.byDirection) fields.resize(places.size());
    std::mutex reporting;
    std::size_t done = 0;
    tbb::parallel_for(first, places.size(), [&](std::size_t i) {
      if (settings_.checkpoint) settings_.checkpoint();
      PathRays rays;
      light[i] = lightAt(places[i], i, effort, effort.byDirection ? &fields[i] : nullptr, rays);
      const std::scoped_lock lock(reporting);
      rays_.scattered += rays.scattered;
      rays_.shadow += rays.shadow;
      ++done;
      if (progress_ && (done % 64 == 0 || first + done == places.size())) {
        progress_({"light records", first + done, places.size()});
      }
    });
    records.setLight(std::move(light), std::move(fields));
  }

  [[nodiscard]] const PathRays& rays() const { return rays_; }

 private:
  [[nodiscard]] SurfaceLight lightAt(const RecordPlace& place, std::size_t number, const Effort& effort,
                                     LightField* field, PathRays& rays) const {
    SurfaceLight sum;
    FieldSums sums;
    double squaredError = 0.0;  // of the sum of the batches
    int batches = 0;
    while (batches < effort.mostBatches) {
      Sampler::Stream stream =
          streamOf(static_cast<std::uint32_t>(batches), settings_.seed, effort.pathsPerBatch);
      stream.pixel = {static_cast<std::uint32_t>(number & 0xffffu), static_cast<std::uint32_t>(number >> 16)};
      const SurfaceLight batch =
          tracer_.gather(place.position, place.normal, stream, rays, field != nullptr ? &sums : nullptr);
      ++batches;
      sum.radiance += batch.radiance;
      sum.meanDirection += batch.meanDirection * luminance(batch.radiance);
      squaredError += batch.error * batch.error;
      if (batches < effort.leastBatches) continue;
      if (std::sqrt(squaredError) <= settings_.relativeError * luminance(sum.radiance)) break;
    }
    const float whole = luminance(sum.radiance);
    if (whole > 0.0f) sum.meanDirection /= whole;
    sum.radiance /= static_cast<float>(batches);
    const float unit = luminance(sum.radiance);
    if (field != nullptr && unit > 0.0f) *field = sums.finish(batches * effort.pathsPerBatch, unit);
    sum.error = static_cast<float>(std::sqrt(squaredError)) / static_cast<float>(batches);
    return sum;
  }

  PathTracer& tracer_;
  const SolutionSettings& settings_;
  const ProgressCallback& progress_;
  PathRays rays_;
};

constexpr int kCoarsestStride = 32, kFinestStride = 2;  ///< display pixels
/// How often light is followed from what the cameras see to what sends it there.
constexpr int kBounceLevels = 2;
/// How often the coarse records of a noisy scene are gathered again: the first time their paths still end at
/// noisy ones.
constexpr int kNoisyPasses = 2;

/// Gathering paths end at these records from now on.
void use(PathTracer& tracer, const IrradianceRecords& coarse) {
  tracer.setSolution(std::make_shared<const LightSolution>(LightSolution{coarse, {}, {}, {}}));
}

/// Of the records from `first` on.
double meanRelativeError(const std::vector<SurfaceLight>& light, std::size_t first) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = first; i < light.size(); ++i) {
    const float value = luminance(light[i].radiance);
    if (!(value > 0.0f)) continue;
    sum += light[i].error / value;
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

void extendCoarse(PathTracer& tracer, Gatherer& gatherer, std::span<const Camera> cameras,
                  const SolutionSettings& settings, IrradianceRecords& records) {
  Placer placer(tracer, settings, settings.coarse, records);
  const std::size_t before = records.places().size();
  for (const Camera& camera : cameras) placer.placeSeen(camera, kCoarsestStride);
  std::size_t first = before;
  for (int bounce = 0; bounce < kBounceLevels; ++bounce) {
    const std::size_t last = records.places().size();
    placer.placeBounces(first, last);
    first = last;
  }
  gatherer.gather(records, before, gatherer.coarse());
  use(tracer, records);
  gatherer.gather(records, before, gatherer.coarse());
  if (meanRelativeError(records.light(), before) <= settings.noisy) return;
  // Few paths bring most of the light. Where it comes from is known well enough now; how much it is, only
  // when the records that send it are clean.
  for (int pass = 0; pass < kNoisyPasses; ++pass) {
    use(tracer, records);
    tracer.setBright(tracer.findBright());
    gatherer.gather(records, before, gatherer.noisyCoarse());
  }
}

std::uint64_t fingerprint(const Camera& camera) {
  const Pose& pose = camera.pose();
  std::vector<double> values = {camera.verticalFieldOfView(), static_cast<double>(camera.size().width),
                                static_cast<double>(camera.size().height)};
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) values.push_back(pose.worldFromCamera[c][r]);
    values.push_back(pose.eye[c]);
  }
  return fnv1a(std::as_bytes(std::span<const double>(values)));
}

}  // namespace

bool LightSolution::isFor(const Camera& camera) const {
  return std::find(cameras.begin(), cameras.end(), fingerprint(camera)) != cameras.end();
}

std::optional<SurfaceLight> LightSolution::at(const glm::vec3& position, const glm::vec3& normal) const {
  std::optional<SurfaceLight> light = fine.at(position, normal);
  return light ? light : coarse.roughlyAt(position, normal);
}

std::optional<SurfaceLight> LightSolution::roughlyAt(const glm::vec3& position,
                                                     const glm::vec3& normal) const {
  std::optional<SurfaceLight> light = fine.roughlyAt(position, normal);
  return light ? light : coarse.roughlyAt(position, normal);
}

std::shared_ptr<const LightSolution> solveIrradiance(PathTracer& tracer, std::span<const Camera> cameras,
                                                     const SolutionSettings& settings,
                                                     const std::shared_ptr<const LightSolution>& known,
                                                     const ProgressCallback& progress) {
  LightSolution solution = known ? *known : LightSolution{};
  std::vector<Camera> added;
  for (const Camera& camera : cameras) {
    if (solution.isFor(camera)) continue;
    solution.cameras.push_back(fingerprint(camera));
    added.push_back(camera);
  }

  Gatherer gatherer(tracer, settings, progress);
  if (known) use(tracer, known->coarse);
  extendCoarse(tracer, gatherer, added, settings, solution.coarse);
  use(tracer, solution.coarse);
  Placer placer(tracer, settings, settings.fine, solution.fine);
  for (int stride = kCoarsestStride / 2; stride >= kFinestStride; stride /= 2) {
    const std::size_t before = solution.fine.places().size();
    for (const Camera& camera : added) placer.placeSeen(camera, stride);
    gatherer.gather(solution.fine, before, gatherer.fine());
  }
  solution.rays = gatherer.rays();
  return std::make_shared<const LightSolution>(std::move(solution));
}

}  // namespace promenade::render
