#pragma once
// Another program that renders keyframes when it is asked to: --renderer (docs/external-renderers.md).

#include <filesystem>
#include <string>

#include "paths/camera_path.h"
#include "src/app/console.h"
#include "src/app/foreign_frames.h"
#include "src/app/render_job.h"
#include "src/core/camera.h"

namespace promenade::app {

class ExternalRenderer final : public ForeignFrames {
 public:
  /// `command` goes to the shell once a frame with {frame}, {camera}, {out} and {scene} replaced. Requests,
  /// frames and what the command said are kept in `folder`; a frame that was asked for by another command, of
  /// another scene file or for another camera is asked for again. `console` must outlive this.
  ExternalRenderer(std::string command, std::string scene, std::filesystem::path folder, Console& console);

  /// Throws CannotContinue if the command fails or leaves no file.
  [[nodiscard]] std::filesystem::path frame(const Camera& camera, int index) override;

 private:
  std::string command_;
  std::string scene_;
  std::filesystem::path folder_;
  std::string made_;  ///< fingerprint of command and scene
  Console& console_;
};

/// The walk of --renderer: --path FILE, else a camera of the scene if that is glTF.
[[nodiscard]] paths::CameraPath externalPath(const RenderOptions& options, const RenderValues& values);

/// `command` with {name} replaced by the quoted value; what is in braces and no known name stays. Throws
/// InputError unless {out} is in it, and {camera} or {frame}.
[[nodiscard]] std::string filledIn(const std::string& command, int frame, const std::string& camera,
                                   const std::string& out, const std::string& scene);

}  // namespace promenade::app
