#pragma once
// What a command-line argument names: one image, a sequence of images, or a video.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "src/io/image_file.h"

namespace promenade::io {

struct Sequence {
  std::string argument;                       ///< as it was given, for messages
  std::vector<std::filesystem::path> images;  ///< in order; empty for a video
  std::filesystem::path video;                ///< empty for images
  std::string layer;                          ///< of the images, as for readImage()
  [[nodiscard]] bool isVideo() const { return !video.empty(); }
};

/// - an image file: a sequence of one;
/// - a video file (.mp4 .mov .m4v .mkv .webm .avi .gif);
/// - a folder: its images in the order of their names, which must all have one extension; a folder without
///   images but with a subfolder "frames" (what `promenade render` writes) means that subfolder;
/// - a printf pattern with one %d or %0Nd in the file name ("dir/%06d.exr"): from the lowest number that is
///   there to the highest, without a gap;
/// - a glob ("dir/frame_*.png"), quoted from the shell, in the order of the names.
/// A file that bears the very name comes before pattern and glob. Hidden files are never taken.
/// Throws InputError that says what was found instead.
[[nodiscard]] Sequence resolveSequence(const std::string& argument);

/// Frame after frame of a sequence, whatever it is made of. Memory holds one frame.
class SequenceReader {
 public:
  explicit SequenceReader(Sequence sequence);
  SequenceReader(SequenceReader&&) noexcept;
  SequenceReader& operator=(SequenceReader&&) noexcept;
  ~SequenceReader();

  [[nodiscard]] int frameCount() const;
  /// Of a video; images do not say.
  [[nodiscard]] std::optional<double> framesPerSecond() const;
  /// The file that the frame comes from.
  [[nodiscard]] const std::filesystem::path& file(int frame) const;
  /// The next frame; nothing after the last. Throws InputError for a damaged file and for a frame whose size
  /// is not that of the first (both are stated).
  [[nodiscard]] std::optional<ImageFile> next();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace promenade::io
