#include "src/app/motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace promenade::app {
namespace {

bool valid(const glm::vec2& flow) {
  return std::isfinite(flow.x) && std::isfinite(flow.y);
}

}  // namespace

PixelFlow flowToPrevious(const PixelFlow& previousFrameToNext) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  PixelFlow result(previousFrameToNext.size(), glm::vec2(nan));
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x) {
      const glm::vec2 flow = previousFrameToNext(x, y);
      if (!valid(flow)) continue;
      const float toX = std::floor(static_cast<float>(x) + flow.x + 0.5f);
      const float toY = std::floor(static_cast<float>(y) + flow.y + 0.5f);
      if (!(toX >= 0.0f && toY >= 0.0f && toX < static_cast<float>(result.width()) &&
            toY < static_cast<float>(result.height()))) {
        continue;
      }
      result(static_cast<int>(toX), static_cast<int>(toY)) = -flow;
    }
  }
  return result;
}

PixelFlow meanFlow(const PixelFlow& a, const PixelFlow& b) {
  if (a.empty()) return b.clone();
  if (b.empty()) return a.clone();
  PixelFlow mean(a.size());
  const auto first = a.pixels();
  const auto second = b.pixels();
  const auto out = mean.pixels();
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (valid(first[i]) && valid(second[i])) {
      out[i] = (first[i] + second[i]) * 0.5f;
    } else {
      out[i] = valid(first[i]) ? first[i] : second[i];
    }
  }
  return mean;
}

bool isStill(const PixelFlow& flow) {
  const auto pixels = flow.pixels();
  return !pixels.empty() &&
         std::all_of(pixels.begin(), pixels.end(), [](const glm::vec2& f) { return f == glm::vec2(0.0f); });
}

}  // namespace promenade::app
