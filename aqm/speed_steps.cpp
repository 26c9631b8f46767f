#include "aqm/speed_steps.h"

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "aqm/retina.h"

namespace promenade::aqm {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<float, 8>;

/// Faster motion counts as this, in its own direction; squares stay finite.
constexpr float kFastest = 1e6f;

/// retinalVelocity() of a row, in single precision.
void retinalRow(const VelocityMap& velocity, int y, Eye eye, float* vx, float* vy) {
  const auto row = velocity.row(y);
  for (std::size_t x = 0; x < row.size(); ++x) {
    const float largest = std::max({std::abs(row[x].x), std::abs(row[x].y), kFastest});
    vx[x] = row[x].x * (kFastest / largest);
    vy[x] = row[x].y * (kFastest / largest);
  }
  if (eye != Eye::kTracking) {
    return;
  }
  for (std::size_t x = 0; x < row.size(); ++x) {
    const float image = std::sqrt(vx[x] * vx[x] + vy[x] * vy[x]);
    const float pursuit = std::min(0.82f * image + 0.15f, 80.0f);
    const float rest = image > 0.0f ? (image - pursuit) / image : 0.0f;
    vx[x] *= rest;
    vy[x] *= rest;
  }
}

struct Range {
  int least = 65535;
  int greatest = 0;
};

/// Steps of the speeds, and their range among the first `width`.
Range stepRow(const float* speeds, float slowest, int greatest, int width, int stride, std::uint16_t* steps) {
  const Lanes tag;
  const auto perSlowest = hn::Set(tag, 1.0f / slowest);
  const auto one = hn::Set(tag, 1.0f);
  const auto scale = hn::Set(tag, static_cast<float>(kSpeedSteps));
  const auto last = hn::Set(tag, static_cast<float>(greatest));
  alignas(64) std::int32_t numbers[8];
  for (int x = 0; x < stride; x += static_cast<int>(hn::Lanes(tag))) {
    const auto ratio = hn::Max(one, hn::Mul(hn::Load(tag, speeds + x), perSlowest));
    const auto position = hn::Min(last, hn::Mul(scale, hn::Log2(tag, ratio)));
    hn::Store(hn::NearestInt(position), hn::RebindToSigned<Lanes>(), numbers);
    for (int i = 0; i < static_cast<int>(hn::Lanes(tag)); ++i) {
      steps[x + i] = static_cast<std::uint16_t>(numbers[i]);
    }
  }
  const auto [least, most] = std::minmax_element(steps, steps + width);
  return {*least, *most};
}

}  // namespace

SpeedSteps speedSteps(const VelocityMap& velocity, int orientations, Eye eye) {
  SpeedSteps result;
  result.levels = speedLevels(eye);
  if (velocity.empty()) {
    return result;
  }
  std::vector<glm::vec2> directions;
  for (int l = 0; orientations > 1 && l < orientations; ++l) {
    directions.emplace_back(acrossBars(l, orientations));
  }
  for (std::size_t i = 0; i <= directions.size(); ++i) {
    result.planes.emplace_back(velocity.width(), velocity.height());
  }
  const auto slowest = static_cast<float>(result.levels.slowest);
  const int greatest = result.levels.last * kSpeedSteps;
  std::vector<Range> ranges(static_cast<std::size_t>(velocity.height()));
  tbb::parallel_for(0, velocity.height(), [&](int y) {
    Plane<float> rows(velocity.width(), 3);
    const float* vx = rows.row(0);
    const float* vy = rows.row(1);
    float* speeds = rows.row(2);
    retinalRow(velocity, y, eye, rows.row(0), rows.row(1));
    Range& range = ranges[static_cast<std::size_t>(y)];
    for (std::size_t l = 0; l < result.planes.size(); ++l) {
      if (l < directions.size()) {
        const glm::vec2 across = directions[l];
        for (int x = 0; x < rows.stride(); ++x) {
          speeds[x] = std::abs(vx[x] * across.x + vy[x] * across.y);
        }
      } else {
        for (int x = 0; x < rows.stride(); ++x) {
          speeds[x] = std::sqrt(vx[x] * vx[x] + vy[x] * vy[x]);
        }
      }
      const Range found =
          stepRow(speeds, slowest, greatest, velocity.width(), rows.stride(), result.planes[l].row(y));
      range = {std::min(range.least, found.least), std::max(range.greatest, found.greatest)};
    }
  });
  Range all;
  for (const Range& range : ranges) {
    all = {std::min(all.least, range.least), std::max(all.greatest, range.greatest)};
  }
  result.first = all.least / kSpeedSteps;
  result.last = (all.greatest + kSpeedSteps - 1) / kSpeedSteps;
  result.fastest = result.levels.slowest * std::exp2(static_cast<double>(all.greatest) / kSpeedSteps);
  return result;
}

}  // namespace promenade::aqm
