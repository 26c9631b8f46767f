#pragma once

#include <string>

namespace promenade::render {

/// Of the Embree that is loaded, e.g. "3.13.5".
[[nodiscard]] std::string embreeVersion();

}  // namespace promenade::render
