#include "src/io/library_versions.h"

#include <OpenColorIO/OpenColorIO.h>
#include <OpenEXR/OpenEXRConfig.h>
#include <OpenImageIO/imageio.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/avutil.h>
#include <libswscale/swscale.h>
}

namespace promenade::io {
namespace {

std::string ofLibav(unsigned version) {
  return std::to_string(AV_VERSION_MAJOR(version)) + "." + std::to_string(AV_VERSION_MINOR(version)) + "." +
         std::to_string(AV_VERSION_MICRO(version));
}

// 10000 * major + 100 * minor + patch.
std::string ofOpenImageIO(int version) {
  return std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
         std::to_string(version % 100);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> libraryVersions() {
  return {{"OpenImageIO", ofOpenImageIO(OIIO::openimageio_version())},
          {"OpenColorIO", OCIO_NAMESPACE::GetVersion()},
          {"OpenEXR", OPENEXR_VERSION_STRING},
          {"libavcodec", ofLibav(avcodec_version())},
          {"libavformat", ofLibav(avformat_version())},
          {"libavutil", ofLibav(avutil_version())},
          {"libswscale", ofLibav(swscale_version())}};
}

}  // namespace promenade::io
