#pragma once
// What everything that is given PathSettings makes of them. Not part of the folder's public face.

#include <cstdint>

#include "src/render/path_renderer.h"

namespace promenade::render {

/// Throws InputError if they make no sense.
void requireGood(const PathSettings& settings);

[[nodiscard]] std::uint32_t seedOf(const PathSettings& settings);

}  // namespace promenade::render
