#include "src/render/path_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "src/render/ray_offset.h"
#include "src/render/scattering_surface.h"

namespace promenade::render {
namespace {

constexpr int kFirstRoulette = 3;  ///< scatterings before Russian roulette may end a path
constexpr float kLeastSurvival = 0.05f;
constexpr float kHiddenSkyShare = 0.25f;  ///< samples of the sky where the guide has seen none of it
constexpr int kMostPassages = 64;         ///< straight through panes and blended surfaces, along one path
/// Width of the pencil of rays after scattering with density pdf, per unit distance: a fraction of the solid
/// angle 1/pdf that one sample stands for. Only texture filtering depends on it.
constexpr float kSpreadOfScattering = 0.15f;

float largest(const Rgb& c) {
  return std::max(c.x, std::max(c.y, c.z));
}
bool isBlack(const Rgb& c) {
  return c.x <= 0.0f && c.y <= 0.0f && c.z <= 0.0f;
}

/// Power heuristic with exponent 2 (Veach 1997, eq. 9.13) for one sample of each strategy.
float powerHeuristic(float pdf, float otherPdf) {
  const float ratio = otherPdf / pdf;
  return 1.0f / (1.0f + ratio * ratio);
}

/// Duff et al., Building an Orthonormal Basis, Revisited (JCGT 6(1), 2017).
struct Basis {
  glm::vec3 x, y, z;
  explicit Basis(const glm::vec3& normal) : z(normal) {
    const float sign = std::copysign(1.0f, z.z);
    const float a = -1.0f / (sign + z.z);
    const float b = z.x * z.y * a;
    x = {1.0f + sign * z.x * z.x * a, sign * b, -sign * z.x};
    y = {b, sign + z.y * z.y * a, -z.y};
  }
  [[nodiscard]] glm::vec3 toLocal(const glm::vec3& w) const {
    return {glm::dot(w, x), glm::dot(w, y), glm::dot(w, z)};
  }
  [[nodiscard]] glm::vec3 toWorld(const glm::vec3& l) const { return l.x * x + l.y * y + l.z * z; }
};

/// Along the pencil's cross-section, or as if it met the surface at a right angle: enough for light that is
/// blurred anyway.
enum class Filtering { kAlongSurface, kRound };

/// Akenine-Moeller et al., Improved Shader and Texture Level of Detail Using Ray Cones (JCGT 10(1), 2021),
/// sec. 3.
Footprint projectPencil(const glm::vec3& normal, const glm::vec3& direction, float width,
                        Filtering filtering) {
  if (filtering == Filtering::kRound) {
    const Basis basis(normal);
    return {basis.x * width, basis.y * width};
  }
  const float cosine = std::max(std::abs(glm::dot(normal, direction)), 1e-3f);
  const glm::vec3 inPlane = direction - glm::dot(normal, direction) * normal;
  const float length = glm::length(inPlane);
  const glm::vec3 along = length > 1e-4f ? inPlane / length : Basis(normal).x;
  return {along * (width / cosine), glm::cross(normal, along) * width};
}

/// Panes stay clear: light goes straight through them in next event estimation too.
void roughen(BsdfParameters& bsdf, float least) {
  if (bsdf.transmission > 0.0f && bsdf.thinWalled) return;
  bsdf.roughness = std::max(bsdf.roughness, least);
  bsdf.clearcoatRoughness = std::max(bsdf.clearcoatRoughness, least);
}

/// Turns a smooth refracting solid's surface into a pane; false if it is none.
bool makePane(BsdfParameters& bsdf, float cosine) {
  if (bsdf.thinWalled || bsdf.transmission <= 0.0f) return false;
  BsdfParameters pane = bsdf;
  pane.thinWalled = true;
  pane.insideMaterial = false;
  if (straightTransmittance(pane, cosine) == Rgb(0.0f)) return false;
  bsdf = pane;
  return true;
}

Ray shadowRay(const glm::vec3& origin, const LightSample& light) {
  Ray ray;
  ray.origin = origin;
  ray.direction = light.atInfinity ? light.direction : light.target - origin;
  if (!light.atInfinity) ray.farthest = 1.0f - 1e-5f;
  return ray;
}

}  // namespace

struct PathTracer::Vertex {
  glm::vec3 position;
  glm::vec3 facing;  ///< geometric normal on the side the path came from
  Basis basis;       ///< z: the shading normal, on that side
  glm::vec3 wo;      ///< where the path came from, local
  SurfaceLook look;
  std::uint32_t instance;
  int material;
  const SkyGuide::View* sky;  ///< null without environment

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

/// Expected samples of the environment and of the other lights at a vertex.
struct PathTracer::Shares {
  float environment = 0.0f;
  float local = 0.0f;
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

/// Shadow rays of the paths from one primary hit: they share their origin, so they travel in packets.
class PathTracer::ShadowBatch {
 public:
  ShadowBatch(const EmbreeScene& embree, SampleRadiance& sum) : embree_(embree), sum_(sum) {}

