#pragma once
// The whole example.

#include <filesystem>

namespace promenade::hall {

struct HallStatistics {
  std::size_t triangles;
  std::size_t bytes;  ///< of all files
};

/// Writes the exhibition hall with its walk as `folder`/hall.gltf, hall.bin and images. The same bytes each
/// time.
HallStatistics writeHall(const std::filesystem::path& folder);

}  // namespace promenade::hall
