#pragma once
// The scene as shading needs it: where a hit lies, which way it faces, what its material is there.
// Not part of the folder's public face.

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "src/render/bsdf.h"
#include "src/render/detail.h"
#include "src/render/embree_scene.h"
#include "src/scene/scene.h"

namespace promenade::render {

class MaterialTextures;
struct NormalChange;

/// A hit in world space, before its material is looked at.
struct SurfacePoint {
  glm::vec3 position{0.0f};
  glm::vec3 geometricNormal{0.0f};  ///< unit, on the front side (counter-clockwise winding)
  glm::vec3 normal{0.0f};           ///< unit, interpolated, on the front side
  glm::vec4 tangent{0.0f};          ///< world space, unit; w handedness, 0 where the mesh has none
  glm::vec2 texCoord[2]{};
  glm::vec4 color{1.0f};
  glm::vec3 edge1{0.0f}, edge2{0.0f};                ///< of the triangle, world space
  glm::vec2 texCoordEdge1[2]{}, texCoordEdge2[2]{};  ///< the same in texture space, for footprints
  float normalLength = 0.0f;  ///< of the interpolated normal, world space, before it was made unit
  std::uint32_t instance = 0;
  std::uint32_t triangle = 0;
  int material = 0;
  bool frontFace = true;
};

/// The cross-section of a pencil of rays where it meets the surface: two half axes in the surface, world
/// space.
struct Footprint {
  glm::vec3 major{0.0f}, minor{0.0f};
  Detail detail = Detail::kFull;
};

/// KHR_materials_volume: the part of light left after `distance` metres inside the material.
[[nodiscard]] Rgb volumeTransmittance(const Material& material, float distance);

/// The material at a point.
struct SurfaceLook {
  BsdfParameters bsdf;
  glm::vec3 normal{
      0.0f};  ///< unit shading normal on the side of the ray's origin; reflections stay above the surface
  Rgb emission{0.0f};  ///< toward the ray's origin
  float alpha = 1.0f;  ///< coverage of a blended material; 1 for others
  bool unlit = false;  ///< emits only
};

class Surfaces {
 public:
  struct FilterTarget {
    const Surfaces* owner = nullptr;
    std::uint32_t mesh = 0;
    bool cutOut = false;      ///< some texels are not there at all
    bool attenuates = false;  ///< some texels let light through to a shadow ray
  };
  struct Placement {
    std::uint32_t mesh = 0;
    bool flattened = true;
    glm::mat4x3 worldFromObject{1.0f};
    glm::mat3 worldNormalFromObject{1.0f};  ///< inverse transpose, not normalised
    float orientation = 1.0f;               ///< -1 where the placement mirrors
    std::size_t firstPosition = 0;          ///< of a flattened instance in flatPositions_
  };
  struct Triangles {
    const glm::vec3* positions = nullptr;  ///< readable 16 bytes at a time, the last one too
    std::size_t vertexCount = 0;
    const glm::uvec3* indices = nullptr;
    std::size_t triangleCount = 0;
    const FilterTarget* filter = nullptr;
  };

  /// Which transparent surfaces a shadow ray passes straight through.
  enum class ShadowsThrough { kPanes, kPanesAndSolids };

  /// `scene` must outlive this.
  explicit Surfaces(const Scene& scene, ShadowsThrough shadowsThrough = ShadowsThrough::kPanes);
  ~Surfaces();
  Surfaces(const Surfaces&) = delete;
  Surfaces& operator=(const Surfaces&) = delete;

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] std::size_t meshCount() const { return scene_.meshes.size(); }
  [[nodiscard]] std::size_t instanceCount() const { return placements_.size(); }
  [[nodiscard]] const Placement& placement(std::size_t instance) const { return placements_[instance]; }
  /// What Embree is given: world space for a flattened instance, else the mesh in object space.
  [[nodiscard]] Triangles triangles(std::size_t instance) const;
  [[nodiscard]] const Material& materialOf(std::size_t instance) const;
  [[nodiscard]] const MaterialTextures& textures() const { return *textures_; }

  /// `direction`: the ray that found the hit (only its sense relative to the surface matters).
  [[nodiscard]] SurfacePoint pointAt(const Hit& hit, const glm::vec3& direction) const;
  /// Geometric normal in world space, unit, on the side that faces against `direction`. `traced`: the
  /// normal of a triangle of that instance as Embree gives it (EmbreeScene::PacketHits).
  [[nodiscard]] glm::vec3 facingNormal(std::uint32_t instance, const glm::vec3& traced,
                                       const glm::vec3& direction) const {
    const Placement& p = placements_[instance];
    const glm::vec3 normal = p.flattened ? traced : p.worldNormalFromObject * traced;
    const float squared = glm::dot(normal, normal);
    if (!(squared > 0.0f && std::isfinite(squared))) return -glm::normalize(direction);
    return normal * (std::copysign(1.0f, -glm::dot(normal, direction)) / std::sqrt(squared));
  }
  /// World-space corners of a triangle in the order of the mesh.
  struct Corners {
    glm::vec3 a{0.0f}, b{0.0f}, c{0.0f};
    glm::vec3 frontNormal{0.0f};  ///< on the front side, as long as twice the area
  };
  [[nodiscard]] Corners corners(std::size_t instance, std::uint32_t triangle) const;

  /// `direction` is the unit direction of the ray that arrives.
  [[nodiscard]] SurfaceLook lookAt(const SurfacePoint& point, const glm::vec3& direction,
                                   const Footprint& footprint) const;

  /// Radiance that a point of an emissive triangle sends to its shining side, coverage included.
  [[nodiscard]] Rgb emissionAt(std::uint32_t instance, std::uint32_t triangle, glm::vec2 barycentric) const;
  /// Luminance of emissionAt() averaged over the triangle, roughly: for choosing between lights.
  [[nodiscard]] float meanEmission(std::uint32_t instance, std::uint32_t triangle) const;

  /// For the filters of Embree. Barycentric as in Hit.
  [[nodiscard]] bool isPresent(std::uint32_t mesh, std::uint32_t triangle, glm::vec2 barycentric) const;
  [[nodiscard]] Rgb shadowTransmittance(std::uint32_t mesh, std::uint32_t triangle, glm::vec2 barycentric,
                                        const glm::vec3& normal, const glm::vec3& direction) const;

 private:
  /// 0 where the normal was not interpolated.
  [[nodiscard]] NormalChange normalChange(const SurfacePoint& point) const;
  [[nodiscard]] float alphaAt(const Mesh& mesh, const Material& material, std::uint32_t triangle,
                              glm::vec2 barycentric) const;

  const Scene& scene_;
  ShadowsThrough shadowsThrough_;
  std::unique_ptr<MaterialTextures> textures_;
  std::vector<Placement> placements_;
  std::vector<FilterTarget> filters_;                    // a mesh
  std::vector<glm::vec3> flatPositions_;                 // world space, of flattened instances
  std::vector<std::vector<glm::vec3>> objectPositions_;  // a mesh, padded; empty where no instance shares it
};

}  // namespace promenade::render
