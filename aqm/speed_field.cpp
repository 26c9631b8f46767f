#include "aqm/speed_field.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "aqm/csf.h"
#include "aqm/retina.h"

namespace promenade::aqm {

double SpeedLevels::speed(int level) const {
  return std::ldexp(slowest, level);
}

SpeedLevels speedLevels(Eye eye) {
  const double slowest = slowestSpeed(eye);
  return {slowest, 13 + static_cast<int>(std::lround(std::log2(kDriftSpeed / slowest)))};
}

VelocityMap retinalVelocities(const VelocityMap& imageVelocity, Eye eye) {
  VelocityMap retinal(imageVelocity.size());
  tbb::parallel_for(0, retinal.height(), [&](int y) {
    for (int x = 0; x < retinal.width(); ++x) {
      retinal(x, y) = glm::vec2(retinalVelocity(glm::dvec2(imageVelocity(x, y)), eye));
    }
  });
  return retinal;
}

SpeedField speedField(const VelocityMap& retinal, Size image, int orientation, int orientations, Eye eye,
                      double onset) {
  SpeedField field;
  field.steps = speedLevels(eye);
  const double slowest = field.steps.slowest;
  const double fastest = field.steps.speed(field.steps.last);
  const bool isOriented = orientation != kUnoriented;
  const glm::dvec2 across = isOriented ? acrossBars(orientation, orientations) : glm::dvec2(0.0);
  for (Plane<float>* plane : {&field.speed, &field.octave, &field.gain}) {
    *plane = Plane<float>(image.width, image.height);
  }
  field.levelsOfRow.resize(static_cast<std::size_t>(image.height));
  const auto octaveOf = [&](double speed) { return std::log2(speed / slowest); };
  // By far the commonest speed: where nothing moves, and wherever the motion is along the bars.
  const double still = std::min(std::hypot(slowest, onset), fastest);
  const double stillOctave = octaveOf(still);
  const auto stillGain = static_cast<float>(speedGain(still));
  const auto levelsAt = [](double octave) {
    const int below = static_cast<int>(octave);
    return octave > below ? 3u << below : 1u << below;
  };
  tbb::parallel_for(0, image.height, [&](int y) {
    std::uint32_t levels = 0;
    for (int x = 0; x < image.width; ++x) {
      double speed = slowest;
      if (!retinal.empty()) {
        const glm::dvec2 velocity(retinal(x, y));
        speed = isOriented ? channelSpeed(velocity, across, slowest) : channelSpeed(velocity, slowest);
      }
      const bool isStill = speed == slowest;
      const double seen = isStill ? still : std::min(std::hypot(speed, onset), fastest);
      const double octave = isStill ? stillOctave : octaveOf(seen);
      field.speed.row(y)[x] = static_cast<float>(seen);
      field.octave.row(y)[x] = static_cast<float>(octave);
      field.gain.row(y)[x] = isStill ? stillGain : static_cast<float>(speedGain(seen));
      levels |= levelsAt(octave);
    }
    field.levelsOfRow[static_cast<std::size_t>(y)] = levels;
  });
  for (const std::uint32_t levels : field.levelsOfRow) {
    field.levels |= levels;
  }
  return field;
}

}  // namespace promenade::aqm
