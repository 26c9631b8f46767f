#pragma once
// Where the frames of a walk come from that Promenade does not trace: files that are there (KnownFrames in
// frame_files.h) or that a command makes (ExternalRenderer).

#include <filesystem>

#include "src/core/camera.h"
#include "src/core/frame.h"

namespace promenade::app {

class ForeignFrames {
 public:
  ForeignFrames() = default;
  ForeignFrames(const ForeignFrames&) = delete;
  ForeignFrames& operator=(const ForeignFrames&) = delete;
  virtual ~ForeignFrames() = default;

  /// The file of frame `index` of the walk, as `camera` sees it (io::readForeignFrame()); made if need be.
  [[nodiscard]] virtual std::filesystem::path frame(const Camera& camera, int index) = 0;
};

/// A frame's file as samples for warping. Of other programs' files only colour and depth are taken: normals
/// follow from the depth, and what is hit is one item. Throws InputError as io::readForeignFrame() does, and
/// for another size than the camera's.
[[nodiscard]] Frame frameFrom(const std::filesystem::path& file, const Camera& camera);

}  // namespace promenade::app
