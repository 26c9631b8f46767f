#include "src/app/shared_keyframes.h"

#include <nlohmann/json.hpp>

#include "src/io/exr_samples.h"
#include "src/walkthrough/statistics_json.h"
#include "src/walkthrough/view.h"

namespace promenade::app {

using walkthrough::Keyframe;

SharedKeyframes::SharedKeyframes(const OutputFolder& folder, const paths::CameraPath& path,
                                 const walkthrough::Settings& settings, std::string jobHash,
                                 std::set<int> shared)
    : folder_(folder),
      path_(path),
      settings_(settings),
      jobHash_(std::move(jobHash)),
      shared_(std::move(shared)) {}

std::optional<Keyframe> SharedKeyframes::find(int frame) const {
  if (!shared_.contains(frame)) return std::nullopt;
  const Camera camera = walkthrough::sampleCamera(path_, settings_, frame);
  auto samples = io::readSamples(folder_.keyframe(frame), camera, jobHash_);
  if (!samples) return std::nullopt;
  const auto statistics = walkthrough::frameStatisticsFrom(
      nlohmann::json::parse(samples->note.statistics, nullptr, /*allow_exceptions=*/false));
  if (!statistics) return std::nullopt;
  return Keyframe{std::move(samples->frame), *statistics};
}

void SharedKeyframes::keep(int frame, const Keyframe& keyframe) const {
  if (!shared_.contains(frame)) return;
  io::writeSamples(folder_.keyframe(frame), keyframe.frame,
                   {jobHash_, walkthrough::toJson(keyframe.statistics).dump()});
}

}  // namespace promenade::app