  void add(const Ray& ray, const Rgb& diffuse, const Rgb& viewDependent) {
    const auto i = static_cast<std::size_t>(count_++);
    rays_[i] = ray;
    diffuse_[i] = diffuse;
    viewDependent_[i] = viewDependent;
    if (count_ == EmbreeScene::kPacket) flush();
  }
  void flush() {
    if (count_ == 0) return;
    const auto transmittance = embree_.transmittance(rays_, count_);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
      sum_.diffuse += diffuse_[i] * transmittance[i];
      sum_.viewDependent += viewDependent_[i] * transmittance[i];
    }
    count_ = 0;
  }

 private:
  const EmbreeScene& embree_;
  SampleRadiance& sum_;
  int count_ = 0;
  std::array<Ray, EmbreeScene::kPacket> rays_;
  std::array<Rgb, EmbreeScene::kPacket> diffuse_;
  std::array<Rgb, EmbreeScene::kPacket> viewDependent_;
};

PathTracer::PathTracer(const Scene& scene, const PathSettings& settings)
    : settings_(settings),
      surfaces_(scene, settings.solidGlass == SolidGlass::kRefracts
                           ? Surfaces::ShadowsThrough::kPanes
                           : Surfaces::ShadowsThrough::kPanesAndSolids),
      embree_(surfaces_, settings.threads),
      lights_(surfaces_) {
  if (!scene.environment) return;
  environment_.emplace(*scene.environment);
  sky_.emplace(embree_, *environment_);
}

Rgb PathTracer::background(const glm::vec3& unitDirection) const {
  return environment_ ? environment_->radiance(unitDirection) : Rgb(0.0f);
}

PathTracer::Vertex PathTracer::vertexAt(const Hit& hit, const glm::vec3& unitDirection,
                                        const Pencil& pencil) const {
  const SurfacePoint point = surfaces_.pointAt(hit, unitDirection);
  const glm::vec3 facing = point.frontFace ? point.geometricNormal : -point.geometricNormal;
  SurfaceLook look =
      surfaces_.lookAt(point, unitDirection,
                       projectPencil(facing, unitDirection, pencil.width,
                                     pencil.blurred ? Filtering::kRound : Filtering::kAlongSurface));
  const Basis basis(look.normal);
  return {
      point.position, facing,       basis,          basis.toLocal(-unitDirection),
      look,           hit.instance, point.material, sky_ ? &sky_->viewFrom(point.position, facing) : nullptr};
}

/// Both kinds of light, the sky less often where none of it has been seen.
PathTracer::Shares PathTracer::firstShares(const Vertex& vertex) const {
  Shares shares;
  if (vertex.sky != nullptr) shares.environment = vertex.sky->share > 0.0f ? 1.0f : kHiddenSkyShare;
  if (!lights_.empty()) shares.local = 1.0f;
  return shares;
}

/// One kind of light only.
PathTracer::Shares PathTracer::laterShares(const Vertex& vertex) const {
  Shares shares = firstShares(vertex);
  if (shares.environment > 0.0f && shares.local > 0.0f) {
    shares.environment *= 0.5f;
    shares.local = 1.0f - shares.environment;
  }
  return shares;
}

/// Calls add(shadow ray, diffuse, view-dependent) for each light point chosen. Shares that sum to at most 1
/// are the probabilities that one kind of light is asked; otherwise each kind is asked with its own.
template <class Add>
void PathTracer::sampleLights(const Vertex& vertex, const ScatteringSurface& scattering, const Shares& shares,
                              Sampler& sampler, const Add& add) const {
  bool askEnvironment = shares.environment > 0.0f;
  bool askLocal = shares.local > 0.0f;
  if (askEnvironment && shares.environment < 1.0f) {
    const float choose = sampler.next1D();
    askEnvironment = choose < shares.environment;
    if (shares.local < 1.0f) askLocal = askLocal && !askEnvironment;
  }
  const auto weigh = [&](const LightSample& light, float share) {
    const glm::vec3 wi = vertex.basis.toLocal(light.direction);
    if (!vertex.agree(wi, light.direction)) return;
    const BsdfValue f = scattering.evaluate(wi);
    if (isBlack(f.diffuse + f.viewDependent)) return;
    const float pdf = light.pdf * share;
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
        lights_.sample(vertex.position, vertex.facing, choose, sampler.next2D());
    if (light && light->pdf > 0.0f) weigh(*light, shares.local);
  }
}

Rgb PathTracer::follow(Carried path, Sampler& sampler, PathRays& rays) const {
  Rgb sum(0.0f);
  const auto add = [&](Rgb radiance, int bounces) {
    if (bounces > 1) {
      const float most = largest(radiance);
      if (most > settings_.indirectLimit) radiance *= settings_.indirectLimit / most;
    }
    sum += radiance;
  };
  for (int passages = 0; passages < kMostPassages;) {
    Ray ray;
    ray.origin = path.origin;
    ray.direction = path.direction;
    const Hit hit = embree_.intersect(ray);
    ++rays.scattered;
    if (!hit.found()) {
      if (environment_) {
        const float weight = path.scatterDelta
                                 ? 1.0f
                                 : powerHeuristic(path.scatterPdf, sky_->pdf(*path.sky, path.direction) *
                                                                       path.shares.environment);
        add(path.throughput * environment_->radiance(path.direction) * weight, path.bounces);
      }
      break;
    }
    if (path.medium >= 0) {
      path.throughput *= volumeTransmittance(
          surfaces_.scene().materials[static_cast<std::size_t>(path.medium)], hit.distance);
    }
    path.width += path.spread * hit.distance;
    Vertex vertex = vertexAt(hit, path.direction, {path.width, path.blurred});
    const bool solidAsPane = path.blurred && settings_.solidGlass == SolidGlass::kStraightAfterScattering &&
                             makePane(vertex.look.bsdf, vertex.wo.z);
    if (path.blurred) roughen(vertex.look.bsdf, settings_.leastIndirectRoughness);
    if (vertex.look.alpha < 1.0f && sampler.next1D() >= vertex.look.alpha) {
      path.origin = offsetRayOrigin(vertex.position, -vertex.facing);
      ++passages;
      continue;
    }
    if (!isBlack(vertex.look.emission)) {
      float weight = 1.0f;
      if (!path.scatterDelta && !vertex.look.unlit) {
        const float distance = glm::length(vertex.position - path.scatterPosition);
        const Lights::Found found{hit.instance, hit.triangle, path.direction, distance};
        const float lightPdf =
            lights_.pdf(found, path.scatterPosition, path.scatterNormal) * path.shares.local;
        weight = powerHeuristic(path.scatterPdf, lightPdf);
      }
      add(path.throughput * vertex.look.emission * weight, path.bounces);
    }
    if (vertex.look.unlit || !(vertex.wo.z > 0.0f)) break;

    const ScatteringSurface scattering(vertex.look.bsdf, vertex.wo);
    const auto passStraight = [&](const Rgb& through) {
      path.throughput *= through;
      if (solidAsPane) {
        const Material& material = surfaces_.scene().materials[static_cast<std::size_t>(vertex.material)];
        path.throughput *= volumeTransmittance(material, 0.5f * material.thickness);
        path.medium = -1;
      }
      path.origin = offsetRayOrigin(vertex.position, -vertex.facing);
      ++passages;
    };
    if (path.bounces >= settings_.maxBounces) {
      // No more scattering, but a pane does not scatter: next event estimation saw through it too.
      const Rgb through = vertex.look.bsdf.thinWalled ? scattering.straightTransmittance() : Rgb(0.0f);
      if (isBlack(through)) break;
      passStraight(through);
      continue;
    }
    const Shares shares = laterShares(vertex);
    sampleLights(vertex, scattering, shares, sampler,
                 [&](const Ray& shadow, const Rgb& diffuse, const Rgb& viewDependent) {
                   ++rays.shadow;
                   add(path.throughput * (diffuse + viewDependent) * embree_.transmittance(shadow),
                       path.bounces + 1);
                 });

    const float choose = sampler.next1D();
    const BsdfSample s = scattering.sample(choose, sampler.next2D());
    const Rgb scattered = s.diffuse + s.viewDependent;
    if (!(s.pdf > 0.0f) || isBlack(scattered)) break;
    if (vertex.isStraightThrough(s)) {
      passStraight(scattered);
      continue;
    }
    const glm::vec3 direction = glm::normalize(vertex.basis.toWorld(s.wi));
    if (!vertex.agree(s.wi, direction)) break;
    path.throughput *= scattered;
    ++path.bounces;
    if (path.bounces >= kFirstRoulette) {
      const float survival = std::clamp(largest(path.throughput) * path.importance, kLeastSurvival, 1.0f);
      if (sampler.next1D() >= survival) break;
      path.throughput /= survival;
    }
    if (s.wi.z < 0.0f && !vertex.look.bsdf.thinWalled) {
      path.medium = vertex.look.bsdf.insideMaterial ? -1 : vertex.material;
    }
    path.origin = vertex.originToward(direction);
    path.direction = direction;
    path.scatterPosition = vertex.position;
    path.scatterNormal = vertex.facing;
    path.scatterPdf = s.pdf;
    path.scatterDelta = s.delta;
    path.shares = shares;
    path.sky = vertex.sky;
    path.blurred = path.blurred || !s.delta;
    if (!s.delta) path.spread = std::max(path.spread, kSpreadOfScattering / std::sqrt(s.pdf));
  }
  return sum;
}

SampleRadiance PathTracer::shade(const Hit& hit, const Ray& primary, float pixelWidth,
                                 const Sampler::Stream& stream, PathRays& rays) const {
  const float length = glm::length(primary.direction);
  const glm::vec3 direction = primary.direction / length;
  const float width = pixelWidth * hit.distance;
  const Vertex vertex = vertexAt(hit, direction, {width, false});
  const SurfaceLook& look = vertex.look;

  SampleRadiance sum;
  if (look.unlit && look.alpha >= 1.0f) return {look.emission, Rgb(0.0f)};

  const int count = settings_.pathsPerSample;
  const bool scatters = !look.unlit && settings_.maxBounces >= 1 && vertex.wo.z > 0.0f;
  const ScatteringSurface scattering(look.bsdf, scatters ? vertex.wo : glm::vec3(0.0f, 0.0f, 1.0f));
  const Shares shares = firstShares(vertex);
  ShadowBatch shadows(embree_, sum);
  for (int i = 0; i < count; ++i) {
    Sampler sampler(stream, static_cast<std::uint32_t>(i));
    Carried next;
    next.width = width;
    next.spread = pixelWidth / length;
    if (look.alpha < 1.0f && sampler.next1D() >= look.alpha) {
      next.origin = offsetRayOrigin(vertex.position, -vertex.facing);
      next.direction = direction;
      sum.viewDependent += follow(next, sampler, rays);
      continue;
    }
    sum.diffuse += look.emission;
    if (!scatters) continue;

    sampleLights(vertex, scattering, shares, sampler,
                 [&](const Ray& shadow, const Rgb& diffuse, const Rgb& viewDependent) {
                   ++rays.shadow;
                   shadows.add(shadow, diffuse, viewDependent);
                 });

    const float choose = sampler.next1D();
    const BsdfSample s = scattering.sample(choose, sampler.next2D());
    const Rgb scattered = s.diffuse + s.viewDependent;
    if (!(s.pdf > 0.0f) || isBlack(scattered)) continue;
    if (vertex.isStraightThrough(s)) {
      next.origin = offsetRayOrigin(vertex.position, -vertex.facing);
      next.direction = direction;
    } else {
      const glm::vec3 world = glm::normalize(vertex.basis.toWorld(s.wi));
      if (!vertex.agree(s.wi, world)) continue;
      next.origin = vertex.originToward(world);
      next.direction = world;
      next.scatterPosition = vertex.position;
      next.scatterNormal = vertex.facing;
      next.scatterPdf = s.pdf;
      next.scatterDelta = s.delta;
      next.shares = shares;
      next.sky = vertex.sky;
      next.bounces = 1;
      if (s.wi.z < 0.0f && !look.bsdf.thinWalled)
        next.medium = look.bsdf.insideMaterial ? -1 : vertex.material;
      next.blurred = !s.delta;
      if (!s.delta) next.spread = std::max(next.spread, kSpreadOfScattering / std::sqrt(s.pdf));
    }
    next.importance = largest(scattered);
    const Rgb arriving = follow(next, sampler, rays);
    sum.diffuse += s.diffuse * arriving;
    sum.viewDependent += s.viewDependent * arriving;
  }
  shadows.flush();
  const float each = 1.0f / static_cast<float>(count);
  return {sum.diffuse * each, sum.viewDependent * each};
}

}  // namespace promenade::render
