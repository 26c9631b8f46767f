#pragma once
// An image that textures read: what is known of it whole, and where its texels come from. The texels
// themselves are not kept here: whoever needs them decodes them, as often as its memory asks.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "src/core/image.h"

namespace promenade {

/// 8 bits a channel, RGBA, alpha not premultiplied, origin top left, as encoded in the file. (16-bit images
/// are rounded to 8 bits, with a warning.)
using Texels = Image<std::array<std::uint8_t, 4>>;

class TexelSource {
 public:
  TexelSource() = default;
  TexelSource(const TexelSource&) = delete;
  TexelSource& operator=(const TexelSource&) = delete;
  virtual ~TexelSource() = default;

  /// The same at every call, from any number of threads. What was decoded once fails only for want of memory.
  [[nodiscard]] virtual Texels texels() const = 0;
  /// What the texels are decoded from: the same bytes give the same texels.
  [[nodiscard]] virtual std::span<const std::uint8_t> bytes() const = 0;
};

/// How many texels have each value, by channel.
using TexelCounts = std::array<std::array<std::uint64_t, 256>, 4>;

[[nodiscard]] inline TexelCounts countTexels(const Texels& texels) {
  TexelCounts counts{};
  for (const auto& texel : texels.pixels()) {
    for (std::size_t c = 0; c < counts.size(); ++c) ++counts[c][texel[c]];
  }
  return counts;
}

struct TextureImage {
  std::string name;
  Size size;           ///< at least 1x1
  TexelCounts counts;  ///< of source->texels()
  std::shared_ptr<const TexelSource> source;
};

}  // namespace promenade
