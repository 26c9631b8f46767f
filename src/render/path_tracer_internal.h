#pragma once
// What the parts of PathTracer share: path_tracer.cpp (paths), gathering.cpp (the light of records) and
// path_solution.cpp (what uses that light).

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "src/render/basis.h"
#include "src/render/path_tracer.h"
#include "src/render/ray_offset.h"
#include "src/render/scattering_surface.h"
#include "src/render/shadow_batch.h"

namespace promenade::render {

inline float largest(const Rgb& c) {
  return std::max(c.x, std::max(c.y, c.z));
}
inline bool isBlack(const Rgb& c) {
  return c.x <= 0.0f && c.y <= 0.0f && c.z <= 0.0f;
}

/// Power heuristic with exponent 2 (Veach 1997, eq. 9.13) for one sample of each strategy.
inline float powerHeuristic(float pdf, float otherPdf) {
  const float ratio = otherPdf / pdf;
  return 1.0f / (1.0f + ratio * ratio);
}

/// From this roughness on a reflection met on the way is as good as matt: the solution says what it shows.
constexpr float kBroadRoughness = 0.5f;
/// ... after a scattering that has blurred it already: what a glossy floor casts on a wall would be found by
/// chance only, and is nearly the same when it leaves the floor in all directions.
constexpr float kBroadToTheBlurred = 0.2f;

/// From this roughness on the reflection seen directly is taken from the solution too: its lobe is as wide as
/// the solution's directions are apart, and hundreds of paths would not be as clean.
constexpr float kBroadToTheEye = 0.3f;

/// Surfaces with less diffuse albedo than this have no records, unless their reflection is broad.
constexpr float kLeastDiffuse = 0.01f;

/// Whether all that the material sends back is as broad as a lobe of that roughness.
inline bool isOpaqueBeyond(const BsdfParameters& bsdf, float roughness) {
  return bsdf.roughness >= roughness && bsdf.transmission <= 0.0f && bsdf.clearcoat <= 0.0f;
}

inline bool isBroadToTheEye(const BsdfParameters& bsdf) {
  return isOpaqueBeyond(bsdf, kBroadToTheEye);
}

/// Panes stay clear: light goes straight through them in next event estimation too.
inline void roughen(BsdfParameters& bsdf, float least) {
  if (bsdf.transmission > 0.0f && bsdf.thinWalled) return;
  bsdf.roughness = std::max(bsdf.roughness, least);
  bsdf.clearcoatRoughness = std::max(bsdf.clearcoatRoughness, least);
}

/// Width of the pencil of rays after scattering with density `pdf`, per unit distance: a fraction of the
/// solid angle 1/pdf that one sample stands for. Only texture filtering depends on it.
inline float spreadOfScattering(float pdf) {
  return 0.15f / std::sqrt(pdf);
}

/// Takes the diffuse part away where that leaves the rest as it was, so that no samples are spent on it.
inline void dropDiffuse(BsdfParameters& bsdf) {
  if (bsdf.metallic <= 0.0f && bsdf.transmission <= 0.0f) bsdf.baseColor = Rgb(0.0f);
}

inline Ray shadowRay(const glm::vec3& origin, const LightSample& light) {
  Ray ray;
  ray.origin = origin;
  ray.direction = light.atInfinity ? light.direction : light.target - origin;
  if (!light.atInfinity) ray.farthest = 1.0f - 1e-5f;
  return ray;
}

struct PathTracer::Vertex {
  glm::vec3 position;
  glm::vec3 facing;  ///< geometric normal on the side the path came from
  Basis basis;       ///< z: the shading normal, on that side
  glm::vec3 wo;      ///< where the path came from, local
  SurfaceLook look;
  std::uint32_t instance;
  int material;
  const SkyGuide::View* sky;          ///< null without environment, and until it is looked at
  LightTree::View* lights = nullptr;  ///< of whoever samples them from here often; else null

  [[nodiscard]] glm::vec3 originToward(const glm::vec3& worldDirection) const {
    return offsetRayOrigin(position, glm::dot(worldDirection, facing) > 0.0f ? facing : -facing);
  }
  /// Shading and geometric normal must agree on whether light is reflected or transmitted, or light leaks.
  [[nodiscard]] bool agree(const glm::vec3& local, const glm::vec3& world) const {
    return local.z * glm::dot(world, facing) > 0.0f;
  }
  /// The only lobe that leaves light its direction.
  [[nodiscard]] bool isStraightThrough(const BsdfSample& s) const {
    return s.delta && look.bsdf.thinWalled && s.wi.z < 0.0f;
  }
};

/// Expected samples of the environment, of the other lights, and of bright surfaces at a vertex.
struct PathTracer::Shares {
  float environment = 0.0f;
  float local = 0.0f;
  float bright = 0.0f;
};

/// A point on a bright surface, not yet known to be seen.
struct PathTracer::TowardBright {
  BrightSurfaces::Chosen chosen;
  Ray shadow;
  Rgb diffuse{0.0f}, viewDependent{0.0f};  ///< what reaches the vertex is scattered with, over the density
  float spread = 0.0f;                     ///< of the pencil of rays that the point stands for
};

/// A path between two vertices.
struct PathTracer::Carried {
  glm::vec3 origin;
  glm::vec3 direction;  ///< unit
  Rgb throughput{1.0f};
  float importance = 1.0f;  ///< of the whole path before, for Russian roulette
  // The last vertex that changed the direction, for multiple importance sampling: passing straight through a
  // pane changes neither the density of the direction nor the light that next event estimation at that vertex
  // could have chosen.
  glm::vec3 scatterPosition{0.0f}, scatterNormal{0.0f};
  float scatterPdf = 0.0f;
  bool scatterDelta = true;
  Shares shares;
  const SkyGuide::View* sky = nullptr;
  float width = 0.0f;  ///< of the pencil of rays at the origin
  float spread = 0.0f;
  int medium = -1;  ///< material of the solid that the path is in
  int bounces = 0;
  bool blurred = false;  ///< some scattering was not a mirror's
};

/// A line of sight: from the eye straight on, through panes and blended surfaces, by way of mirrors and
/// smooth boundaries.
struct PathTracer::Sight {
  Carried path;  ///< throughput: what the eye gets of the light that arrives along it
  /// Which way it took at each surface: a number for each line of a sample.
  std::uint32_t turns = 0;
  int passages = 0;  ///< straight through surfaces
  Effort effort = Effort::kExactly;
  Pilots* pilots = nullptr;
  float besides = 0.0f;  ///< luminance that the eye is known to get otherwise

