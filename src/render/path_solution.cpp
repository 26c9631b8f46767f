// The part of PathTracer that uses a view-independent solution of the light on matt surfaces.

#include "src/render/path_tracer_internal.h"

#include <limits>

#include "src/core/display.h"
#include "src/render/irradiance_solution.h"
#include "src/render/stratified_mean.h"

namespace promenade::render {
namespace {

/// Distance of whoever asks for light, where no one in particular does.
constexpr float kFar = std::numeric_limits<float>::infinity();
/// Less than this of white light is not worth a ray.
constexpr float kLeastTraced = 0.002f;
/// Up to this share of what a surface sends back all samples share their random numbers. (A stronger
/// reflection would show the few directions as ghosts.)
constexpr float kFaint = 0.25f;
/// A reflection gets at least so many paths, and up to so many until it is clean.
constexpr int kLeastPaths = 16;
constexpr int kMostPaths = 128;
/// Standard error of a sample of a strong reflection, as a share of all it shows, at which it is: between
/// this and 1.4 times as much, as paths are doubled (pilot.h).
constexpr float kStrongNoise = 0.1f;
/// The same where it is faint, or its numbers are shared.
constexpr float kFaintNoise = 0.015f;
/// Below this roughness a lobe shows so little of the surroundings that its paths find nearly the same; such
/// surfaces are often large and flat (polished floors), where noise is seen best. They may be clean after a
/// few paths, and are traced to less noise.
constexpr float kNarrow = 0.1f;
constexpr float kNarrowNoise = 0.06f;
constexpr int kLeastNarrowPaths = 8;
/// From one path alone nothing can be told of the noise.
constexpr int kLeastOfAll = 2;
/// Beside a known diffuse part only lobes are traced, which find all but small lights by themselves: so
/// lights are asked for every so many paths.
constexpr int kPathsPerLight = 4;
constexpr std::uint32_t kLightSeed = 0x9e3779b9u;

}  // namespace

void PathTracer::setSolution(std::shared_ptr<const LightSolution> solution) {
  settings_.solution = std::move(solution);
}

void PathTracer::setBright(std::shared_ptr<const BrightSurfaces> bright) {
  bright_ = bright && !bright->empty() ? std::move(bright) : nullptr;
}

std::shared_ptr<const BrightSurfaces> PathTracer::findBright() const {
  if (!settings_.solution) return nullptr;
  return std::make_shared<const BrightSurfaces>(
      surfaces_, embree_, [this](const Hit& hit, const glm::vec3& direction, float width) {
        // Most of a scene is not known, and quickly passed over.
        const SurfacePoint point = surfaces_.pointAt(hit, direction);
        const glm::vec3 facing = point.frontFace ? point.geometricNormal : -point.geometricNormal;
        if (!settings_.solution->roughlyAt(point.position, facing, kFar)) return 0.0f;
        PathRays uncounted;
        return luminance(sentBackAt(hit, direction, width, kFar, uncounted));
      });
}

PathTracer::SentBack PathTracer::sentBack(const Vertex& vertex, const ScatteringSurface& scattering,
                                          const SurfaceLight& known, bool blurred, PathRays& rays) const {
  const BsdfAlbedo albedo = scattering.albedo();
  const Rgb under = radianceOnTurned(known, vertex.facing, vertex.look.normal);
  const SampleRadiance direct = fromDeltaLights(vertex, scattering, rays);
  const bool isBroad = isOpaqueBeyond(vertex.look.bsdf, blurred ? kBroadToTheBlurred : kBroadRoughness);
  const Rgb reflected = isBroad ? albedo.diffuse + albedo.viewDependent : albedo.diffuse;
  return {reflected * under + direct.diffuse + direct.viewDependent, isBroad};
}

Rgb PathTracer::sentBackAt(const Hit& hit, const glm::vec3& direction, float width, float distance,
                           PathRays& rays) const {
  Vertex vertex = vertexAt(hit, direction, {width, true});
  if (vertex.look.unlit || !(vertex.wo.z > 0.0f)) return Rgb(0.0f);
  const std::optional<SurfaceLight> known = lightFromSolution(vertex, distance);
  if (!known) return Rgb(0.0f);
  roughen(vertex.look.bsdf, settings_.leastIndirectRoughness);
  const ScatteringSurface scattering(vertex.look.bsdf, vertex.wo);
  return vertex.look.alpha * sentBack(vertex, scattering, *known, true, rays).radiance;
}

Rgb PathTracer::sentBy(const TowardBright& bright, PathRays& rays) const {
  const BrightSurfaces::Chosen& chosen = bright.chosen;
  return sentBackAt(chosen.hit, chosen.direction, bright.spread * chosen.hit.distance, chosen.hit.distance,
                    rays);
}

std::optional<SurfaceLight> PathTracer::lightFromSolution(const Vertex& vertex,
                                                          std::optional<float> blurredOver) const {
  if (!settings_.solution) return std::nullopt;
  return blurredOver ? settings_.solution->roughlyAt(vertex.position, vertex.facing, *blurredOver)
                     : settings_.solution->at(vertex.position, vertex.facing);
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

SampleRadiance PathTracer::shadeFromSolution(const Sight& sight, Vertex vertex, ScatteringSurface scattering,
                                             const Sampler::Stream& stream, PathRays& rays) const {
  SurfaceLook& look = vertex.look;
  const BsdfAlbedo albedo = scattering.albedo();
  const std::optional<SurfaceLight> known =
      largest(albedo.diffuse) > kLeastDiffuse || isBroadToTheEye(look.bsdf)
          ? lightFromSolution(vertex, std::nullopt)
          : SurfaceLight{};
  SampleRadiance result = fromDeltaLights(vertex, scattering, rays);
  Rgb traced = albedo.viewDependent;
  if (known) {
    const Rgb under = radianceOnTurned(*known, vertex.facing, look.normal);
    result.diffuse += albedo.diffuse * under;
    if (isBroadToTheEye(look.bsdf)) {
      const ReflectionLobe lobe = scattering.reflectionLobe();
      const std::optional<Rgb> arriving = settings_.solution->fine.meanArriving(
          vertex.position, vertex.facing,
          [&](const Basis& field) { return weigh(lobe, vertex.basis, field); });
      if (arriving) {
        result.viewDependent += albedo.viewDependent * *arriving;
        return result;
      }
    }
    dropDiffuse(look.bsdf);
    scattering = ScatteringSurface(look.bsdf, vertex.wo).withoutDeltaLobes();
  } else {
    traced += albedo.diffuse;
  }
  const float weight = sight.weight();
  const float share = weight * largest(traced);
  if (share < kLeastTraced) return result;

  const bool isFaint = known && share <= kFaint * largest(albedo.diffuse + albedo.viewDependent);
  Sampler::Stream numbers = sight.numbersOf(stream);
  if (isFaint) numbers = sharedNumbers(numbers);
  const bool isExact = sight.effort == Effort::kExactly;
  if (!isExact) {
    numbers.pathsPerPixel = std::max(stream.pathsPerPixel, static_cast<std::uint32_t>(kMostPaths));
  }
  // Effort in proportion to what the eye gets of it.
  const auto ofWeight = [weight](int paths) {
    return std::max(kLeastOfAll,
                    static_cast<int>(std::ceil(static_cast<float>(paths) * std::min(weight, 1.0f))));
  };
  const int most = ofWeight(static_cast<int>(numbers.pathsPerPixel));
  const int pathsPerLight = known ? kPathsPerLight : 1;
  const float times = 1.0f / static_cast<float>(pathsPerLight);
  const Shares asked = firstShares(vertex);
  const Shares shares{asked.environment * times, asked.local * times};
  Sampler::Stream lightNumbers = numbers;
  lightNumbers.seed ^= kLightSeed;
  LightTree::View lights = lights_.viewFrom(vertex.position, vertex.facing);
  vertex.lights = &lights;
  SampleRadiance sum;
  StratifiedMean found(most);
  const auto add = [&](int path, const SampleRadiance& part) {
    sum.viewDependent += part.viewDependent;
    if (!known) sum.diffuse += part.diffuse;
    found.add(path, luminance(part.viewDependent) + (known ? 0.0f : luminance(part.diffuse)));
  };
  struct Lit {
    int path;
    SampleRadiance light;
  };
  auto shadows = shadowBatch<Lit>(embree_, [&add](const Lit& lit, const Rgb& transmittance) {
    add(lit.path, {lit.light.diffuse * transmittance, lit.light.viewDependent * transmittance});
  });
  int count = 0;
  const auto trace = [&](int paths) {
    for (const int end = count + paths; count < end; ++count) {
      Sampler sampler(numbers, static_cast<std::uint32_t>(count));
      const float choose = sampler.next1D();
      const BsdfSample s = scattering.sample(choose, sampler.next2D());
      if (count % pathsPerLight == 0) {
        Sampler lightSampler(lightNumbers, static_cast<std::uint32_t>(count / pathsPerLight));
        sampleLights(vertex, scattering, asked, times, lightSampler, DeltaLights::kExcluded,
                     [&](const Ray& shadow, const Rgb& diffuse, const Rgb& viewDependent) {
                       ++rays.shadow;
                       shadows.add(shadow, {count, {diffuse, viewDependent}});
                     });
      }
      const Rgb scattered = known ? s.viewDependent : s.diffuse + s.viewDependent;
      if (!(s.pdf > 0.0f) || isBlack(scattered)) continue;
      const std::optional<Carried> next = leave(sight, vertex, s, shares);
      if (!next) continue;
      const Rgb arriving = follow(*next, sampler, rays);
      add(count, {s.diffuse * arriving, s.viewDependent * arriving});
    }
    shadows.flush();
  };
  const bool isNarrow = look.bsdf.roughness < kNarrow &&
                        !(look.bsdf.clearcoat > 0.0f && look.bsdf.clearcoatRoughness >= kNarrow);
  const float noise = isFaint || isExact ? kFaintNoise : isNarrow ? kNarrowNoise : kStrongNoise;
  const auto error = [&] { return weight * found.standardError(count); };
  const auto limit = [&] {
    const float mean = luminance(sum.diffuse + sum.viewDependent) / static_cast<float>(count);
    return noise * (sight.besides + weight * (luminance(result.diffuse + result.viewDependent) + mean));
  };
  // Whoever gets fewer learns nothing about their noise.
  const int enough = ofWeight(isNarrow ? kLeastNarrowPaths : kLeastPaths);
  int before = 0;
  if (sight.effort == Effort::kGoOn) {
    const Pilot& pilot = sight.pilots->lines[sight.pilots->next++];
    sum = pilot.sum;
    before = count = pilot.paths;
    trace(pilot.wanted - before);
  } else {
    trace(std::min(most, enough));
    while (isExact && count < most && error() > limit()) trace(std::min(count, most - count));
  }
  rays.paths += static_cast<std::uint64_t>(count - before);
  if (isExact && (count < enough || error() > limit())) ++rays.noisyLines;
  if (sight.effort == Effort::kPilot) {
    const float ofAll = error();
    sight.pilots->lines.push_back(
        {sum, count, most, ofAll * ofAll * static_cast<float>(count), limit() * limit(), count});
  }
  const float each = 1.0f / static_cast<float>(count);
  result.diffuse += sum.diffuse * each;
  result.viewDependent += sum.viewDependent * each;
  return result;
}

}  // namespace promenade::render
