#include "src/render/sky_guide.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "src/render/maths.h"
#include "src/render/shadow_batch.h"

namespace promenade::render {
namespace {

constexpr int kFineCells = 40;  ///< along the longest side of the scene
constexpr int kFineInCoarse = 4;
// Rays of a bin that is looked at.
constexpr int kFineRays = 1;
constexpr int kCoarseRays = 4;   ///< a window that they miss is not seen by any of the fine cells
constexpr int kFurtherRays = 3;  ///< where sky was seen, or beside it
/// What a fine cell sees counts as if this many rays more had seen what the coarse one saw: few rays miss a
/// window easily.
constexpr float kRaysOfAround = 0.25f;
constexpr float kRaysByLight = 64.0f;  ///< further ones, spread over the bins by their light
constexpr int kSkySamplesPerBin = 16;
constexpr float kToNeighbours = 0.05f;
constexpr float kLeastShare = 0.25f;
constexpr float kMostShare = 0.9f;

/// Clarberg 2008, as in PBRT 4th ed., 3.8.3, about +Y.
glm::vec3 directionAt(int bin, float du, float dv) {
  const float u = 2.0f * (static_cast<float>(bin % SkyGuide::kEdge) + du) / SkyGuide::kEdge - 1.0f;
  const float v = 2.0f * (static_cast<float>(bin / SkyGuide::kEdge) + dv) / SkyGuide::kEdge - 1.0f;
  const float fromDiagonal = 1.0f - (std::abs(u) + std::abs(v));
  const float r = 1.0f - std::abs(fromDiagonal);
  const float phi = (r == 0.0f ? 1.0f : (std::abs(v) - std::abs(u)) / r + 1.0f) * (kPi / 4.0f);
  const float height = std::copysign(1.0f - r * r, fromDiagonal);
  const float radius = r * std::sqrt(std::max(0.0f, 2.0f - r * r));
  return {std::copysign(std::cos(phi), u) * radius, height, std::copysign(std::sin(phi), v) * radius};
}

int binOf(const glm::vec3& direction) {
  const float x = std::abs(direction.x), z = std::abs(direction.z);
  const float r = std::sqrt(std::max(0.0f, 1.0f - std::abs(direction.y)));
  const float most = std::max(x, z);
  float phi = most > 0.0f ? std::atan(std::min(x, z) / most) * (2.0f / kPi) : 0.0f;
  if (x < z) phi = 1.0f - phi;
  float v = phi * r;
  float u = r - v;
  if (direction.y < 0.0f) {
    const float swapped = 1.0f - v;
    v = 1.0f - u;
    u = swapped;
  }
  const auto indexOf = [](float along, float sign) {
    const float position = 0.5f * (std::copysign(along, sign) + 1.0f) * SkyGuide::kEdge;
    return std::clamp(static_cast<int>(position), 0, SkyGuide::kEdge - 1);
  };
  return indexOf(v, direction.z) * SkyGuide::kEdge + indexOf(u, direction.x);
}

float massOf(const SkyGuide::View& view, std::size_t bin) {
  return view.cumulative[bin] - (bin > 0 ? view.cumulative[bin - 1] : 0.0f);
}

/// A little of each bin goes to its neighbours.
std::array<float, SkyGuide::kBins> withNeighbours(const std::array<float, SkyGuide::kBins>& values) {
  constexpr int kEdge = SkyGuide::kEdge;
  std::array<float, SkyGuide::kBins> spread = values;
  for (int row = 0; row < kEdge; ++row) {
    for (int column = 0; column < kEdge; ++column) {
      const float value = kToNeighbours * values[static_cast<std::size_t>(row * kEdge + column)];
      if (!(value > 0.0f)) continue;
      for (int r = std::max(row - 1, 0); r <= std::min(row + 1, kEdge - 1); ++r) {
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, kEdge - 1); ++c) {
          if (r != row || c != column) spread[static_cast<std::size_t>(r * kEdge + c)] += value;
        }
      }
    }
  }
  return spread;
}

