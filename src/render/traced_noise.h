#pragma once
// How much noise is left in a reflection that is traced until it is clean (pilot.h). Not part of the folder's
// public face.

namespace promenade::render {

/// Standard error of a sample of a strong reflection, as a share of all it shows, at which tracing stops:
/// between this and 1.4 times as much, as paths are doubled.
constexpr float kStrongNoise = 0.1f;
/// Below this roughness a lobe shows so little of the surroundings that its paths find nearly the same; such
/// surfaces are often large and flat (polished floors), where noise is seen best. They may be clean after a
/// few paths, and are traced to less noise.
constexpr float kNarrow = 0.1f;

}  // namespace promenade::render
