#pragma once
// Surfaces that send on far more light than others, as lights: a patch of sun on a floor or a window sill,
// which lights a room through a few cells of the hemisphere that paths leaving by the cosine rarely hit.
// Points on them are chosen as points on lamps are (light_tree.h), from what a few rays say can be seen from
// each part of the scene (as in Vevoda, Kondapaneni, Krivanek, Bayesian Online Regression for Adaptive Direct
// Illumination Sampling (SIGGRAPH 2018), but learned beforehand: sky_guide.h), and combined with the paths
// that find them by chance (multiple importance sampling), so what is bright here need only be roughly known:
// errors cost noise, not bias. (A many-light method: Keller, Instant Radiosity (SIGGRAPH 1997); Walter et
// al., Lightcuts (SIGGRAPH 2005); but its lights are pieces of surfaces with a density, so that nothing has
// to be clamped near them.) Not part of the folder's public face.

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "src/render/cell_views.h"
#include "src/render/light_tree.h"
#include "src/render/surfaces.h"

namespace promenade::render {

class BrightSurfaces {
 public:
  /// Luminance that the hit point of a surface sends back along a ray of that unit direction, averaged over
  /// about `width`. Any number of threads ask.
  using Luminance = std::function<float(const Hit& hit, const glm::vec3& direction, float width)>;

  /// Asks `luminance` for small pieces of all surfaces, straight from either side. `surfaces` and `embree`
  /// must outlive this; `luminance` need not.
  BrightSurfaces(const Surfaces& surfaces, const EmbreeScene& embree, const Luminance& luminance);

  [[nodiscard]] bool empty() const { return pieces_.empty(); }
  [[nodiscard]] std::size_t size() const { return pieces_.size(); }
  /// Their part of all the light that surfaces send on.
  [[nodiscard]] float share() const { return share_; }

  struct Chosen {
    Hit hit;                    ///< as a ray from `position` would find it
    glm::vec3 direction{0.0f};  ///< unit, toward it
    glm::vec3 target{0.0f};     ///< where a shadow ray ends, just off the surface
    float pdf = 0.0f;           ///< per solid angle, > 0
  };
  /// A point for the surface at `position` with unit `normal`; nothing if it is seen from behind.
  [[nodiscard]] std::optional<Chosen> sample(const glm::vec3& position, const glm::vec3& normal, float choose,
                                             glm::vec2 u) const;
  /// The density per solid angle with which sample() chooses a point found by a ray of unit `direction` from
  /// `position`, `distance` away; 0 if it is not among the bright.
  [[nodiscard]] float pdf(const Hit& hit, const glm::vec3& direction, float distance,
                          const glm::vec3& position, const glm::vec3& normal) const;

 private:
  enum class Side : std::uint32_t { kFront, kBack };
  /// One of the `divisions`^2 equal parts of a triangle, on one side.
  struct Piece {
    std::uint32_t instance = 0, triangle = 0;
    std::uint32_t place = 0;  ///< part * 2 + side: pieces of one triangle are sorted by it
    std::uint32_t divisions = 1;
  };
  /// The bright pieces of a triangle, in pieces_.
  struct Range {
    std::uint32_t begin = 0, end = 0;
  };
  /// Neighbouring pieces that face nearly the same way: what is seen from a cell or not.
  struct Group {
    std::vector<std::uint32_t> pieces;
    LightTree tree;
    std::vector<float> cumulative;  ///< of the pieces' intensities
  };
  static constexpr std::size_t kMostGroups = 128;
  /// How much light each group sends to a cell: cumulative, the last is 1 (unless nothing comes).
  struct View {
    std::array<float, kMostGroups> cumulative{};
    bool isDark = true;
  };
  struct Membership {
    std::uint32_t group = 0, index = 0;
  };
  struct Triangle {
    std::uint32_t instance, triangle;
    friend bool operator==(const Triangle&, const Triangle&) = default;
  };
  struct TriangleHash {
    std::size_t operator()(const Triangle& t) const {
      return (std::uint64_t{t.instance} << 32 | t.triangle) * 0x9e3779b97f4a7c15ull >> 7;
    }
  };

  void gather(std::vector<std::uint32_t> pieces, std::span<const LightBounds> lights, std::size_t groups);
  [[nodiscard]] const View& viewFrom(const glm::vec3& position, const glm::vec3& normal) const;
  [[nodiscard]] std::unique_ptr<View> look(const CellSide& from) const;
  struct Point {
    glm::vec2 barycentric{0.0f};
    glm::vec3 position{0.0f};
    glm::vec3 out{0.0f};  ///< unit normal on the bright side
    float area = 0.0f;    ///< of the piece
  };
  [[nodiscard]] Point pointOn(const Piece& piece, glm::vec2 u) const;

  const Surfaces& surfaces_;
  const EmbreeScene& embree_;
  std::vector<Piece> pieces_;
  std::vector<Group> groups_;
  std::vector<Membership> groupOf_;  // of each piece
  std::unordered_map<Triangle, Range, TriangleHash> ranges_;
  CellViews<View> views_;
  float share_ = 0.0f;
};

}  // namespace promenade::render
