// The part of PathTracer that finds the light of records.
//
// Its parts are sampled by numbers of their own, as often as each needs: what is noisy differs from place to
// place (the sky through a gap, a sunny sill around a corner, a wall that a mirror lights), and points on
// lights that come cleanly take time away from paths that do not. Which samples a place gets follows from how
// much those it has got scatter, so rare light that its first samples missed is a little underestimated; the
// first samples are therefore many.

#include <array>
#include <cstddef>
#include <limits>
#include <numbers>

#include "src/core/display.h"
#include "src/render/path_tracer_internal.h"
#include "src/render/stratified_mean.h"

namespace promenade::render {
namespace {

/// Points on lights for each path that finds them too, as their weights see it: shadow rays are cheap and
/// lights are strong.
constexpr float kLightsPerPath = 4.0f;

/// A white matt surface that wants to know its light by direction: most of its samples are chosen by the
/// cosine, the others evenly over the cells of a light field.
class GatheringSurface {
 public:
  [[nodiscard]] static BsdfValue evaluate(const glm::vec3& wi) {
    BsdfValue value;
    if (!(wi.z > 0.0f)) return value;
    const float cosine = wi.z / std::numbers::pi_v<float>;
    value.diffuse = Rgb(cosine);
    value.pdf = glm::mix(cosine, LightField::pdf(wi), kForTheField);
    return value;
  }
  /// Strips of the square go to either way, so that both keep the stratification of `u`.
  [[nodiscard]] static BsdfSample sample(glm::vec2 u) {
    BsdfSample s;
    s.wi = u.x < kForTheField ? LightField::sample({u.x / kForTheField, u.y})
                              : sampleCosine({(u.x - kForTheField) / (1.0f - kForTheField), u.y});
    const BsdfValue value = evaluate(s.wi);
    s.pdf = value.pdf;
    if (s.pdf > 0.0f) s.diffuse = value.diffuse / s.pdf;
    return s;
  }

 private:
  static constexpr float kForTheField = 0.25f;
};

/// Kinds of samples; those of light first, as FieldSums counts them.
enum Kind : std::size_t { kSkyPoints, kLampPoints, kBrightPoints, kPaths, kKinds };
static_assert(kPaths == FieldSums::kKinds);

/// Time of one sample, in paths: measured in the kitchen.
constexpr std::array<float, kKinds> kCost = {0.2f, 0.2f, 0.6f, 1.0f};
constexpr std::array<std::uint32_t, kKinds> kSeed = {0x9e3779b9u, 0x7f4a7c15u, 0x94d049bbu, 0u};

/// What samples of one kind have found.
struct Part {
  DoubledMean mean;
  int done = 0;
  Rgb radiance{0.0f};
  glm::vec3 direction{0.0f};

  void add(int sample, const Rgb& share, const glm::vec3& from) {
    const float value = luminance(share);
    mean.add(sample, value);
    radiance += share;
    direction += value * from;
  }
};

/// The parts of a record's light.
class Parts {
 public:
  void begin(Kind kind, int count) {
    if (count <= 0) return;
    constexpr int kBlocks = DoubledMean::kBlocks;
    parts_[kind].emplace(Part{DoubledMean((count + kBlocks - 1) / kBlocks * kBlocks)});
  }
  [[nodiscard]] bool has(Kind kind) const { return parts_[kind].has_value(); }
  [[nodiscard]] Part& of(Kind kind) { return *parts_[kind]; }
  [[nodiscard]] int count(Kind kind) const { return has(kind) ? parts_[kind]->mean.count() : 0; }

