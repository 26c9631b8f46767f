#pragma once
// Scenes whose visibility and radiance are known in closed form, ray cast in double precision.

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "src/core/frame.h"

namespace promenade::ibr::tests {

/// Radiance of a surface at a world point (of the background: in a unit direction).
using Texture = std::function<Rgb(const glm::dvec3&)>;

struct Hit {
  double distance;  ///< in lengths of the direction
  glm::dvec3 normal;
};
/// The nearest hit of a ray at a distance > 0.
using Intersect = std::function<std::optional<Hit>(const glm::dvec3& origin, const glm::dvec3& direction)>;

[[nodiscard]] Intersect rectangle(const glm::dvec3& corner, const glm::dvec3& edge,
                                  const glm::dvec3& otherEdge);
[[nodiscard]] Intersect sphere(const glm::dvec3& centre, double radius);
[[nodiscard]] Intersect box(const glm::dvec3& low, const glm::dvec3& high);
/// A round column along y, of flat faces: `sides` rectangles.
[[nodiscard]] Intersect prism(const glm::dvec3& base, double radius, double height, int sides);

[[nodiscard]] Texture uniform(Rgb radiance);
/// Smooth waves along all axes, `wavelength` in metres, values 0.1 to 0.9.
[[nodiscard]] Texture waves(double wavelength);
/// Black (0.05) and white (0.95) bars across x + y + z.
[[nodiscard]] Texture stripes(double period);

class AnalyticScene {
 public:
  AnalyticScene& add(ItemId item, Intersect shape, Texture texture);
  AnalyticScene& setBackground(Texture texture);

  [[nodiscard]] Visibility visibility(const Camera& camera) const;
  /// Diffuse radiance is the texture; a quarter of it is also in the view-dependent layer, so that both are
  /// tested.
  [[nodiscard]] Frame render(const Camera& camera) const;
  /// Whether nothing lies between.
  [[nodiscard]] bool sees(const glm::dvec3& eye, const glm::dvec3& point) const;

 private:
  struct Thing {
    ItemId item;
    Intersect shape;
    Texture texture;
  };
  struct Nearest {
    const Thing* thing = nullptr;
    Hit hit{};
  };
  [[nodiscard]] Nearest nearest(const glm::dvec3& origin, const glm::dvec3& direction) const;

  std::vector<Thing> things_;
  Texture background_ = uniform(Rgb(0.0f));
};

/// Looks along -z from `eye` with square 90 degree corners: a vertical field of view such that the focal
/// length is `focalPixels`.
[[nodiscard]] Camera cameraAt(const glm::dvec3& eye, Size size, double focalPixels);
/// Turned about the vertical by `yaw` radians (positive: to the left), then tilted by `pitch`, then rolled.
[[nodiscard]] Camera turnedCamera(const glm::dvec3& eye, double yaw, double pitch, double roll, Size size,
                                  double focalPixels);

/// Root of the mean square of the difference, over all channels.
[[nodiscard]] double rmse(const RadianceMap& a, const RadianceMap& b);
/// Peak signal-to-noise ratio of diffuse radiance with peak 1, over samples where `counts` is nonzero (empty:
/// all).
[[nodiscard]] double psnr(const RadianceMap& a, const RadianceMap& b, const Mask& counts);

}  // namespace promenade::ibr::tests
