#pragma once
// Videos, through the libraries of FFmpeg. What each format holds is in docs/formats.md.

#include <filesystem>
#include <memory>
#include <optional>

#include "src/core/image.h"

namespace promenade::io {

/// Frames per second as videos state it: a quotient of integers.
struct FrameRate {
  int numerator = 25;
  int denominator = 1;
  [[nodiscard]] double framesPerSecond() const { return static_cast<double>(numerator) / denominator; }
  friend bool operator==(const FrameRate&, const FrameRate&) = default;
};

/// 25 -> 25/1; 23.976, 29.97 and 59.94 -> their exact NTSC quotients (N * 1000/1001); else the nearest
/// quotient with a denominator up to 1001. Throws InputError outside [0.01, 1000].
[[nodiscard]] FrameRate frameRateFrom(double framesPerSecond);

enum class VideoFormat {
  kH264,  ///< .mp4: H.264, yuv420p, CRF 16, tagged Rec.709, limited range, moov atom first
  kFfv1,  ///< .mkv: FFV1 version 3, 8-bit RGB: bit-exact
  kVp9,   ///< .webm: VP9, yuv420p, CRF 20, tagged Rec.709, limited range
  kGif,   ///< .gif: 6x7x6 colours, ordered dither, endless loop; times are rounded to 1/100 s
};

/// By the extension. Throws InputError that lists the known ones: call it before long work.
[[nodiscard]] VideoFormat videoFormatOf(const std::filesystem::path& file);

/// Writes a video frame by frame under a temporary name; finish() completes it and gives it its name.
/// Destroyed without finish(), it leaves nothing behind. The same frames give the same bytes on the same
/// libraries: thread counts are fixed and no clock is written. One thread at a time.
class VideoWriter {
 public:
  /// `size` is that of every frame. 4:2:0 formats need even sizes: an odd column or row is repeated once at
  /// the right or bottom, so a 5x3 animation gives a 6x4 H.264 or VP9 video. FFV1 repeats only a side of one
  /// pixel. Throws InputError (extension, folder, encoder absent from the FFmpeg libraries) or
  /// CannotContinue.
  VideoWriter(const std::filesystem::path& file, Size size, FrameRate frameRate);
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) noexcept;
  ~VideoWriter();

  /// Throws InputError if the frame has another size, CannotContinue if the disk is full.
  void write(const EncodedMap& frame);
  /// Call once, last. Throws InputError if no frame was written.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads the first video stream of a file (mp4/mov, mkv/webm, avi, gif), frame by frame. One thread at a
/// time.
class VideoReader {
 public:
  /// Goes through the whole file once to count its frames. Throws InputError if the file is missing, not a
  /// video or cut short.
  explicit VideoReader(const std::filesystem::path& file);
  VideoReader(VideoReader&&) noexcept;
  VideoReader& operator=(VideoReader&&) noexcept;
  ~VideoReader();

  [[nodiscard]] Size size() const;
  [[nodiscard]] FrameRate frameRate() const;
  [[nodiscard]] int frameCount() const;  ///< exact
  /// Code values (8 bits a channel / 255): YCbCr goes through the matrix and range the stream is tagged with
  /// (untagged: Rec.601 below 720 rows, else Rec.709); the transfer function is not touched. Nothing after
  /// the last frame. Throws InputError for a damaged stream.
  [[nodiscard]] std::optional<EncodedMap> next();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace promenade::io
