#pragma once
// Small glTF files for tests, in a folder that goes away with its owner.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

namespace promenade::tests {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::random_device random;
    path_ = std::filesystem::temp_directory_path() / ("promenade-scene-" + std::to_string(random()));
    std::filesystem::create_directories(path_);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << content;
    return file;
  }

 private:
  std::filesystem::path path_;
};

/// Little-endian bytes of numbers, as buffers hold them.
template <class T>
std::string bytesOf(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

inline std::string base64(const std::string& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text.push_back(i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63u]);
    }
  }
  return text;
}

inline std::string dataUri(const std::string& bytes) {
  return "data:application/octet-stream;base64," + base64(bytes);
}

/// One triangle (0,0,0) (1,0,0) (0,1,0) without indices, in a data URI: one buffer, view, accessor, mesh,
/// node and scene.
inline nlohmann::json triangleScene() {
  const std::string positions = bytesOf<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
  return {{"asset", {{"version", "2.0"}}},
          {"buffers", {{{"byteLength", positions.size()}, {"uri", dataUri(positions)}}}},
          {"bufferViews", {{{"buffer", 0}, {"byteLength", positions.size()}}}},
          {"accessors", {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}}},
          {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
          {"nodes", {{{"mesh", 0}}}},
          {"scenes", {{{"nodes", {0}}}}},
          {"scene", 0}};
}

/// Appends `bytes` as a buffer with one view; returns the view's index.
inline int addView(nlohmann::json& scene, const std::string& bytes) {
  scene["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", dataUri(bytes)}});
  scene["bufferViews"].push_back({{"buffer", scene["buffers"].size() - 1}, {"byteLength", bytes.size()}});
  return static_cast<int>(scene["bufferViews"].size()) - 1;
}

/// Appends an accessor to its own buffer; returns its index.
inline int addAccessor(nlohmann::json& scene, const std::string& bytes, int componentType, const char* type,
                       std::size_t count) {
  const int view = addView(scene, bytes);
  scene["accessors"].push_back(
      {{"bufferView", view}, {"componentType", componentType}, {"type", type}, {"count", count}});
  return static_cast<int>(scene["accessors"].size()) - 1;
}

}  // namespace promenade::tests
