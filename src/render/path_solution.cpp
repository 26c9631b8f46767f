// The part of PathTracer that makes and uses a view-independent solution of the light on matt surfaces.

#include "src/render/path_tracer_internal.h"

#include "src/core/display.h"
#include "src/render/irradiance_solution.h"

namespace promenade::render {
namespace {

/// Less than this of white light in the view-dependent part is not worth a ray.
constexpr float kLeastViewDependent = 0.002f;
/// Up to this share of white light every sample uses the same random numbers: the error of a faint reflection
/// is then a smooth function of place and direction, the same in every frame, instead of grain that differs
/// between keyframes. (A stronger reflection would show the few directions as ghosts.)
constexpr float kFaint = 0.25f;
/// From this roughness on the reflection seen directly is taken from the solution too: its lobe is nearly as
/// wide as the hemisphere, and a few paths would only add noise to it.
constexpr float kBroadToTheEye = 0.8f;

}  // namespace

SurfaceLight PathTracer::gather(const glm::vec3& position, const glm::vec3& normal,
                                const Sampler::Stream& stream, PathRays& rays) const {
  // A white matt surface seen from straight above: what it sends back is irradiance / pi.
  SurfaceLook look;
  look.bsdf.specular = 0.0f;
  look.normal = normal;
  const Vertex vertex{position,
                      normal,
                      Basis(normal),
                      glm::vec3(0.0f, 0.0f, 1.0f),
                      look,
                      0,
                      0,
                      sky_ ? &sky_->viewFrom(position, normal) : nullptr};
  SurfaceLight sum;
  const auto add = [&sum](const Rgb& radiance, const glm::vec3& direction) {
    sum.radiance += radiance;
    sum.meanDirection += luminance(radiance) * direction;
  };
  struct Arriving {
    Rgb radiance{0.0f};
    glm::vec3 direction{0.0f};
  };
  auto shadows = shadowBatch<Arriving>(embree_, [&add](const Arriving& light, const Rgb& transmittance) {
    add(light.radiance * transmittance, light.direction);
  });
  const ScatteringSurface scattering(look.bsdf, vertex.wo);
  const Shares shares = firstShares(vertex);
  for (std::uint32_t i = 0; i < stream.pathsPerPixel; ++i) {
    Sampler sampler(stream, i);
    sampleLights(vertex, scattering, shares, sampler, DeltaLights::kExcluded,
                 [&](const Ray& shadow, const Rgb& diffuse, const Rgb&) {
                   ++rays.shadow;
                   shadows.add(shadow, {diffuse, glm::normalize(shadow.direction)});
                 });
    const float choose = sampler.next1D();
    const BsdfSample s = scattering.sample(choose, sampler.next2D());
    if (!(s.pdf > 0.0f) || isBlack(s.diffuse)) continue;
    const glm::vec3 world = glm::normalize(vertex.basis.toWorld(s.wi));
    Carried next;
    scatter(vertex, s, world, shares, next);
    next.importance = largest(s.diffuse);
    add(s.diffuse * follow(next, sampler, rays), world);
  }
  shadows.flush();
  const float whole = luminance(sum.radiance);
  if (whole > 0.0f) sum.meanDirection /= whole;
  sum.radiance /= static_cast<float>(stream.pathsPerPixel);
  return sum;
}

std::optional<SurfaceLight> PathTracer::lightFromSolution(const Vertex& vertex) const {
  if (!settings_.solution) return std::nullopt;
  return settings_.solution->records.at(vertex.position, vertex.facing);
}

SampleRadiance PathTracer::fromDeltaLights(const Vertex& vertex, const ScatteringSurface& scattering,
                                           PathRays& rays) const {
  SampleRadiance sum;
  lights_.forEachDelta(vertex.position, [&](const LightSample& light) {
    const glm::vec3 wi = vertex.basis.toLocal(light.direction);
    if (!vertex.agree(wi, light.direction)) return;
    const BsdfValue f = scattering.evaluate(wi);
    if (isBlack(f.diffuse + f.viewDependent)) return;
    ++rays.shadow;
    const Rgb arriving =
        light.radiance * embree_.transmittance(shadowRay(vertex.originToward(light.direction), light));
    sum.diffuse += f.diffuse * arriving;
    sum.viewDependent += f.viewDependent * arriving;
  });
  return sum;
}

SampleRadiance PathTracer::shadeFromSolution(Vertex vertex, const SurfaceLight& known,
                                             const glm::vec3& direction, Cone cone,
                                             const Sampler::Stream& stream, PathRays& rays) const {
  SurfaceLook& look = vertex.look;
  ScatteringSurface scattering(look.bsdf, vertex.wo);
  const BsdfAlbedo albedo = scattering.albedo();
  SampleRadiance result = fromDeltaLights(vertex, scattering, rays);
  result.diffuse += look.emission + albedo.diffuse * radianceOnTurned(known, vertex.facing, look.normal);
  if (isOpaqueBeyond(look.bsdf, kBroadToTheEye)) {
    result.viewDependent += albedo.viewDependent * radianceOnTurned(known, vertex.facing, look.normal);
    return result;
  }
  const float share = largest(albedo.viewDependent);
  if (share < kLeastViewDependent) return result;

  const int count = settings_.pathsPerSample;
  Sampler::Stream numbers = stream;
  if (share <= kFaint) {
    numbers.pixel = {0, 0};
    numbers.frame = 0;
  }
  dropDiffuse(look.bsdf);
  scattering = ScatteringSurface(look.bsdf, vertex.wo);
  const Shares shares = firstShares(vertex);
  Rgb sum(0.0f);
  auto shadows = shadowBatch<Rgb>(
      embree_, [&sum](const Rgb& light, const Rgb& transmittance) { sum += light * transmittance; });
  for (int i = 0; i < count; ++i) {
    Sampler sampler(numbers, static_cast<std::uint32_t>(i));
    sampleLights(vertex, scattering, shares, sampler, DeltaLights::kExcluded,
                 [&](const Ray& shadow, const Rgb&, const Rgb& viewDependent) {
                   ++rays.shadow;
                   shadows.add(shadow, viewDependent);
                 });
    const float choose = sampler.next1D();
    const BsdfSample s = scattering.sample(choose, sampler.next2D());
    if (!(s.pdf > 0.0f) || isBlack(s.viewDependent)) continue;
    Carried next;
    next.width = cone.width;
    next.spread = cone.spread;
    if (vertex.isStraightThrough(s)) {
      next.origin = offsetRayOrigin(vertex.position, -vertex.facing);
      next.direction = direction;
    } else {
      const glm::vec3 world = glm::normalize(vertex.basis.toWorld(s.wi));
      if (!vertex.agree(s.wi, world)) continue;
      scatter(vertex, s, world, shares, next);
    }
    next.importance = largest(s.viewDependent);
    sum += s.viewDependent * follow(next, sampler, rays);
  }
  shadows.flush();
  result.viewDependent += sum / static_cast<float>(count);
  return result;
}

}  // namespace promenade::render
