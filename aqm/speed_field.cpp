#include "aqm/speed_field.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "aqm/csf.h"
#include "aqm/retina.h"

namespace promenade::aqm {

double levelSpeed(int level) {
  return std::ldexp(kDriftSpeed, level);
}

VelocityMap retinalVelocities(const VelocityMap& imageVelocity) {
  VelocityMap retinal(imageVelocity.size());
  tbb::parallel_for(0, retinal.height(), [&](int y) {
    for (int x = 0; x < retinal.width(); ++x) {
      retinal(x, y) = glm::vec2(retinalVelocity(glm::dvec2(imageVelocity(x, y))));
    }
  });
  return retinal;
}

SpeedField speedField(const VelocityMap& retinal, Size image, int orientation) {
  SpeedField field;
  for (Plane<float>* plane : {&field.speed, &field.octave, &field.gain}) {
    *plane = Plane<float>(image.width, image.height);
  }
  field.levelsOfRow.resize(static_cast<std::size_t>(image.height));
  const auto driftGain = static_cast<float>(speedGain(kDriftSpeed));
  tbb::parallel_for(0, image.height, [&](int y) {
    std::uint32_t levels = 0;
    for (int x = 0; x < image.width; ++x) {
      double speed = kDriftSpeed;
      if (!retinal.empty()) {
        speed = std::min(channelSpeed(glm::dvec2(retinal(x, y)), orientation), levelSpeed(kFastestLevel));
      }
      field.speed.row(y)[x] = static_cast<float>(speed);
      if (speed == kDriftSpeed) {
        // By far the commonest: where nothing moves, and wherever the motion is along the bars.
        field.gain.row(y)[x] = driftGain;
        levels |= 1u;
        continue;
      }
      const double octave = std::log2(speed / kDriftSpeed);
      const int below = static_cast<int>(octave);
      field.octave.row(y)[x] = static_cast<float>(octave);
      field.gain.row(y)[x] = static_cast<float>(speedGain(speed));
      levels |= octave > below ? 3u << below : 1u << below;
    }
    field.levelsOfRow[static_cast<std::size_t>(y)] = levels;
  });
  for (const std::uint32_t levels : field.levelsOfRow) {
    field.levels |= levels;
  }
  return field;
}

}  // namespace promenade::aqm
