#pragma once
// Internal: a scene's images, decoded (OpenImageIO) to see that they can be and what they hold, sizes checked
// before decoding. What stays in memory is the encoded bytes.

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "src/scene/accessors.h"
#include "src/scene/gltf.h"
#include "src/scene/scene.h"

namespace promenade::scene {

/// Collects the images that materials use, then decodes them.
class ImageStore {
 public:
  ImageStore(const Gltf& gltf, const Accessors& accessors, SceneFiles& files)
      : gltf_(gltf), accessors_(accessors), files_(files) {}

  /// The index in Scene::images that image `image` of the file will have. Throws InputError: no such image or
  /// file.
  [[nodiscard]] int use(int image, const std::string& place);

  /// Decodes every image in use once. Throws InputError: an image that cannot be decoded, or is over the
  /// limit.
  [[nodiscard]] std::vector<TextureImage> decode(Budget& budget, Warnings& warnings) const;

 private:
  struct Entry {
    std::string place;
    std::string name;
    std::shared_ptr<const Bytes> file;  ///< keeps `encoded` alive; none for a buffer view
    std::span<const std::uint8_t> encoded;
  };

  const Gltf& gltf_;
  const Accessors& accessors_;
  SceneFiles& files_;
  std::map<int, int> byImage_;
  std::map<const std::uint8_t*, int> byContent_;  ///< images that share a file or a view are decoded once
  std::vector<Entry> entries_;
};

}  // namespace promenade::scene
