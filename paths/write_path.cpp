#include "paths/write_path.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <vector>

#include "paths/text.h"
#include "src/core/errors.h"

namespace promenade::paths {
namespace {

using OrderedJson = nlohmann::ordered_json;
// One quaternion a frame, each on the side of the one before, so that component-wise interpolators do well
// too.
std::vector<glm::dquat> rotationsOf(const CameraPath& path) {
  std::vector<glm::dquat> rotations;
  for (const PathFrame& frame : path.frames) {
    glm::dquat q = glm::normalize(glm::quat_cast(frame.pose.worldFromCamera));
    if (!rotations.empty() && glm::dot(rotations.back(), q) < 0.0) q = -q;
    rotations.push_back(q);
  }
  return rotations;
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? kAlphabet[word >> (18 - 6 * k) & 63u] : '=';
    }
  }
  return text;
}

// glTF buffers are little-endian.
void append(std::vector<std::uint8_t>& bytes, double value) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  for (int k = 0; k < 4; ++k) bytes.push_back(static_cast<std::uint8_t>(bits >> (8 * k) & 0xffu));
}

}  // namespace

std::string toPromenadeJson(const CameraPath& path) {
  const std::vector<glm::dquat> rotations = rotationsOf(path);
  OrderedJson keys = OrderedJson::array();
  for (std::size_t i = 0; i <= path.frames.size(); ++i) {
    const std::size_t f = std::min(i, path.frames.size() - 1);
    const PathFrame& frame = path.frames[f];
    const glm::dquat& q = rotations[f];
    keys.push_back({{"time", static_cast<double>(i) / path.framesPerSecond},
                    {"eye", {frame.pose.eye.x, frame.pose.eye.y, frame.pose.eye.z}},
                    {"rotation", {q.x, q.y, q.z, q.w}},
                    {"fov", glm::degrees(frame.verticalFieldOfView)}});
  }
  const OrderedJson root = {
      {"fps", path.framesPerSecond}, {"interpolation", "linear"}, {"speed", "timed"}, {"keys", keys}};
  return root.dump(1) + "\n";
}

std::string toNerfstudio(const CameraPath& path) {
  OrderedJson cameras = OrderedJson::array();
  for (const PathFrame& frame : path.frames) {
    const glm::dmat3& m = frame.pose.worldFromCamera;
    const glm::dvec3& e = frame.pose.eye;
    cameras.push_back({{"camera_to_world",
                        {m[0].x, m[1].x, m[2].x, e.x, m[0].y, m[1].y, m[2].y, e.y, m[0].z, m[1].z, m[2].z,
                         e.z, 0.0, 0.0, 0.0, 1.0}},
                       {"fov", glm::degrees(frame.verticalFieldOfView)},
                       {"aspect", 16.0 / 9.0}});
  }
  const OrderedJson root = {{"camera_type", "perspective"},
                            {"render_height", 720},
                            {"render_width", 1280},
                            {"fps", path.framesPerSecond},
                            {"seconds", static_cast<double>(path.frames.size()) / path.framesPerSecond},
                            {"camera_path", cameras}};
  return root.dump(1) + "\n";
}

std::string toTum(const CameraPath& path) {
  const std::vector<glm::dquat> rotations = rotationsOf(path);
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (std::size_t i = 0; i < path.frames.size(); ++i) {
    const glm::dvec3& e = path.frames[i].pose.eye;
    // To y down, looking along +z (read_path.h).
    const glm::dquat q = rotations[i] * glm::dquat(0.0, 1.0, 0.0, 0.0);
    const double time = static_cast<double>(i) / path.framesPerSecond;
    for (const double value : {time, e.x, e.y, e.z, q.x, q.y, q.z}) text += exactNumber(value) + " ";
    text += exactNumber(q.w) + "\n";
  }
  return text;
}

std::string toGltf(const CameraPath& path) {
  const double fieldOfView = path.frames.front().verticalFieldOfView;
  for (const PathFrame& frame : path.frames) {
    if (std::abs(frame.verticalFieldOfView - fieldOfView) > 1e-9) {
      throw InputError(
          "a glTF animation cannot change the field of view, and that of this path changes; "
          "write Promenade JSON or nerfstudio instead");
    }
  }
  const std::vector<glm::dquat> rotations = rotationsOf(path);
  const std::size_t count = path.frames.size() + 1;  // the last key closes the half-open interval
  const auto frameOf = [&](std::size_t key) { return std::min(key, path.frames.size() - 1); };
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < count; ++i) append(bytes, static_cast<double>(i) / path.framesPerSecond);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3& e = path.frames[frameOf(i)].pose.eye;
    for (const double value : {e.x, e.y, e.z}) append(bytes, value);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dquat& q = rotations[frameOf(i)];
    for (const double value : {q.x, q.y, q.z, q.w}) append(bytes, value);
  }
  const auto lastTime =
      static_cast<double>(static_cast<float>(static_cast<double>(count - 1) / path.framesPerSecond));
  const auto accessor = [&](int view, const char* type) {
    return OrderedJson{{"bufferView", view}, {"componentType", 5126}, {"count", count}, {"type", type}};
  };
  OrderedJson times = accessor(0, "SCALAR");
  times["min"] = {0.0};
  times["max"] = {lastTime};
  const auto view = [](std::size_t offset, std::size_t length) {
    return OrderedJson{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}};
  };
  const auto channel = [](int sampler, const char* property) {
    return OrderedJson{{"sampler", sampler}, {"target", {{"node", 0}, {"path", property}}}};
  };
  const auto sampler = [](int output) {
    return OrderedJson{{"input", 0}, {"output", output}, {"interpolation", "LINEAR"}};
  };
  const std::string name = path.name.empty() ? "walk" : path.name;
  const OrderedJson root = {
      {"asset", {{"version", "2.0"}, {"generator", "promenade"}}},
      {"scene", 0},
      {"scenes", OrderedJson::array({{{"nodes", {0}}}})},
      {"nodes", OrderedJson::array({{{"name", name}, {"camera", 0}}})},
      {"cameras", OrderedJson::array({{{"name", name},
                                       {"type", "perspective"},
                                       {"perspective", {{"yfov", fieldOfView}, {"znear", 0.01}}}}})},
      {"animations",
       OrderedJson::array(
           {{{"name", name},
             {"samplers", OrderedJson::array({sampler(1), sampler(2)})},
             {"channels", OrderedJson::array({channel(0, "translation"), channel(1, "rotation")})}}})},
      {"accessors", OrderedJson::array({times, accessor(1, "VEC3"), accessor(2, "VEC4")})},
      {"bufferViews",
       OrderedJson::array({view(0, 4 * count), view(4 * count, 12 * count), view(16 * count, 16 * count)})},
      {"buffers", OrderedJson::array({{{"byteLength", bytes.size()},
                                       {"uri", "data:application/octet-stream;base64," + base64(bytes)}}})}};
  return root.dump(1) + "\n";
}

}  // namespace promenade::paths