  [[nodiscard]] SurfaceLight light() const {
    SurfaceLight sum;
    double squaredError = 0.0;
    for (const std::optional<Part>& part : parts_) {
      if (!part) continue;
      const float each = 1.0f / static_cast<float>(part->mean.count());
      sum.radiance += each * part->radiance;
      sum.meanDirection += each * part->direction;
      squaredError += part->mean.squaredError();
    }
    const float whole = luminance(sum.radiance);
    if (whole > 0.0f) sum.meanDirection /= whole;
    sum.error = static_cast<float>(std::sqrt(squaredError));
    return sum;
  }
  /// The kind of which as many samples again take the most error away for their time, if all of them together
  /// then cost no more than `most` paths.
  [[nodiscard]] std::optional<Kind> worthDoubling(double most) const {
    double spent = 0.0;
    for (std::size_t k = 0; k < kKinds; ++k) spent += cost(static_cast<Kind>(k));
    std::optional<Kind> best;
    double bestGain = 0.0;
    for (std::size_t k = 0; k < kKinds; ++k) {
      const Kind kind = static_cast<Kind>(k);
      if (!has(kind) || spent + cost(kind) > most) continue;
      const double gain = parts_[kind]->mean.squaredError() / cost(kind);
      if (!(gain > bestGain)) continue;
      bestGain = gain;
      best = kind;
    }
    return best;
  }

 private:
  [[nodiscard]] double cost(Kind kind) const { return double{kCost[kind]} * count(kind); }
  std::array<std::optional<Part>, kKinds> parts_;
};

}  // namespace

/// Draws the samples of one record.
class PathTracer::Gatherer {
 public:
  Gatherer(const PathTracer& tracer, const Vertex& vertex, const Sampler::Stream& numbers,
           const GatherEffort& effort, PathRays& rays)
      : tracer_(tracer),
        vertex_(vertex),
        lights_(tracer.lights_.viewFrom(vertex.position, vertex.facing)),
        numbers_(numbers),
        effort_(effort),
        rays_(rays) {
    vertex_.lights = &lights_;
    const Shares asked = tracer.firstShares(vertex);
    shares_ = {asked.environment * kLightsPerPath, asked.local * kLightsPerPath, 0.0f};
    const bool isBright = tracer.bright_ && tracer.settings_.solution && tracer.settings_.maxBounces > 1;
    if (isBright) shares_.bright = 1.0f;
    parts_.begin(kSkyPoints, asked.environment > 0.0f ? effort.points : 0);
    parts_.begin(kLampPoints, asked.local > 0.0f ? effort.points : 0);
    parts_.begin(kBrightPoints, isBright ? effort.points / kLightsPerBright : 0);
    parts_.begin(kPaths, effort.paths);
  }

  [[nodiscard]] Gathered gather() {
    for (std::size_t k = 0; k < kKinds; ++k) draw(static_cast<Kind>(k));
    SurfaceLight light = parts_.light();
    while (light.error > effort_.relativeError * luminance(light.radiance)) {
      const std::optional<Kind> next = parts_.worthDoubling(effort_.most);
      if (!next) break;
      parts_.of(*next).mean.grow();
      draw(*next);
      light = parts_.light();
    }
    const float unit = luminance(light.radiance);
    Gathered result{light, {}};
    if (unit > 0.0f) {
      result.field = field_.finish(
          {parts_.count(kSkyPoints), parts_.count(kLampPoints), parts_.count(kBrightPoints)}, unit);
    }
    return result;
  }

 private:
  /// ... which cost more than points on other lights.
  static constexpr int kLightsPerBright = 4;

  /// Samples of that kind until there are as many as its mean is for.
  void draw(Kind kind) {
    if (!parts_.has(kind)) return;
    Part& part = parts_.of(kind);
    Sampler::Stream stream = numbers_;
    stream.seed ^= kSeed[kind];
    stream.pathsPerPixel = static_cast<std::uint32_t>(std::max(part.mean.count(), mostOf(kind)));
    const auto forEach = [&](const auto& sample) {
      for (; part.done < part.mean.count(); ++part.done) {
        Sampler sampler(stream, static_cast<std::uint32_t>(part.done));
        sample(sampler);
      }
    };
    switch (kind) {
      case kSkyPoints:
        return drawLights(kind, {shares_.environment / kLightsPerPath, 0.0f, 0.0f}, forEach);
      case kLampPoints:
        return drawLights(kind, {0.0f, shares_.local / kLightsPerPath, 0.0f}, forEach);
      case kBrightPoints:
        return drawBright(forEach);
      default:
        return forEach([&](Sampler& sampler) { drawPath(sampler); });
    }
  }
  /// What the sequence of a kind must have room for.
  [[nodiscard]] int mostOf(Kind kind) const {
    return static_cast<int>(static_cast<float>(effort_.most) / kCost[kind]);
  }