void fill(SkyGuide::View& view, const std::array<float, SkyGuide::kBins>& light) {
  std::partial_sum(light.begin(), light.end(), view.cumulative.begin());
  view.light = view.cumulative.back();
  if (!(view.light > 0.0f)) return;
  for (float& c : view.cumulative) c /= view.light;
  view.cumulative.back() = 1.0f;
  for (std::size_t row = 0; row < SkyGuide::kEdge; ++row) {
    view.rowEnds[row] = view.cumulative[(row + 1) * SkyGuide::kEdge - 1];
  }
}

/// The environment's own samples are chosen by radiance, so of them the same share arrives as of the light.
float shareOf(float arrived, float unobstructed) {
  const float arrivedShare = unobstructed > 0.0f ? arrived / unobstructed : 0.0f;
  return std::clamp(1.0f - arrivedShare, kLeastShare, kMostShare);
}

}  // namespace

SkyGuide::SkyGuide(const EmbreeScene& embree, const EnvironmentLight& environment)
    : embree_(embree),
      environment_(environment),
      coarse_(embree.bounds(), kFineCells / kFineInCoarse),
      fine_(embree.bounds(), kFineCells) {
  fillBins();
}

void SkyGuide::fillBins() {
  // As many samples of the environment's density, which find the sun, as of uniform directions, which find
  // what is dim.
  constexpr int kSamples = kBins * kSkySamplesPerBin;
  constexpr float kUniform = 1.0f / (4.0f * kPi);
  const auto add = [this](int bin, const EnvironmentSample& s) {
    bins_[static_cast<std::size_t>(bin)].radiance +=
        meanOf(s.radiance) / (s.pdf + kUniform) * (kBins * kUniform / kSamples);
  };
  Jitter jitter(0);
  for (int i = 0; i < kSamples; ++i) {
    const int bin = i / kSkySamplesPerBin;
    const float du = jitter.next(), dv = jitter.next();
    add(bin, environment_.toward(directionAt(bin, du, dv)));
    const float u = (static_cast<float>(i) + jitter.next()) / kSamples;
    const EnvironmentSample s = environment_.sample({u, jitter.next()});
    if (s.pdf > 0.0f) add(binOf(s.direction), s);
  }
  float sum = 0.0f;
  for (const Bin& bin : bins_) sum += bin.radiance;
  if (!(sum > 0.0f)) return;
  for (int i = 0; i < kBins; ++i) {
    Bin& bin = bins_[static_cast<std::size_t>(i)];
    bin.raysByLight = static_cast<int>(kRaysByLight * bin.radiance / sum);
    const glm::vec3 direction = directionAt(i, 0.5f, 0.5f);
    for (int side = 0; side < CellSide::kSides; ++side) {
      unobstructed_[static_cast<std::size_t>(side)] +=
          bin.radiance * std::max(glm::dot(direction, CellSide::axisOf(side)), 0.0f);
    }
  }
}

const SkyGuide::View& SkyGuide::viewFrom(const glm::vec3& position, const glm::vec3& normal) const {
  return fine_.at(position, normal, [this](const CellSide& from) {
    const View& around = coarse_.at(from.middle(), from.axis,
                                    [this](const CellSide& coarse) { return look(coarse, nullptr); });
    return look(from, &around);
  });
}

