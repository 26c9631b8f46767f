#pragma once
// A few words in a picture: capital letters, digits and some signs, 5 x 7 dots each.

#include <string_view>

#include "src/core/image.h"

namespace promenade::app {

/// Pixels of a dot's edge.
inline constexpr int kDot = 2;
inline constexpr int kLetterHeight = 7 * kDot;

/// Pixels from the first letter's left edge to where the next word would begin.
[[nodiscard]] int textWidth(std::string_view text);

/// White, with its upper left corner at (left, top); what is outside of the image is left out. Small letters
/// are drawn as capitals, characters that have no letter here as spaces.
void drawText(EncodedMap& image, int left, int top, std::string_view text);

}  // namespace promenade::app
