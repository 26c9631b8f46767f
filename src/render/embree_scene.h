#pragma once
// The one place where Embree 3 is used: device, top-level scene and one level of instances behind plain
// types. Not part of the folder's public face (only the renderer includes it).
//
// Instances whose mesh is used once (or is tiny) are flattened: their triangles stand in the top-level scene
// in world space, which traces faster. The others share one bottom-level scene a mesh. Either way a hit names
// the index into Scene::instances. Robust mode, so that a ray gives the same hit alone or in a packet of any
// width.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>

#include "src/core/image.h"

namespace promenade::render {

class Surfaces;

struct Ray {
  glm::vec3 origin{0.0f};
  glm::vec3 direction{0.0f, 0.0f, 1.0f};  ///< need not be unit; distances are multiples of its length
  float nearest = 0.0f;
  float farthest = std::numeric_limits<float>::infinity();
};

struct Hit {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t instance = kNone;  ///< index into Scene::instances
  std::uint32_t triangle = 0;      ///< index into the mesh's triangles
  glm::vec2 barycentric{0.0f};     ///< weights of the triangle's second and third vertex
  float distance = std::numeric_limits<float>::infinity();
  [[nodiscard]] bool found() const { return instance != kNone; }
};

class EmbreeScene {
 public:
  static constexpr int kPacket = 16;

  /// `surfaces` must outlive this. `threads` for building, 0 = all.
  EmbreeScene(const Surfaces& surfaces, int threads);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  /// Nearest surface; texels cut out by an alpha mask, or wholly transparent ones of a blended material, are
  /// not there.
  [[nodiscard]] Hit intersect(const Ray& ray) const;
  struct PacketHits {
    std::array<Hit, kPacket> hits;
    /// Of the triangles, of any length and on either side, in the space that Embree was given
    /// (Surfaces::triangles). Embree has them at hand; to read the corners again costs as much as half the
    /// tracing.
    std::array<glm::vec3, kPacket> normals;
  };
  /// The same for `count` <= kPacket coherent rays.
  [[nodiscard]] PacketHits intersect(const std::array<Ray, kPacket>& rays, int count) const;

  /// Fraction of light that gets from one end of the ray to the other: 0 behind an opaque surface;
  /// alpha-blended surfaces and delta thin-walled transmission let a part through.
  [[nodiscard]] Rgb transmittance(const Ray& ray) const;
  /// The same for `count` <= kPacket rays, best of one origin.
  [[nodiscard]] std::array<Rgb, kPacket> transmittance(const std::array<Ray, kPacket>& rays, int count) const;

  struct Bounds {
    glm::vec3 lower{0.0f}, upper{0.0f};  ///< both 0 for an empty scene
  };
  [[nodiscard]] Bounds bounds() const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace promenade::render
