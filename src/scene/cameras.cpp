#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <set>
#include <unordered_map>

#include "src/scene/placement.h"
#include "src/scene/values.h"

namespace promenade::scene {
namespace {

constexpr double kHalfTurn = 3.14159265358979324;
// Chains of nodes are copied for each camera and animation.
constexpr std::size_t kDeepestCamera = 1024;
constexpr std::size_t kMostCameras = 10'000;

class CameraReader {
 public:
  CameraReader(const Gltf& gltf, const std::vector<PlacedNode>& nodes, const Accessors& accessors,
               Budget& budget, Warnings& warnings)
      : gltf_(gltf), nodes_(nodes), accessors_(accessors), budget_(budget), warnings_(warnings) {}

  [[nodiscard]] std::vector<CameraAnimation> read() {
    std::vector<CameraAnimation> atRest;
    std::vector<std::size_t> placedAt;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const int camera = sourceOf(nodes_[i]).camera;
      if (camera < 0) {
        continue;
      }
      gltf_.checkIndex(camera, gltf_.model.cameras.size(), placeOf(nodes_[i]) + ".camera", "camera");
      if (std::optional<CameraAnimation> found = cameraAtRest(static_cast<std::size_t>(camera), i)) {
        atRest.push_back(std::move(*found));
        placedAt.push_back(i);
      }
      if (atRest.size() > kMostCameras) {
        gltf_.fail("cameras", "more than " + std::to_string(kMostCameras) + " are placed in the scene");
      }
    }
    checkChannels();
    std::vector<CameraAnimation> result = atRest;
    const CamerasOnNode camerasOn = findCamerasOn(placedAt);
    for (const tinygltf::Animation& animation : gltf_.model.animations) {
      const ChannelsOfNode channels = channelsByNode(animation);
      for (const std::size_t camera : movedCameras(channels, camerasOn)) {
        budget_.chargeGeometry(atRest[camera].rootToCamera.size(), sizeof(AnimatedNode));
        CameraAnimation& moved = result.emplace_back(atRest[camera]);
        // Never empty: that would say "at rest".
        moved.name = animation.name.empty()
                         ? "animation " + std::to_string(&animation - gltf_.model.animations.data())
                         : printable(animation.name);
        animate(moved, placedAt[camera], animation, channels);
      }
    }
    return result;
  }

 private:
  /// For each node of the file, the cameras (indices into those at rest) on or below it.
  using CamerasOnNode = std::unordered_map<int, std::vector<std::size_t>>;
  /// Channels that move nodes, by node.
  using ChannelsOfNode = std::map<int, std::vector<const tinygltf::AnimationChannel*>>;

  [[nodiscard]] const tinygltf::Node& sourceOf(const PlacedNode& placed) const {
    return gltf_.model.nodes[static_cast<std::size_t>(placed.node)];
  }
  [[nodiscard]] static std::string placeOf(const PlacedNode& placed) {
    return at("nodes", static_cast<std::size_t>(placed.node));
  }

  [[nodiscard]] std::optional<CameraAnimation> cameraAtRest(std::size_t camera, std::size_t placed) {
    const tinygltf::Camera& source = gltf_.model.cameras[camera];
    if (source.type != "perspective") {
      warnings_.add(at("cameras", camera) + ": only perspective cameras are supported; it is left out");
      return std::nullopt;
    }
    if (!(source.perspective.yfov > 0.0 && source.perspective.yfov < kHalfTurn)) {
      gltf_.fail(at("cameras", camera) + ".perspective.yfov",
                 "expected more than 0 and less than pi, found " + std::to_string(source.perspective.yfov));
    }
    CameraAnimation result;
    result.cameraName = printable(!source.name.empty() ? source.name : sourceOf(nodes_[placed]).name);
    result.verticalFieldOfView = source.perspective.yfov;
    if (static_cast<std::size_t>(nodes_[placed].depth) > kDeepestCamera) {
      gltf_.fail(placeOf(nodes_[placed]),
                 "its camera lies more than " + std::to_string(kDeepestCamera) + " deep");
    }
    budget_.chargeGeometry(static_cast<std::uint64_t>(nodes_[placed].depth), sizeof(AnimatedNode));
    for (int i = static_cast<int>(placed); i != -1; i = nodes_[static_cast<std::size_t>(i)].parent) {
      result.rootToCamera.push_back(nodeAtRest(nodes_[static_cast<std::size_t>(i)]));
    }
    std::reverse(result.rootToCamera.begin(), result.rootToCamera.end());
    return result;
  }

  [[nodiscard]] AnimatedNode nodeAtRest(const PlacedNode& placed) const {
    const tinygltf::Node& source = sourceOf(placed);
    AnimatedNode node;
    node.name = printable(source.name);
    node.restMatrix = restTransform(gltf_, static_cast<std::size_t>(placed.node));
    // Their lengths were checked with the transform.
    if (!source.translation.empty()) {
      node.translation = {source.translation[0], source.translation[1], source.translation[2]};
    }
    if (!source.rotation.empty()) {
      node.rotation = glm::normalize(
          glm::dquat(source.rotation[3], source.rotation[0], source.rotation[1], source.rotation[2]));
    }
    if (!source.scale.empty()) {
      node.scale = {source.scale[0], source.scale[1], source.scale[2]};
    }
    return node;
  }

