#pragma once
// Image velocity of a sequence whose frames hold their flow to the next.

#include "src/core/image.h"

namespace promenade::app {

/// The flow of each pixel to the previous frame, from the previous frame's flow to this one: every pixel of
/// the previous frame is followed to where it goes, rounded to a pixel. NaN where none arrives.
[[nodiscard]] PixelFlow flowToPrevious(const PixelFlow& previousFrameToNext);

/// Mean of two flows of the same size where both are valid, else the valid one, else NaN. An empty map gives
/// the other. Swapping them changes nothing.
[[nodiscard]] PixelFlow meanFlow(const PixelFlow& a, const PixelFlow& b);

/// True if no pixel moves (and there are pixels): what the last frame of a walk says, which has no next.
[[nodiscard]] bool isStill(const PixelFlow& flow);

}  // namespace promenade::app
