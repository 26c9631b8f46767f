// What the eye sees through panes and blended surfaces, in mirrors and through smooth boundaries: where light
// has only a few ways to go, the tracer follows all of them, each with its weight, instead of choosing one by
// chance. What lies at the end of such a line of sight is shaded as if it were seen directly, with effort in
// proportion to the weight; so clean glass costs hardly more than no glass. Russian roulette keeps the number
// of lines small and the mean right (docs/method.md, "Lines of sight").

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

/// Numbers for the ways that a line takes at a surface.
constexpr std::uint32_t kWays = 3, kThrough = 1, kMirrored = 2;

}  // namespace

SampleRadiance PathTracer::shade(const Hit& hit, const Ray& primary, float pixelWidth,
                                 const Sampler::Stream& stream, PathRays& rays) const {
  const float length = glm::length(primary.direction);
  Sight sight;
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
  const Vertex vertex = vertexAt(hit, path.direction, {path.width, false});
  const float alpha = vertex.look.alpha;
  SampleRadiance seen;
  if (alpha > 0.0f) {
    Sight covered = sight;
    covered.path.throughput *= alpha;
    add(seeSurface(covered, vertex, stream, rays), alpha, seen);
  }
  if (alpha < 1.0f) {
    sight.besides += luminance(path.throughput * whole(seen));
    seen.viewDependent += seeBeyond(straightOn(sight, vertex), Rgb(1.0f - alpha), stream, rays);
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
  const bool hasLobes = !isBlack(lobes.reflected + lobes.transmitted);
  Sight from = sight;
  if (mayScatter) {
    const ScatteringSurface rest = hasLobes ? scattering.withoutDeltaLobes() : scattering;
    from.besides = sight.besides + luminance(sight.path.throughput * whole(seen));
    add(settings_.solution ? shadeFromSolution(from, vertex, rest, stream, rays)
                           : shadeByPaths(from, vertex, rest, stream, rays),
        1.0f, seen);
  }
  if (!hasLobes) return seen;

  struct Way {
    std::optional<Sight> next;
    Rgb share;
  };
  const bool isThin = look.bsdf.thinWalled;
  std::array<Way, 2> ways;
  if (isThin) {
    ways[0] = {straightOn(from, vertex), lobes.transmitted};
  } else if (mayScatter && !isBlack(lobes.transmitted)) {
    ways[0] = {turned(from, vertex, lobes.through), lobes.transmitted};
  }
  if (mayScatter) ways[1] = {turned(from, vertex, lobes.mirrored), lobes.reflected};
  // What shows most first: how clean the rest must be is measured by it.
  if (largest(ways[1].share) > largest(ways[0].share)) std::swap(ways[0], ways[1]);
  for (Way& way : ways) {
    if (!way.next) continue;
    way.next->besides = sight.besides + luminance(sight.path.throughput * whole(seen));
    seen.viewDependent += seeBeyond(*way.next, way.share, stream, rays);
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
          : std::max(kLeastWeight, kLeastPathsOfALine / static_cast<float>(settings_.pathsPerSample));
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
  sight.turns = kWays * sight.turns + kThrough;
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
  sight.turns = kWays * sight.turns + (localDirection.z > 0.0f ? kMirrored : kThrough);
  return sight;
}

}  // namespace promenade::render