  /// Indices of all channels and samplers, used by a camera or not.
  void checkChannels() const {
    for (std::size_t a = 0; a < gltf_.model.animations.size(); ++a) {
      const tinygltf::Animation& animation = gltf_.model.animations[a];
      for (std::size_t c = 0; c < animation.channels.size(); ++c) {
        const std::string place = at("animations", a) + ".channels[" + std::to_string(c) + "]";
        gltf_.checkIndex(animation.channels[c].sampler, animation.samplers.size(), place + ".sampler",
                         "sampler");
        if (animation.channels[c].target_node >= 0) {
          gltf_.checkIndex(animation.channels[c].target_node, gltf_.model.nodes.size(),
                           place + ".target.node", "node");
        }
      }
      for (std::size_t s = 0; s < animation.samplers.size(); ++s) {
        const std::string place = at("animations", a) + ".samplers[" + std::to_string(s) + "]";
        gltf_.checkIndex(animation.samplers[s].input, accessors_.size(), place + ".input", "accessor");
        gltf_.checkIndex(animation.samplers[s].output, accessors_.size(), place + ".output", "accessor");
      }
    }
  }

  /// No larger than all chains together, which the budget has counted.
  [[nodiscard]] CamerasOnNode findCamerasOn(const std::vector<std::size_t>& placedAt) const {
    CamerasOnNode result;
    for (std::size_t camera = 0; camera < placedAt.size(); ++camera) {
      for (int i = static_cast<int>(placedAt[camera]); i != -1;
           i = nodes_[static_cast<std::size_t>(i)].parent) {
        result[nodes_[static_cast<std::size_t>(i)].node].push_back(camera);
      }
    }
    return result;
  }

  [[nodiscard]] static ChannelsOfNode channelsByNode(const tinygltf::Animation& animation) {
    ChannelsOfNode result;
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
      const std::string& path = channel.target_path;
      if (path == "translation" || path == "rotation" || path == "scale") {
        result[channel.target_node].push_back(&channel);
      }
    }
    return result;
  }

  [[nodiscard]] static std::set<std::size_t> movedCameras(const ChannelsOfNode& channels,
                                                          const CamerasOnNode& camerasOn) {
    std::set<std::size_t> result;
    for (const auto& [node, ignored] : channels) {
      if (const auto found = camerasOn.find(node); found != camerasOn.end()) {
        result.insert(found->second.begin(), found->second.end());
      }
    }
    return result;
  }

  /// Puts the animation's tracks on the camera's chain.
  void animate(CameraAnimation& camera, std::size_t placed, const tinygltf::Animation& animation,
               const ChannelsOfNode& channels) const {
    auto node = camera.rootToCamera.rbegin();
    for (int i = static_cast<int>(placed); i != -1; i = nodes_[static_cast<std::size_t>(i)].parent, ++node) {
      const PlacedNode& step = nodes_[static_cast<std::size_t>(i)];
      const auto found = channels.find(step.node);
      if (found == channels.end()) {
        continue;
      }
      for (const tinygltf::AnimationChannel* channel : found->second) {
        readChannel(*node, step, animation, *channel);
      }
    }
  }

  void readChannel(AnimatedNode& node, const PlacedNode& placed, const tinygltf::Animation& animation,
                   const tinygltf::AnimationChannel& channel) const {
    const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
    const std::string place =
        at("animations", static_cast<std::size_t>(&animation - gltf_.model.animations.data())) +
        ".samplers[" + std::to_string(channel.sampler) + "]";
    if (!sourceOf(placed).matrix.empty()) {
      gltf_.fail(placeOf(placed), "is animated by " + place + ", but has a matrix");
    }
    if (channel.target_path == "translation") {
      node.translationTrack =
          readTrack(sampler, place, accessors_.readVec3(sampler.output, place + ".output"));
    } else if (channel.target_path == "rotation") {
      node.rotationTrack = readTrack(sampler, place, accessors_.readVec4(sampler.output, place + ".output"));
    } else {
      node.scaleTrack = readTrack(sampler, place, accessors_.readVec3(sampler.output, place + ".output"));
    }
  }

  template <class Value>
  [[nodiscard]] Track<Value> readTrack(const tinygltf::AnimationSampler& sampler, const std::string& place,
                                       std::vector<Value> values) const {
    Track<Value> track;
    if (sampler.interpolation == "STEP") {
      track.interpolation = Interpolation::kStep;
    } else if (sampler.interpolation == "CUBICSPLINE") {
      track.interpolation = Interpolation::kCubicSpline;
    } else if (!sampler.interpolation.empty() && sampler.interpolation != "LINEAR") {
      gltf_.fail(place + ".interpolation",
                 "expected STEP, LINEAR or CUBICSPLINE, found " + inQuotes(sampler.interpolation));
    }
    track.times = accessors_.readScalars(sampler.input, place + ".input");
    track.values = std::move(values);
    const std::size_t perTime = track.interpolation == Interpolation::kCubicSpline ? 3 : 1;
    if (track.values.size() != track.times.size() * perTime) {
      gltf_.fail(place, std::to_string(track.times.size()) + " times need " +
                            std::to_string(track.times.size() * perTime) + " values, found " +
                            std::to_string(track.values.size()));
    }
    return track;
  }

  const Gltf& gltf_;
  const std::vector<PlacedNode>& nodes_;
  const Accessors& accessors_;
  Budget& budget_;
  Warnings& warnings_;
};

}  // namespace

std::vector<CameraAnimation> placeCameras(const Gltf& gltf, const std::vector<PlacedNode>& nodes,
                                          const Accessors& accessors, Budget& budget, Warnings& warnings) {
  return CameraReader(gltf, nodes, accessors, budget, warnings).read();
}

}  // namespace promenade::scene
