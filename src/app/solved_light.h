#pragma once
// The light solution of a walk and the file that keeps it.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "paths/camera_path.h"
#include "src/app/console.h"
#include "src/render/path_renderer.h"
#include "src/scene/scene.h"
#include "src/walkthrough/report.h"

namespace promenade::app {

struct LightRequest {
  std::filesystem::path file;  ///< read if it is there, written if anything was added
  std::string hash;            ///< of the scene, its light and the seed (lightHash())
  std::uint64_t seed = 0;
  int threads = 0;
};

struct SolvedLight {
  std::shared_ptr<const render::LightSolution> solution;
  walkthrough::LightReport report;
};

/// The light of the whole walk, whatever part of it is rendered, so that parts fit together: from the file as
/// far as it goes, the rest computed. A file that is damaged or of another scene is replaced, with a notice.
[[nodiscard]] SolvedLight solveLightOf(const paths::CameraPath& path, Size size, const Scene& scene,
                                       const LightRequest& request, Console& console);

}  // namespace promenade::app
