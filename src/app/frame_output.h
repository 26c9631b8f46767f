#pragma once
// Where finished frames go: an EXR file each.

#include <tbb/task_group.h>

#include <string>

#include "paths/camera_path.h"
#include "src/app/output_folder.h"
#include "src/io/exr_frame.h"
#include "src/walkthrough/walkthrough.h"

namespace promenade::app {

/// A frame of `path` as its file holds it. `scene` and `jobHash` go into the metadata.
[[nodiscard]] io::FrameFile fileOf(walkthrough::FinishedFrame&& frame, const paths::CameraPath& path,
                                   const std::string& scene, const std::string& jobHash);

/// A frame is written beside the work on those that follow it, one at a time, in the order in which they
/// come.
class FrameFiles {
 public:
  /// `folder` and `path` must outlive this. `scene` and `jobHash` go into every frame's metadata.
  FrameFiles(const OutputFolder& folder, const paths::CameraPath& path, std::string scene,
             std::string jobHash);
  FrameFiles(const FrameFiles&) = delete;
  FrameFiles& operator=(const FrameFiles&) = delete;
  /// What was begun is written to the end.
  ~FrameFiles();

  /// Throws InputError or CannotContinue (io/exr_frame.h) if the file before could not be written.
  void write(walkthrough::FinishedFrame&& frame);
  /// The metric's maps of a segment's middle.
  void writeMiddle(walkthrough::JudgedMiddle&& middle);
  /// Returns when every file is there; throws as write() does.
  void finish();
  /// Wall seconds that the caller waited for files.
  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  const OutputFolder& folder_;
  const paths::CameraPath& path_;
  std::string scene_;
  std::string jobHash_;
  tbb::task_group writing_;
  double seconds_ = 0.0;
};

}  // namespace promenade::app
