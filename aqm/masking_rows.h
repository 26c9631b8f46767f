#pragma once
// The formulas of masking.h along rows, eight pixels at a time. `count` is a multiple of 8; rows are aligned
// as those of a Plane, but for `elevations` written to.

namespace promenade::aqm {

/// A strip of this many columns stays in the cache while a filter runs down it.
inline constexpr int kStripWidth = 256;
/// What a thread takes at a time.
inline constexpr int kRowsPerBlock = 16;

/// (1 + (strength response)^4)^(1/4).
void elevateByUnitKnee(const float* responses, double strength, float* elevations, int count);

/// sums += (|test - reference| / min(elevations))^3.5
void addDifferences(const float* test, const float* reference, const float* testElevation,
                    const float* referenceElevation, float* sums, int count);

}  // namespace promenade::aqm
