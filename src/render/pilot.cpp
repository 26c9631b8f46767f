#include "src/render/pilot.h"

#include <algorithm>
#include <cstdlib>

namespace promenade::render {
namespace {

struct Together {
  float variance = 0.0f;
  float squaredLimit = 0.0f;
  int count = 0;

  void add(const Pilot& pilot) {
    variance += pilot.variance;
    squaredLimit += pilot.squaredLimit;
    ++count;
  }
};

/// In all, of a reflection with this pilot, where one path has that variance.
int pathsUntil(float squaredLimit, float variance, const Pilot& pilot) {
  int paths = pilot.paths;
  while (paths < pilot.most && variance >= 2.0f * static_cast<float>(paths) * squaredLimit &&
         variance > 0.0f) {
    paths = std::min(2 * paths, pilot.most);
  }
  return paths;
}

Together around(std::span<const PilotedSample> samples, const PilotedSample& sample, std::size_t line) {
  Together together;
  for (const PilotedSample& other : samples) {
    const glm::ivec2 offset = other.position - sample.position;
    if (&other == &sample || other.instance != sample.instance || other.pilots.lines.size() <= line ||
        std::abs(offset.x) > kPilotReach || std::abs(offset.y) > kPilotReach) {
      continue;
    }
    together.add(other.pilots.lines[line]);
  }
  return together;
}

}  // namespace

void choosePaths(std::span<PilotedSample> samples) {
  for (PilotedSample& sample : samples) {
    for (std::size_t line = 0; line < sample.pilots.lines.size(); ++line) {
      Pilot& pilot = sample.pilots.lines[line];
      Together known = around(samples, sample, line);
      if (known.count < kLeastPilots) known.add(pilot);
      pilot.wanted = std::max(pathsUntil(known.squaredLimit, known.variance, pilot),
                              pathsUntil(kOutlier * kOutlier * pilot.squaredLimit, pilot.variance, pilot));
    }
  }
}

}  // namespace promenade::render
