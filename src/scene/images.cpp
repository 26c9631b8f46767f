#include "src/scene/images.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <string_view>

#include "src/scene/png_check.h"

namespace promenade::scene {
namespace {

// No PNG or JPEG is smaller than its texels by more than this (DEFLATE: 1032:1), so a file that claims more
// is cut off or lies; below the floor nobody is hurt.
constexpr std::uint64_t kLargestCompression = 1100;
constexpr std::uint64_t kHarmlessTexelBytes = 64ull << 20;

bool startsWith(std::span<const std::uint8_t> bytes, std::string_view magic, std::size_t offset = 0) {
  return bytes.size() >= offset + magic.size() &&
         std::memcmp(bytes.data() + offset, magic.data(), magic.size()) == 0;
}

/// A file name whose ending selects OpenImageIO's reader; by content, since mimeType and names are often
/// wrong.
std::optional<std::string> nameForReader(std::span<const std::uint8_t> bytes) {
  if (startsWith(bytes, "\x89PNG")) return "image.png";
  if (startsWith(bytes, "\xFF\xD8\xFF")) return "image.jpg";
  if (startsWith(bytes, "RIFF") && startsWith(bytes, "WEBP", 8)) return "image.webp";
  return std::nullopt;
}

struct Decoded {
  Texels texels;
  std::string error;
  bool rounded = false;
};

/// Grey, grey-alpha and RGB to RGBA, in place.
void expandChannels(Texels& texels, int channels) {
  for (auto& texel : texels.pixels()) {
    if (channels <= 2) {
      texel = {texel[0], texel[0], texel[0], channels == 2 ? texel[1] : std::uint8_t{255}};
    } else if (channels == 3) {
      texel[3] = 255;
    }
  }
}

/// OpenImageIO 2.4 multiplies the colours of WebP by alpha, whatever it is asked.
void divideByAlpha(Texels& texels) {
  for (auto& texel : texels.pixels()) {
    const int alpha = texel[3];
    for (std::size_t c = 0; c < 3 && alpha > 0; ++c) {
      texel[c] = static_cast<std::uint8_t>(std::min(255, (texel[c] * 255 + alpha / 2) / alpha));
    }
  }
}

/// `budget` may be null: what was decoded once need not be charged again.
Decoded decodeImage(std::span<const std::uint8_t> encoded, Budget* budget) {
  Decoded result;
  const std::optional<std::string> name = nameForReader(encoded);
  if (!name) {
    result.error = startsWith(encoded, "\xABKTX 20") ? "KTX2 images (KHR_texture_basisu) are not supported"
                                                     : "expected a PNG, JPEG or WebP image";
    return result;
  }
  if (name->ends_with(".png")) {
    result.error = pngDamage(encoded);
    if (!result.error.empty()) {
      return result;
    }
  }
  // The proxy only reads; its interface is not const.
  OIIO::Filesystem::IOMemReader proxy(const_cast<std::uint8_t*>(encoded.data()), encoded.size());
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;  // glTF alpha is not premultiplied
  OIIO::Filesystem::IOProxy* proxyPointer = &proxy;
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxyPointer);
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(*name, &config, &proxy);
  if (!input) {
    result.error = "cannot be decoded: " + printable(OIIO::geterror());
    return result;
  }
  input->threads(1);  // images are decoded side by side; OpenImageIO's own threads would only compete
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1) {
    result.error = "cannot be decoded: it has no texels";
    return result;
  }
  const auto width = static_cast<std::uint64_t>(spec.width);
  const auto height = static_cast<std::uint64_t>(spec.height);
  if (budget != nullptr) budget->chargeTexture(width, height);
  if (width * height * 4 > kHarmlessTexelBytes && width * height * 4 / kLargestCompression > encoded.size()) {
    result.error = "claims " + std::to_string(width) + " x " + std::to_string(height) + " texels in " +
                   std::to_string(encoded.size()) + " bytes";
    return result;
  }
  const int channels = std::min(spec.nchannels, 4);
  result.rounded = spec.format.size() > 1;
  result.texels = Texels(spec.width, spec.height);
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, result.texels.pixels().data(), 4,
                         static_cast<OIIO::stride_t>(width * 4))) {
    result.error = "cannot be decoded: " + printable(input->geterror());
    return result;
  }
  expandChannels(result.texels, channels);
  if (name->ends_with(".webp")) {
    divideByAlpha(result.texels);
  }
  return result;
}

