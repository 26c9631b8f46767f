#pragma once
// What `promenade render` is asked for, as values, and everything that is checked before long work begins.

#include <cstdint>
#include <optional>
#include <string>

#include "paths/camera_path.h"
#include "src/app/options.h"
#include "src/app/values.h"
#include "src/scene/scene.h"
#include "src/walkthrough/walkthrough.h"

namespace promenade::app {

/// The options alone, before any file is read.
struct RenderValues {
  Size size;
  std::optional<double> framesPerSecond;
  int supersample = 2;
  std::optional<walkthrough::Antialiasing> antialiasing;
  std::optional<int> pathsPerSample;  ///< nothing: automatic
  double tolerancePercent = 3.0;
  int spacing = 16;
  double verifyPercent = 1.0;
  double footprintLimit = 2.5;  ///< ibr::WarpSettings
  walkthrough::Method method = walkthrough::Method::kImageBased;
  DisplayModel display;
  ToneOptions tone;
  int threads = 0;
  std::uint64_t seed = 0;
};

/// Throws InputError for every value that makes no sense, and for more memory than the machine has.
[[nodiscard]] RenderValues renderValues(const RenderOptions& options);

/// The scene with the light that the options ask for; never dark (a notice among its warnings).
[[nodiscard]] Scene sceneFor(const RenderOptions& options);

/// The walk: a file, or a camera of the scene.
[[nodiscard]] paths::CameraPath walkFor(const RenderOptions& options, const RenderValues& values,
                                        const Scene& scene);

/// Settings of the walkthrough; of the tone mapping the curve (and its view) alone.
[[nodiscard]] walkthrough::Settings settingsFor(const RenderOptions& options, const RenderValues& values,
                                                const paths::CameraPath& path);

/// The tone mapping of the walk: what is automatic is found in a few small frames. A pure function of the
/// job, so that a run that goes on with it finds the same.
[[nodiscard]] ToneMapping toneFor(const RenderValues& values, const Scene& scene,
                                  const paths::CameraPath& path, const Renderer& renderer,
                                  const walkthrough::Settings& settings);

/// Equal for jobs whose frames are the same bit for bit: of all that decides their pixels, the program itself
/// included.
[[nodiscard]] std::string jobHash(const RenderOptions& options, const walkthrough::Settings& settings,
                                  const Scene& scene, const paths::CameraPath& path);

/// Equal for scenes and seeds whose light solution is the same.
[[nodiscard]] std::string lightHash(const RenderOptions& options, const Scene& scene);

/// A job with everything it reads.
struct LoadedJob {
  RenderOptions options;
  RenderValues values;
  Scene scene;
  paths::CameraPath path;
  walkthrough::Settings settings;  ///< exposure 0 where it is automatic
  std::string hash;
  double secondsLoading = 0.0;
};

/// Throws InputError.
[[nodiscard]] LoadedJob loadJob(const RenderOptions& options);

}  // namespace promenade::app
