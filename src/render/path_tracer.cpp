#include "src/render/path_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "src/render/path_tracer_internal.h"

namespace promenade::render {
namespace {

constexpr int kFirstRoulette = 3;  ///< scatterings before Russian roulette may end a path
constexpr float kLeastSurvival = 0.05f;
constexpr float kHiddenSkyShare = 0.25f;  ///< samples of the sky where the guide has seen none of it

/// Along the pencil's cross-section, or as if it met the surface at a right angle: enough for light that is
/// blurred anyway.
enum class Filtering { kAlongSurface, kRound };

/// Akenine-Moeller et al., Improved Shader and Texture Level of Detail Using Ray Cones (JCGT 10(1), 2021),
/// sec. 3.
Footprint projectPencil(const glm::vec3& normal, const glm::vec3& direction, float width,
                        Filtering filtering) {
  if (filtering == Filtering::kRound) {
    const Basis basis(normal);
    return {basis.x * width, basis.y * width, Detail::kBlurred};
  }
  const float cosine = std::max(std::abs(glm::dot(normal, direction)), 1e-3f);
  const glm::vec3 inPlane = direction - glm::dot(normal, direction) * normal;
  const float length = glm::length(inPlane);
  const glm::vec3 along = length > 1e-4f ? inPlane / length : Basis(normal).x;
  return {along * (width / cosine), glm::cross(normal, along) * width, Detail::kFull};
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

}  // namespace

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
  return {point.position, facing,       basis,          basis.toLocal(-unitDirection),
          look,           hit.instance, point.material, nullptr};
}

void PathTracer::lookAtSky(Vertex& vertex) const {
  if (sky_) vertex.sky = &sky_->viewFrom(vertex.position, vertex.facing);
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
  if (bright_ && settings_.solution) shares.bright = 1.0f;
  return shares;
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
        Rgb arriving;
        if (path.scatterDelta) {
          arriving = environment_->radiance(path.direction);
        } else {
          const EnvironmentSample s = sky_->toward(*path.sky, path.direction);
          arriving = s.radiance * powerHeuristic(path.scatterPdf, s.pdf * path.shares.environment);
        }
        add(path.throughput * arriving, path.bounces);
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

    ScatteringSurface scattering(vertex.look.bsdf, vertex.wo);
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
    const std::optional<SurfaceLight> known = lightFromSolution(
        vertex,
        path.blurred ? std::optional(glm::length(vertex.position - path.scatterPosition)) : std::nullopt);
    if (known) {
      const SentBack sent = sentBack(vertex, scattering, *known, path.blurred, rays);
      float weight = 1.0f;
      if (path.shares.bright > 0.0f && !path.scatterDelta) {
        const float distance = glm::length(vertex.position - path.scatterPosition);
        weight = powerHeuristic(path.scatterPdf,
                                path.shares.bright * bright_->pdf(hit, path.direction, distance,
                                                                  path.scatterPosition, path.scatterNormal));
      }
      add(path.throughput * sent.radiance * weight, path.bounces + 1);
      if (sent.isAll) break;
      dropDiffuse(vertex.look.bsdf);
      scattering = ScatteringSurface(vertex.look.bsdf, vertex.wo);
    }
    lookAtSky(vertex);
    const Shares shares = laterShares(vertex);
    sampleLights(vertex, scattering, shares, 1.0f, sampler,
                 known ? DeltaLights::kExcluded : DeltaLights::kIncluded,
                 [&](const Ray& shadow, const Rgb& diffuse, const Rgb& viewDependent) {
                   ++rays.shadow;
                   const Rgb arriving = known ? viewDependent : diffuse + viewDependent;
                   add(path.throughput * arriving * embree_.transmittance(shadow), path.bounces + 1);
                 });
    const float brightShare = path.bounces + 1 < settings_.maxBounces ? shares.bright : 0.0f;
    if (const auto bright = chooseBright(vertex, scattering, brightShare, sampler)) {
      ++rays.shadow;
      const Rgb transmittance = embree_.transmittance(bright->shadow);
      if (!isBlack(transmittance)) {
        const Rgb arriving = known ? bright->viewDependent : bright->diffuse + bright->viewDependent;
        add(path.throughput * arriving * sentBy(*bright, rays) * transmittance, path.bounces + 2);
      }
    }

    const float choose = sampler.next1D();
    const BsdfSample s = scattering.sample(choose, sampler.next2D());
    const Rgb scattered = known ? s.viewDependent : s.diffuse + s.viewDependent;
    if (!(s.pdf > 0.0f) || isBlack(scattered)) break;
    if (vertex.isStraightThrough(s)) {
      passStraight(scattered);
      continue;
    }
    const glm::vec3 direction = glm::normalize(vertex.basis.toWorld(s.wi));
    if (!vertex.agree(s.wi, direction)) break;
    path.throughput *= scattered;
    if (path.bounces + 1 >= kFirstRoulette) {
      const float survival = std::clamp(largest(path.throughput) * path.importance, kLeastSurvival, 1.0f);
      if (sampler.next1D() >= survival) break;
      path.throughput /= survival;
    }
    scatter(vertex, s, direction, shares, path);
  }
  return sum;
}

