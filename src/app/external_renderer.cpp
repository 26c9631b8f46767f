#include "src/app/external_renderer.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "src/app/fingerprint.h"
#include "src/app/folders.h"
#include "src/app/formatted.h"
#include "src/app/interrupt.h"
#include "src/app/path_choice.h"
#include "src/app/shell_words.h"
#include "src/app/subprocess.h"
#include "src/core/errors.h"
#include "src/io/json.h"
#include "src/io/text_file.h"

namespace promenade::app {
namespace {

namespace fs = std::filesystem;

// glTF's conventions: metres, y up, the camera looks along its -z.
nlohmann::ordered_json requestFor(const Camera& camera, int frame, const std::string& made) {
  const Pose& pose = camera.pose();
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (int r = 0; r < 3; ++r) {
    rows.push_back(
        {pose.worldFromCamera[0][r], pose.worldFromCamera[1][r], pose.worldFromCamera[2][r], pose.eye[r]});
  }
  rows.push_back({0.0, 0.0, 0.0, 1.0});
  return {{"frame", frame},
          {"width", camera.size().width},
          {"height", camera.size().height},
          {"vertical_fov", camera.verticalFieldOfView()},
          {"world_from_camera", rows},
          {"made", made}};
}

std::string fingerprintOf(const std::string& command, const std::string& scene) {
  Fingerprint fingerprint;
  fingerprint.add(command);
  if (!scene.empty()) addFile(fingerprint, scene);
  return fingerprint.text();
}

}  // namespace

std::string filledIn(const std::string& command, int frame, const std::string& camera, const std::string& out,
                     const std::string& scene) {
  const std::pair<std::string, std::string> values[] = {{"{frame}", std::to_string(frame)},
                                                        {"{camera}", shellWords({camera})},
                                                        {"{out}", shellWords({out})},
                                                        {"{scene}", shellWords({scene})}};
  const auto has = [&](const char* name) { return command.find(name) != std::string::npos; };
  if (!has("{out}") || !(has("{camera}") || has("{frame}"))) {
    throw InputError("--renderer: expected a command with {out} and with {camera} or {frame}");
  }
  std::string filled;
  for (std::size_t at = 0; at < command.size();) {
    const auto* found = std::find_if(std::begin(values), std::end(values), [&](const auto& value) {
      return command.compare(at, value.first.size(), value.first) == 0;
    });
    if (found == std::end(values)) {
      filled += command[at++];
    } else {
      filled += found->second;
      at += found->first.size();
    }
  }
  return filled;
}

ExternalRenderer::ExternalRenderer(std::string command, std::string scene, fs::path folder, Console& console)
    : command_(std::move(command)),
      scene_(std::move(scene)),
      folder_(std::move(folder)),
      made_(fingerprintOf(command_, scene_)),
      console_(console) {
  (void)filledIn(command_, 0, {}, {}, {});  // refused before any long work
  makeFolder(folder_);
}

fs::path ExternalRenderer::frame(const Camera& camera, int index) {
  const std::string name = formatted("%06d", index);
  const auto file = [&](const char* extension) { return folder_ / (name + extension); };
  const fs::path out = file(".exr");
  const fs::path done = file(".done.json");  // the request again, once its frame is whole
  const nlohmann::ordered_json wanted = requestFor(camera, index, made_);
  if (fs::exists(out) && fs::exists(done) && io::readJson(done) == nlohmann::json(wanted)) return out;
  throwIfInterrupted();
  fs::remove(done);
  fs::remove(out);
  io::writeJson(file(".json"), wanted);
  console_.info("asking for frame " + std::to_string(index));
  const std::string command = filledIn(command_, index, file(".json").string(), out.string(), scene_);
  const ProgramResult result = runProgram({"sh", "-c", command});
  throwIfInterrupted();  // Ctrl-C ends the command as well
  io::writeTextFile(file(".log"), result.output);
  const std::string said = " (" + file(".log").string() + " has what it said): " + command;
  if (result.status != 0) {
    throw CannotContinue("--renderer: the command failed with exit status " + std::to_string(result.status) +
                         said);
  }
  if (!fs::exists(out)) throw CannotContinue("--renderer: the command left no " + out.string() + said);
  io::writeJson(done, wanted);
  return out;
}

paths::CameraPath externalPath(const RenderOptions& options, const RenderValues& values) {
  if (!options.path.empty() && fs::exists(options.path)) return walkFor(options, values, Scene{});
  if (options.scene.empty() || !isGltf(options.scene)) {
    throw InputError("--renderer: expected a walk: --path FILE, or a glTF scene with a camera animation");
  }
  return walkFor(options, values, loadScene(options.scene, loadOptions(options.load)));
}

}  // namespace promenade::app
