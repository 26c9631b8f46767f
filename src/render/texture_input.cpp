#include "src/render/texture_input_internal.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "src/core/display.h"
#include "src/core/errors.h"

namespace promenade::render {
namespace {

constexpr int kChannels = 4;
constexpr const char* kFileAttribute = "promenade:file";

template <class Value>
using TexelsOf = Image<std::array<Value, kChannels>>;

/// Which texels of a row of `from` one texel of its half covers, and how much of each: 2, or 3 where `from`
/// is odd (then the outer two are cut), so that every texel of the larger image has the same weight in the
/// smaller.
struct Coverage {
  int first;
  std::array<float, 3> weight;
};

Coverage coverageOf(int index, int from, int to) {
  if (from == to) return {index, {1.0f, 0.0f, 0.0f}};  // a side that is 1 already
  if (from == 2 * to) return {2 * index, {0.5f, 0.5f, 0.0f}};
  const auto n = static_cast<float>(to);
  const auto i = static_cast<float>(index);
  const float whole = static_cast<float>(from);
  return {2 * index, {(n - i) / whole, n / whole, (i + 1.0f) / whole}};
}

template <class Value>
class MeanTexel {
 public:
  void add(float weight, const std::array<Value, kChannels>& texel) {
    for (std::size_t c = 0; c < kChannels; ++c) sum_[c] += weight * static_cast<float>(texel[c]);
  }
  [[nodiscard]] std::array<Value, kChannels> texel() const {
    std::array<Value, kChannels> rounded{};
    for (std::size_t c = 0; c < kChannels; ++c) rounded[c] = static_cast<Value>(sum_[c] + 0.5f);
    return rounded;
  }

 private:
  std::array<float, kChannels> sum_{};
};

/// Deviation in place of alpha.
class MeanNormalTexel {
 public:
  using Texel = std::array<std::uint8_t, kChannels>;

  void add(float weight, const Texel& texel) {
    mean_.add(weight, glm::vec4(texel[0], texel[1], texel[2], texel[3]) / 255.0f);
  }
  [[nodiscard]] Texel texel() const {
    const glm::vec4 value(mean_.encoded(), std::min(std::sqrt(mean_.variance()), 1.0f));
    Texel rounded{};
    for (int c = 0; c < kChannels; ++c) {
      rounded[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(255.0f * value[c] + 0.5f);
    }
    return rounded;
  }

 private:
  MeanNormal mean_;
};

template <class Mean, class Value>
void halve(const TexelsOf<Value>& from, Size size, std::array<Value, kChannels>* to) {
  for (int y = 0; y < size.height; ++y) {
    const Coverage rows = coverageOf(y, from.height(), size.height);
    for (int x = 0; x < size.width; ++x) {
      const Coverage columns = coverageOf(x, from.width(), size.width);
      Mean mean;
      for (int dy = 0; dy < 3; ++dy) {
        for (int dx = 0; dx < 3; ++dx) {
          const float weight =
              rows.weight[static_cast<std::size_t>(dy)] * columns.weight[static_cast<std::size_t>(dx)];
          if (weight > 0.0f) mean.add(weight, from(columns.first + dx, rows.first + dy));
        }
      }
      *to++ = mean.texel();
    }
  }
}

std::array<std::uint16_t, 256> makeDecodeTable() {
  std::array<std::uint16_t, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<std::uint16_t>(std::lround(65535.0f * decodeSrgb(static_cast<float>(i) / 255.0f)));
  }
  return table;
}

void decodeColours(const Texels& texels, std::array<std::uint16_t, kChannels>* to) {
  static const std::array<std::uint16_t, 256> table = makeDecodeTable();
  for (const auto& texel : texels.pixels()) {
    *to++ = {table[texel[0]], table[texel[1]], table[texel[2]], static_cast<std::uint16_t>(texel[3] * 257)};
  }
}

/// The cache keeps in it the tile that its thread looks at, so what is read while a tile is read needs its
/// own.
class NestedLookups {
 public:
  explicit NestedLookups(OIIO::ImageCache& cache) : cache_(cache), thread_(cache.create_thread_info()) {}
  NestedLookups(const NestedLookups&) = delete;
  NestedLookups& operator=(const NestedLookups&) = delete;
  ~NestedLookups() { cache_.destroy_thread_info(thread_); }
  [[nodiscard]] OIIO::ImageCache::Perthread* thread() const { return thread_; }

 private:
  OIIO::ImageCache& cache_;
  OIIO::ImageCache::Perthread* thread_;
};

class TextureInput final : public OIIO::ImageInput {
 public:
  [[nodiscard]] const char* format_name() const override { return "promenade"; }

