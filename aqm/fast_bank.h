#pragma once
// What channels.h and masking.h do, in less time: bands on coarser grids (grid.h), few terms instead of many
// speed levels (speed_terms.h), only the coefficients that a channel passes (passband.h).

#include <optional>
#include <vector>

#include "aqm/filter_bank.h"
#include "aqm/grid.h"
#include "aqm/plane.h"
#include "aqm/settings.h"
#include "aqm/spectrum.h"
#include "aqm/speed_steps.h"
#include "aqm/speed_terms.h"

namespace promenade::aqm {

/// The speeds for fastPowers(); nothing where the formulas have to be executed one by one: asked for;
/// settings other than cortex filters, a CSF that knows of motion, global contrast, a unit knee or no
/// masking, no signed map; motion so fast on the retina that what is interpolated between pixels leaves its
/// bounds (docs/method.md, "Limit: very fast motion"). `velocity`: as for speedSteps().
[[nodiscard]] std::optional<SpeedSteps> speedsToRunFast(const VelocityMap& velocity,
                                                        const Settings& settings);

struct BandPlan {
  int band = 1;
  Grid grid;
  SpeedTerms terms;
};

/// How much is transformed for bands 1 .. K + 1.
[[nodiscard]] std::vector<BandPlan> bandPlans(const Layout& layout, const FilterBank& filters,
                                              const Settings& settings, const Adaptation& adaptation,
                                              const SpeedSteps& speeds);

/// sum d^3.5 over all channels, of the image's size; see DifferenceSum.
[[nodiscard]] Plane<float> fastPowers(const Layout& layout, const Spectrum& test, const Spectrum& reference,
                                      const FilterBank& filters, const Settings& settings,
                                      const Adaptation& adaptation, const SpeedSteps& speeds);

}  // namespace promenade::aqm
