#pragma once
// A frame that another renderer wrote: OpenEXR with colour and Z (docs/formats.md).

#include <filesystem>
#include <optional>

#include "src/core/camera.h"
#include "src/core/image.h"

namespace promenade::io {

/// Nothing where the file has none: Promenade's attributes, else worldToCamera and worldToNDC.
struct ForeignCamera {
  std::optional<Camera> camera;
  std::optional<double> framesPerSecond;
};

/// Of a frame's header alone. Throws InputError as readForeignFrame() does for a camera.
[[nodiscard]] ForeignCamera readForeignCamera(const std::filesystem::path& file);

struct ForeignFrame {
  RadianceMap radiance;  ///< R G B, or the Combined layer of a multi-layer file
  DepthMap depth;        ///< along the view axis, metres; +inf where nothing is hit
  /// Promenade's own frames have them; empty in others, whose conventions differ.
  NormalMap normal;
  ItemBuffer item;
};

/// Throws InputError if the file is missing, damaged, no OpenEXR file, has no colour or no Z, Z in half (11
/// bits are too few to warp by), a depth that is not positive, or a data window that is not the display
/// window. Its camera is not looked at.
[[nodiscard]] ForeignFrame readForeignFrame(const std::filesystem::path& file);

}  // namespace promenade::io