  [[nodiscard]] float weight() const { return largest(path.throughput); }
  /// Random numbers of its own, from those of the sample.
  [[nodiscard]] Sampler::Stream numbersOf(Sampler::Stream stream) const {
    stream.seed ^= turns * 0x9e3779b9u;
    return stream;
  }
};

/// The same four sets of random numbers for all samples of all frames; neighbours take turns with them, so
/// that their errors average out in a pixel. An error of a faint part is then a smooth function of place and
/// direction, the same in every frame, instead of grain that differs between keyframes.
inline Sampler::Stream sharedNumbers(Sampler::Stream stream) {
  stream.pixel = stream.pixel & 1u;
  stream.frame = 0;
  return stream;
}

/// Straight through panes and blended surfaces, along one path.
constexpr int kMostPassages = 64;

/// Calls add(shadow ray, diffuse, view-dependent) for each light point chosen. Shares that sum to at most 1
/// are the probabilities that one kind of light is asked; otherwise each kind is asked with its own. `times`:
/// how often this is called for each time that the surface is sampled.
template <class Scattering, class Add>
void PathTracer::sampleLights(const Vertex& vertex, const Scattering& scattering, const Shares& shares,
                              float times, Sampler& sampler, DeltaLights deltaLights, const Add& add) const {
  bool askEnvironment = shares.environment > 0.0f;
  bool askLocal = shares.local > 0.0f;
  if (askEnvironment && shares.environment < 1.0f) {
    const float choose = sampler.next1D();
    askEnvironment = choose < shares.environment;
    if (shares.local < 1.0f) askLocal = askLocal && !askEnvironment;
  }
  const auto weigh = [&](const LightSample& light, float share) {
    if (light.delta && deltaLights == DeltaLights::kExcluded) return;
    const glm::vec3 wi = vertex.basis.toLocal(light.direction);
    if (!vertex.agree(wi, light.direction)) return;
    const BsdfValue f = scattering.evaluate(wi);
    if (isBlack(f.diffuse + f.viewDependent)) return;
    const float pdf = light.pdf * share * times;
    const float weight = (light.delta ? 1.0f : powerHeuristic(pdf, f.pdf)) / pdf;
    const Rgb arriving = light.radiance * weight;
    add(shadowRay(vertex.originToward(light.direction), light), f.diffuse * arriving,
        f.viewDependent * arriving);
  };
  if (askEnvironment) {
    const float choose = sampler.next1D();
    const EnvironmentSample s = sky_->sample(*vertex.sky, choose, sampler.next2D());
    if (s.pdf > 0.0f && !isBlack(s.radiance)) {
      LightSample light;
      light.direction = s.direction;
      light.atInfinity = true;
      light.radiance = s.radiance;
      light.pdf = s.pdf;
      weigh(light, shares.environment);
    }
  }
  if (askLocal) {
    const float choose = sampler.next1D();
    const std::optional<LightSample> light =
        vertex.lights != nullptr ? lights_.sample(*vertex.lights, choose, sampler.next2D())
                                 : lights_.sample(vertex.position, vertex.facing, choose, sampler.next2D());
    if (light && light->pdf > 0.0f) weigh(*light, shares.local);
  }
}

template <class Scattering>
std::optional<PathTracer::TowardBright> PathTracer::chooseBright(const Vertex& vertex,
                                                                 const Scattering& scattering, float share,
                                                                 Sampler& sampler) const {
  if (!(share > 0.0f)) return std::nullopt;
  const float choose = sampler.next1D();
  const glm::vec2 u = sampler.next2D();
  const std::optional<BrightSurfaces::Chosen> chosen =
      bright_->sample(vertex.position, vertex.facing, choose, u);
  if (!chosen) return std::nullopt;
  const glm::vec3 wi = vertex.basis.toLocal(chosen->direction);
  if (!vertex.agree(wi, chosen->direction)) return std::nullopt;
  const BsdfValue f = scattering.evaluate(wi);
  if (isBlack(f.diffuse + f.viewDependent)) return std::nullopt;
  const float pdf = chosen->pdf * share;
  const float weight = powerHeuristic(pdf, f.pdf) / pdf;
  TowardBright toward{*chosen, {}, weight * f.diffuse, weight * f.viewDependent, spreadOfScattering(f.pdf)};
  toward.shadow.origin = vertex.originToward(chosen->direction);
  toward.shadow.direction = chosen->target - toward.shadow.origin;
  toward.shadow.farthest = 1.0f - 1e-5f;
  return toward;
}

}  // namespace promenade::render
