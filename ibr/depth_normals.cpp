#include "ibr/depth_normals.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "ibr/source_surface.h"

namespace promenade::ibr {
namespace {

class Surface {
 public:
  Surface(const DepthMap& depth, const Camera& camera) : depth_(depth), rays_(camera) {}

  [[nodiscard]] glm::vec3 normal(int x, int y) const {
    if (!isHit(x, y)) return glm::vec3(0.0f);
    const glm::vec3 ray = rays_.through(x, y);
    const auto across = tangent(x, y, 1, 0);
    const auto down = tangent(x, y, 0, 1);
    if (!across || !down) return -glm::normalize(ray);
    const glm::vec3 normal = glm::cross(*down, *across);
    const float length = glm::length(normal);
    if (!(length > 0.0f)) return -glm::normalize(ray);
    return (glm::dot(normal, ray) > 0.0f ? -normal : normal) / length;
  }

 private:
  [[nodiscard]] bool isHit(int x, int y) const {
    return depth_.contains(x, y) && std::isfinite(depth_(x, y));
  }
  [[nodiscard]] glm::vec3 point(int x, int y) const { return depth_(x, y) * rays_.through(x, y); }

  // 1 / depth is linear across the image of a plane: how far three samples in a row are from one.
  [[nodiscard]] float bend(int x, int y, int dx, int dy) const {
    if (!isHit(x + dx, y + dy)) return std::numeric_limits<float>::infinity();
    // Without a third sample the step itself has to do.
    if (!isHit(x + 2 * dx, y + 2 * dy)) {
      return std::abs(1.0f / depth_(x, y) - 1.0f / depth_(x + dx, y + dy));
    }
    return std::abs(1.0f / depth_(x, y) - 2.0f / depth_(x + dx, y + dy) +
                    1.0f / depth_(x + 2 * dx, y + 2 * dy));
  }

  /// Towards growing x or y; nothing beside a sample that stands alone.
  [[nodiscard]] std::optional<glm::vec3> tangent(int x, int y, int dx, int dy) const {
    const float forward = bend(x, y, dx, dy);
    const float backward = bend(x, y, -dx, -dy);
    if (!std::isfinite(forward) && !std::isfinite(backward)) return std::nullopt;
    return forward <= backward ? point(x + dx, y + dy) - point(x, y) : point(x, y) - point(x - dx, y - dy);
  }

  const DepthMap& depth_;
  RayBasis rays_;
};

}  // namespace

NormalMap normalsOf(const DepthMap& depth, const Camera& camera) {
  assert(depth.size() == camera.size());
  NormalMap normals(depth.size());
  const Surface surface(depth, camera);
  tbb::parallel_for(0, depth.height(), [&](int y) {
    for (int x = 0; x < depth.width(); ++x) normals(x, y) = surface.normal(x, y);
  });
  return normals;
}

}  // namespace promenade::ibr
