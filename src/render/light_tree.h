#pragma once
// Chooses one of many lights with a probability near its share of the light that arrives, by a bounding
// hierarchy. Conty Estevez, Kulla, Importance Sampling of Many Lights with Adaptive Tree Splitting (2018), in
// the form of PBRT 4th ed., 12.6.3. Departs from PBRT: the weight of a light is its peak intensity (not its
// power), so that triangles and point lights are on one scale, and the distance is bounded below by the
// radius of the node's sphere. Not part of the folder's public face.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace promenade::render {

/// What a light, or a group of lights, sends where: within thetaO of the axis there are emitters' normals,
/// and each shines up to thetaE away from its normal.
struct LightBounds {
  glm::vec3 lower{0.0f}, upper{0.0f};
  glm::vec3 axis{0.0f, 0.0f, 1.0f};
  float cosThetaO = 1.0f;
  float cosThetaE = 0.0f;
  float intensity = 0.0f;  ///< along the axis, > 0
  bool bothSides = false;
};

class LightTree {
 public:
  explicit LightTree(std::span<const LightBounds> lights);

  struct Choice {
    std::uint32_t light = 0;
    float probability = 0.0f;
  };
  /// A light for the surface at `position` with unit `normal` (either side); nothing if none reaches it.
  [[nodiscard]] std::optional<Choice> choose(const glm::vec3& position, const glm::vec3& normal,
                                             float u) const;
  /// The tree from one place: choose() for whoever chooses there often. Remembers the ways it went.
  class View;
  /// The probability with which choose() gives `light`.
  [[nodiscard]] float probability(std::uint32_t light, const glm::vec3& position,
                                  const glm::vec3& normal) const;

 private:
  struct Node {
    glm::vec3 centre{0.0f};
    float radius = 0.0f;
    glm::vec3 axis{0.0f};
    float intensity = 0.0f;
    float cosThetaO = 1.0f, cosThetaE = 0.0f;
    bool bothSides = false;
    bool leaf = true;
    std::uint32_t next = 0;  ///< a leaf's light, else the second child (the first follows its parent)
    std::uint32_t parent = 0;
  };
  struct Item;

  static Node nodeOf(const LightBounds& bounds);
  static float importance(const Node& node, const glm::vec3& position, const glm::vec3& normal);
  LightBounds build(std::span<Item> items, std::uint32_t parent);
  /// Probability of the first child of an inner node; negative if neither child reaches the place.
  [[nodiscard]] float firstShare(std::uint32_t node, const glm::vec3& position,
                                 const glm::vec3& normal) const;
  /// firstShareOf(inner node) as above.
  template <class FirstShareOf>
  [[nodiscard]] std::optional<Choice> descend(float u, const FirstShareOf& firstShareOf) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leafOfLight_;
};

class LightTree::View {
 public:
  /// `tree` must outlive this. `normal`: unit, either side.
  View(const LightTree& tree, const glm::vec3& position, const glm::vec3& normal);

  [[nodiscard]] const glm::vec3& position() const { return position_; }
  /// What LightTree::choose() gives there.
  [[nodiscard]] std::optional<Choice> choose(float u);

 private:
  /// Ways are remembered by node, modulo this: of large trees the part that lights most.
  static constexpr std::size_t kRemembered = 256;
  static constexpr std::uint32_t kNone = 0xffffffffu;
  struct Remembered {
    std::uint32_t node;
    float firstShare;
  };

  const LightTree& tree_;
  const glm::vec3 position_, normal_;
  std::array<Remembered, kRemembered> remembered_;
};

}  // namespace promenade::render
