#pragma once
// How the frames of a comparison become what a viewer sees.

#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>

#include "src/core/display.h"
#include "src/core/image.h"
#include "src/core/tone_mapping.h"
#include "src/io/image_file.h"

namespace promenade::app {

struct Viewing {
  ToneMapping tone;
  int firstFrame = 0;  ///< of the walk that `tone` is of: what the first frame of the comparison is there
  DisplayModel display;
  double pixelsPerDegree = 0.0;
  double framesPerSecond = 0.0;
  bool absolute = false;              ///< channel Y is cd/m2: neither tone mapping nor display
  std::optional<glm::vec2> velocity;  ///< degrees per second, everywhere
};

/// What two images that are compared, both of one size, go through.
struct Shown {
  FrameTone tone;
  Surroundings surroundings;
};
[[nodiscard]] Shown shownBoth(const io::ImageFile& a, const io::ImageFile& b, const Viewing& viewing,
                              int index);

/// Code values for the display: floating-point images are tone mapped, the others have them.
[[nodiscard]] EncodedMap encodedOf(const io::ImageFile& image, const Shown& shown);

/// cd/m2, at least 1e-4. Throws InputError that names `file`, and the pixel where its channel Y is not
/// finite.
[[nodiscard]] LuminanceMap luminanceOf(const io::ImageFile& image, const Viewing& viewing, const Shown& shown,
                                       const std::filesystem::path& file);

/// Gives each frame its velocity from the flows of this frame and the one before.
class Motion {
 public:
  explicit Motion(const Viewing& viewing) : viewing_(viewing) {}

  /// Degrees per second; empty if nothing is known to move. `last`: no frame follows.
  [[nodiscard]] VelocityMap next(const io::ImageFile& test, const io::ImageFile& reference, bool last);

 private:
  const Viewing& viewing_;
  PixelFlow previous_;  // of the frame before, to this one
};

}  // namespace promenade::app
