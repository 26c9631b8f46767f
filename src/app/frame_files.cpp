#include "src/app/frame_files.h"

#include <charconv>
#include <glm/gtc/quaternion.hpp>

#include "paths/keyframes.h"
#include "src/core/errors.h"
#include "src/io/foreign_frame.h"

namespace promenade::app {
namespace {

namespace fs = std::filesystem;

std::optional<int> numberOf(const fs::path& file) {
  if (file.extension() != ".exr" || file.filename().string().starts_with('.')) return std::nullopt;
  const std::string stem = file.stem().string();
  const std::size_t digits = stem.find_last_not_of("0123456789");
  const std::string number = stem.substr(digits == std::string::npos ? 0 : digits + 1);
  int value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (number.empty() || error != std::errc{} || end != number.data() + number.size()) return std::nullopt;
  return value < 1'000'000 ? std::optional(value) : std::nullopt;
}

}  // namespace

std::map<int, fs::path> frameFiles(const std::string& folder) {
  if (!fs::is_directory(folder)) throw InputError(folder, "--from: expected a folder of frames");
  const fs::path own = fs::path(folder) / "frames";
  std::map<int, fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::is_directory(own) ? own : fs::path(folder))) {
    const auto number = numberOf(entry.path());
    if (!number) continue;
    const auto [other, isNew] = files.emplace(*number, entry.path());
    if (!isNew) {
      throw InputError(folder, "two frames of number " + std::to_string(*number) + ": " +
                                   other->second.filename().string() + ", " +
                                   entry.path().filename().string());
    }
  }
  if (files.empty()) throw InputError(folder, "--from: there are no frames (NUMBER.exr) in it");
  return files;
}

paths::CameraPath pathThrough(const std::map<int, fs::path>& frames, std::optional<double> framesPerSecond) {
  std::map<int, paths::PathFrame> known;
  for (const auto& [number, file] : frames) {
    const io::ForeignCamera found = io::readForeignCamera(file);
    if (!found.camera) {
      throw InputError(file.string(),
                       "has no camera (worldToCamera and worldToNDC); name the walk with --path FILE");
    }
    if (!framesPerSecond) framesPerSecond = found.framesPerSecond;
    known.emplace(number, paths::PathFrame{found.camera->pose(), found.camera->verticalFieldOfView()});
  }
  const double rate = framesPerSecond.value_or(25.0);
  const int first = known.begin()->first;
  const int last = known.rbegin()->first;
  paths::CameraPath path;
  path.framesPerSecond = rate;
  path.frames.assign(static_cast<std::size_t>(last) + 1, known.begin()->second);
  if (known.size() > 1) {
    paths::Keyframes keyframes;
    keyframes.framesPerSecond = rate;
    for (const auto& [number, frame] : known) {
      keyframes.keys.push_back({.timeSeconds = (number - first) / rate,
                                .eye = frame.pose.eye,
                                .target = {},
                                .rotation = glm::quat_cast(frame.pose.worldFromCamera),
                                .verticalFieldOfView = frame.verticalFieldOfView});
    }
    const paths::CameraPath between = paths::walkThrough(keyframes, frames.begin()->second.string());
    for (int i = 0; i < between.frameCount() && first + i <= last; ++i) {
      path.frames[static_cast<std::size_t>(first + i)] = between.frames[static_cast<std::size_t>(i)];
    }
  }
  for (const auto& [number, frame] : known) path.frames[static_cast<std::size_t>(number)] = frame;
  return path;
}

}  // namespace promenade::app
