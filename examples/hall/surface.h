#pragma once
// Triangle surfaces and the few ways the hall's geometry is made. Metres, +Y up, triangles counter-clockwise
// seen from outside, normals unit length, texture coordinates in metres unless said otherwise.

#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace promenade::hall {

struct Surface {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;
  std::vector<glm::dvec2> texCoords;
  std::vector<std::uint32_t> indices;

  /// Appends a copy of `other`, moved by `placement` (a rotation, translation and positive scale).
  Surface& add(const Surface& other, const glm::dmat4& placement = glm::dmat4(1.0));
  /// Appends a flat quadrilateral, corners counter-clockwise; (0,0) of the texture at the first corner and
  /// its axes along a->b and a->d.
  Surface& addQuad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);
  Surface& scaleTexture(const glm::dvec2& factor);
  [[nodiscard]] std::size_t triangleCount() const { return indices.size() / 3; }
};

/// The surface p(u, v), u and v in [0, 1], as a grid of `columns` x `rows` quadrilaterals. Its outside is the
/// side dp/du x dp/dv points to; normals are derivatives, so closed surfaces have no seam. Texture
/// coordinates are (u, v) * `textureScale`.
using Parametric = std::function<glm::dvec3(double u, double v)>;
[[nodiscard]] Surface parametric(const Parametric& p, int columns, int rows, glm::dvec2 textureScale);

/// Smooth pieces of a profile; the edge between two pieces is sharp. Points are (distance from the axis or
/// wall, height).
class Profile {
 public:
  explicit Profile(glm::dvec2 start) : last_(start) {}
  /// A sharp-edged straight piece.
  Profile& lineTo(glm::dvec2 end);
  /// A quarter-ellipse from the last point to `end`, bulging outward (torus, ovolo) or inward (scotia,
  /// cavetto).
  enum class Bulge { kOutward, kInward };
  Profile& quarterTo(glm::dvec2 end, Bulge bulge, int segments = 6);
  /// A smooth curve (Catmull-Rom) through the last point and `points`.
  Profile& curveThrough(const std::vector<glm::dvec2>& points, int segmentsEach = 6);
  [[nodiscard]] const std::vector<std::vector<glm::dvec2>>& pieces() const { return pieces_; }

 private:
  glm::dvec2 last_;
  std::vector<std::vector<glm::dvec2>> pieces_;
};

/// The profile turned about +Y. Going up along the profile, the outside is away from the axis.
[[nodiscard]] Surface lathe(const Profile& profile, int segments);

/// The profile (x outward from the wall, y up) drawn along +Z from `z0` to `z1`; same outside as lathe().
[[nodiscard]] Surface extrude(const Profile& profile, double z0, double z1);

/// A moulding around a rectangle in the plane z = 0, mitred at the corners. Profile points are (distance from
/// the opening's edge outward, height above the plane), listed from the opening's edge to the outer edge.
[[nodiscard]] Surface frame(double width, double height, const std::vector<glm::dvec2>& profile);

/// A box with its edges cut off by `chamfer`, flat shaded.
[[nodiscard]] Surface box(const glm::dvec3& low, const glm::dvec3& high, double chamfer = 0.0);

/// A tube of circular section along a closed (u = 0 meets u = 1) or open curve, without twist; ends stay
/// open.
enum class Ends { kClosed, kOpen };
[[nodiscard]] Surface tube(const std::function<glm::dvec3(double u)>& curve,
                           const std::function<double(double u)>& radius, int segmentsAlong,
                           int segmentsAround, Ends ends);

/// A cylinder with flat caps from `from` to `to`.
[[nodiscard]] Surface rod(const glm::dvec3& from, const glm::dvec3& to, double radius, int segments = 12);

[[nodiscard]] Surface sphere(double radius, int segments, int rings);

/// A wall in the plane z = 0 facing +Z, x in [-width/2, width/2], y in [bottom, top], with one round-headed
/// opening about x = 0 (sill, springing line, half width) whose reveal goes back to z = -depth.
struct ArchOpening {
  double sill;
  double springing;
  double halfWidth;
};
[[nodiscard]] Surface wallWithArch(double width, double bottom, double top, const ArchOpening& opening,
                                   double depth);
/// The opening filled: a flat surface facing +Z at z = 0.
[[nodiscard]] Surface archPane(const ArchOpening& opening);

[[nodiscard]] glm::dmat4 moved(const glm::dvec3& by);
/// Rotation about `axis`, then translation.
[[nodiscard]] glm::dmat4 turned(double radians, const glm::dvec3& axis,
                                const glm::dvec3& by = glm::dvec3(0.0));

}  // namespace promenade::hall
