#pragma once
// Where finished frames go: EXR files and the video.

#include <filesystem>
#include <optional>
#include <string>

#include "paths/camera_path.h"
#include "src/app/output_folder.h"
#include "src/io/video.h"
#include "src/walkthrough/walkthrough.h"

namespace promenade::app {

struct FrameOutputSettings {
  std::filesystem::path video;
  ToneMapping tone;
  std::string scene;
  std::string jobHash;
};

class FrameOutput {
 public:
  /// `folder` and `path` must outlive this. The video is begun at once: what cannot be written is known
  /// early.
  FrameOutput(const OutputFolder& folder, const paths::CameraPath& path, Size size,
              FrameOutputSettings settings);

  /// Writes the frame (unless it is there from an earlier run) and adds it to the video.
  void add(walkthrough::FinishedFrame&& frame);
  /// Adds a frame of an earlier run to the video.
  void addFinished(int index);
  /// Adds the metric's maps of a segment's middle.
  void addMiddle(const walkthrough::JudgedMiddle& middle);
  void finish();

  /// The next frame that the video waits for; frames before it are ignored by add().
  [[nodiscard]] int nextFrame() const { return nextFrame_; }
  void startAt(int frame) { nextFrame_ = frame; }
  [[nodiscard]] double secondsEncoding() const { return secondsEncoding_; }
  [[nodiscard]] double secondsWriting() const { return secondsWriting_; }

 private:
  const OutputFolder& folder_;
  const paths::CameraPath& path_;
  FrameOutputSettings settings_;
  io::VideoWriter video_;
  int nextFrame_ = 0;
  double secondsEncoding_ = 0.0;
  double secondsWriting_ = 0.0;
};

}  // namespace promenade::app
