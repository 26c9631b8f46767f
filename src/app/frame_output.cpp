#include "src/app/frame_output.h"

#include <cstdio>

#include "src/io/exr_frame.h"
#include "src/io/exr_maps.h"
#include "src/walkthrough/statistics.h"

namespace promenade::app {

using walkthrough::Stopwatch;

FrameOutput::FrameOutput(const OutputFolder& folder, const paths::CameraPath& path, Size size,
                         FrameOutputSettings settings)
    : folder_(folder),
      path_(path),
      settings_(std::move(settings)),
      video_(settings_.video, size, io::frameRateFrom(path.framesPerSecond)) {}

void FrameOutput::add(walkthrough::FinishedFrame&& frame) {
  // A resumed job begins at a keyframe that may be finished already.
  if (frame.index < nextFrame_) return;
  nextFrame_ = frame.index + 1;
  {
    const Stopwatch watch(secondsEncoding_);
    video_.write(encodeForDisplay(frame.radiance, settings_.tone));
  }
  const Stopwatch watch(secondsWriting_);
  io::FrameFile file;
  file.metadata.frame = frame.index;
  file.metadata.framesPerSecond = path_.framesPerSecond;
  file.metadata.camera = path_.camera(frame.index, frame.radiance.size());
  file.metadata.scene = settings_.scene;
  file.metadata.programVersion = PROMENADE_VERSION;
  file.metadata.jobHash = settings_.jobHash;
  file.radiance = std::move(frame.radiance);
  file.depth = std::move(frame.visibility.depth);
  file.normal = std::move(frame.visibility.normal);
  file.item = std::move(frame.visibility.item);
  file.flowToNext = std::move(frame.flowToNext);
  file.source = std::move(frame.source);
  io::writeFrame(folder_.frame(file.metadata.frame), file);
}

void FrameOutput::addFinished(int index) {
  const Stopwatch watch(secondsEncoding_);
  video_.write(encodeForDisplay(io::readFrame(folder_.frame(index)).radiance, settings_.tone));
  nextFrame_ = index + 1;
}

void FrameOutput::addMiddle(const walkthrough::JudgedMiddle& middle) {
  const Stopwatch watch(secondsWriting_);
  char name[64];
  std::snprintf(name, sizeof(name), "%06d-%06d.exr", middle.segment.first, middle.segment.last);
  io::writeMaps(folder_.map(name), {middle.metric.jnd, middle.metric.pooledJnd, middle.metric.probability});
}

void FrameOutput::finish() {
  const Stopwatch watch(secondsEncoding_);
  video_.finish();
}

}  // namespace promenade::app
