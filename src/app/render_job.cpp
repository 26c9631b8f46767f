#include "src/app/render_job.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <string_view>

#include "src/app/displays.h"
#include "src/app/fingerprint.h"
#include "src/app/interrupt.h"
#include "src/app/machine.h"
#include "src/app/path_choice.h"
#include "src/app/printable.h"
#include "src/app/scene_options.h"
#include "src/app/values.h"
#include "src/core/errors.h"
#include "src/io/environment.h"
#include "src/io/path_file.h"
#include "src/io/video.h"
#include "src/scene/sky.h"
#include "src/walkthrough/statistics.h"

namespace promenade::app {
namespace {

std::uint64_t seedFrom(const std::string& text) {
  return static_cast<std::uint64_t>(integerFrom(text, 0, 2'147'483'647, "--seed"));
}

std::optional<walkthrough::Antialiasing> antialiasingFrom(const RenderOptions& options) {
  walkthrough::Antialiasing antialiasing;
  antialiasing.radius = integerFrom(options.filterRadius, 1, 16, "--filter-radius");
  if (choiceFrom(options.filter, {"box", "temporal"}, "--filter") == "box") return std::nullopt;
  // Their samples lie in the middle of pixels in every frame.
  if (!options.from.empty() || !options.renderer.empty()) {
    throw InputError(
        "--filter: expected box for frames of another renderer (--from, --renderer), found temporal");
  }
  return antialiasing;
}

// A clear sky of turbidity 3.
Environment skyFrom(const std::string& sun) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const glm::dvec2 degrees(pairFrom(sun, "--sun"));
  if (!(degrees.x >= 0.0 && degrees.x <= 90.0 && std::abs(degrees.y) <= 360.0)) {
    throw InputError("--sun: expected an elevation from 0 to 90 and an azimuth within 360 degrees, found '" +
                     printable(sun) + "'");
  }
  return clearSky(degrees.x * kDegree, degrees.y * kDegree, 3.0);
}

// Every option does unless it is known not to, so that a new one cannot be forgotten. What files hold, and
// what is resolved into `Settings`, enters the hash as such.
bool decidesPixels(const std::string& option) {
  static constexpr std::string_view kDoNot[] = {"path",
                                                "from",
                                                "out",
                                                "fps",
                                                "frames",
                                                "display",
                                                "tone",
                                                "ocio",
                                                "ocio-display",
                                                "ocio-view",
                                                "ocio-input",
                                                "environment",
                                                "light-solution",
                                                "video",
                                                "threads",
                                                "resume",
                                                "overwrite",
                                                "maps",
                                                "config",
                                                "quiet",
                                                "log-level",
                                                "help",
                                                "allow-outside-folder",
                                                "max-file-bytes",
                                                "max-json-bytes",
                                                "max-texture-bytes",
                                                "texture-memory",
                                                "max-geometry-bytes",
                                                "max-triangles",
                                                "max-instances",
                                                "max-expansion"};
  return std::find(std::begin(kDoNot), std::end(kDoNot), option) == std::end(kDoNot);
}

}  // namespace

RenderValues renderValues(const RenderOptions& options) {
  RenderValues v;
  v.size = sizeFrom(options.size, "--size");
  if (!options.fps.empty()) v.framesPerSecond = numberFrom(options.fps, 0.01, 1000.0, "--fps");
  v.supersample = integerFrom(options.supersample, 1, 16, "--supersample");
  v.antialiasing = antialiasingFrom(options);
  if (options.spp != "auto") v.pathsPerSample = integerFrom(options.spp, 1, 1 << 20, "--spp");
  v.tolerancePercent = numberFrom(options.tolerance, 0.0, 100.0, "--tolerance");
  v.spacing = integerFrom(options.spacing, 1, 256, "--spacing");
  v.verifyPercent = numberFrom(options.verify, 0.0, 100.0, "--verify");
  v.footprintLimit = numberFrom(options.footprintLimit, 0.01, 1000.0, "--footprint-limit");
  v.method = choiceFrom(options.method, {"ibr", "full"}, "--method") == "full"
                 ? walkthrough::Method::kFull
                 : walkthrough::Method::kImageBased;
  (void)choiceFrom(options.integrator, {"walkthrough", "path"}, "--integrator");
  v.display = displayNamed(options.display);
  v.tone = toneOptionsFrom(options.tone, options.exposure, options.unit, options.ocio);
  v.threads = integerFrom(options.threads, 0, 4096, "--threads");
  v.seed = seedFrom(options.seed);
  if (!options.video.empty()) (void)io::videoFormatOf(options.video);
  if (options.sky && !options.environment.empty()) {
    throw InputError("--sky, --environment: expected one of them, found both");
  }
  if (options.resume && options.overwrite) {
    throw InputError("--resume, --overwrite: expected one of them, found both");
  }
  walkthrough::Settings settings;
  settings.size = v.size;
  settings.supersample = v.supersample;
  settings.antialiasing = v.antialiasing;
  settings.keyframeSpacing = v.spacing;
  settings.frames = {0, v.spacing};  // no more are held at once
  requireMemory(walkthrough::memoryNeededBytes(settings), availableMemoryBytes());
  return v;
}

Scene sceneFor(const RenderOptions& options) {
  Scene scene = loadScene(options.scene, loadOptions(options.load));
  if (!options.environment.empty())
    scene.environment = Environment{io::readEnvironment(options.environment), 0.0};
  if (options.sky) scene.environment = skyFrom(options.sun);
  return ensureLight(std::move(scene));
}

paths::CameraPath walkFor(const RenderOptions& options, const RenderValues& values, const Scene& scene) {
  const std::string& wanted = options.path;
  const bool isFile = !wanted.empty() && std::filesystem::exists(wanted);
  if (isFile && isGltf(wanted)) {
    return pathOfScene(loadScene(wanted, loadOptions(options.load)), "", values.framesPerSecond);
  }
  if (isFile) return io::readPathFile(wanted, {.framesPerSecond = values.framesPerSecond});
  const std::string extension = std::filesystem::path(wanted).extension().string();
  if (wanted.find('/') != std::string::npos || extension == ".json" || extension == ".txt" ||
      isGltf(wanted)) {
    throw InputError("--path: there is no such file: '" + printable(wanted) + "'");
  }
  return pathOfScene(scene, wanted, values.framesPerSecond);
}

walkthrough::Settings settingsFor(const RenderOptions& options, const RenderValues& values,
                                  const paths::CameraPath& path) {
  walkthrough::Settings s;
  s.size = values.size;
  s.supersample = values.supersample;
  s.antialiasing = values.antialiasing;
  s.frames = {0, path.frameCount() - 1};
  if (!options.frames.empty()) {
    const Frames frames = framesFrom(options.frames, path.frameCount(), "--frames");
    s.frames = {frames.first, frames.last};
  }
  s.method = values.method;
  s.tolerancePercent = values.tolerancePercent;
  if (!values.pathsPerSample) s.stopping = walkthrough::StoppingRule{};
  s.keyframeSpacing = values.spacing;
  s.probeShare = values.verifyPercent / 100.0;
  s.warp.footprintLimit = values.footprintLimit;
  s.seed = values.seed;
  s.display = values.display;
  s.tone.curve = values.tone.curve;
  s.tone.view = values.tone.view;
  return s;
}

ToneMapping toneFor(const RenderValues& values, const Scene& scene, const paths::CameraPath& path,
                    const Renderer& renderer, const walkthrough::Settings& settings) {
  ToneMapping tone;
  const ToneOptions& asked = values.tone;
  tone.curve = asked.curve;
  tone.view = asked.view;
  tone.exposureEv = asked.exposureEv
                        ? *asked.exposureEv
                        : walkthrough::automaticExposure(path, settings.frames, renderer, settings.size);
  // Punctual lights are in candela and lux (KHR_lights_punctual), so radiance is in cd/m2.
  const bool isPhotometric = !scene.lights.empty() && !asked.exposureEv;
  tone.candelasPerUnit =
      asked.candelasPerUnit.value_or(isPhotometric ? 1.0 : candelasFromExposure(tone.exposureEv));
  if (modelsTheEye(tone.curve)) {
    tone.adaptation =
        walkthrough::adaptationAlong(path, settings.frames, renderer, settings.size, tone.candelasPerUnit);
  }
  return tone;
}

std::string jobHash(const RenderOptions& options, const walkthrough::Settings& settings, const Scene& scene,
                    const paths::CameraPath& path) {
  Fingerprint f;
  // Another program may render other pixels, though it bears the same version.
  addFile(f, "/proc/self/exe");
  addFile(f, options.scene);
  addScene(f, scene);
  addPath(f, path);
  const DisplayModel& d = settings.display;
  for (const double value : {static_cast<double>(settings.size.width),
                             static_cast<double>(settings.size.height),
                             static_cast<double>(settings.supersample),
                             static_cast<double>(settings.frames.first),
                             static_cast<double>(settings.frames.last),
                             settings.tolerancePercent,
                             static_cast<double>(settings.keyframeSpacing),
                             settings.probeShare,
                             settings.warp.footprintLimit,
                             static_cast<double>(d.resolution.width),
                             static_cast<double>(d.resolution.height),
                             d.diagonalMetres,
                             d.viewingDistanceMetres,
                             d.peakLuminance,
                             d.blackLuminance,
                             d.ambientIlluminance,
                             d.screenReflectance,
                             static_cast<double>(d.transfer),
                             d.gamma,
                             static_cast<double>(d.signal)}) {
    f.add(value);
  }
  for (const glm::dvec2& c : {d.primaries.red, d.primaries.green, d.primaries.blue, d.primaries.white}) {
    f.add(c.x);
    f.add(c.y);
  }
  f.add(std::string(nameOf(settings.tone.curve)));
  if (settings.tone.view) f.add(settings.tone.view->fingerprint);
  for (const auto& [name, value] : options.all) {
    if (decidesPixels(name)) {
      f.add(name);
      f.add(value);
    }
  }
  return f.text();
}

std::string lightHash(const RenderOptions& options, const Scene& scene) {
  Fingerprint f;
  f.add(std::string(PROMENADE_VERSION));
  addFile(f, options.scene);
  addScene(f, scene);
  f.add(options.seed);
  return f.text();
}

LoadedJob loadJob(const RenderOptions& options) {
  for (const auto& [name, value] :
       {std::pair("--from", options.from), std::pair("--renderer", options.renderer)}) {
    if (!value.empty()) {
      throw InputError(std::string(name) + ": frames of other renderers are for promenade render alone");
    }
  }
  if (options.scene.empty()) throw InputError("scene is required (promenade render --help)");
  LoadedJob job;
  job.options = options;
  job.values = renderValues(options);
  {
    const walkthrough::Stopwatch watch(job.secondsLoading);
    job.scene = sceneFor(options);
    job.path = walkFor(options, job.values, job.scene);
    job.settings = settingsFor(options, job.values, job.path);
    job.hash = jobHash(options, job.settings, job.scene, job.path);
  }
  throwIfInterrupted();
  return job;
}

}  // namespace promenade::app
