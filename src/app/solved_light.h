#pragma once
// The light solution of a walk and the file that keeps it.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "paths/camera_path.h"
#include "src/app/console.h"
#include "src/render/path_renderer.h"
#include "src/scene/scene.h"
#include "src/walkthrough/report.h"

namespace promenade::app {

/// Of a solution's file that is read: 6 million records.
inline constexpr std::size_t kMaximumSolutionBytes = std::size_t{4} << 30;

struct LightRequest {
  std::filesystem::path file;  ///< read if it is there, written if anything was added
  std::string hash;            ///< of the scene, its light and the seed (lightHash())
  std::uint64_t seed = 0;
  int threads = 0;
  /// Told of a solution that was made or extended, with the file's contents, before the file is written. May
  /// be empty.
  std::function<void(const walkthrough::LightReport&, const std::string& bytes)> made = {};
};

struct SolvedLight {
  std::shared_ptr<const render::LightSolution> solution;
  walkthrough::LightReport report;
};

/// The solution in `file`; null if there is none. One that is damaged or of another scene than `hash` says is
/// none either, with a notice that ends in `fate`: "it is ...".
[[nodiscard]] std::shared_ptr<const render::LightSolution> keptLight(const std::filesystem::path& file,
                                                                     const std::string& hash,
                                                                     const std::string& fate,
                                                                     Console& console);

/// The light of the whole walk, whatever part of it is rendered, so that parts fit together: from the file as
/// far as it goes, the rest computed. A file that is damaged or of another scene is replaced, with a notice.
[[nodiscard]] SolvedLight solveLightOf(const paths::CameraPath& path, Size size, const Scene& scene,
                                       const LightRequest& request, Console& console);

}  // namespace promenade::app
