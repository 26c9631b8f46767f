#pragma once
// Small scenes made by hand, whose light is known in closed form.

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "src/core/frame.h"
#include "src/scene/scene.h"

namespace promenade::tests {

inline constexpr double kPi = glm::pi<double>();
inline const glm::vec3 kUp(0.0f, 1.0f, 0.0f);

inline Material diffuseMaterial(const Rgb& albedo) {
  Material m;
  m.baseColor = glm::vec4(albedo, 1.0f);
  m.metallic = 0.0f;
  m.roughness = 1.0f;
  m.specular = 0.0f;  // no dielectric coat: Lambert exactly
  m.doubleSided = true;
  return m;
}

inline Material emitter(const Rgb& radiance) {
  Material m = diffuseMaterial(Rgb(0.0f));
  m.emission = radiance;
  return m;
}

/// A parallelogram; the front is the side that cross(edgeU, edgeV) points to. Texture coordinates 0..1 along
/// the edges.
inline Mesh quad(const glm::vec3& corner, const glm::vec3& edgeU, const glm::vec3& edgeV, int material) {
  Mesh m;
  m.positions = {corner, corner + edgeU, corner + edgeU + edgeV, corner + edgeV};
  m.normals.assign(4, glm::normalize(glm::cross(edgeU, edgeV)));
  m.texCoords[0] = {{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}};
  m.triangles = {{0, 1, 2}, {0, 2, 3}};
  m.material = material;
  return m;
}

/// A sphere of latitude-longitude facets, fronts outward, smooth normals.
inline Mesh sphere(const glm::vec3& centre, float radius, int slices, int stacks, int material) {
  Mesh m;
  for (int j = 0; j <= stacks; ++j) {
    for (int i = 0; i <= slices; ++i) {
      const double theta = kPi * j / stacks;
      const double phi = 2.0 * kPi * i / slices;
      const glm::vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      m.positions.push_back(centre + radius * n);
      m.normals.push_back(n);
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (slices + 1) + i); };
  for (int j = 0; j < stacks; ++j) {
    for (int i = 0; i < slices; ++i) {
      if (j > 0) m.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (j + 1 < stacks) m.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  m.material = material;
  return m;
}

inline void place(Scene& scene, Mesh mesh) {
  scene.meshes.push_back(std::move(mesh));
  Instance instance;
  instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
  scene.instances.push_back(instance);
}

/// Texels as they are, not encoded.
class StoredTexels : public TexelSource {
 public:
  explicit StoredTexels(Texels texels) : texels_(std::move(texels)) {}
  [[nodiscard]] Texels texels() const override { return texels_.clone(); }
  [[nodiscard]] std::span<const std::uint8_t> bytes() const override {
    return {reinterpret_cast<const std::uint8_t*>(texels_.pixels().data()), texels_.size().area() * 4};
  }

 private:
  Texels texels_;
};

inline TextureImage textureImage(Texels texels) {
  const Size size = texels.size();
  const TexelCounts counts = countTexels(texels);
  return {"image", size, counts, std::make_shared<StoredTexels>(std::move(texels))};
}

/// A texture of one texel (0 to 255).
inline Texture uniformTexture(Scene& scene, const std::array<std::uint8_t, 4>& texel) {
  scene.images.push_back(textureImage(Texels(Size{1, 1}, texel)));
  Texture texture;
  texture.image = static_cast<int>(scene.images.size()) - 1;
  return texture;
}

inline Environment uniformSky(const Rgb& radiance) {
  Environment e;
  e.radiance = RadianceMap(Size{1, 1}, radiance);
  return e;
}

/// A camera at `eye` that looks at `target`.
inline Camera lookingAt(const glm::dvec3& eye, const glm::dvec3& target, Size size,
                        double verticalFieldOfView = 0.8, const glm::dvec3& up = {0.0, 1.0, 0.0}) {
  const glm::dvec3 back = glm::normalize(eye - target);
  const glm::dvec3 right = glm::normalize(glm::cross(up, back));
  return Camera(Pose{glm::dmat3(right, glm::cross(back, right), back), eye}, verticalFieldOfView, size);
}

inline glm::dvec3 meanRadiance(const Frame& frame) {
  const RadianceMap all = combinedRadiance(frame);
  glm::dvec3 sum(0.0);
  for (const Rgb& pixel : all.pixels()) sum += glm::dvec3(pixel);
  return sum / static_cast<double>(all.pixels().size());
}

}  // namespace promenade::tests
