#include "paths/statistics.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>

#include "paths/rotation.h"

namespace promenade::paths {
namespace {

double meanOf(const std::vector<double>& values) {
  return values.empty()
             ? 0.0
             : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double maxOf(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

}  // namespace

std::vector<double> speeds(const CameraPath& path) {
  std::vector<double> result;
  for (std::size_t i = 1; i < path.frames.size(); ++i) {
    result.push_back(glm::distance(path.frames[i - 1].pose.eye, path.frames[i].pose.eye) *
                     path.framesPerSecond);
  }
  return result;
}

std::vector<double> turnRates(const CameraPath& path) {
  std::vector<double> result;
  for (std::size_t i = 1; i < path.frames.size(); ++i) {
    const double angle =
        angleBetween(path.frames[i - 1].pose.worldFromCamera, path.frames[i].pose.worldFromCamera);
    result.push_back(glm::degrees(angle) * path.framesPerSecond);
  }
  return result;
}

Statistics statisticsOf(const CameraPath& path) {
  const std::vector<double> speed = speeds(path);
  const std::vector<double> turning = turnRates(path);
  Statistics s;
  s.frames = path.frameCount();
  s.framesPerSecond = path.framesPerSecond;
  s.durationSeconds = s.frames / path.framesPerSecond;
  s.lengthMetres = std::accumulate(speed.begin(), speed.end(), 0.0) / path.framesPerSecond;
  s.meanSpeed = meanOf(speed);
  s.maxSpeed = maxOf(speed);
  s.meanTurnRate = meanOf(turning);
  s.maxTurnRate = maxOf(turning);
  const auto [low, high] = std::minmax_element(
      path.frames.begin(), path.frames.end(),
      [](const PathFrame& a, const PathFrame& b) { return a.verticalFieldOfView < b.verticalFieldOfView; });
  if (low != path.frames.end()) {
    s.minVerticalFieldOfView = glm::degrees(low->verticalFieldOfView);
    s.maxVerticalFieldOfView = glm::degrees(high->verticalFieldOfView);
  }
  return s;
}

}  // namespace promenade::paths
