#include "src/io/image_file.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "src/core/errors.h"
#include "src/io/file_error.h"
#include "src/io/image_limits.h"
#include "src/io/png.h"

namespace promenade::io {
namespace {

namespace fs = std::filesystem;

constexpr int kAbsent = -1;

int channel(const OIIO::ImageSpec& spec, std::string_view name) {
  for (int i = 0; i < spec.nchannels; ++i) {
    if (spec.channelnames[static_cast<std::size_t>(i)] == name) return i;
  }
  return kAbsent;
}

std::array<int, 3> colourChannels(const OIIO::ImageSpec& spec, const fs::path& file) {
  const std::array<int, 3> rgb{channel(spec, "R"), channel(spec, "G"), channel(spec, "B")};
  if (std::ranges::find(rgb, kAbsent) == rgb.end()) return rgb;
  if (const int y = channel(spec, "Y"); y != kAbsent) return {y, y, y};
  const int colours = spec.nchannels - (spec.alpha_channel >= 0 ? 1 : 0);
  if (colours == 1) {
    const int only = spec.alpha_channel == 0 ? 1 : 0;
    return {only, only, only};
  }
  std::string names;
  for (const std::string& name : spec.channelnames) names += (names.empty() ? "" : ", ") + name;
  throw InputError(file.string(), "expected channels R, G and B, or Y, found " + names);
}

// A contiguous range of channels of one image, as float.
class Planes {
 public:
  Planes(OIIO::ImageInput& in, const fs::path& file, int first, int last)
      : first_(first), count_(static_cast<std::size_t>(last - first + 1)), width_(in.spec().width) {
    const OIIO::ImageSpec& spec = in.spec();
    values_.resize(count_ * static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height));
    if (!in.read_image(0, 0, first, last + 1, OIIO::TypeDesc::FLOAT, values_.data())) {
      throw InputError(file.string(), "cannot read the pixels: " + firstLine(in.geterror()));
    }
  }
  [[nodiscard]] float at(int x, int y, int whichChannel) const {
    const auto pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    return values_[pixel * count_ + static_cast<std::size_t>(whichChannel - first_)];
  }

 private:
  int first_;
  std::size_t count_;
  int width_;
  std::vector<float> values_;
};

// Calls set(x, y of the display window, x, y of the data window) where the windows overlap.
template <class Set>
void forEachPixel(const OIIO::ImageSpec& spec, const Set& set) {
  const int left = spec.x - spec.full_x;
  const int top = spec.y - spec.full_y;
  for (int y = std::max(0, -top); y < spec.height && y + top < spec.full_height; ++y) {
    for (int x = std::max(0, -left); x < spec.width && x + left < spec.full_width; ++x)
      set(x + left, y + top, x, y);
  }
}

template <class ColourMap>
ColourMap colourOf(const OIIO::ImageSpec& spec, const Planes& planes, const std::array<int, 3>& rgb) {
  ColourMap map(spec.full_width, spec.full_height);
  forEachPixel(spec, [&](int x, int y, int dataX, int dataY) {
    for (int i = 0; i < 3; ++i) map(x, y)[i] = planes.at(dataX, dataY, rgb[static_cast<std::size_t>(i)]);
  });
  return map;
}

}  // namespace

Size ImageFile::size() const {
  return std::visit([](const auto& map) { return map.size(); }, colour);
}

ImageFile readImage(const fs::path& file) {
  requireRegularFile(file);
  requireWholePng(file);
  const auto in = OIIO::ImageInput::open(file.string());
  if (!in) throw InputError(file.string(), "cannot read as an image: " + firstLine(OIIO::geterror()));
  in->threads(1);  // frames are read side by side; OpenImageIO's own threads would only compete
  const OIIO::ImageSpec& spec = in->spec();
  requireReasonableSize(file, {spec.width, spec.height});
  requireReasonableSize(file, {spec.full_width, spec.full_height});
  if (spec.depth > 1 || spec.deep)
    throw InputError(file.string(), "expected a flat image, found a volume or deep samples");

  const std::array<int, 3> rgb = colourChannels(spec, file);
  const int flowX = channel(spec, "Vector.X");
  const int flowY = channel(spec, "Vector.Y");
  const bool hasFlow = flowX != kAbsent && flowY != kAbsent;
  const bool isExr = std::strcmp(in->format_name(), "openexr") == 0;
  const int luminance = isExr ? channel(spec, "Y") : kAbsent;
  std::vector<int> wanted(rgb.begin(), rgb.end());
  if (hasFlow) wanted.insert(wanted.end(), {flowX, flowY});
  if (luminance != kAbsent) wanted.push_back(luminance);
  const auto [first, last] = std::ranges::minmax(wanted);
  const Planes planes(*in, file, first, last);

  ImageFile image;
  if (spec.format.is_floating_point()) {
    image.colour = colourOf<RadianceMap>(spec, planes, rgb);
  } else {
    image.colour = colourOf<EncodedMap>(spec, planes, rgb);
  }
  if (hasFlow) {
    image.flowToNext = PixelFlow(spec.full_width, spec.full_height, glm::vec2(0.0f));
    forEachPixel(spec, [&](int x, int y, int dataX, int dataY) {
      image.flowToNext(x, y) = {planes.at(dataX, dataY, flowX), planes.at(dataX, dataY, flowY)};
    });
  }
  if (luminance != kAbsent) {
    image.luminance = LuminanceMap(spec.full_width, spec.full_height);
    forEachPixel(spec, [&](int x, int y, int dataX, int dataY) {
      image.luminance(x, y) = planes.at(dataX, dataY, luminance);
    });
  }
  return image;
}

}  // namespace promenade::io
