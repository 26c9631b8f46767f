#include "src/scene/nodes.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "src/scene/values.h"

namespace promenade::scene {
namespace {

bool isSane(const glm::dmat4& matrix) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!(std::abs(matrix[column][row]) <= kLargestCoordinate)) {  // also false for NaN
        return false;
      }
    }
  }
  return true;
}

void checkLength(const Gltf& gltf, const std::vector<double>& values, std::size_t expected,
                 const std::string& place) {
  if (!values.empty() && values.size() != expected) {
    gltf.fail(place,
              "expected " + std::to_string(expected) + " numbers, found " + std::to_string(values.size()));
  }
}

/// parent[i] of every node, -1 for roots.
std::vector<int> findParents(const Gltf& gltf) {
  const auto& nodes = gltf.model.nodes;
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const int child : nodes[i].children) {
      gltf.checkIndex(child, nodes.size(), at("nodes", i) + ".children", "node");
      int& parent = parents[static_cast<std::size_t>(child)];
      if (parent != -1 || static_cast<std::size_t>(child) == i) {
        gltf.fail(
            at("nodes", i) + ".children",
            "node " + std::to_string(child) +
                (static_cast<std::size_t>(child) == i ? " is its own child" : " has more than one parent"));
      }
      parent = static_cast<int>(i);
    }
  }
  return parents;
}

/// With one parent each, a node that no root reaches lies on or below a cycle.
void checkAcyclic(const Gltf& gltf, const std::vector<int>& parents) {
  std::vector<int> pending;
  for (std::size_t i = 0; i < parents.size(); ++i) {
    if (parents[i] == -1) {
      pending.push_back(static_cast<int>(i));
    }
  }
  std::vector<bool> reached(parents.size(), false);
  while (!pending.empty()) {
    const auto node = static_cast<std::size_t>(pending.back());
    pending.pop_back();
    reached[node] = true;
    pending.insert(pending.end(), gltf.model.nodes[node].children.begin(),
                   gltf.model.nodes[node].children.end());
  }
  for (std::size_t i = 0; i < reached.size(); ++i) {
    if (!reached[i]) {
      gltf.fail(at("nodes", i), "is part of a cycle or below one");
    }
  }
}

std::vector<int> shownRoots(const Gltf& gltf, const std::vector<int>& parents) {
  const tinygltf::Model& model = gltf.model;
  std::vector<int> roots;
  if (model.scenes.empty()) {
    if (model.defaultScene > -1) {
      gltf.fail("scene", "there is no scene " + std::to_string(model.defaultScene) + ", the file has 0");
    }
    for (std::size_t i = 0; i < parents.size(); ++i) {
      if (parents[i] == -1) {
        roots.push_back(static_cast<int>(i));
      }
    }
    return roots;
  }
  for (std::size_t i = 0; i < model.scenes.size(); ++i) {
    for (const int node : model.scenes[i].nodes) {
      gltf.checkIndex(node, model.nodes.size(), at("scenes", i) + ".nodes", "node");
      if (parents[static_cast<std::size_t>(node)] != -1) {
        gltf.fail(at("scenes", i) + ".nodes", "node " + std::to_string(node) + " is not a root");
      }
    }
  }
  const int shown = model.defaultScene > -1 ? model.defaultScene : 0;
  gltf.checkIndex(shown, model.scenes.size(), "scene", "scene");
  return model.scenes[static_cast<std::size_t>(shown)].nodes;
}

}  // namespace

glm::dmat4 restTransform(const Gltf& gltf, std::size_t index) {
  const tinygltf::Node& node = gltf.model.nodes[index];
  const std::string place = at("nodes", index);
  checkLength(gltf, node.matrix, 16, place + ".matrix");
  checkLength(gltf, node.translation, 3, place + ".translation");
  checkLength(gltf, node.rotation, 4, place + ".rotation");
  checkLength(gltf, node.scale, 3, place + ".scale");
  glm::dmat4 result(1.0);
  if (!node.matrix.empty()) {
    for (int i = 0; i < 16; ++i) {
      result[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    }
    if (result[0][3] != 0.0 || result[1][3] != 0.0 || result[2][3] != 0.0 || result[3][3] != 1.0) {
      gltf.fail(place + ".matrix", "its last row must be 0 0 0 1");
    }
  } else {
    if (!node.translation.empty()) {
      result =
          glm::translate(result, glm::dvec3(node.translation[0], node.translation[1], node.translation[2]));
    }
    if (!node.rotation.empty()) {
      const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
      const double length = glm::length(rotation);
      if (!(length > 1e-6) || !std::isfinite(length)) {
        gltf.fail(place + ".rotation", "the quaternion has no direction");
      }
      result = result * glm::mat4_cast(rotation / length);
    }
    if (!node.scale.empty()) {
      result = glm::scale(result, glm::dvec3(node.scale[0], node.scale[1], node.scale[2]));
    }
  }
  if (!isSane(result)) {
    gltf.fail(place, "its transform is not finite or beyond 1e15");
  }
  return result;
}

std::vector<PlacedNode> placeNodes(const Gltf& gltf) {
  const std::vector<int> parents = findParents(gltf);
  checkAcyclic(gltf, parents);
  const auto& nodes = gltf.model.nodes;
  std::vector<bool> taken(nodes.size(), false);
  std::vector<PlacedNode> placed;
  for (const int root : shownRoots(gltf, parents)) {
    if (taken[static_cast<std::size_t>(root)]) {
      gltf.fail("scenes", "node " + std::to_string(root) + " is listed twice");
    }
    taken[static_cast<std::size_t>(root)] = true;
    placed.push_back({root, -1, 1, glm::dmat4(1.0)});
  }
  // Breadth first: `placed` is its own queue.
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const auto node = static_cast<std::size_t>(placed[i].node);
    placed[i].worldFromNode = placed[i].worldFromNode * restTransform(gltf, node);
    if (!isSane(placed[i].worldFromNode)) {
      gltf.fail(at("nodes", node), "its world transform is not finite or beyond 1e15");
    }
    for (const int child : nodes[node].children) {
      placed.push_back({child, static_cast<int>(i), placed[i].depth + 1, placed[i].worldFromNode});
    }
  }
  return placed;
}

}  // namespace promenade::scene
