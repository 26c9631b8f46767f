#pragma once
// Which files of a folder are images, by their names.

#include <set>
#include <string>

namespace promenade::io {

/// With their dot, small letters: of every format of the OpenImageIO at hand but videos (.gif among them) and
/// what holds no flat picture.
[[nodiscard]] std::set<std::string> imageExtensions();

}  // namespace promenade::io
