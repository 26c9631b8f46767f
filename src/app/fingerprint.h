#pragma once
// A short name for everything that decides what a job's frames look like.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "paths/camera_path.h"
#include "src/scene/scene.h"

namespace promenade::app {

/// A 64-bit hash of bytes in order (not against attackers: against mistaking one job for another).
class Fingerprint {
 public:
  void add(std::span<const std::byte> bytes);
  void add(const std::string& text);  ///< with its length
  void add(double value);
  template <class T>
  void addArray(std::span<const T> values) {
    add(static_cast<double>(values.size()));
    add(std::as_bytes(values));
  }
  /// 16 hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t state_ = 0x9e3779b97f4a7c15ull;
};

/// The scene as it will be traced: geometry, placement, textures, environment; and the bytes of its main
/// file, which hold the materials and lights.
void addScene(Fingerprint& fingerprint, const Scene& scene);
void addFile(Fingerprint& fingerprint, const std::filesystem::path& file);
void addPath(Fingerprint& fingerprint, const paths::CameraPath& path);

}  // namespace promenade::app
