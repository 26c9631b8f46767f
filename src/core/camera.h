#pragma once
// A pinhole camera with square pixels (glTF convention: looks along -Z, +Y up, +X right).
// Pixel coordinates: x right, y down, the centre of pixel (i, j) at (i + 0.5, j + 0.5).

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "src/core/image.h"

namespace promenade {

/// A rigid placement: columns of `worldFromCamera` are the camera's right, up and backward axes
/// (orthonormal).
struct Pose {
  glm::dmat3 worldFromCamera{1.0};
  glm::dvec3 eye{0.0};
};

struct Projection {
  glm::dvec2 pixel;    ///< image position, may lie outside the image
  double depthMetres;  ///< along the view axis, > 0
};

class Camera {
 public:
  Camera() : Camera(Pose{}, 1.0, Size{1, 1}) {}
  /// `verticalFieldOfView` in radians, in (0, pi); `size` at least 1x1. Precondition, asserted.
  /// `subpixelOffset` moves every sample position by that many pixels (|offset| <= 0.5).
  Camera(const Pose& pose, double verticalFieldOfView, Size size, glm::dvec2 subpixelOffset = {0.0, 0.0});

  [[nodiscard]] const Pose& pose() const { return pose_; }
  [[nodiscard]] double verticalFieldOfView() const { return verticalFieldOfView_; }
  [[nodiscard]] Size size() const { return size_; }
  [[nodiscard]] glm::dvec2 subpixelOffset() const { return subpixelOffset_; }
  /// Focal length in pixels, the same in x and y.
  [[nodiscard]] double focalPixels() const { return focalPixels_; }

  /// World-space direction through image position `pixel` (a pixel centre is +0.5), scaled so that its
  /// component along the view axis is 1: the point at depth z is eye + z * direction.
  [[nodiscard]] glm::dvec3 direction(glm::dvec2 pixel) const;
  [[nodiscard]] glm::dvec3 pointAt(glm::dvec2 pixel, double depthMetres) const;
  /// Image position and depth of a world point; nothing if it is not in front of the eye.
  [[nodiscard]] std::optional<Projection> project(const glm::dvec3& worldPoint) const;
  /// The same for a point at infinity in `worldDirection`.
  [[nodiscard]] std::optional<glm::dvec2> projectDirection(const glm::dvec3& worldDirection) const;

  /// The same camera with `factor` samples along each pixel edge.
  [[nodiscard]] Camera supersampled(int factor) const;
  [[nodiscard]] Camera withSubpixelOffset(glm::dvec2 offset) const;

 private:
  [[nodiscard]] std::optional<Projection> projectLocal(const glm::dvec3& cameraSpace) const;

  Pose pose_;
  double verticalFieldOfView_;
  Size size_;
  glm::dvec2 subpixelOffset_;
  double focalPixels_;
};

}  // namespace promenade
