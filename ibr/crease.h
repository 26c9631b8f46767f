#pragma once
// Which parts of one item are one surface.

namespace promenade::ibr {

/// Samples of one item whose geometric normals differ by more lie on two sides of a crease: neither stands
/// for the other. A larger angle leaves fewer holes on ornaments and foliage finer than a sample, and shows
/// the face beside a bevel instead of the bevel. Degrees. Measured against 30.5 and 12: docs/method.md.
inline constexpr double kCreaseDegrees = 18.0;

}  // namespace promenade::ibr
