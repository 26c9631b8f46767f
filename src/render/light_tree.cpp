#include "src/render/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "src/render/maths.h"

namespace promenade::render {
namespace {

constexpr int kBuckets = 12;

float sineOf(float cosine) {
  return std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
}

/// cos(max(0, a - b)).
float cosOfDifference(float sinA, float cosA, float sinB, float cosB) {
  return cosA > cosB ? 1.0f : cosA * cosB + sinA * sinB;
}

struct Cone {
  glm::vec3 axis;
  float cosine;
};

/// The smallest cone around two; PBRT 4th ed., 3.8.4.
Cone enclose(const Cone& a, const Cone& b) {
  const float thetaA = std::acos(std::clamp(a.cosine, -1.0f, 1.0f));
  const float thetaB = std::acos(std::clamp(b.cosine, -1.0f, 1.0f));
  const float thetaD = std::acos(std::clamp(glm::dot(a.axis, b.axis), -1.0f, 1.0f));
  if (std::min(thetaD + thetaB, kPi) <= thetaA) return a;
  if (std::min(thetaD + thetaA, kPi) <= thetaB) return b;
  const float theta = 0.5f * (thetaA + thetaD + thetaB);
  if (theta >= kPi) return {a.axis, -1.0f};
  const glm::vec3 perpendicular = b.axis - glm::dot(a.axis, b.axis) * a.axis;
  const float length = glm::length(perpendicular);
  if (length < 1e-6f) return {a.axis, -1.0f};
  const float turn = theta - thetaA;
  return {glm::normalize(std::cos(turn) * a.axis + std::sin(turn) * perpendicular / length), std::cos(theta)};
}

LightBounds enclose(const LightBounds& a, const LightBounds& b) {
  if (a.intensity <= 0.0f) return b;
  if (b.intensity <= 0.0f) return a;
  const Cone cone = enclose(Cone{a.axis, a.cosThetaO}, Cone{b.axis, b.cosThetaO});
  LightBounds both;
  both.lower = glm::min(a.lower, b.lower);
  both.upper = glm::max(a.upper, b.upper);
  both.axis = cone.axis;
  both.cosThetaO = cone.cosine;
  both.cosThetaE = std::min(a.cosThetaE, b.cosThetaE);
  both.intensity = a.intensity + b.intensity;
  both.bothSides = a.bothSides || b.bothSides;
  return both;
}

/// Surface area orientation heuristic of one side of a split, Conty Estevez and Kulla 2018, eq. (1) and (2).
float splitCost(const LightBounds& b, const glm::vec3& parentExtent, int dimension) {
  const float thetaO = std::acos(std::clamp(b.cosThetaO, -1.0f, 1.0f));
  const float thetaE = std::acos(std::clamp(b.cosThetaE, -1.0f, 1.0f));
  const float thetaW = std::min(thetaO + thetaE, kPi);
  const float sinO = std::sin(thetaO);
  const float measure =
      2.0f * kPi * (1.0f - b.cosThetaO) +
      0.5f * kPi *
          (2.0f * thetaW * sinO - std::cos(thetaO - 2.0f * thetaW) - 2.0f * thetaO * sinO + b.cosThetaO);
  const glm::vec3 e = b.upper - b.lower;
  const float area = 2.0f * (e.x * e.y + e.y * e.z + e.z * e.x);
  const float longest = std::max(parentExtent.x, std::max(parentExtent.y, parentExtent.z));
  return b.intensity * measure * area * longest / parentExtent[dimension];
}

}  // namespace

struct LightTree::Item {
  LightBounds bounds;
  std::uint32_t light = 0;
};

LightTree::Node LightTree::nodeOf(const LightBounds& b) {
  Node node;
  node.centre = 0.5f * (b.lower + b.upper);
  node.radius = 0.5f * glm::length(b.upper - b.lower);
  node.axis = b.axis;
  node.intensity = b.intensity;
  node.cosThetaO = b.cosThetaO;
  node.cosThetaE = b.cosThetaE;
  node.bothSides = b.bothSides;
  return node;
}

LightTree::LightTree(std::span<const LightBounds> lights) : leafOfLight_(lights.size()) {
  if (lights.empty()) return;
  std::vector<Item> items;
  items.reserve(lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i) items.push_back({lights[i], static_cast<std::uint32_t>(i)});
  nodes_.reserve(2 * lights.size());
  build(items, 0);
}

LightBounds LightTree::build(std::span<Item> items, std::uint32_t parent) {
  const auto self = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  if (items.size() == 1) {
    Node leaf = nodeOf(items[0].bounds);
    leaf.next = items[0].light;
    leaf.parent = parent;
    nodes_[self] = leaf;
    leafOfLight_[items[0].light] = self;
    return items[0].bounds;
  }

  const auto centreOf = [](const Item& item) { return 0.5f * (item.bounds.lower + item.bounds.upper); };
  glm::vec3 lower = items[0].bounds.lower, upper = items[0].bounds.upper;
  glm::vec3 leastCentre = centreOf(items[0]), mostCentre = leastCentre;
  for (const Item& item : items) {
    lower = glm::min(lower, item.bounds.lower);
    upper = glm::max(upper, item.bounds.upper);
    leastCentre = glm::min(leastCentre, centreOf(item));
    mostCentre = glm::max(mostCentre, centreOf(item));
  }
  const auto bucketOf = [&](const Item& item, int dimension) {
    const float t = (centreOf(item)[dimension] - leastCentre[dimension]) /
                    (mostCentre[dimension] - leastCentre[dimension]);
    return std::clamp(static_cast<int>(t * kBuckets), 0, kBuckets - 1);
  };
  float leastCost = std::numeric_limits<float>::infinity();
  int bestDimension = -1;
  int bestBucket = 0;
  for (int dimension = 0; dimension < 3; ++dimension) {
    if (!(mostCentre[dimension] > leastCentre[dimension])) continue;
    std::array<LightBounds, kBuckets> buckets{};
    for (const Item& item : items) {
      LightBounds& bucket = buckets[static_cast<std::size_t>(bucketOf(item, dimension))];
      bucket = enclose(bucket, item.bounds);
    }
    for (int split = 0; split + 1 < kBuckets; ++split) {
      LightBounds left, right;
      for (int i = 0; i < kBuckets; ++i) {
        LightBounds& side = i <= split ? left : right;
        side = enclose(side, buckets[static_cast<std::size_t>(i)]);
      }
      if (left.intensity <= 0.0f || right.intensity <= 0.0f) continue;
      const float cost =
          splitCost(left, upper - lower, dimension) + splitCost(right, upper - lower, dimension);
      if (cost < leastCost) {
        leastCost = cost;
        bestDimension = dimension;
        bestBucket = split;
      }
    }
  }
  std::size_t middle = items.size() / 2;
  if (bestDimension >= 0) {
    const auto second = std::partition(items.begin(), items.end(), [&](const Item& item) {
      return bucketOf(item, bestDimension) <= bestBucket;
    });
    const auto count = static_cast<std::size_t>(second - items.begin());
    if (count > 0 && count < items.size()) middle = count;
  }
  const LightBounds first = build(items.first(middle), self);
  const auto secondChild = static_cast<std::uint32_t>(nodes_.size());
  const LightBounds second = build(items.subspan(middle), self);
  const LightBounds both = enclose(first, second);
  Node node = nodeOf(both);
  node.leaf = false;
  node.next = secondChild;
  node.parent = parent;
  nodes_[self] = node;
  return both;
}

/// PBRT 4th ed., 12.6.3, LightBounds::Importance: intensity toward the point, over the squared distance,
/// times the cosine at the surface, each bounded above over the node.
float LightTree::importance(const Node& node, const glm::vec3& position, const glm::vec3& normal) {
  const glm::vec3 toPoint = position - node.centre;
  const float squared = glm::dot(toPoint, toPoint);
  const float radiusSquared = node.radius * node.radius;
  const float bounded = std::max(squared, std::max(radiusSquared, 1e-12f));
  const glm::vec3 direction = toPoint / std::sqrt(std::max(squared, 1e-20f));

  // The angle that the node's sphere takes up.
  const bool inside = squared <= radiusSquared;
  const float sinB = inside ? 0.0f : std::sqrt(radiusSquared / squared);
  const float cosB = inside ? -1.0f : sineOf(sinB);

  float cosW = glm::dot(node.axis, direction);
  if (node.bothSides) cosW = std::abs(cosW);
  const float sinW = sineOf(cosW);
  const float sinO = sineOf(node.cosThetaO);
  const float cosX = cosOfDifference(sinW, cosW, sinO, node.cosThetaO);
  const float sinX = sineOf(cosX);
  const float cosP = cosOfDifference(sinX, cosX, sinB, cosB);
  if (cosP <= node.cosThetaE) return 0.0f;

  const float cosI = std::abs(glm::dot(direction, normal));
  const float cosAtSurface = cosOfDifference(sineOf(cosI), cosI, sinB, cosB);
  return std::max(0.0f, node.intensity * cosP * cosAtSurface / bounded);
}

float LightTree::firstShare(std::uint32_t node, const glm::vec3& position, const glm::vec3& normal) const {
  const float a = importance(nodes_[node + 1], position, normal);
  const float b = importance(nodes_[nodes_[node].next], position, normal);
  return a + b > 0.0f ? a / (a + b) : -1.0f;
}

template <class FirstShareOf>
std::optional<LightTree::Choice> LightTree::descend(float u, const FirstShareOf& firstShareOf) const {
  if (nodes_.empty()) return std::nullopt;
  std::uint32_t index = 0;
  float probability = 1.0f;
  while (!nodes_[index].leaf) {
    const float share = firstShareOf(index);
    if (share < 0.0f) return std::nullopt;
    if (u < share) {
      u = std::min(u / share, 0.99999994f);
      probability *= share;
      index = index + 1;
    } else {
      u = std::min((u - share) / (1.0f - share), 0.99999994f);
      probability *= 1.0f - share;
      index = nodes_[index].next;
    }
  }
  // A tree of one light: nothing has asked yet whether it reaches the point at all.
  return Choice{nodes_[index].next, probability};
}

std::optional<LightTree::Choice> LightTree::choose(const glm::vec3& position, const glm::vec3& normal,
                                                   float u) const {
  return descend(u, [&](std::uint32_t node) { return firstShare(node, position, normal); });
}

LightTree::View::View(const LightTree& tree, const glm::vec3& position, const glm::vec3& normal)
    : tree_(tree), position_(position), normal_(normal) {
  remembered_.fill({kNone, 0.0f});
}

std::optional<LightTree::Choice> LightTree::View::choose(float u) {
  return tree_.descend(u, [this](std::uint32_t node) {
    Remembered& way = remembered_[node % kRemembered];
    if (way.node != node) way = {node, tree_.firstShare(node, position_, normal_)};
    return way.firstShare;
  });
}

float LightTree::probability(std::uint32_t light, const glm::vec3& position, const glm::vec3& normal) const {
  std::uint32_t index = leafOfLight_[light];
  float probability = 1.0f;
  while (index != 0) {
    const std::uint32_t parent = nodes_[index].parent;
    const float share = firstShare(parent, position, normal);
    if (share < 0.0f) return 0.0f;
    probability *= index == parent + 1 ? share : 1.0f - share;
    index = parent;
  }
  return probability;
}

}  // namespace promenade::render