void PathTracer::scatter(const Vertex& vertex, const BsdfSample& sample, const glm::vec3& direction,
                         const Shares& shares, Carried& path) const {
  if (sample.wi.z < 0.0f && !vertex.look.bsdf.thinWalled) {
    path.medium = vertex.look.bsdf.insideMaterial ? -1 : vertex.material;
  }
  ++path.bounces;
  path.origin = vertex.originToward(direction);
  path.direction = direction;
  path.scatterPosition = vertex.position;
  path.scatterNormal = vertex.facing;
  path.scatterPdf = sample.pdf;
  path.scatterDelta = sample.delta;
  path.shares = shares;
  path.sky = vertex.sky;
  path.blurred = path.blurred || !sample.delta;
  if (!sample.delta) path.spread = std::max(path.spread, spreadOfScattering(sample.pdf));
}

std::optional<PathTracer::Carried> PathTracer::leave(const Sight& sight, const Vertex& vertex,
                                                     const BsdfSample& sample, const Shares& shares) const {
  const glm::vec3 world = glm::normalize(vertex.basis.toWorld(sample.wi));
  if (!vertex.agree(sample.wi, world)) return std::nullopt;
  Carried path = sight.path;
  path.throughput = Rgb(1.0f);
  path.importance = sight.weight() * largest(sample.diffuse + sample.viewDependent);
  scatter(vertex, sample, world, shares, path);
  return path;
}

SampleRadiance PathTracer::shadeByPaths(const Sight& sight, Vertex vertex,
                                        const ScatteringSurface& scattering, const Sampler::Stream& stream,
                                        PathRays& rays) const {
  const int count =
      std::max(1, static_cast<int>(std::ceil(static_cast<float>(stream.pathsPerPixel) * sight.weight())));
  rays.paths += static_cast<std::uint64_t>(count);
  ++rays.noisyLines;
  const Sampler::Stream numbers = sight.numbersOf(stream);
  const Shares shares = firstShares(vertex);
  LightTree::View lights = lights_.viewFrom(vertex.position, vertex.facing);
  vertex.lights = &lights;
  SampleRadiance sum;
  auto shadows =
      shadowBatch<SampleRadiance>(embree_, [&sum](const SampleRadiance& light, const Rgb& transmittance) {
        sum.diffuse += light.diffuse * transmittance;
        sum.viewDependent += light.viewDependent * transmittance;
      });
  for (int i = 0; i < count; ++i) {
    Sampler sampler(numbers, static_cast<std::uint32_t>(i));
    sampleLights(vertex, scattering, shares, 1.0f, sampler, DeltaLights::kIncluded,
                 [&](const Ray& shadow, const Rgb& diffuse, const Rgb& viewDependent) {
                   ++rays.shadow;
                   shadows.add(shadow, {diffuse, viewDependent});
                 });

    const float choose = sampler.next1D();
    const BsdfSample s = scattering.sample(choose, sampler.next2D());
    if (!(s.pdf > 0.0f) || isBlack(s.diffuse + s.viewDependent)) continue;
    const std::optional<Carried> next = leave(sight, vertex, s, shares);
    if (!next) continue;
    const Rgb arriving = follow(*next, sampler, rays);
    sum.diffuse += s.diffuse * arriving;
    sum.viewDependent += s.viewDependent * arriving;
  }
  shadows.flush();
  const float each = 1.0f / static_cast<float>(count);
  return {sum.diffuse * each, sum.viewDependent * each};
}

}  // namespace promenade::render
