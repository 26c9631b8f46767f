#pragma once
// The video of a walk, some of whose frames may be there from an earlier run or from other machines.

#include <filesystem>

#include "src/app/output_folder.h"
#include "src/io/video.h"
#include "src/walkthrough/walkthrough.h"

namespace promenade::app {

/// Shows what the files of the frames hold: it is the same whoever rendered them, and when.
class WalkVideo {
 public:
  /// `folder` must outlive this. The video is begun at once: what cannot be written is known early.
  WalkVideo(const std::filesystem::path& file, const OutputFolder& folder,
            const walkthrough::Settings& settings, double framesPerSecond);

  /// Frames in the order of time; those before it that were left out come from the folder.
  void add(int frame, const RadianceMap& radiance);
  /// The rest comes from the folder.
  void finish();
  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  void addFromFolder(int end);
  void write(int frame, const RadianceMap& radiance);

  const OutputFolder& folder_;
  ToneMapping tone_;
  DisplayModel display_;
  walkthrough::FrameRange walk_;
  io::VideoWriter video_;
  int next_;  ///< the frame it waits for
  double seconds_ = 0.0;
};

}  // namespace promenade::app
