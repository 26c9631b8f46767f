#include "src/render/sky_guide.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "src/render/maths.h"

namespace promenade::render {
namespace {

constexpr int kRaysPerBin = 2;
constexpr int kEnvironmentRays = 64;  ///< chosen by the environment, to see how many of those arrive
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

/// Traces rays in packets and hands each its transmittance.
template <class Use>
class PacketQueue {
 public:
  PacketQueue(const EmbreeScene& embree, const Use& use) : embree_(embree), use_(use) {}
  void add(const glm::vec3& origin, const glm::vec3& direction, int tag, float value) {
    const auto i = static_cast<std::size_t>(count_++);
    rays_[i].origin = origin;
    rays_[i].direction = direction;
    tags_[i] = tag;
    values_[i] = value;
    if (count_ == EmbreeScene::kPacket) flush();
  }
  void flush() {
    if (count_ == 0) return;
    const auto transmittance = embree_.transmittance(rays_, count_);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
      use_(tags_[i], values_[i] * meanOf(transmittance[i]));
    }
    count_ = 0;
  }

 private:
  const EmbreeScene& embree_;
  const Use& use_;
  int count_ = 0;
  std::array<Ray, EmbreeScene::kPacket> rays_;
  std::array<int, EmbreeScene::kPacket> tags_;
  std::array<float, EmbreeScene::kPacket> values_;
};

}  // namespace

SkyGuide::SkyGuide(const EmbreeScene& embree, const EnvironmentLight& environment)
    : embree_(embree), environment_(environment), views_(embree.bounds()) {}

const SkyGuide::View& SkyGuide::viewFrom(const glm::vec3& position, const glm::vec3& normal) const {
  return views_.at(position, normal, [this](const CellSide& from) { return look(from); });
}

std::unique_ptr<SkyGuide::View> SkyGuide::look(const CellSide& from) const {
  Jitter jitter(from.number);
  std::array<float, kBins> seen{};
  const auto gather = [&](int bin, float value) { seen[static_cast<std::size_t>(bin)] += value; };
  PacketQueue histogramRays(embree_, gather);
  for (int bin = 0; bin < kBins; ++bin) {
    for (int ray = 0; ray < kRaysPerBin; ++ray) {
      const float du = jitter.next(), dv = jitter.next();
      const glm::vec3 direction = directionAt(bin, du, dv);
      const glm::vec3 origin = from.point(jitter);
      // Normals of this side turn up to 55 degrees from its axis, so a direction may serve though it is
      // behind the axis.
      const float cosine = 0.1f + glm::dot(direction, from.axis);
      if (cosine <= -0.6f) continue;
      const float value = meanOf(environment_.radiance(direction)) * std::max(cosine, 0.1f);
      if (value > 0.0f) histogramRays.add(origin, direction, bin, value);
    }
  }
  histogramRays.flush();

  float asked = 0.0f, arrived = 0.0f;
  const auto count = [&](int, float value) { arrived += value; };
  PacketQueue environmentRays(embree_, count);
  for (int i = 0; i < kEnvironmentRays; ++i) {
    const float u = (static_cast<float>(i) + jitter.next()) / kEnvironmentRays;
    const EnvironmentSample s = environment_.sample({u, jitter.next()});
    const glm::vec3 origin = from.point(jitter);
    const float cosine = glm::dot(s.direction, from.axis);
    if (!(s.pdf > 0.0f) || cosine <= 0.0f) continue;
    asked += cosine;
    environmentRays.add(origin, s.direction, 0, cosine);
  }
  environmentRays.flush();

  auto view = std::make_unique<View>();
  // A little of each bin's light goes to its neighbours: the rays see a bin at a few points only.
  float sum = 0.0f;
  for (int row = 0; row < kEdge; ++row) {
    for (int column = 0; column < kEdge; ++column) {
      float value = 0.0f;
      for (int r = std::max(row - 1, 0); r <= std::min(row + 1, kEdge - 1); ++r) {
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, kEdge - 1); ++c) {
          value += seen[static_cast<std::size_t>(r * kEdge + c)] * (r == row && c == column ? 1.0f : 0.05f);
        }
      }
      sum += value;
      view->cumulative[static_cast<std::size_t>(row * kEdge + column)] = sum;
    }
  }
  if (sum > 0.0f) {
    for (float& c : view->cumulative) c /= sum;
    view->cumulative.back() = 1.0f;
    for (std::size_t row = 0; row < kEdge; ++row)
      view->rowEnds[row] = view->cumulative[(row + 1) * kEdge - 1];
    const float arrivedShare = asked > 0.0f ? arrived / asked : 0.0f;
    view->share = std::clamp(1.0f - arrivedShare, kLeastShare, kMostShare);
  }
  return view;
}

EnvironmentSample SkyGuide::sample(const View& view, float choose, glm::vec2 u) const {
  EnvironmentSample s;
  if (choose >= view.share) {
    s = environment_.sample(u);
    if (!(s.pdf > 0.0f)) return s;
  } else {
    const float which = std::min(choose / view.share, kOneBelow);
    const auto rowEnd = std::upper_bound(view.rowEnds.begin(), view.rowEnds.end() - 1, which);
    const auto row = view.cumulative.begin() + (rowEnd - view.rowEnds.begin()) * kEdge;
    const auto found = std::upper_bound(row, row + kEdge, which);
    const int bin = std::min(static_cast<int>(found - view.cumulative.begin()), kBins - 1);
    s.direction = directionAt(bin, u.x, u.y);
    s.radiance = environment_.radiance(s.direction);
  }
  s.pdf = pdf(view, s.direction);
  return s;
}

float SkyGuide::pdf(const View& view, const glm::vec3& direction) const {
  const float plain = environment_.pdf(direction);
  if (view.share <= 0.0f) return plain;
  const auto bin = static_cast<std::size_t>(binOf(direction));
  const float mass = view.cumulative[bin] - (bin > 0 ? view.cumulative[bin - 1] : 0.0f);
  return view.share * mass * (kBins / (4.0f * kPi)) + (1.0f - view.share) * plain;
}

}  // namespace promenade::render
