#include "src/app/frame_output.h"

#include <memory>
#include <utility>

#include "src/app/formatted.h"
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

FrameFiles::~FrameFiles() {
  try {
    writing_.wait();
  } catch (...) {
    // Not asked for by finish(): another error is on its way.
  }
}

void FrameFiles::write(walkthrough::FinishedFrame&& frame) {
  finish();
  // A task is called as a constant.
  writing_.run([this, held = std::make_shared<walkthrough::FinishedFrame>(std::move(frame))] {
    const std::filesystem::path file = folder_.frame(held->index);
    io::writeFrame(file, fileOf(std::move(*held), path_, scene_, jobHash_));
  });
}

void FrameFiles::writeMiddle(walkthrough::JudgedMiddle&& middle) {
  finish();
  writing_.run([this, held = std::make_shared<const walkthrough::JudgedMiddle>(std::move(middle))] {
    const std::string name = formatted("%06d-%06d.exr", held->segment.first, held->segment.last);
    io::writeMaps(folder_.map(name), {held->metric.jnd, held->metric.pooledJnd, held->metric.probability});
  });
}

void FrameFiles::finish() {
  const Stopwatch watch(seconds_);
  writing_.wait();
}

}  // namespace promenade::app
