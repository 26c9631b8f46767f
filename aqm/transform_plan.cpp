#include "aqm/transform_plan.h"

#include <algorithm>
#include <bit>

#include "aqm/fast_bank.h"
#include "aqm/retina.h"
#include "aqm/speed_field.h"

namespace promenade::aqm {
namespace {

/// Speed levels that the plain execution transforms for a channel of centre frequency `rho`.
int levelsOf(const VelocityMap& retinal, Size size, int orientation, double rho, const Settings& settings) {
  const bool byLevels = (settings.csf == Csf::kKellyDaly || settings.csf == Csf::kDalyMoving) &&
                        settings.csfPlacement == CsfPlacement::kWithinBands;
  if (!byLevels) {
    return 1;
  }
  const double onset = onsetSpeed(settings.onsetHertz, rho);
  return std::popcount(
      speedField(retinal, size, orientation, settings.orientations, settings.eye, onset).levels);
}

}  // namespace

std::vector<PlannedTransforms> plannedTransforms(Size size, const VelocityMap& velocity,
                                                 const Settings& settings) {
  const double ppd = settings.pixelsPerDegree;
  const Layout layout =
      layoutOf(size, ppd, settings.radialBands == 0 ? bandCount(ppd) : settings.radialBands);
  std::vector<PlannedTransforms> result{{layout.padded, 2, 0}};
  const auto addInverse = [&](Size padded, int count) {
    const auto same = std::ranges::find(result, padded, &PlannedTransforms::size);
    if (same == result.end()) {
      result.push_back({padded, 0, count});
    } else {
      same->inverse += count;
    }
  };
  const FilterBank filters(settings.decomposition, layout.bands, settings.orientations);
  if (const std::optional<SpeedSteps> speeds = speedsToRunFast(velocity, settings)) {
    for (const BandPlan& plan : bandPlans(layout, filters, settings, Adaptation{}, *speeds)) {
      const int channels = plan.band > layout.bands ? 1 : settings.orientations;
      addInverse(plan.grid.padded, 2 * channels * static_cast<int>(plan.terms.shapes.size()));
    }
    return result;
  }
  const VelocityMap retinal = retinalVelocities(velocity, settings.eye);
  for (int l = 0; l < settings.orientations; ++l) {
    const int orientation = settings.orientations == 1 ? kUnoriented : l;
    // Without an onset every band has the same speeds.
    const int different = settings.onsetHertz > 0.0 ? layout.bands : 1;
    for (int band = 1; band <= different; ++band) {
      const int levels = levelsOf(retinal, size, orientation, ppd * filters.centre(band), settings);
      addInverse(layout.padded, 2 * (layout.bands / different) * levels);
    }
  }
  const double lowest = ppd * filters.centre(layout.bands + 1);
  addInverse(layout.padded, 2 * levelsOf(retinal, size, kUnoriented, lowest, settings));
  return result;
}

}  // namespace promenade::aqm