  template <class ForEach>
  void drawLights(Kind kind, const Shares& asked, const ForEach& forEach) {
    struct Arriving {
      int sample = 0;
      Rgb radiance{0.0f};
      glm::vec3 direction{0.0f};
    };
    auto shadows =
        shadowBatch<Arriving>(tracer_.embree_, [&](const Arriving& light, const Rgb& transmittance) {
          addLight(kind, light.sample, light.radiance * transmittance, light.direction);
        });
    forEach([&](Sampler& sampler) {
      tracer_.sampleLights(vertex_, scattering_, asked, kLightsPerPath, sampler, DeltaLights::kExcluded,
                           [&](const Ray& shadow, const Rgb& diffuse, const Rgb&) {
                             ++rays_.shadow;
                             shadows.add(shadow, {parts_.of(kind).done, kLightsPerPath * diffuse,
                                                  glm::normalize(shadow.direction)});
                           });
    });
    shadows.flush();
  }

  template <class ForEach>
  void drawBright(const ForEach& forEach) {
    struct Arriving {
      int sample = 0;
      TowardBright toward;
    };
    auto shadows =
        shadowBatch<Arriving>(tracer_.embree_, [&](const Arriving& point, const Rgb& transmittance) {
          if (isBlack(transmittance)) return;
          const Rgb radiance = tracer_.sentBy(point.toward, rays_);
          addLight(kBrightPoints, point.sample, point.toward.diffuse * radiance * transmittance,
                   point.toward.chosen.direction);
        });
    forEach([&](Sampler& sampler) {
      const auto toward = tracer_.chooseBright(vertex_, scattering_, shares_.bright, sampler);
      if (!toward) return;
      ++rays_.shadow;
      shadows.add(toward->shadow, {parts_.of(kBrightPoints).done, *toward});
    });
    shadows.flush();
  }

  void addLight(Kind kind, int sample, const Rgb& share, const glm::vec3& direction) {
    parts_.of(kind).add(sample, share, direction);
    field_.addLight(kind, vertex_.basis.toLocal(direction), share);
  }

  void drawPath(Sampler& sampler) {
    const BsdfSample s = scattering_.sample(sampler.next2D());
    if (!(s.pdf > 0.0f) || isBlack(s.diffuse)) return;
    const glm::vec3 world = glm::normalize(vertex_.basis.toWorld(s.wi));
    Carried next;
    tracer_.scatter(vertex_, s, world, shares_, next);
    next.importance = largest(s.diffuse);
    const Rgb arriving = tracer_.follow(next, sampler, rays_);
    parts_.of(kPaths).add(parts_.of(kPaths).done, s.diffuse * arriving, world);
    field_.addPath(s.wi, arriving);
  }

  const PathTracer& tracer_;
  Vertex vertex_;
  LightTree::View lights_;
  const Sampler::Stream numbers_;
  const GatherEffort effort_;
  PathRays& rays_;
  const GatheringSurface scattering_{};
  Shares shares_;
  Parts parts_;
  FieldSums field_;
};

Gathered PathTracer::gather(const glm::vec3& position, const glm::vec3& normal,
                            const Sampler::Stream& numbers, const GatherEffort& effort,
                            PathRays& rays) const {
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
  return Gatherer(*this, vertex, numbers, effort, rays).gather();
}

}  // namespace promenade::render