std::unique_ptr<SkyGuide::View> SkyGuide::look(const CellSide& from, const View* around) const {
  auto view = std::make_unique<View>();
  if (around != nullptr && around->share <= 0.0f) return view;
  struct Asked {
    std::size_t bin;
    float byHistogram, bySky;
  };
  struct Seen {
    float byHistogram = 0.0f, bySky = 0.0f;
    int rays = 0;
  };
  std::array<Seen, kBins> seen{};
  auto shadows = shadowBatch<Asked>(embree_, [&seen](const Asked& asked, const Rgb& transmittance) {
    const float through = meanOf(transmittance);
    seen[asked.bin].byHistogram += asked.byHistogram * through;
    seen[asked.bin].bySky += asked.bySky * through;
  });
  Jitter jitter(from.number);
  const auto lookAt = [&](std::size_t bin, int count) {
    seen[bin].rays += count;
    for (int k = 0; k < count; ++k) {
      const float du = jitter.next(), dv = jitter.next();
      Ray ray;
      ray.direction = directionAt(static_cast<int>(bin), du, dv);
      ray.origin = from.point(jitter);
      const float cosine = glm::dot(ray.direction, from.axis);
      // Normals of this side turn up to 55 degrees from its axis, so a direction may serve though it is
      // behind the axis.
      if (cosine <= -0.7f) continue;
      shadows.add(ray, {bin, std::max(cosine + 0.1f, 0.1f), std::max(cosine, 0.0f)});
    }
  };
  const int rays = around == nullptr ? kCoarseRays : kFineRays;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    const bool mayShow = around == nullptr ? bins_[bin].radiance > 0.0f : massOf(*around, bin) > 0.0f;
    if (mayShow) lookAt(bin, rays + bins_[bin].raysByLight);
  }
  shadows.flush();
  // Again where sky was seen, and beside it.
  std::array<float, kBins> light{};
  for (std::size_t bin = 0; bin < kBins; ++bin) light[bin] = seen[bin].byHistogram;
  const std::array<float, kBins> near = withNeighbours(light);
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    if (near[bin] > 0.0f && seen[bin].rays > 0) lookAt(bin, kFurtherRays);
  }
  shadows.flush();

  float arrived = 0.0f;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    const Seen& s = seen[bin];
    if (s.rays == 0) continue;
    const auto count = static_cast<float>(s.rays);
    arrived += s.bySky * bins_[bin].radiance / count;
    light[bin] = s.byHistogram * bins_[bin].radiance / count;
    if (around == nullptr) continue;
    const float part = kRaysOfAround / (count + kRaysOfAround);
    light[bin] = glm::mix(light[bin], massOf(*around, bin) * around->light, part);
  }
  fill(*view, withNeighbours(light));  // the rays see a bin at a few points only
  if (view->light > 0.0f) {
    view->share = shareOf(arrived, unobstructed_[static_cast<std::size_t>(from.side)]);
  }
  return view;
}

EnvironmentSample SkyGuide::sample(const View& view, float choose, glm::vec2 u) const {
  if (choose >= view.share) {
    EnvironmentSample s = environment_.sample(u);
    if (s.pdf > 0.0f) s.pdf = mixedPdf(view, s.direction, s.pdf);
    return s;
  }
  const float which = std::min(choose / view.share, kOneBelow);
  const auto rowEnd = std::upper_bound(view.rowEnds.begin(), view.rowEnds.end() - 1, which);
  const auto row = view.cumulative.begin() + (rowEnd - view.rowEnds.begin()) * kEdge;
  const auto found = std::upper_bound(row, row + kEdge, which);
  const int bin = std::min(static_cast<int>(found - view.cumulative.begin()), kBins - 1);
  return toward(view, directionAt(bin, u.x, u.y));
}

EnvironmentSample SkyGuide::toward(const View& view, const glm::vec3& direction) const {
  EnvironmentSample s = environment_.toward(direction);
  s.pdf = mixedPdf(view, direction, s.pdf);
  return s;
}

float SkyGuide::mixedPdf(const View& view, const glm::vec3& direction, float environmentPdf) {
  if (view.share <= 0.0f) return environmentPdf;
  const float mass = massOf(view, static_cast<std::size_t>(binOf(direction)));
  return view.share * mass * (kBins / (4.0f * kPi)) + (1.0f - view.share) * environmentPdf;
}

}  // namespace promenade::render
