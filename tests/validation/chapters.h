#pragma once
// What the page consists of, in its order. `data` is the folder of the published data.

#include <filesystem>
#include <vector>

#include "tests/validation/report.h"
#include "tests/validation/threshold.h"

namespace promenade::validation {

void reportModelfest(Report& report, const std::filesystem::path& data);
void reportSensitivities(Report& report, const std::filesystem::path& data);
void reportRipple(Report& report);
void reportEdgesInNoise(Report& report, const std::filesystem::path& data);
void reportStability(Report& report);
/// Daly's list of tests (1993; course notes 2000, slides 39 to 51).
void reportPsychometricSlope(Report& report);
void reportSummation(Report& report);
void reportContrastMasking(Report& report);
void reportChannelShapes(Report& report);
void reportLightAdaptation(Report& report);
void reportNoiseOnTheCsf(Report& report);
void reportEdgesAtGreyLevels(Report& report);
void reportBlur(Report& report);
void reportVernier(Report& report);
void reportMotion(Report& report);

}  // namespace promenade::validation
