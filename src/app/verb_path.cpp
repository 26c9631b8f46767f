#include <cstdio>

#include "paths/plot.h"
#include "paths/statistics.h"
#include "src/app/path_choice.h"
#include "src/app/values.h"
#include "src/app/verbs.h"
#include "src/core/errors.h"
#include "src/io/path_file.h"
#include "src/io/text_file.h"
#include "src/scene/load.h"

namespace promenade::app {
namespace {

std::string described(const paths::CameraPath& path) {
  const paths::Statistics s = paths::statisticsOf(path);
  char text[640];
  std::snprintf(text, sizeof(text),
                "frames         %d at %g frames/s\n"
                "duration       %.3f s\n"
                "length         %.3f m\n"
                "speed          %.3f m/s mean, %.3f m/s max\n"
                "turn rate      %.2f deg/s mean, %.2f deg/s max\n"
                "field of view  %.2f to %.2f deg, vertical\n",
                s.frames, s.framesPerSecond, s.durationSeconds, s.lengthMetres, s.meanSpeed, s.maxSpeed,
                s.meanTurnRate, s.maxTurnRate, s.minVerticalFieldOfView, s.maxVerticalFieldOfView);
  return text;
}

}  // namespace

ExitStatus runPath(const PathOptions& options, Console& console) {
  std::optional<double> fps;
  if (!options.fps.empty()) fps = numberFrom(options.fps, 0.001, 10'000.0, "--fps");
  std::optional<io::PathFormat> format;
  if (!options.to.empty()) format = io::pathFormatNamed(options.to.front());
  if (!options.name.empty() && !isGltf(options.file)) {
    throw InputError("--name: only glTF files have paths with names, and " + options.file + " is none");
  }

  const paths::CameraPath path =
      isGltf(options.file)
          ? pathOfScene(loadScene(options.file, loadOptions(options.load)), options.name, fps)
          : io::readPathFile(options.file, {.framesPerSecond = fps});
  if (format) io::writePathFile(options.to.back(), path, *format);
  if (!options.plot.empty()) io::writeTextFile(options.plot, paths::plotSvg(path));
  console.result(described(path));
  return ExitStatus::kDone;
}

}  // namespace promenade::app
