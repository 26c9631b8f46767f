#include "src/render/texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>

#include "src/core/display.h"

namespace promenade::render {
namespace {

using Texel = std::array<std::uint8_t, 4>;
using Texels = Image<Texel>;
using DecodeTable = std::array<float, 256>;

template <class Decode>
DecodeTable makeTable(Decode decode) {
  DecodeTable table{};
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = decode(static_cast<float>(i) / 255.0f);
  return table;
}

const DecodeTable kDecodeSrgb = makeTable([](float v) { return decodeSrgb(v); });
const DecodeTable kDecodeLinear = makeTable([](float v) { return v; });

const DecodeTable& tableOf(TexelEncoding encoding) {
  return encoding == TexelEncoding::kSrgb ? kDecodeSrgb : kDecodeLinear;
}

glm::vec4 decode(const Texel& texel, const DecodeTable& colour) {
  return {colour[texel[0]], colour[texel[1]], colour[texel[2]], kDecodeLinear[texel[3]]};
}

std::uint8_t quantize(float v) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(v * 255.0f), 0L, 255L));
}

Texel encode(const glm::vec4& v, TexelEncoding encoding) {
  const auto colour = [encoding](float c) {
    return quantize(encoding == TexelEncoding::kSrgb ? encodeSrgb(c) : c);
  };
  return {colour(v.r), colour(v.g), colour(v.b), quantize(v.a)};
}

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

Texels half(const Texels& from, TexelEncoding encoding) {
  const DecodeTable& table = tableOf(encoding);
  Texels result(Size{std::max(1, from.width() / 2), std::max(1, from.height() / 2)});
  for (int y = 0; y < result.height(); ++y) {
    const Coverage rows = coverageOf(y, from.height(), result.height());
    for (int x = 0; x < result.width(); ++x) {
      const Coverage columns = coverageOf(x, from.width(), result.width());
      glm::vec4 sum(0.0f);
      for (int dy = 0; dy < 3; ++dy) {
        for (int dx = 0; dx < 3; ++dx) {
          const float weight =
              rows.weight[static_cast<std::size_t>(dy)] * columns.weight[static_cast<std::size_t>(dx)];
          if (weight > 0.0f) sum += weight * decode(from(columns.first + dx, rows.first + dy), table);
        }
      }
      result(x, y) = encode(sum, encoding);
    }
  }
  return result;
}

/// The coordinate brought into [0, 1] as the wrap mode says.
float wrapCoordinate(float t, Wrap wrap) {
  if (!std::isfinite(t)) return 0.0f;
  switch (wrap) {
    case Wrap::kRepeat:
      return t - std::floor(t);
    case Wrap::kMirroredRepeat: {
      const float phase = t - 2.0f * std::floor(0.5f * t);
      return phase > 1.0f ? 2.0f - phase : phase;
    }
    case Wrap::kClampToEdge:
      break;
  }
  return std::clamp(t, 0.0f, 1.0f);
}

/// A neighbour's index, at most one texel outside. (At a mirror the neighbour is the edge texel itself.)
int wrapIndex(int i, int size, Wrap wrap) {
  if (i >= 0 && i < size) return i;
  if (wrap == Wrap::kRepeat) return i < 0 ? size - 1 : 0;
  return i < 0 ? 0 : size - 1;
}

glm::vec4 nearest(const Texels& texels, glm::vec2 uv, const DecodeTable& table) {
  const int x = std::min(static_cast<int>(uv.x * static_cast<float>(texels.width())), texels.width() - 1);
  const int y = std::min(static_cast<int>(uv.y * static_cast<float>(texels.height())), texels.height() - 1);
  return decode(texels(x, y), table);
}

glm::vec4 bilinear(const Texels& texels, glm::vec2 uv, const Texture& texture, const DecodeTable& table) {
  const float x = uv.x * static_cast<float>(texels.width()) - 0.5f;
  const float y = uv.y * static_cast<float>(texels.height()) - 0.5f;
  const float floorX = std::floor(x);
  const float floorY = std::floor(y);
  const float fx = x - floorX;
  const float fy = y - floorY;
  const int x0 = wrapIndex(static_cast<int>(floorX), texels.width(), texture.wrapU);
  const int x1 = wrapIndex(static_cast<int>(floorX) + 1, texels.width(), texture.wrapU);
  const int y0 = wrapIndex(static_cast<int>(floorY), texels.height(), texture.wrapV);
  const int y1 = wrapIndex(static_cast<int>(floorY) + 1, texels.height(), texture.wrapV);
  const glm::vec4 top = decode(texels(x0, y0), table) * (1.0f - fx) + decode(texels(x1, y0), table) * fx;
  const glm::vec4 bottom = decode(texels(x0, y1), table) * (1.0f - fx) + decode(texels(x1, y1), table) * fx;
  return top * (1.0f - fy) + bottom * fy;
}

