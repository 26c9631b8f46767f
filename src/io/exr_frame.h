#pragma once
// A rendered frame as an OpenEXR file: one part, named channels as compositors read them (docs/formats.md).

#include <filesystem>
#include <string>

#include "src/core/camera.h"
#include "src/core/frame.h"
#include "src/core/image.h"

namespace promenade::io {

struct FrameMetadata {
  int frame = 0;                 ///< number in the walk, from 0
  double framesPerSecond = 0.0;  ///< of the walk; 0: not known, the attribute is absent
  Camera camera;                 ///< of the display pixels; its size is that of the maps
  std::string scene;             ///< file the scene came from
  std::string programVersion;
  std::string jobHash;  ///< equal for frames of one job (scene, path and settings), by which a job is resumed
};

/// A frame of display pixels. Radiance is always there. Any other map may be empty, and its channels are then
/// not in the file.
struct FrameFile {
  FrameMetadata metadata;
  RadianceMap radiance;  ///< R G B, half
  DepthMap depth;        ///< Z, float, +inf where nothing is hit
  NormalMap normal;      ///< N.X N.Y N.Z, half, world space
  PixelFlow flowToNext;  ///< Vector.X Vector.Y, float, pixels to the next frame; NaN where there is none
  ItemBuffer item;       ///< Item.ID, uint
  SourceMap source;      ///< Source, half (0 to 6)
};

/// Writes the file whole or not at all. The same frame gives the same bytes: no clock, no host name.
/// Radiance that is not a number becomes 0 and what half cannot hold becomes +-65504, so that no filter in a
/// compositor spreads it. Precondition (asserted): every map is empty or has the camera's size.
/// Throws InputError or CannotContinue (file_error.h). May be called from several threads at once.
void writeFrame(const std::filesystem::path& file, const FrameFile& frame);

/// The radiance as a frame's file holds it: rounded to half.
[[nodiscard]] RadianceMap asStored(const RadianceMap& radiance);

/// Reads what writeFrame() wrote; the camera comes back exactly. Throws InputError if the file is missing,
/// damaged, no OpenEXR file, or not a frame of Promenade (an attribute or R, G, B missing). Unknown channels
/// are ignored.
[[nodiscard]] FrameFile readFrame(const std::filesystem::path& file);

/// The header only: cheap, to see which frames of a job are there.
[[nodiscard]] FrameMetadata readFrameMetadata(const std::filesystem::path& file);

/// Name of a frame's file inside the folder of frames: "000000.exr".
[[nodiscard]] std::string frameFileName(int frame);

}  // namespace promenade::io