  bool open(const std::string& name, OIIO::ImageSpec& /*spec*/) override {
    errorfmt("{}: no texture of a scene", name);
    return false;
  }
  bool open(const std::string& name, OIIO::ImageSpec& spec, const OIIO::ImageSpec& config) override {
    const void* file = nullptr;
    if (!config.getattribute(kFileAttribute, OIIO::TypeDesc::PTR, &file)) return open(name, spec);
    file_ = static_cast<const TextureFile*>(file);
    seek_subimage(0, 0);
    spec = m_spec;
    return true;
  }
  bool close() override { return true; }
  [[nodiscard]] int current_miplevel() const override { return level_; }

  bool seek_subimage(int subimage, int level) override {
    const Size base = file_->image->size;
    const bool exists = level == 0 || sizeOfLevel(base, level - 1).area() > 1;
    if (subimage != 0 || level < 0 || !exists) return false;
    const Size size = sizeOfLevel(base, level);
    level_ = level;
    m_spec = OIIO::ImageSpec(size.width, size.height, kChannels,
                             isWide() ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8);
    return true;
  }

  // What the cache calls. It asks for all of a level, in the level's own format, packed.
  bool read_image(int /*subimage*/, int level, int /*firstChannel*/, int /*lastChannel*/,
                  OIIO::TypeDesc format, void* data, OIIO::stride_t /*x*/, OIIO::stride_t /*y*/,
                  OIIO::stride_t /*z*/, OIIO::ProgressCallback /*progress*/, void* /*argument*/) override {
    // An exception would leave the tile unfinished for ever, and other threads waiting for it.
    try {
      if (format == OIIO::TypeDesc::UINT16 && isWide()) return readLevel<std::uint16_t>(level, data);
      if (format == OIIO::TypeDesc::UINT8 && !isWide()) return readLevel<std::uint8_t>(level, data);
      errorfmt("{}: unexpected format {}", file_->image->name, format);
    } catch (const std::exception& error) {
      errorfmt("{}: {}", file_->image->name, error.what());
    }
    return false;
  }
  bool read_native_scanline(int /*subimage*/, int /*level*/, int /*y*/, int /*z*/, void* /*data*/) override {
    errorfmt("{}: only whole levels can be read", file_->image->name);
    return false;
  }

 private:
  [[nodiscard]] bool isWide() const { return file_->encoding == TexelEncoding::kSrgb; }
  [[nodiscard]] bool isNormals() const { return file_->encoding == TexelEncoding::kNormal; }

  template <class Value>
  bool readLevel(int level, void* data) {
    auto* to = static_cast<std::array<Value, kChannels>*>(data);
    if (level == 0) {
      const Texels texels = file_->image->source->texels();
      if constexpr (std::is_same_v<Value, std::uint16_t>) {
        decodeColours(texels, to);
      } else {
        std::copy(texels.pixels().begin(), texels.pixels().end(), to);
        if (isNormals()) std::for_each_n(to, texels.size().area(), [](auto& texel) { texel[3] = 0; });
      }
      return true;
    }
    const Size finer = sizeOfLevel(file_->image->size, level - 1);
    TexelsOf<Value> texels(finer);
    const NestedLookups lookups(*file_->cache);
    OIIO::ImageCache::ImageHandle* handle = file_->cache->get_image_handle(file_->name, lookups.thread());
    if (!file_->cache->get_pixels(handle, lookups.thread(), 0, level - 1, 0, finer.width, 0, finer.height, 0,
                                  1, OIIO::BaseTypeFromC<Value>::value, texels.pixels().data())) {
      errorfmt("{}", file_->cache->geterror());
      return false;
    }
    const Size size = sizeOfLevel(file_->image->size, level);
    if constexpr (std::is_same_v<Value, std::uint8_t>) {
      if (isNormals()) {
        halve<MeanNormalTexel>(texels, size, to);
        return true;
      }
    }
    halve<MeanTexel<Value>>(texels, size, to);
    return true;
  }

  const TextureFile* file_ = nullptr;
  int level_ = 0;
};

OIIO::ImageInput* makeTextureInput() {
  return new TextureInput;  // a creator's result is deleted by the cache
}

}  // namespace

void addToCache(const TextureFile& file) {
  OIIO::ImageSpec config;
  const void* pointer = &file;
  config.attribute(kFileAttribute, OIIO::TypeDesc::PTR, &pointer);
  if (!file.cache->add_file(file.name, &makeTextureInput, &config)) {
    throw CannotContinue(file.image->name + ": " + file.cache->geterror());
  }
}

Size sizeOfLevel(Size size, int level) {
  return {std::max(1, size.width >> level), std::max(1, size.height >> level)};
}

std::size_t bytesOf(const TextureFile& file) {
  std::size_t texels = 0;
  for (int level = 0; level == 0 || sizeOfLevel(file.image->size, level - 1).area() > 1; ++level) {
    texels += sizeOfLevel(file.image->size, level).area();
  }
  return texels * kChannels * (file.encoding == TexelEncoding::kSrgb ? 2 : 1);
}

}  // namespace promenade::render