/// Level of the pyramid at which a texel is as wide as the footprint, by area; <= 0: level 0 or finer.
float levelOf(const Texture& texture, Size size, float footprintUv) {
  const glm::mat3& m = texture.transform;
  const float texelsPerUv =
      std::sqrt(std::abs(m[0][0] * m[1][1] - m[1][0] * m[0][1]) * static_cast<float>(size.area()));
  const float footprintTexels = footprintUv * texelsPerUv;
  if (!(footprintTexels > 1.0f)) return 0.0f;  // not a number as well
  return std::log2(std::min(footprintTexels, 1e9f));
}

}  // namespace

TextureLibrary::Pyramid TextureLibrary::makePyramid(const Texels& base, TexelEncoding encoding) {
  Pyramid pyramid{&base, {}};
  const Texels* last = &base;
  while (last->size().area() > 1) {
    Texels next = half(*last, encoding);
    pyramid.above.push_back(std::move(next));
    last = &pyramid.above.back();
  }
  return pyramid;
}

TextureLibrary::TextureLibrary(const Scene& scene) : images_(scene.images.size()) {
  const auto add = [this, &scene](const std::optional<Texture>& texture) {
    if (!texture) return;
    const auto index = static_cast<std::size_t>(texture->image);
    Pyramid& pyramid =
        texture->encoding == TexelEncoding::kSrgb ? images_[index].srgb : images_[index].linear;
    const Texels& base = scene.images[index].texels;
    const bool whole = pyramid.base != nullptr && (!pyramid.above.empty() || base.size().area() <= 1);
    if (whole) return;
    pyramid = texture->mipmapped ? makePyramid(base, texture->encoding) : Pyramid{&base, {}};
  };
  for (const Material& material : scene.materials) {
    add(material.baseColorTexture);
    add(material.metallicRoughnessTexture);
    add(material.normalTexture);
    add(material.emissionTexture);
    add(material.transmissionTexture);
    add(material.specularTexture);
    add(material.specularColorTexture);
    add(material.clearcoatTexture);
    add(material.clearcoatRoughnessTexture);
    add(material.clearcoatNormalTexture);
  }
}

glm::vec4 TextureLibrary::sample(const Texture& texture, glm::vec2 uv, float footprintUv) const {
  const ImagePyramids& image = images_[static_cast<std::size_t>(texture.image)];
  const Pyramid& pyramid = texture.encoding == TexelEncoding::kSrgb ? image.srgb : image.linear;
  const DecodeTable& table = tableOf(texture.encoding);
  const glm::vec3 transformed = texture.transform * glm::vec3(uv, 1.0f);
  const glm::vec2 wrapped{wrapCoordinate(transformed.x, texture.wrapU),
                          wrapCoordinate(transformed.y, texture.wrapV)};

  const float level = texture.mipmapped ? levelOf(texture, pyramid.base->size(), footprintUv) : 0.0f;
  if (level <= 0.0f || pyramid.above.empty()) {
    return texture.magnification == Filter::kNearest ? nearest(*pyramid.base, wrapped, table)
                                                     : bilinear(*pyramid.base, wrapped, texture, table);
  }
  const auto top = static_cast<int>(pyramid.above.size());
  const auto levelTexels = [&pyramid](int i) -> const Texels& {
    return i == 0 ? *pyramid.base : pyramid.above[static_cast<std::size_t>(i - 1)];
  };
  if (level >= static_cast<float>(top)) return decode(levelTexels(top)(0, 0), table);
  const int finer = static_cast<int>(level);
  const float blend = level - static_cast<float>(finer);
  return bilinear(levelTexels(finer), wrapped, texture, table) * (1.0f - blend) +
         bilinear(levelTexels(finer + 1), wrapped, texture, table) * blend;
}

std::size_t TextureLibrary::bytes() const {
  std::size_t sum = 0;
  for (const ImagePyramids& image : images_) {
    for (const Pyramid* pyramid : {&image.srgb, &image.linear}) {
      for (const Texels& level : pyramid->above) sum += level.size().area() * sizeof(Texel);
    }
  }
  return sum;
}

}  // namespace promenade::render
