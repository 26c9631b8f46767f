// What the eye sees through panes and blended surfaces, in mirrors and through smooth boundaries: where light
// has only a few ways to go, the tracer follows all of them, each with its weight, instead of choosing one by
// chance. What lies at the end of such a line of sight is shaded as if it were seen directly, with effort in
// proportion to the weight; so clean glass costs hardly more than no glass. Russian roulette keeps the number
// of lines small and the mean right (docs/method.md, "Lines of sight").

#include <algorithm>
#include <array>
#include <optional>

#include "src/core/display.h"
#include "src/render/path_tracer_internal.h"

namespace promenade::render {
namespace {

/// Lines of less weight are followed with the chance that gives them this weight: a tree of lines has at most
/// 1 / kLeastWeight ends on average.
constexpr float kLeastWeight = 0.005f;
/// ... and without a solution, where an end costs a path at least, about twice as many as paths are asked
/// for.
constexpr float kLeastPathsOfALine = 0.5f;

Rgb whole(const SampleRadiance& radiance) {
  return radiance.diffuse + radiance.viewDependent;
}

void add(const SampleRadiance& part, float share, SampleRadiance& sum) {
  sum.diffuse += share * part.diffuse;
  sum.viewDependent += share * part.viewDependent;
}

/// Ways that a line takes at a surface: 1 to 3 along a delta lobe, 4 where nothing covers it.
constexpr std::uint32_t kWays = 5, kUncovered = 4;

}  // namespace

SampleRadiance PathTracer::shade(const Hit& hit, const Ray& primary, float pixelWidth,
                                 const Sampler::Stream& stream, Effort effort, Pilots& pilots,
                                 PathRays& rays) const {
  const float length = glm::length(primary.direction);
  Sight sight;
  sight.effort = effort;
  sight.pilots = &pilots;
  sight.path.origin = primary.origin;
  sight.path.direction = primary.direction / length;
  sight.path.spread = pixelWidth / length;
  Hit end = hit;
  end.distance *= length;
  return see(sight, end, stream, rays);
}

SampleRadiance PathTracer::see(Sight sight, const Hit& hit, const Sampler::Stream& stream,
                               PathRays& rays) const {
  Carried& path = sight.path;
  if (!hit.found()) return {background(path.direction), Rgb(0.0f)};
  path.width += path.spread * hit.distance;
  const Rgb clear =
      path.medium >= 0 ? volumeTransmittance(
                             surfaces_.scene().materials[static_cast<std::size_t>(path.medium)], hit.distance)
                       : Rgb(1.0f);
  path.throughput *= clear;
  Vertex vertex = vertexAt(hit, path.direction, {path.width, false});
  lookAtSky(vertex);
  const float alpha = vertex.look.alpha;
  SampleRadiance seen;
  if (alpha > 0.0f) {
    Sight covered = sight;
    covered.path.throughput *= alpha;
    add(seeSurface(covered, vertex, stream, rays), alpha, seen);
  }
  if (alpha < 1.0f) {
    sight.besides += luminance(path.throughput * whole(seen));
    Sight beyond = straightOn(sight, vertex);
    beyond.turns = kWays * sight.turns + kUncovered;
    seen.viewDependent += seeBeyond(beyond, Rgb(1.0f - alpha), stream, rays);
  }
  return {clear * seen.diffuse, clear * seen.viewDependent};
}

SampleRadiance PathTracer::seeSurface(const Sight& sight, const Vertex& vertex, const Sampler::Stream& stream,
                                      PathRays& rays) const {
  const SurfaceLook& look = vertex.look;
  SampleRadiance seen{look.emission, Rgb(0.0f)};
  if (look.unlit || !(vertex.wo.z > 0.0f)) return seen;
  const ScatteringSurface scattering(look.bsdf, vertex.wo);
  const bool mayScatter = sight.path.bounces < settings_.maxBounces;
  const DeltaLobes lobes = scattering.deltaLobes();
  const bool hasLobes =
      std::any_of(lobes.begin(), lobes.end(), [](const DeltaLobe& lobe) { return !isBlack(lobe.weight); });
  const ScatteringSurface rest = hasLobes ? scattering.withoutDeltaLobes() : scattering;
  Sight from = sight;
  if (mayScatter && !isBlack(rest.albedo().diffuse + rest.albedo().viewDependent)) {
    from.besides = sight.besides + luminance(sight.path.throughput * whole(seen));
    add(settings_.solution ? shadeFromSolution(from, vertex, rest, stream, rays)
                           : shadeByPaths(from, vertex, rest, stream, rays),
        1.0f, seen);
  }
  if (!hasLobes) return seen;

  // What shows most first: how clean the rest must be is measured by it.
  std::array<std::uint32_t, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&lobes](std::uint32_t a, std::uint32_t b) {
    return largest(lobes[a].weight) > largest(lobes[b].weight);
  });
  for (const std::uint32_t i : order) {
    if (isBlack(lobes[i].weight)) break;
    std::optional<Sight> next;
    if (lobes[i].wi.z < 0.0f && look.bsdf.thinWalled) {
      next = straightOn(from, vertex);
    } else if (mayScatter) {
      next = turned(from, vertex, lobes[i].wi);
    }
    if (!next) continue;
    next->turns = kWays * sight.turns + i + 1;
    next->besides = sight.besides + luminance(sight.path.throughput * whole(seen));
    seen.viewDependent += seeBeyond(*next, lobes[i].weight, stream, rays);
  }
  return seen;
}

Rgb PathTracer::seeBeyond(Sight sight, Rgb share, const Sampler::Stream& stream, PathRays& rays) const {
  sight.path.throughput *= share;
  const float weight = sight.weight();
  if (!(weight > 0.0f) || sight.passages > kMostPassages) return Rgb(0.0f);
  const float least =
      settings_.solution
          ? kLeastWeight
          : std::max(kLeastWeight, kLeastPathsOfALine / static_cast<float>(stream.pathsPerPixel));
  if (weight < least) {
    const float survival = weight / least;
    const Sampler::Stream numbers = sight.numbersOf(stream);
    Sampler sampler(settings_.solution ? sharedNumbers(numbers) : numbers, 0);
    if (sampler.next1D() >= survival) return Rgb(0.0f);
    share /= survival;
    sight.path.throughput /= survival;
  }
  Ray ray;
  ray.origin = sight.path.origin;
  ray.direction = sight.path.direction;
  ++rays.scattered;
  return share * whole(see(sight, embree_.intersect(ray), stream, rays));
}

PathTracer::Sight PathTracer::straightOn(Sight sight, const Vertex& vertex) {
  sight.path.origin = offsetRayOrigin(vertex.position, -vertex.facing);
  ++sight.passages;
  return sight;
}

std::optional<PathTracer::Sight> PathTracer::turned(Sight sight, const Vertex& vertex,
                                                    const glm::vec3& localDirection) const {
  const glm::vec3 world = glm::normalize(vertex.basis.toWorld(localDirection));
  if (!vertex.agree(localDirection, world)) return std::nullopt;
  BsdfSample mirrored;
  mirrored.wi = localDirection;
  mirrored.pdf = 1.0f;
  mirrored.delta = true;
  scatter(vertex, mirrored, world, firstShares(vertex), sight.path);
  return sight;
}

}  // namespace promenade::render
