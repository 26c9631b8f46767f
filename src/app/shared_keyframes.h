#pragma once
// Keyframes that two parts of a walk share, traced once and handed on as files (DIR/keyframes/000016.exr).

#include <set>
#include <string>

#include "paths/camera_path.h"
#include "src/app/output_folder.h"
#include "src/walkthrough/walkthrough.h"

namespace promenade::app {

/// Other keyframes than the shared ones are not kept.
class SharedKeyframes final : public walkthrough::KeyframeStore {
 public:
  /// `folder`, `path` and `settings` must outlive this. `shared`: numbers of the frames in the walk.
  SharedKeyframes(const OutputFolder& folder, const paths::CameraPath& path,
                  const walkthrough::Settings& settings, std::string jobHash, std::set<int> shared);

  [[nodiscard]] std::optional<walkthrough::Keyframe> find(int frame) const override;
  void keep(int frame, const walkthrough::Keyframe& keyframe) const override;

 private:
  const OutputFolder& folder_;
  const paths::CameraPath& path_;
  const walkthrough::Settings& settings_;
  std::string jobHash_;
  std::set<int> shared_;
};

}  // namespace promenade::app
