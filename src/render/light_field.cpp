#include "src/render/light_field.h"

#include <hwy/highway.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/packing.hpp>

#include "src/render/maths.h"

namespace promenade::render {
namespace {

/// A light on the horizon gives a surface nothing, and says nothing of its radiance.
constexpr float kLeastFieldCosine = 0.02f;

/// Of RGB9E5, and of float.
constexpr std::uint32_t kMantissa = 0x1ffu, kBias = 15 + 9, kFloatBias = 127;
constexpr int kFloatMantissa = 23;

/// Shirley, Chiu, A Low Distortion Map Between Disk and Square (JGT 2(3), 1997), both ways.
glm::vec3 directionAt(glm::vec2 square) {
  const glm::vec2 p = 2.0f * square - 1.0f;
  if (p.x == 0.0f && p.y == 0.0f) return {0.0f, 0.0f, 1.0f};
  const bool alongX = std::abs(p.x) > std::abs(p.y);
  const float r = alongX ? p.x : p.y;
  const float phi = alongX ? kPi / 4.0f * (p.y / p.x) : kPi / 2.0f - kPi / 4.0f * (p.x / p.y);
  const float inner = std::max(0.0f, 1.0f - r * r);
  const float z = inner * inner;
  const float sine = std::copysign(std::sqrt(std::max(0.0f, 1.0f - z * z)), r);
  return {sine * std::cos(phi), sine * std::sin(phi), z};
}

glm::vec2 squareAt(const glm::vec3& direction) {
  const float r = std::sqrt(std::max(0.0f, 1.0f - std::sqrt(std::max(0.0f, direction.z))));
  float phi = std::atan2(direction.y, direction.x);
  if (phi < -kPi / 4.0f) phi += 2.0f * kPi;
  const int quadrant = std::clamp(static_cast<int>((phi + kPi / 4.0f) / (kPi / 2.0f)), 0, 3);
  const float across = r * (phi - static_cast<float>(quadrant) * kPi / 2.0f) / (kPi / 4.0f);
  glm::vec2 p;
  switch (quadrant) {
    case 0:
      p = {r, across};
      break;
    case 1:
      p = {-across, r};
      break;
    case 2:
      p = {-r, -across};
      break;
    default:
      p = {across, -r};
  }
  return glm::clamp(0.5f * p + 0.5f, 0.0f, 1.0f);
}

/// Calls add(cell, weight) for the four cells around a direction; the weights sum to 1.
template <class Add>
void spread(const glm::vec3& direction, const Add& add) {
  const glm::vec2 at = glm::clamp(squareAt(direction) * static_cast<float>(LightField::kSide) - 0.5f, 0.0f,
                                  static_cast<float>(LightField::kSide - 1));
  const glm::vec2 low = glm::min(glm::floor(at), static_cast<float>(LightField::kSide - 2));
  const glm::vec2 part = at - low;
  const auto first = static_cast<std::size_t>(low.y) * LightField::kSide + static_cast<std::size_t>(low.x);
  add(first, (1.0f - part.x) * (1.0f - part.y));
  add(first + 1, part.x * (1.0f - part.y));
  add(first + LightField::kSide, (1.0f - part.x) * part.y);
  add(first + LightField::kSide + 1, part.x * part.y);
}

}  // namespace

const std::array<glm::vec3, LightField::kCells>& LightField::directions() {
  static const auto table = [] {
    std::array<glm::vec3, kCells> directions;
    for (std::size_t i = 0; i < kCells; ++i) {
      const glm::vec2 cell(static_cast<float>(i % kSide), static_cast<float>(i / kSide));
      directions[i] = directionAt((cell + 0.5f) / static_cast<float>(kSide));
    }
    return directions;
  }();
  return table;
}

const std::array<float, LightField::kCells>& LightField::solidAngles() {
  // Each cell counts for what spread() gives it of light from everywhere.
  static const auto table = [] {
    constexpr int kSteps = 64 * kSide;
    std::array<double, kCells> sums{};
    for (int y = 0; y < kSteps; ++y) {
      for (int x = 0; x < kSteps; ++x) {
        const glm::vec3 direction = directionAt((glm::vec2(x, y) + 0.5f) / static_cast<float>(kSteps));
        spread(direction, [&](std::size_t cell, float weight) { sums[cell] += weight / pdf(direction); });
      }
    }
    double whole = 0.0;
    for (const double sum : sums) whole += sum;
    std::array<float, kCells> angles;
    for (std::size_t i = 0; i < kCells; ++i) angles[i] = static_cast<float>(2.0 * kPi * sums[i] / whole);
    return angles;
  }();
  return table;
}

glm::vec3 LightField::sample(glm::vec2 u) {
  return directionAt(u);
}

float LightField::pdf(const glm::vec3& direction) {
  // dz = 4 r (1 - r^2) dr, of a disk with area pi
  return 1.0f / (4.0f * kPi * std::sqrt(std::max(direction.z, 1e-6f)));
}

Rgb LightField::at(std::size_t cell) const {
  // As glm::unpackF3x9_E1x5() does, without its call of pow().
  const std::uint32_t bits = packed_[cell];
  const auto scale = std::bit_cast<float>(((bits >> 27) + kFloatBias - kBias) << kFloatMantissa);
  return scale * Rgb(bits & kMantissa, (bits >> 9) & kMantissa, (bits >> 18) & kMantissa);
}

void LightField::set(std::size_t cell, const Rgb& radiance) {
  packed_[cell] = glm::packF3x9_E1x5(radiance);
}

float LightField::Weights::sum() const {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<float, kLanes> tag;
  auto sums = hn::Zero(tag);
  for (std::size_t i = 0; i < kCells; i += hn::Lanes(tag)) sums = hn::Add(sums, hn::Load(tag, at(i)));
  return hn::GetLane(hn::SumOfLanes(tag, sums));
}

Rgb LightField::weighted(const Weights& weights) const {
  // at() of all lanes.
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<float, kLanes> tag;
  const hn::RebindToUnsigned<decltype(tag)> bitsTag;
  const hn::RebindToSigned<decltype(tag)> signedTag;
  const auto bias = hn::Set(bitsTag, kFloatBias - kBias);
  const auto mantissa = hn::Set(bitsTag, kMantissa);
  auto r = hn::Zero(tag), g = r, b = r;
  for (std::size_t i = 0; i < kCells; i += hn::Lanes(tag)) {
    const auto bits = hn::Load(bitsTag, packed_.data() + i);
    const auto scale =
        hn::BitCast(tag, hn::ShiftLeft<kFloatMantissa>(hn::Add(hn::ShiftRight<27>(bits), bias)));
    const auto weight = hn::Mul(scale, hn::Load(tag, weights.at(i)));
    const auto channel = [&](auto shifted) {
      return hn::ConvertTo(tag, hn::BitCast(signedTag, hn::And(shifted, mantissa)));
    };
    r = hn::MulAdd(weight, channel(bits), r);
    g = hn::MulAdd(weight, channel(hn::ShiftRight<9>(bits)), g);
    b = hn::MulAdd(weight, channel(hn::ShiftRight<18>(bits)), b);
  }
  const auto total = [&](auto lanes) { return hn::GetLane(hn::SumOfLanes(tag, lanes)); };
  return {total(r), total(g), total(b)};
}

void FieldSums::addPath(const glm::vec3& direction, const Rgb& radiance) {
  spread(direction, [&](std::size_t cell, float weight) {
    paths_[cell] += weight * radiance;
    weights_[cell] += weight;
  });
}

void FieldSums::addLight(std::size_t kind, const glm::vec3& direction, const Rgb& share) {
  if (!(direction.z > kLeastFieldCosine)) return;
  // share = L cos / pi per solid angle
  const Rgb arriving = share * (kPi / direction.z);
  spread(direction, [&](std::size_t cell, float weight) { lights_[kind][cell] += weight * arriving; });
}

std::array<Rgb, LightField::kCells> FieldSums::seen() const {
  Rgb all(0.0f);
  float weights = 0.0f;
  for (std::size_t i = 0; i < LightField::kCells; ++i) {
    // Every cell alike, however many paths were sent there.
    if (!(weights_[i] > 0.0f)) continue;
    all += paths_[i] * (LightField::solidAngles()[i] / weights_[i]);
    weights += LightField::solidAngles()[i];
  }
  const Rgb mean = weights > 0.0f ? all / weights : Rgb(0.0f);
  constexpr float kUnknown = 0.25f;  // of a path: how much a cell without paths is taken to be like the rest
  std::array<Rgb, LightField::kCells> seen;
  for (std::size_t i = 0; i < LightField::kCells; ++i) {
    seen[i] = (paths_[i] + kUnknown * mean) / (weights_[i] + kUnknown);
  }
  return seen;
}

LightField FieldSums::finish(const std::array<int, kKinds>& samples, float unit) const {
  const auto radiance = seen();
  LightField field;
  for (std::size_t i = 0; i < LightField::kCells; ++i) {
    Rgb lit(0.0f);
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
      if (samples[kind] > 0) lit += lights_[kind][i] / static_cast<float>(samples[kind]);
    }
    field.set(i, (radiance[i] + lit / LightField::solidAngles()[i]) / unit);
  }
  return field;
}

}  // namespace promenade::render
