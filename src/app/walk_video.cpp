#include "src/app/walk_video.h"

#include "src/app/interrupt.h"
#include "src/io/exr_frame.h"
#include "src/walkthrough/statistics.h"

namespace promenade::app {

using walkthrough::Stopwatch;

WalkVideo::WalkVideo(const std::filesystem::path& file, const OutputFolder& folder,
                     const walkthrough::Settings& settings, double framesPerSecond)
    : folder_(folder),
      tone_(settings.tone),
      display_(settings.display),
      walk_(settings.frames),
      video_(file, settings.size, io::frameRateFrom(framesPerSecond)),
      next_(settings.frames.first) {}

void WalkVideo::add(int frame, const RadianceMap& radiance) {
  const Stopwatch watch(seconds_);
  addFromFolder(frame);
  write(frame, io::asStored(radiance));
  next_ = frame + 1;
}

void WalkVideo::finish() {
  const Stopwatch watch(seconds_);
  addFromFolder(walk_.last + 1);
  video_.finish();
}

void WalkVideo::write(int frame, const RadianceMap& radiance) {
  video_.write(encodeForDisplay(radiance, tone_.at(frame, display_)));
}

void WalkVideo::addFromFolder(int end) {
  for (; next_ < end; ++next_) {
    throwIfInterrupted();
    write(next_, io::readFrame(folder_.frame(next_)).radiance);
  }
}

}  // namespace promenade::app
