#pragma once
// A folder of frames that another renderer wrote, and the walk they were taken on.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "paths/camera_path.h"
#include "src/app/foreign_frames.h"

namespace promenade::app {

/// The .exr files in a folder (or in its subfolder `frames`), by the number at the end of their names
/// ("000012.exr", "beauty.0012.exr"). Throws InputError if there are none, or two of one number.
[[nodiscard]] std::map<int, std::filesystem::path> frameFiles(const std::string& folder);

/// The walk through the cameras of these frames, numbered as they are: exactly theirs where there is one, a
/// smooth curve between. (Before the first there is its camera, so that numbers stay.) `framesPerSecond`
/// absent: the files', else 25. Throws InputError for a file without a camera.
[[nodiscard]] paths::CameraPath pathThrough(const std::map<int, std::filesystem::path>& frames,
                                            std::optional<double> framesPerSecond);

/// Frames that are there; no others may be asked for.
class KnownFrames final : public ForeignFrames {
 public:
  explicit KnownFrames(std::map<int, std::filesystem::path> files) : files_(std::move(files)) {}
  [[nodiscard]] std::filesystem::path frame(const Camera&, int index) override { return files_.at(index); }

 private:
  std::map<int, std::filesystem::path> files_;
};

}  // namespace promenade::app
