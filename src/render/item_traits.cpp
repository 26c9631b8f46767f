#include "src/render/item_traits.h"

#include <array>
#include <cstdint>
#include <map>

namespace promenade::render {
namespace {

constexpr float kMetallic = 0.5f;
constexpr float kSmoothMetal = 0.5f;
constexpr float kSmoothDielectric = 0.35f;
constexpr float kLeastClearcoat = 0.05f;
constexpr float kSmoothClearcoat = 0.5f;
constexpr double kSomewhere = 0.02;
/// Strong reflections are traced with up to twice that (path_solution.cpp), but for narrow ones. Were all of
/// it allowed for, a curved piece of metal would be smoothed visibly, and the grain of a flat one, averaged
/// from few samples, be coarse enough to be seen.
constexpr float kTakenForNoise = 0.05f;
constexpr float kClear = 0.03f;  ///< below this roughness structure is as fine as a sample

/// Values of a channel below and above which 2% of the texels lie, in [0, 1].
struct Range {
  float low = 1.0f, high = 1.0f;
};

class ChannelRanges {
 public:
  explicit ChannelRanges(const Scene& scene) : scene_(scene) {}

  Range of(const std::optional<Texture>& texture, std::size_t channel) {
    if (!texture) return {};
    auto& cached = ranges_[texture->image];
    if (!cached.known) cached = read(texture->image);
    return cached.channels[channel];
  }

 private:
  struct Channels {
    bool known = false;
    std::array<Range, 4> channels;
  };

  [[nodiscard]] Channels read(int image) const {
    const TextureImage& known = scene_.images[static_cast<std::size_t>(image)];
    const TexelCounts& counts = known.counts;
    const double least = kSomewhere * static_cast<double>(known.size.area());
    Channels result;
    result.known = true;
    for (std::size_t c = 0; c < 4; ++c) {
      double below = 0.0;
      std::size_t low = 0;
      while (low < 255 && (below += static_cast<double>(counts[c][low])) < least) ++low;
      double above = 0.0;
      std::size_t high = 255;
      while (high > 0 && (above += static_cast<double>(counts[c][high])) < least) --high;
      result.channels[c] = {static_cast<float>(low) / 255.0f, static_cast<float>(high) / 255.0f};
    }
    return result;
  }

  const Scene& scene_;
  std::map<int, Channels> ranges_;
};

bool isViewDependent(const Material& m, ChannelRanges& ranges) {
  if (m.unlit) return m.alphaMode == AlphaMode::kBlend;
  if (m.alphaMode == AlphaMode::kBlend || m.transmission > 0.0f) return true;
  const float clearcoat = m.clearcoat * ranges.of(m.clearcoatTexture, 0).high;
  const float coatRoughness = m.clearcoatRoughness * ranges.of(m.clearcoatRoughnessTexture, 1).low;
  if (clearcoat >= kLeastClearcoat && coatRoughness <= kSmoothClearcoat) return true;
  const float roughness = m.roughness * ranges.of(m.metallicRoughnessTexture, 1).low;
  const float metallic = m.metallic * ranges.of(m.metallicRoughnessTexture, 2).high;
  if (metallic >= kMetallic && roughness < kSmoothMetal) return true;
  const bool reflects = (m.specular > 0.0f && m.specularColor != Rgb(0.0f)) || metallic > 0.0f;
  return reflects && roughness < kSmoothDielectric;
}

bool texturesShapeReflection(const Material& m) {
  const bool tintsMetal = m.metallic > 0.0f && m.baseColorTexture;
  const bool shapesCoat = m.clearcoatTexture || m.clearcoatRoughnessTexture || m.clearcoatNormalTexture;
  return m.normalTexture || m.metallicRoughnessTexture || m.specularTexture || m.specularColorTexture ||
         m.transmissionTexture || tintsMetal || (m.clearcoat > 0.0f && shapesCoat);
}

/// What is reflected or transmitted by chance is noisy; mirrors and clear panes are not. Where textures shape
/// the reflection, nobody can tell their structure from noise: none is admitted.
float noiseOf(const Material& m) {
  const bool coatIsClear = m.clearcoat > 0.0f && m.clearcoatRoughness < kClear;
  const bool isClear = m.roughness < kClear || coatIsClear || m.alphaMode == AlphaMode::kBlend;
  return isClear || texturesShapeReflection(m) ? 0.0f : kTakenForNoise;
}

}  // namespace

std::vector<ItemTraits> itemTraits(const Scene& scene) {
  ChannelRanges ranges(scene);
  std::vector<ItemTraits> materials;
  materials.reserve(scene.materials.size());
  for (const Material& material : scene.materials) {
    materials.push_back({isViewDependent(material, ranges), noiseOf(material)});
  }
  std::vector<ItemTraits> items;
  items.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    items.push_back(materials[static_cast<std::size_t>(mesh.material)]);
  }
  return items;
}

}  // namespace promenade::render
