#pragma once
// Does a sample of the source lie on the surface that the target sees? The question behind every validity.
//
// Two samples agree if they show one item, neither on the far side of a crease, and the chord between them
// runs along the surface: |(S - P) . (nS + nP)| / 2 <= tolerance. On a plane the chord is perpendicular to
// both normals; on a circle it is perpendicular to their sum, so a curved surface agrees with itself whatever
// its curvature, where a distance from either tangent plane alone would grow with the square of the chord.
// For a tessellated surface the remainder is at most half a chord times the angle between two triangles.
// The tolerance is a quarter of the width of a source sample at that depth, across the line of sight: in
// depth that is 0.25 z / (f |n.r|), which follows the slope. What it confuses is closer together than the
// samples can tell.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "src/core/frame.h"

namespace promenade::ibr {

/// Directions through the samples of a camera, linear in the image position, axis component 1, world axes.
class RayBasis {
 public:
  explicit RayBasis(const Camera& camera);
  /// Through the centre of sample (x, y).
  [[nodiscard]] glm::vec3 through(int x, int y) const {
    return corner_ + static_cast<float>(x) * right_ + static_cast<float>(y) * down_;
  }
  /// What `pixels` further adds to a direction.
  [[nodiscard]] glm::vec3 across(glm::vec2 pixels) const { return pixels.x * right_ + pixels.y * down_; }

 private:
  glm::vec3 corner_;
  glm::vec3 right_;
  glm::vec3 down_;
};

/// A point the target sees, as the source would have to see it. For the background only `item` counts.
struct SurfacePoint {
  ItemId item = kNoItem;
  glm::vec3 fromSourceEye{0.0f};  ///< world axes, metres
  glm::vec3 normal{0.0f};
  float tolerance = 0.0f;  ///< metres
};

/// The chord test: `n` and `m` are the normals at its ends.
inline bool chordRunsAlong(const glm::vec3& chord, const glm::vec3& n, const glm::vec3& m, float tolerance) {
  return std::abs(glm::dot(chord, n + m)) <= 2.0f * tolerance;
}

/// How far off a surface a point may be and still lie on it: a quarter of the width of a sample of `camera`
/// at that depth, and rounding. `otherEye`: the other eye that coordinates are relative to; far from the
/// origin they are rounded more coarsely.
class SurfaceTolerance {
 public:
  SurfaceTolerance(const Camera& camera, const glm::dvec3& otherEye);
  /// Metres, at this depth of `camera`.
  [[nodiscard]] float operator()(float depth) const { return rounding_ + quarterSample_ * depth; }

 private:
  float quarterSample_;  ///< a quarter of the width of a sample at depth 1
  float rounding_;
};

/// The surfaces that the samples of a frame lie on. Keeps a reference to the visibility.
class SampledSurface {
 public:
  /// `otherEye` is the eye of the target. `creaseDegrees`: the largest angle between the normals of samples
  /// that agree.
  SampledSurface(const Visibility& source, const glm::dvec3& otherEye, double creaseDegrees);

  /// Tolerance for points at this depth of the source, metres.
  [[nodiscard]] float tolerance(float sourceDepth) const { return tolerance_(sourceDepth); }

  [[nodiscard]] bool contains(int x, int y) const { return visibility_.depth.contains(x, y); }
  /// Whether sample (x, y) shows the surface of `point`. Precondition: contains(x, y).
  [[nodiscard]] bool agrees(int x, int y, const SurfacePoint& point) const;
  /// The surface at a sample. Precondition: contains(x, y).
  [[nodiscard]] SurfacePoint pointOf(int x, int y) const;

 protected:
  [[nodiscard]] float creaseCosine() const { return creaseCosine_; }

 private:
  const Visibility& visibility_;
  RayBasis rays_;
  SurfaceTolerance tolerance_;
  float creaseCosine_;
};

/// Warped samples are sources of nothing.
[[nodiscard]] inline bool isTraced(SampleSource source) {
  return source == SampleSource::kTraced || source == SampleSource::kTracedHole ||
         source == SampleSource::kTracedItem;
}

/// The same of a frame of which some samples were ray traced, and only those may be sources. Keeps references
/// to the frame.
class SourceSurface : public SampledSurface {
 public:
  SourceSurface(const Frame& source, const glm::dvec3& otherEye, double creaseDegrees);

  /// Whether sample (x, y) was ray traced, and may be a source at all.
  [[nodiscard]] bool isTraced(int x, int y) const;
  /// Whether the 4x4 samples (x-1..x+2, y-1..y+2) are all traced and lie on one smooth surface.
  [[nodiscard]] bool isSmoothBlock(int x, int y) const {
    return smoothBlocks_.contains(x, y) && smoothBlocks_(x, y) != 0;
  }

 private:
  struct LinkedRow {
    std::vector<std::optional<SurfacePoint>> points;  ///< nothing where not traced
    std::vector<std::uint8_t> goesOn;                 ///< whether a sample and the next are linked
  };
  [[nodiscard]] LinkedRow linkedRow(int y) const;
  /// Both traced, and on one smooth surface.
  [[nodiscard]] bool linked(const std::optional<SurfacePoint>& p, const std::optional<SurfacePoint>& q) const;

  const SourceMap& traced_;
  Mask smoothBlocks_;
};

// Inline: asked several times a sample.

inline bool SourceSurface::isTraced(int x, int y) const {
  return ibr::isTraced(traced_(x, y));
}

inline bool SampledSurface::agrees(int x, int y, const SurfacePoint& point) const {
  if (visibility_.item(x, y) != point.item) return false;
  if (point.item == kNoItem) return true;
  const glm::vec3& normal = visibility_.normal(x, y);
  if (!(glm::dot(normal, point.normal) >= creaseCosine_)) return false;
  const glm::vec3 chord = visibility_.depth(x, y) * rays_.through(x, y) - point.fromSourceEye;
  return chordRunsAlong(chord, normal, point.normal, point.tolerance);
}

}  // namespace promenade::ibr
