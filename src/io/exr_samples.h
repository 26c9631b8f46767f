#pragma once
// A traced frame at sample resolution, exactly: what one machine hands to another so that a keyframe need not
// be traced twice. An OpenEXR file that viewers show (docs/formats.md).

#include <filesystem>
#include <optional>
#include <string>

#include "src/core/frame.h"

namespace promenade::io {

/// What a file says of its samples.
struct SamplesNote {
  std::string jobHash;
  std::string statistics;  ///< JSON, as the caller likes it
};

struct SamplesFile {
  Frame frame;
  SamplesNote note;
};

/// Whole or not at all. Every number comes back bit for bit.
void writeSamples(const std::filesystem::path& file, const Frame& frame, const SamplesNote& note);

/// `camera`: the one the frame was traced for. Nothing if the file is missing, or of another job. Throws
/// InputError if it is damaged or not of this camera's size.
[[nodiscard]] std::optional<SamplesFile> readSamples(const std::filesystem::path& file, const Camera& camera,
                                                     const std::string& jobHash);

}  // namespace promenade::io
