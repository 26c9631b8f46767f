#include "src/app/solved_light.h"

#include <vector>

#include "src/app/interrupt.h"
#include "src/io/text_file.h"

namespace promenade::app {

std::shared_ptr<const render::LightSolution> keptLight(const std::filesystem::path& file,
                                                       const std::string& hash, const std::string& fate,
                                                       Console& console) {
  if (!std::filesystem::exists(file)) return nullptr;
  auto kept = render::lightSolutionFrom(io::readTextFile(file, kMaximumSolutionBytes), hash);
  if (!kept) console.info(file.string() + ": not the light of this scene; " + fate);
  return kept;
}

SolvedLight solveLightOf(const paths::CameraPath& path, Size size, const Scene& scene,
                         const LightRequest& request, Console& console) {
  const std::string file = request.file.string();
  const auto known = keptLight(request.file, request.hash, "it is computed anew", console);
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
