#include "src/app/frame_output.h"

#include <cstdio>
#include <utility>

#include "src/io/exr_maps.h"
#include "src/walkthrough/statistics.h"

namespace promenade::app {

using walkthrough::Stopwatch;

io::FrameFile fileOf(walkthrough::FinishedFrame&& frame, const paths::CameraPath& path,
                     const std::string& scene, const std::string& jobHash) {
  io::FrameFile file;
  file.metadata.frame = frame.index;
  file.metadata.framesPerSecond = path.framesPerSecond;
  file.metadata.camera = path.camera(frame.index, frame.radiance.size());
  file.metadata.scene = scene;
  file.metadata.programVersion = PROMENADE_VERSION;
  file.metadata.jobHash = jobHash;
  file.radiance = std::move(frame.radiance);
  file.depth = std::move(frame.visibility.depth);
  file.normal = std::move(frame.visibility.normal);
  file.item = std::move(frame.visibility.item);
  file.flowToNext = std::move(frame.flowToNext);
  file.source = std::move(frame.source);
  return file;
}

FrameFiles::FrameFiles(const OutputFolder& folder, const paths::CameraPath& path, std::string scene,
                       std::string jobHash)
    : folder_(folder), path_(path), scene_(std::move(scene)), jobHash_(std::move(jobHash)) {}

void FrameFiles::write(walkthrough::FinishedFrame&& frame) {
  const Stopwatch watch(seconds_);
  const std::filesystem::path file = folder_.frame(frame.index);
  io::writeFrame(file, fileOf(std::move(frame), path_, scene_, jobHash_));
}

void FrameFiles::writeMiddle(const walkthrough::JudgedMiddle& middle) {
  const Stopwatch watch(seconds_);
  char name[64];
  std::snprintf(name, sizeof(name), "%06d-%06d.exr", middle.segment.first, middle.segment.last);
  io::writeMaps(folder_.map(name), {middle.metric.jnd, middle.metric.pooledJnd, middle.metric.probability});
}

}  // namespace promenade::app
