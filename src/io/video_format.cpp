#include <cctype>
#include <cmath>
#include <string>

#include "src/core/errors.h"
#include "src/io/video.h"

namespace promenade::io {

FrameRate frameRateFrom(double framesPerSecond) {
  if (!(framesPerSecond >= 0.01 && framesPerSecond <= 1000.0)) {
    throw InputError("frame rate: expected 0.01 to 1000 frames per second, found " +
                     std::to_string(framesPerSecond));
  }
  // "23.976" and "29.97" are names of 24000/1001 and 30000/1001, rounded by those who write them.
  const double ntsc = framesPerSecond * 1.001;
  const bool isInteger = std::abs(framesPerSecond - std::round(framesPerSecond)) < 1e-6;
  if (!isInteger && framesPerSecond > 20.0 && std::abs(ntsc - std::round(ntsc)) < 1e-3) {
    return {static_cast<int>(std::lround(ntsc)) * 1000, 1001};
  }
  FrameRate best{static_cast<int>(std::lround(framesPerSecond)), 1};
  double bestError = best.numerator > 0 ? std::abs(framesPerSecond - best.framesPerSecond()) : 1e9;
  for (int denominator = 2; denominator <= 1001 && bestError > 1e-12; ++denominator) {
    const FrameRate candidate{static_cast<int>(std::lround(framesPerSecond * denominator)), denominator};
    const double error = std::abs(framesPerSecond - candidate.framesPerSecond());
    if (candidate.numerator > 0 && error < bestError) {
      best = candidate;
      bestError = error;
    }
  }
  return best;
}

VideoFormat videoFormatOf(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".mp4") return VideoFormat::kH264;
  if (extension == ".mkv") return VideoFormat::kFfv1;
  if (extension == ".webm") return VideoFormat::kVp9;
  if (extension == ".gif") return VideoFormat::kGif;
  throw InputError(file.string(),
                   "expected a video named .mp4 (H.264), .mkv (FFV1), .webm (VP9) or .gif, found '" +
                       file.extension().string() + "'");
}

}  // namespace promenade::io
