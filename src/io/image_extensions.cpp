#include "src/io/image_extensions.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

namespace promenade::io {

std::set<std::string> imageExtensions() {
  constexpr std::array<std::string_view, 8> kOthers{"ffmpeg", "gif",    "null", "openvdb",
                                                    "ptex",   "socket", "term", "zfile"};
  std::set<std::string> extensions;
  // "openexr:exr,sxr,mxr;tiff:tif,tiff"
  std::istringstream formats(OIIO::get_string_attribute("extension_list"));
  for (std::string format; std::getline(formats, format, ';');) {
    const std::size_t colon = format.find(':');
    if (colon == std::string::npos || std::ranges::find(kOthers, format.substr(0, colon)) != kOthers.end())
      continue;
    std::istringstream names(format.substr(colon + 1));
    for (std::string name; std::getline(names, name, ',');) extensions.insert("." + name);
  }
  return extensions;
}

}  // namespace promenade::io
