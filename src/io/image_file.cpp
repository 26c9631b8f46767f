#include "src/io/image_file.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "src/core/errors.h"
#include "src/io/file_error.h"
#include "src/io/image_channels.h"
#include "src/io/image_limits.h"
#include "src/io/png.h"

namespace promenade::io {
namespace {

namespace fs = std::filesystem;

// The channels of every part of an OpenEXR file; of other formats further images are other pictures.
std::vector<PartChannels> partsOf(OIIO::ImageInput& in) {
  std::vector<PartChannels> parts;
  const bool hasParts = std::strcmp(in.format_name(), "openexr") == 0;
  for (int part = 0; part == 0 || (hasParts && in.seek_subimage(part, 0)); ++part) {
    const OIIO::ImageSpec& spec = in.spec();
    parts.push_back({spec.get_string_attribute("oiio:subimagename"), spec.channelnames, spec.alpha_channel});
  }
  (void)in.geterror();  // beyond the last part
  if (parts.size() == 1) parts.front().name.clear();
  return parts;
}

// Some channels of one part, as float, with what lies between them.
class Planes {
 public:
  Planes(OIIO::ImageInput& in, const fs::path& file, std::span<const ChannelPlace> places) {
    const auto [first, last] = std::ranges::minmax(places, {}, &ChannelPlace::channel);
    if (!in.seek_subimage(first.part, 0)) {
      throw InputError(file.string(), "cannot read a part: " + firstLine(in.geterror()));
    }
    spec_ = in.spec();
    requireReasonableSize(file, {spec_.width, spec_.height});
    requireReasonableSize(file, size());
    if (spec_.depth > 1 || spec_.deep)
      throw InputError(file.string(), "expected a flat image, found a volume or deep samples");
    first_ = first.channel;
    count_ = static_cast<std::size_t>(last.channel - first.channel + 1);
    values_.resize(count_ * static_cast<std::size_t>(spec_.width) * static_cast<std::size_t>(spec_.height));
    if (!in.read_image(first.part, 0, first.channel, last.channel + 1, OIIO::TypeDesc::FLOAT,
                       values_.data())) {
      throw InputError(file.string(), "cannot read the pixels: " + firstLine(in.geterror()));
    }
  }
  [[nodiscard]] const OIIO::ImageSpec& spec() const { return spec_; }
  /// Of the display window.
  [[nodiscard]] Size size() const { return {spec_.full_width, spec_.full_height}; }
  /// `x`, `y` in the data window.
  [[nodiscard]] float at(int x, int y, ChannelPlace place) const {
    const auto pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(spec_.width) + static_cast<std::size_t>(x);
    return values_[pixel * count_ + static_cast<std::size_t>(place.channel - first_)];
  }
  /// Calls set(x, y of the display window, x, y of the data window) where the windows overlap.
  template <class Set>
  void forEachPixel(const Set& set) const {
    const int left = spec_.x - spec_.full_x;
    const int top = spec_.y - spec_.full_y;
    for (int y = std::max(0, -top); y < spec_.height && y + top < spec_.full_height; ++y) {
      for (int x = std::max(0, -left); x < spec_.width && x + left < spec_.full_width; ++x)
        set(x + left, y + top, x, y);
    }
  }

 private:
  OIIO::ImageSpec spec_;
  int first_ = 0;
  std::size_t count_ = 0;
  std::vector<float> values_;
};

std::vector<ChannelPlace> placesOf(const ChosenChannels& chosen, bool isExr) {
  std::vector<ChannelPlace> places(chosen.colour.begin(), chosen.colour.end());
  if (chosen.flow) places.insert(places.end(), {chosen.flow->x, chosen.flow->y});
  if (isExr && chosen.luminance) places.push_back(*chosen.luminance);
  return places;
}

bool areClose(std::span<const ChannelPlace> places) {
  constexpr int kFew = 16;
  const auto [first, last] = std::ranges::minmax(places, {}, &ChannelPlace::channel);
  return last.channel - first.channel < kFew &&
         std::ranges::all_of(places, [part = first.part](ChannelPlace place) { return place.part == part; });
}

template <class ColourMap>
ColourMap colourOf(const Planes& planes, const std::array<ChannelPlace, 3>& rgb) {
  ColourMap map(planes.size());
  planes.forEachPixel([&](int x, int y, int dataX, int dataY) {
    for (int i = 0; i < 3; ++i) map(x, y)[i] = planes.at(dataX, dataY, rgb[static_cast<std::size_t>(i)]);
  });
  return map;
}

}  // namespace

Size ImageFile::size() const {
  return std::visit([](const auto& map) { return map.size(); }, colour);
}

ImageFile readImage(const fs::path& file, const std::string& layer) {
  requireRegularFile(file);
  requireWholePng(file);
  const auto in = OIIO::ImageInput::open(file.string());
  if (!in) throw InputError(file.string(), "cannot read as an image: " + firstLine(OIIO::geterror()));
  in->threads(1);  // frames are read side by side; OpenImageIO's own threads would only compete
  const bool isExr = std::strcmp(in->format_name(), "openexr") == 0;
  if (!isExr && !layer.empty()) {
    throw InputError(file.string(),
                     "--layer: only OpenEXR files have layers, this is " + std::string(in->format_name()));
  }
  const ChosenChannels chosen = chooseChannels(partsOf(*in), layer, file);

  // What lies close together is read at once, because every reading decompresses the part.
  const std::vector<ChannelPlace> wanted = placesOf(chosen, isExr);
  const bool isClose = areClose(wanted);
  const auto together = isClose ? std::make_shared<const Planes>(*in, file, wanted) : nullptr;
  const auto planesOf = [&](std::span<const ChannelPlace> places) {
    return isClose ? together : std::make_shared<const Planes>(*in, file, places);
  };

  ImageFile image;
  const auto colour = planesOf(chosen.colour);
  if (colour->spec().format.is_floating_point()) {
    image.colour = colourOf<RadianceMap>(*colour, chosen.colour);
  } else {
    image.colour = colourOf<EncodedMap>(*colour, chosen.colour);
  }
  if (chosen.flow) {
    const auto& [x, y, scale] = *chosen.flow;
    const auto flow = planesOf(std::array{x, y});
    image.flowToNext = PixelFlow(flow->size(), glm::vec2(0.0f));
    flow->forEachPixel([&](int toX, int toY, int dataX, int dataY) {
      image.flowToNext(toX, toY) = scale * glm::vec2(flow->at(dataX, dataY, x), flow->at(dataX, dataY, y));
    });
  }
  if (isExr && chosen.luminance) {
    const auto luminance = planesOf(std::array{*chosen.luminance});
    image.luminance = LuminanceMap(luminance->size());
    luminance->forEachPixel([&](int x, int y, int dataX, int dataY) {
      image.luminance(x, y) = luminance->at(dataX, dataY, *chosen.luminance);
    });
  }
  for (const Size found : {image.flowToNext.size(), image.luminance.size()}) {
    if (found.area() != 0 && found != image.size()) {
      throw InputError(file.string(), "expected parts of one display window, found two of different sizes");
    }
  }
  return image;
}

}  // namespace promenade::io
