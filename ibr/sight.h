#pragma once
// Does a frame see a given point, and through which of its samples? Between samples this can only be told
// from the surfaces that the samples around lie on.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

#include "ibr/source_surface.h"
#include "src/core/frame.h"

namespace promenade::ibr {

/// A point, as found among the samples of a frame.
struct Sighting {
  bool isInside = false;  ///< the frame looks there; else the rest says nothing
  int x = 0;              ///< of the 2x2 samples around it the upper left, which may lie outside by one
  int y = 0;
  /// Bit 2 j + i: sample (x+i, y+j) shows the surface of the point.
  std::uint8_t agreeing = 0;
  /// Likewise: it is in front of the point. Where none is, the point is seen, and the samples may well have
  /// missed it, as thin things are; where some are and some agree, an edge passes between them.
  std::uint8_t hiding = 0;
};

/// Keeps a reference to the visibility.
class Sight {
 public:
  /// `otherEye` is the eye of the frame whose points will be asked for (rounding), `creaseDegrees` as in
  /// WarpSettings.
  Sight(const Visibility& visibility, const glm::dvec3& otherEye, double creaseDegrees);

  /// `pixel`: where in the image the point is.
  [[nodiscard]] Sighting operator()(glm::vec2 pixel, const SurfacePoint& point) const;

  [[nodiscard]] float tolerance(float depth) const { return tolerance_(depth); }

  enum class Relation : std::uint8_t {
    kSame,     ///< the sample shows the surface of the point
    kInFront,  ///< it hides the point from its own place
    kBehind,   ///< the point would hide it
    kBeside,   ///< neither hides the other
  };
  /// Precondition: sample (x, y) is in the frame.
  [[nodiscard]] Relation relation(int x, int y, const SurfacePoint& point) const;

 private:
  const Visibility& visibility_;
  RayBasis rays_;
  SurfaceTolerance tolerance_;
  float creaseCosine_;
};

}  // namespace promenade::ibr