class EncodedTexels : public TexelSource {
 public:
  EncodedTexels(std::shared_ptr<const Bytes> file, std::string name)
      : file_(std::move(file)), name_(std::move(name)) {}

  [[nodiscard]] Texels texels() const override {
    Decoded decoded = decodeImage(*file_, nullptr);
    if (!decoded.error.empty()) throw CannotContinue(name_ + ": " + decoded.error);
    return std::move(decoded.texels);
  }
  [[nodiscard]] std::span<const std::uint8_t> bytes() const override { return *file_; }

 private:
  std::shared_ptr<const Bytes> file_;
  std::string name_;
};

}  // namespace

int ImageStore::use(int image, const std::string& place) {
  gltf_.checkIndex(image, gltf_.images.size(), place, "image");
  if (const auto found = byImage_.find(image); found != byImage_.end()) {
    return found->second;
  }
  const ImageSource& source = gltf_.images[static_cast<std::size_t>(image)];
  Entry entry;
  entry.place = at("images", static_cast<std::size_t>(image));
  entry.name = printable(!source.name.empty()    ? source.name
                         : isDataUri(source.uri) ? entry.place
                                                 : source.uri);
  if (source.uri.empty()) {
    entry.encoded = accessors_.view(source.bufferView, entry.place + ".bufferView");
  } else {
    entry.file = files_.read(source.uri, gltf_.source + ": " + entry.place + ".uri");
    entry.encoded = *entry.file;
  }
  const auto [found, isNew] = byContent_.emplace(entry.encoded.data(), static_cast<int>(entries_.size()));
  if (isNew || entries_[static_cast<std::size_t>(found->second)].encoded.size() != entry.encoded.size()) {
    found->second = static_cast<int>(entries_.size());
    entries_.push_back(std::move(entry));
  }
  byImage_.emplace(image, found->second);
  return found->second;
}

std::vector<TextureImage> ImageStore::decode(Budget& budget, Warnings& warnings) const {
  struct Known {
    Size size;
    TexelCounts counts{};
    std::string error;
    bool rounded = false;
  };
  std::vector<Known> known(entries_.size());
  tbb::parallel_for(std::size_t{0}, entries_.size(), [&](std::size_t i) {
    try {
      const Decoded decoded = decodeImage(entries_[i].encoded, &budget);
      known[i] = {decoded.texels.size(), countTexels(decoded.texels), decoded.error, decoded.rounded};
    } catch (const std::exception& error) {  // kept, so that the first in the file's order is reported
      known[i].error = error.what();
    }
  });
  std::vector<TextureImage> images;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Entry& entry = entries_[i];
    if (!known[i].error.empty()) {
      gltf_.fail(entry.place + " (" + inQuotes(entry.name) + ")", known[i].error);
    }
    if (known[i].rounded) {
      warnings.add(entry.place + " (" + inQuotes(entry.name) +
                   "): its 16-bit channels are rounded to 8 bits");
    }
    // A buffer's other contents need not stay in memory for its images' sake.
    auto bytes =
        entry.file ? entry.file : std::make_shared<const Bytes>(entry.encoded.begin(), entry.encoded.end());
    images.push_back({entry.name, known[i].size, known[i].counts,
                      std::make_shared<const EncodedTexels>(std::move(bytes), entry.name)});
  }
  return images;
}

}  // namespace promenade::scene
