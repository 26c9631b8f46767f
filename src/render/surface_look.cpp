// The material of a surface at a point: textures, vertex colours, normal maps, coverage.

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "src/render/basis.h"
#include "src/render/material_textures.h"
#include "src/render/normal_spread.h"
#include "src/render/surfaces.h"

namespace promenade::render {
namespace {

/// Less coverage than this is no surface at all (half of an 8-bit step would be invisible).
constexpr float kLeastAlpha = 1.0f / 255.0f;

/// Bends `normal` (on the side of the unit vector `out`) so that `out` lies above it and the mirror direction
/// of `out` above the surface whose unit normal is `geometric`: otherwise steep normal maps and smooth
/// normals at silhouettes make black spots. Departs from the common practice of Cycles'
/// ensure_valid_reflection() in lifting the mirror direction straight up instead of turning the normal in its
/// plane.
glm::vec3 reflectingAbove(const glm::vec3& normal, const glm::vec3& geometric, const glm::vec3& out) {
  const float least = std::min(0.02f, 0.9f * glm::dot(geometric, out));
  const glm::vec3 mirrored = 2.0f * glm::dot(normal, out) * normal - out;
  const float height = glm::dot(mirrored, geometric);
  if (height >= least && glm::dot(normal, out) > 1e-3f) return normal;
  const glm::vec3 lifted = glm::normalize(mirrored + (least - height) * geometric);
  const glm::vec3 half = out + lifted;
  const float squared = glm::dot(half, half);
  const glm::vec3 bent = squared > 1e-8f ? half / std::sqrt(squared) : geometric;
  return glm::dot(bent, out) > 1e-3f ? bent : geometric;
}

/// `texel` of a normal map in the frame of the mesh's tangents; the point's own normal where there is none.
glm::vec3 mappedNormal(const SurfacePoint& point, const glm::vec3& texel, float scale) {
  const glm::vec3& normal = point.normal;
  const glm::vec3 tangent = glm::vec3(point.tangent) - glm::dot(glm::vec3(point.tangent), normal) * normal;
  const float length = glm::length(tangent);
  if (!(length > 1e-6f)) return normal;
  const glm::vec3 x = tangent / length;
  const glm::vec3 y = glm::cross(normal, x) * point.tangent.w;
  glm::vec3 n = 2.0f * texel - 1.0f;
  n.x *= scale;
  n.y *= scale;
  const glm::vec3 mapped = n.x * x + n.y * y + std::max(n.z, 0.0f) * normal;
  const float mappedLength = glm::length(mapped);
  return mappedLength > 1e-6f ? mapped / mappedLength : normal;
}

/// `base`: the base colour, textures and vertex colours applied; `look` reads any other texture. Which side
/// the light comes from, and the coat's normal, are left to the caller.
template <class Look>
BsdfParameters parametersOf(const Material& material, const glm::vec4& base, const Look& look) {
  BsdfParameters bsdf;
  bsdf.baseColor = glm::min(Rgb(base), Rgb(1.0f));
  bsdf.metallic = material.metallic;
  bsdf.roughness = material.roughness;
  if (material.metallicRoughnessTexture) {
    const glm::vec4 texel = look(material.metallicRoughnessTexture);
    bsdf.roughness *= texel.g;
    bsdf.metallic *= texel.b;
  }
  bsdf.ior = material.ior;
  bsdf.specular = material.specular;
  if (material.specularTexture) bsdf.specular *= look(material.specularTexture).a;
  bsdf.specularColor = material.specularColor;
  if (material.specularColorTexture) bsdf.specularColor *= Rgb(look(material.specularColorTexture));
  bsdf.transmission = material.transmission;
  if (material.transmissionTexture) bsdf.transmission *= look(material.transmissionTexture).r;
  bsdf.thinWalled = material.thickness <= 0.0f;
  bsdf.clearcoat = material.clearcoat;
  if (material.clearcoatTexture) bsdf.clearcoat *= look(material.clearcoatTexture).r;
  bsdf.clearcoatRoughness = material.clearcoatRoughness;
  if (material.clearcoatRoughnessTexture)
    bsdf.clearcoatRoughness *= look(material.clearcoatRoughnessTexture).g;
  return bsdf;
}

glm::vec2 texCoordOf(const Mesh& mesh, const Texture& texture, const glm::uvec3& t, glm::vec2 barycentric) {
  const std::vector<glm::vec2>& coordinates = mesh.texCoords[texture.texCoord == 1 ? 1 : 0];
  if (coordinates.empty()) return {0.0f, 0.0f};
  return coordinates[t.x] * (1.0f - barycentric.x - barycentric.y) + coordinates[t.y] * barycentric.x +
         coordinates[t.z] * barycentric.y;
}

}  // namespace

Rgb volumeTransmittance(const Material& material, float distance) {
  if (!std::isfinite(material.attenuationDistanceMetres) || material.attenuationDistanceMetres <= 0.0f)
    return Rgb(1.0f);
  return glm::pow(glm::max(material.attenuationColor, Rgb(1e-6f)),
                  Rgb(distance / material.attenuationDistanceMetres));
}

NormalChange Surfaces::normalChange(const SurfacePoint& point) const {
  if (!(point.normalLength > 0.0f && std::isfinite(point.normalLength))) return {};
  const Placement& p = placements_[point.instance];
  const Mesh& mesh = scene_.meshes[p.mesh];
  const glm::uvec3 t = mesh.triangles[point.triangle];
  const glm::mat3 unitFromObject = p.worldNormalFromObject / point.normalLength;
  return {unitFromObject * (mesh.normals[t.y] - mesh.normals[t.x]),
          unitFromObject * (mesh.normals[t.z] - mesh.normals[t.x])};
}

SurfaceLook Surfaces::lookAt(const SurfacePoint& point, const glm::vec3& direction,
                             const Footprint& footprint) const {
  const Material& material = scene_.materials[static_cast<std::size_t>(point.material)];
  const FootprintAlongEdges axes = alongEdges(point, footprint);
  const TextureFootprints footprints(point, axes, footprint.detail);
  const auto look = [&](const std::optional<Texture>& texture) {
    return textures_->at(*texture, point, footprints);
  };

  SurfaceLook result;
  glm::vec4 base = material.baseColor * point.color;
  if (material.baseColorTexture) base *= look(material.baseColorTexture);
  if (material.alphaMode == AlphaMode::kBlend) result.alpha = std::clamp(base.a, 0.0f, 1.0f);
  if (material.unlit) {
    result.unlit = true;
    result.emission = Rgb(base);
    result.normal = point.frontFace ? point.normal : -point.normal;
    return result;
  }

  result.bsdf = parametersOf(material, base, look);
  result.bsdf.insideMaterial = !result.bsdf.thinWalled && !point.frontFace;

  // A single-sided surface shines from its front only.
  if (material.emission != Rgb(0.0f) && (point.frontFace || material.doubleSided)) {
    result.emission = material.emission;
    if (material.emissionTexture) result.emission *= Rgb(look(material.emissionTexture));
  }

  const float side = point.frontFace ? 1.0f : -1.0f;
  const bool isExact = footprint.detail == Detail::kFull;
  const float turning = isExact ? normalVariance(point.normal, normalChange(point), axes) : 0.0f;
  struct Facing {
    glm::vec3 normal;
    float variance;
  };
  const auto facing = [&](const std::optional<Texture>& map, float scale) -> Facing {
    glm::vec3 normal = point.normal;
    float variance = turning;
    if (map && point.tangent.w != 0.0f && isExact) {
      const glm::vec4 texel = look(map);
      normal = mappedNormal(point, glm::vec3(texel), scale);
      variance += scale * scale * texel.a;
    }
    return {reflectingAbove(side * normal, side * point.geometricNormal, -direction), variance};
  };
  const Facing outer = facing(material.normalTexture, material.normalScale);
  result.normal = outer.normal;
  Facing coat = outer;
  if (result.bsdf.clearcoat > 0.0f && (material.normalTexture || material.clearcoatNormalTexture)) {
    coat = facing(material.clearcoatNormalTexture, material.clearcoatNormalScale);
    result.bsdf.clearcoatNormal = Basis(result.normal).toLocal(coat.normal);
  }
  broaden(result.bsdf, outer.variance, coat.variance);
  return result;
}

float Surfaces::alphaAt(const Mesh& mesh, const Material& material, std::uint32_t triangle,
                        glm::vec2 barycentric) const {
  const glm::uvec3 t = mesh.triangles[triangle];
  float alpha = material.baseColor.a;
  if (material.baseColorTexture) {
    const Texture& texture = *material.baseColorTexture;
    alpha *= textures_->alpha(texture, texCoordOf(mesh, texture, t, barycentric));
  }
  if (!mesh.colors.empty()) {
    alpha *= mesh.colors[t.x].a * (1.0f - barycentric.x - barycentric.y) +
             mesh.colors[t.y].a * barycentric.x + mesh.colors[t.z].a * barycentric.y;
  }
  return alpha;
}

Rgb Surfaces::emissionAt(std::uint32_t instance, std::uint32_t triangle, glm::vec2 barycentric) const {
  const Mesh& mesh = scene_.meshes[placements_[instance].mesh];
  const Material& material = scene_.materials[static_cast<std::size_t>(mesh.material)];
  Rgb emission = material.emission;
  if (material.emissionTexture) {
    const Texture& texture = *material.emissionTexture;
    emission *=
        Rgb(textures_->finest(texture, texCoordOf(mesh, texture, mesh.triangles[triangle], barycentric)));
  }
  if (material.alphaMode == AlphaMode::kOpaque) return emission;
  const float alpha = alphaAt(mesh, material, triangle, barycentric);
  if (material.alphaMode == AlphaMode::kMask) return alpha >= material.alphaCutoff ? emission : Rgb(0.0f);
  return alpha >= kLeastAlpha ? emission * std::min(alpha, 1.0f) : Rgb(0.0f);
}

float Surfaces::meanEmission(std::uint32_t instance, std::uint32_t triangle) const {
  const Mesh& mesh = scene_.meshes[placements_[instance].mesh];
  const Material& material = scene_.materials[static_cast<std::size_t>(mesh.material)];
  Rgb emission = material.emission;
  if (material.emissionTexture) {
    // Four parts of the triangle, each looked up as wide as it is.
    const Texture& texture = *material.emissionTexture;
    const glm::uvec3 t = mesh.triangles[triangle];
    const glm::vec2 a = texCoordOf(mesh, texture, t, {0.0f, 0.0f});
    const glm::vec2 b = texCoordOf(mesh, texture, t, {1.0f, 0.0f});
    const glm::vec2 c = texCoordOf(mesh, texture, t, {0.0f, 1.0f});
    const float width = 0.5f * std::max({glm::length(b - a), glm::length(c - a), glm::length(c - b)});
    glm::vec4 sum(0.0f);
    for (const glm::vec2 at : {(a + b + c) / 3.0f, (4.0f * a + b + c) / 6.0f, (a + 4.0f * b + c) / 6.0f,
                               (a + b + 4.0f * c) / 6.0f}) {
      sum += textures_->mean(texture, at, width);
    }
    emission *= Rgb(sum) / 4.0f;
  }
  return 0.2126f * emission.x + 0.7152f * emission.y + 0.0722f * emission.z;
}

bool Surfaces::isPresent(std::uint32_t meshIndex, std::uint32_t triangle, glm::vec2 barycentric) const {
  const Mesh& mesh = scene_.meshes[meshIndex];
  const Material& material = scene_.materials[static_cast<std::size_t>(mesh.material)];
  const float alpha = alphaAt(mesh, material, triangle, barycentric);
  return alpha >= (material.alphaMode == AlphaMode::kMask ? material.alphaCutoff : kLeastAlpha);
}

Rgb Surfaces::shadowTransmittance(std::uint32_t meshIndex, std::uint32_t triangle, glm::vec2 barycentric,
                                  const glm::vec3& normal, const glm::vec3& direction) const {
  const Mesh& mesh = scene_.meshes[meshIndex];
  const Material& material = scene_.materials[static_cast<std::size_t>(mesh.material)];
  float alpha = 1.0f;
  if (material.alphaMode != AlphaMode::kOpaque) {
    alpha = std::clamp(alphaAt(mesh, material, triangle, barycentric), 0.0f, 1.0f);
    if (material.alphaMode == AlphaMode::kMask) alpha = alpha >= material.alphaCutoff ? 1.0f : 0.0f;
  }
  const bool solid = material.thickness > 0.0f;
  if (alpha <= 0.0f || material.unlit || material.transmission <= 0.0f ||
      (solid && shadowsThrough_ == ShadowsThrough::kPanes)) {
    return Rgb(1.0f - alpha);
  }
  const glm::uvec3 t = mesh.triangles[triangle];
  const auto look = [&](const std::optional<Texture>& texture) {
    return textures_->finest(*texture, texCoordOf(mesh, *texture, t, barycentric));
  };
  glm::vec4 base = material.baseColor;
  if (!mesh.colors.empty()) {
    base *= mesh.colors[t.x] * (1.0f - barycentric.x - barycentric.y) + mesh.colors[t.y] * barycentric.x +
            mesh.colors[t.z] * barycentric.y;
  }
  if (material.baseColorTexture) base *= look(material.baseColorTexture);
  BsdfParameters bsdf = parametersOf(material, base, look);
  bsdf.thinWalled = true;
  const float scale = std::sqrt(glm::dot(normal, normal) * glm::dot(direction, direction));
  const float cosine = scale > 0.0f ? std::abs(glm::dot(normal, direction)) / scale : 1.0f;
  Rgb through = straightTransmittance(bsdf, cosine);
  if (solid) through *= volumeTransmittance(material, 0.5f * material.thickness);
  return Rgb(1.0f - alpha) + alpha * through;
}

}  // namespace promenade::render
