#include "tests/render/radiosity.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "src/core/display.h"
#include "src/render/basis.h"
#include "src/render/ray_offset.h"
#include "src/render/sampler.h"
#include "tests/render/scenes.h"

namespace promenade::tests {
namespace {

void cut(Mesh& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, float longestEdge) {
  const float ab = glm::distance(a, b);
  const float bc = glm::distance(b, c);
  const float ca = glm::distance(c, a);
  if (std::max({ab, bc, ca}) > longestEdge) {  // the longest edge in its middle: shapes stay good
    if (ab >= bc && ab >= ca) {
      const glm::vec3 m = 0.5f * (a + b);
      cut(mesh, a, m, c, longestEdge);
      cut(mesh, m, b, c, longestEdge);
    } else if (bc >= ca) {
      cut(mesh, b, c, a, longestEdge);
    } else {
      cut(mesh, c, a, b, longestEdge);
    }
    return;
  }
  const glm::vec3 normal = glm::cross(b - a, c - a);
  if (!(glm::length(normal) > 0.0f)) return;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {a, b, c});
  mesh.normals.insert(mesh.normals.end(), 3, glm::normalize(normal));
  mesh.triangles.push_back({first, first + 1, first + 2});
}

}  // namespace

Scene mattMesh(const Scene& scene, float longestEdge) {
  Scene matt;
  for (const Material& material : scene.materials) {
    Material m = diffuseMaterial(Rgb(material.baseColor));
    m.emission = material.emission;
    m.doubleSided = false;
    matt.materials.push_back(m);
  }
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
    const auto world = [&](std::uint32_t vertex) {
      return instance.worldFromObject * glm::vec4(mesh.positions[vertex], 1.0f);
    };
    Mesh pieces;
    pieces.material = mesh.material;
    for (const glm::uvec3& t : mesh.triangles) cut(pieces, world(t.x), world(t.y), world(t.z), longestEdge);
    place(matt, std::move(pieces));
  }
  return matt;
}

Radiosity::Radiosity(const render::Surfaces& surfaces, const render::EmbreeScene& embree) : embree_(embree) {
  const Scene& scene = surfaces.scene();
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(scene.instances[i].mesh)];
    const Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
    std::vector<Patch>& patches = patches_.emplace_back();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const render::Surfaces::Corners corners = surfaces.corners(i, t);
      const float twiceArea = glm::length(corners.frontNormal);
      patches.push_back({corners.a, corners.b, corners.c, corners.frontNormal / twiceArea, 0.5f * twiceArea,
                         Rgb(material.baseColor), material.emission, material.emission});
    }
  }
}

void Radiosity::shoot(double unshotShare, int raysPerShot) {
  const double enough = unshotShare * unshotPower();
  while (unshotPower() > enough) {
    Patch& from = *brightest();
    const Rgb shot = std::exchange(from.unshot, Rgb(0.0f)) * (from.area / static_cast<float>(raysPerShot));
    const render::Basis basis(from.normal);
    render::Sampler::Stream stream;
    stream.frame = static_cast<std::uint32_t>(shots_++);
    stream.pathsPerPixel = static_cast<std::uint32_t>(raysPerShot);
    for (std::uint32_t k = 0; k < stream.pathsPerPixel; ++k) {
      render::Sampler sampler(stream, k);
      const glm::vec2 u = sampler.next2D();
      const float root = std::sqrt(u.x);  // uniform over the triangle
      const glm::vec3 point = from.a * (1.0f - root) + from.b * (root * (1.0f - u.y)) + from.c * (root * u.y);
      render::Ray ray;
      ray.origin = render::offsetRayOrigin(point, from.normal);
      ray.direction = basis.toWorld(render::sampleCosine(sampler.next2D()));
      const render::Hit hit = embree_.intersect(ray);
      if (!hit.found()) continue;
      Patch& to = patches_[hit.instance][hit.triangle];
      if (glm::dot(to.normal, ray.direction) >= 0.0f) continue;  // its back is black
      const Rgb received = to.reflectance * shot / to.area;
      to.radiance += received;
      to.unshot += received;
    }
  }
}

Patch* Radiosity::brightest() {
  Patch* best = nullptr;
  for (auto& group : patches_) {
    for (Patch& patch : group) {
      if (best == nullptr || luminance(patch.unshot) * patch.area > luminance(best->unshot) * best->area) {
        best = &patch;
      }
    }
  }
  return best;
}

double Radiosity::unshotPower() const {
  double sum = 0.0;
  for (const auto& group : patches_) {
    for (const Patch& patch : group) sum += static_cast<double>(luminance(patch.unshot)) * patch.area;
  }
  return sum;
}

}  // namespace promenade::tests
