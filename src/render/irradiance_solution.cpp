#include "src/render/irradiance_solution.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <mutex>
#include <utility>

#include "src/core/display.h"
#include "src/core/fnv1a.h"
#include "src/render/record_placer.h"

namespace promenade::render {
namespace {

constexpr int kCoarsestStride = 32, kFinestStride = 2;  ///< display pixels
/// How often light is followed from what the cameras see to what sends it there.
constexpr int kBounceLevels = 2;
/// How often coarse records are gathered to know how noisy they are: the first result ends the paths of the
/// second.
constexpr int kCoarsePasses = 2;
/// The passes in which the coarse records of a noisy scene are gathered again, by the share of their paths:
/// of what all records have too much or too little of, two thirds stay after a further pass, so early ones
/// need not be as clean as the last.
constexpr std::array kNoisyPasses = {0.25, 0.25, 0.5, 1.0};
/// The passes before which bright surfaces are looked for: they need only be roughly known.
constexpr std::size_t kBrightPasses = 2;
/// A coarse record sends light on only to what is at least its reach away, over this. Measured in a white
/// room: 4, 2 and 1 take out nearly the same error, and the paths that go on are dearer and dearer.
constexpr float kMostReachOfDistance = 4.0f;
/// Of coarse records, on the sky and on lamps each.
constexpr int kPointsPerPath = 4;

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

std::uint64_t pathsOf(std::size_t records, int each) {
  return static_cast<std::uint64_t>(records) * static_cast<std::uint64_t>(each);
}

int noisyPaths(const SolutionSettings& settings, std::size_t pass) {
  return static_cast<int>(kNoisyPasses[pass] * settings.noisyCoarsePaths);
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

/// Gathers the light of records.
class IrradianceSolver::Gatherer {
 public:
  Gatherer(PathTracer& tracer, const SolutionSettings& settings, const ProgressCallback& progress)
      : tracer_(tracer), settings_(settings), progress_(progress) {}

  [[nodiscard]] GatherEffort coarse() const { return all(settings_.coarsePaths); }
  [[nodiscard]] GatherEffort lastCoarse() const { return all(settings_.lastCoarsePaths); }
  [[nodiscard]] GatherEffort noisyCoarse(std::size_t pass) const { return all(noisyPaths(settings_, pass)); }
  [[nodiscard]] GatherEffort fine() const { return settings_.fineEffort; }

  enum class Directions { kForget, kKeep };
  /// Light of the records from `first` on: of coarse ones without their directions, whose noise averages out;
  /// of fine ones with them, whose noise is seen. Where they are gathered once more, `numbers` gives the
  /// paths other random ones, so that their errors do not add up from pass to pass.
  void gather(IrradianceRecords& records, std::size_t first, const GatherEffort& effort,
              Directions directions, std::uint32_t numbers) {
    const auto& places = records.places();
    std::vector<SurfaceLight> light = records.light();
    light.resize(places.size());
    std::vector<LightField> fields = records.fields();
    if (directions == Directions::kKeep) fields.resize(places.size());
    std::mutex reporting;
    std::size_t done = 0;
    tbb::parallel_for(first, places.size(), [&](std::size_t i) {
      if (settings_.checkpoint) settings_.checkpoint();
      PathRays rays;
      const Gathered gathered =
          tracer_.gather(places[i].position, places[i].normal, numbersOf(i, numbers), effort, rays);
      light[i] = gathered.light;
      if (directions == Directions::kKeep) fields[i] = gathered.field;
      const std::scoped_lock lock(reporting);
      rays_.scattered += rays.scattered;
      rays_.shadow += rays.shadow;
      ++done;
      if (progress_ && (done % 64 == 0 || first + done == places.size())) {
        progress_({"light records", first + done, places.size()});
      }
    });
    records.setLight(std::move(light), std::move(fields), noiseOf(directions));
  }

  [[nodiscard]] const PathRays& rays() const { return rays_; }

 private:
  [[nodiscard]] static IrradianceRecords::Noise noiseOf(Directions directions) {
    return directions == Directions::kKeep ? IrradianceRecords::Noise::kTakenOut
                                           : IrradianceRecords::Noise::kLeftIn;
  }
  /// No more than that: the errors of coarse records average out, if they have no share in which samples they
  /// get.
  [[nodiscard]] static GatherEffort all(int paths) { return {paths, kPointsPerPath * paths, 0, 0.0f}; }
  [[nodiscard]] Sampler::Stream numbersOf(std::size_t record, std::uint32_t numbers) const {
    constexpr std::uint32_t kEach = 0x632be5abu;  // odd, so that no two are equal
    Sampler::Stream stream;
    stream.seed = settings_.seed ^ numbers * kEach;
    stream.pixel = {static_cast<std::uint32_t>(record & 0xffffu), static_cast<std::uint32_t>(record >> 16)};
    return stream;
  }

  PathTracer& tracer_;
  const SolutionSettings& settings_;
  const ProgressCallback& progress_;
  PathRays rays_;
};

bool LightSolution::isFor(const Camera& camera) const {
  return std::find(cameras.begin(), cameras.end(), fingerprint(camera)) != cameras.end();
}

std::optional<SurfaceLight> LightSolution::at(const glm::vec3& position, const glm::vec3& normal) const {
  std::optional<SurfaceLight> light = fine.at(position, normal);
  return light ? light : coarse.roughlyAt(position, normal);
}

std::optional<SurfaceLight> LightSolution::roughlyAt(const glm::vec3& position, const glm::vec3& normal,
                                                     float distance) const {
  std::optional<SurfaceLight> light = fine.roughlyAt(position, normal);
  return light ? light : coarse.roughlyAt(position, normal, kMostReachOfDistance * distance);
}

IrradianceSolver::IrradianceSolver(PathTracer& tracer, std::span<const Camera> cameras,
                                   const SolutionSettings& settings,
                                   const std::shared_ptr<const LightSolution>& known)
    : tracer_(tracer), settings_(settings), known_(known) {
  if (known_) solution_ = *known_;
  solution_.rays = {};
  coarseBefore_ = solution_.coarse.places().size();
  fineBefore_ = solution_.fine.places().size();
  for (const Camera& camera : cameras) {
    if (!solution_.isFor(camera)) added_.push_back(camera);
  }
  stride_ = added_.empty() ? 0 : kCoarsestStride / 2;
}

bool IrradianceSolver::isFirst() const {
  return stride_ == kCoarsestStride / 2;
}

void IrradianceSolver::placeCoarse() {
  IrradianceRecords& records = solution_.coarse;
  RecordPlacer placer(tracer_, settings_, settings_.coarse, records);
  for (const Camera& camera : added_) placer.placeSeen(camera, kCoarsestStride);
  std::size_t first = coarseBefore_;
  for (int bounce = 0; bounce < kBounceLevels; ++bounce) {
    const std::size_t last = records.places().size();
    placer.placeBounces(first, last);
    first = last;
  }
}

void IrradianceSolver::gatherCoarse(Gatherer& gatherer, const MayTrace& mayTrace) {
  IrradianceRecords& records = solution_.coarse;
  if (known_) {
    use(tracer_, known_->coarse);
  } else {
    tracer_.setSolution(nullptr);
  }
  tracer_.setBright(nullptr);
  std::uint32_t numbers = 0;
  for (int pass = 0; pass < kCoarsePasses; ++pass) {
    if (pass > 0) use(tracer_, records);
    gatherer.gather(records, coarseBefore_, gatherer.coarse(), Gatherer::Directions::kForget, numbers++);
  }
  isNoisy_ = meanRelativeError(records.light(), coarseBefore_) > settings_.noisy;
  std::uint64_t more = 0;
  for (std::size_t pass = 0; pass < kNoisyPasses.size(); ++pass) {
    more += pathsOf(records.places().size() - coarseBefore_, noisyPaths(settings_, pass));
  }
  if (isNoisy_ && (!mayTrace || mayTrace(more))) {
    // Few paths bring most of the light. Where it comes from is known well enough now; how much it is, only
    // when the records that send it are clean.
    for (std::size_t pass = 0; pass < kNoisyPasses.size(); ++pass) {
      use(tracer_, records);
      if (pass < kBrightPasses) tracer_.setBright(tracer_.findBright());
      gatherer.gather(records, coarseBefore_, gatherer.noisyCoarse(pass), Gatherer::Directions::kForget,
                      numbers++);
    }
    isNoisy_ = false;
  } else if (!isNoisy_) {
    use(tracer_, records);
    gatherer.gather(records, coarseBefore_, gatherer.lastCoarse(), Gatherer::Directions::kForget, numbers++);
  }
  use(tracer_, records);
}

std::uint64_t IrradianceSolver::place() {
  assert(!isDone());
  if (!isPlaced_) {
    if (isFirst()) placeCoarse();
    RecordPlacer placer(tracer_, settings_, settings_.fine, solution_.fine);
    for (const Camera& camera : added_) placer.placeSeen(camera, stride_);
    isPlaced_ = true;
  }
  const std::uint64_t fine =
      pathsOf(solution_.fine.places().size() - fineBefore_, settings_.fineEffort.paths);
  if (!isFirst()) return fine;
  return fine + pathsOf(solution_.coarse.places().size() - coarseBefore_,
                        kCoarsePasses * settings_.coarsePaths + settings_.lastCoarsePaths);
}

void IrradianceSolver::gather(const ProgressCallback& progress, const MayTrace& mayTrace) {
  (void)place();
  Gatherer gatherer(tracer_, settings_, progress);
  if (isFirst()) gatherCoarse(gatherer, mayTrace);
  gatherer.gather(solution_.fine, fineBefore_, gatherer.fine(), Gatherer::Directions::kKeep, 0);
  solution_.rays.scattered += gatherer.rays().scattered;
  solution_.rays.shadow += gatherer.rays().shadow;
  fineBefore_ = solution_.fine.places().size();
  isPlaced_ = false;
  stride_ = stride_ > kFinestStride ? stride_ / 2 : 0;
  if (isDone() && !isNoisy_) {
    for (const Camera& camera : added_) solution_.cameras.push_back(fingerprint(camera));
  }
}

int IrradianceSolver::levelsLeft() const {
  int levels = 0;
  for (int stride = stride_; stride >= kFinestStride; stride /= 2) ++levels;
  return levels;
}

}  // namespace promenade::render
