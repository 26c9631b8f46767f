#pragma once
// The only door to the file system for a scene: regular files, inside the scene's folder unless allowed,
// size-limited.

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "src/scene/budget.h"

namespace promenade::scene {

using Bytes = std::vector<std::uint8_t>;

/// Undoes percent-encoding (RFC 3986, 2.1); a % that is not followed by two hexadecimal digits stays.
[[nodiscard]] std::string decodePercent(std::string_view text);

[[nodiscard]] bool isDataUri(std::string_view uri);
/// The bytes of a data URI (RFC 2397), base64 or percent-encoded. Throws InputError(where, ...) if it is
/// malformed.
[[nodiscard]] Bytes decodeDataUri(std::string_view uri, const std::string& where);

/// Reads a regular file whole, or its first `wanted` bytes if those are fewer. Throws InputError: absent, a
/// folder, a pipe or a device (which are never opened for reading), unreadable.
[[nodiscard]] Bytes readRegularFile(const std::filesystem::path& file, Budget& budget,
                                    std::uint64_t wanted = UINT64_MAX);

/// Resolves the URIs of one scene.
class SceneFiles {
 public:
  SceneFiles(const std::filesystem::path& sceneFile, FileAccess access, Budget& budget);

  /// The canonical path of a relative URI. `where` names the place in the scene for messages.
  [[nodiscard]] std::filesystem::path resolve(const std::string& uri, const std::string& where) const;
  /// The bytes behind a URI (data URIs too), at least `wanted` of them unless UINT64_MAX. Files are read once
  /// and shared.
  [[nodiscard]] std::shared_ptr<const Bytes> read(const std::string& uri, const std::string& where);

 private:
  std::filesystem::path folder_;
  FileAccess access_;
  Budget* budget_;
  std::map<std::filesystem::path, std::shared_ptr<const Bytes>> read_;
};

}  // namespace promenade::scene
