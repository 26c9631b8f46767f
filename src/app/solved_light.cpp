#include "src/app/solved_light.h"

#include <vector>

#include "src/app/interrupt.h"
#include "src/io/text_file.h"

namespace promenade::app {

SolvedLight solveLightOf(const paths::CameraPath& path, Size size, const Scene& scene,
                         const LightRequest& request, Console& console) {
  const std::string file = request.file.string();
  std::shared_ptr<const render::LightSolution> known;
  if (std::filesystem::exists(request.file)) {
    known = render::lightSolutionFrom(io::readTextFile(request.file, kMaximumSolutionBytes), request.hash);
    if (!known) console.info(file + ": not the light of this scene; it is computed anew");
  }
  std::vector<Camera> cameras;
  for (int frame = 0; frame < path.frameCount(); ++frame) cameras.push_back(path.camera(frame, size));
  SolvedLight light;
  light.solution = render::solveLight(
      scene, {.seed = request.seed, .threads = request.threads, .checkpoint = [] { throwIfInterrupted(); }},
      cameras, known, console.progress());
  console.endProgress();
  const render::LightSolutionSize before = known ? render::sizeOf(*known) : render::LightSolutionSize{};
  const render::LightSolutionSize now = render::sizeOf(*light.solution);
  light.report = {.file = file,
                  .records = now.records,
                  .recordsAdded = now.records - before.records,
                  .cameras = now.cameras,
                  .rays = light.solution == known ? 0 : now.rays};
  if (light.solution == known) {
    console.info(file + ": " + std::to_string(now.records) + " light records used again");
  } else {
    const std::string bytes = render::toBytes(*light.solution, request.hash);
    if (request.made) request.made(light.report, bytes);
    io::writeTextFile(request.file, bytes);
  }
  return light;
}

}  // namespace promenade::app
