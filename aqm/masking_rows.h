#pragma once
// The formulas of masking.h along rows, eight pixels at a time. `count` is a multiple of 8; rows are aligned
// as those of a Plane, but for `elevations` written to.

namespace promenade::aqm {

/// (1 + (strength response)^4)^(1/4).
void elevateByUnitKnee(const float* responses, double strength, float* elevations, int count);

/// sums += (|test - reference| / min(elevations))^3.5
void addDifferences(const float* test, const float* reference, const float* testElevation,
                    const float* referenceElevation, float* sums, int count);

}  // namespace promenade::aqm
