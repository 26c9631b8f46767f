#pragma once
// The pictures of a report's page, each as a data URI.

#include <optional>
#include <string>
#include <vector>

#include "src/app/rendered_job.h"
#include "src/core/frame.h"
#include "src/core/progress.h"

namespace promenade::app {

/// Pictures of one frame, all of one size; empty where there is none.
struct FramePictures {
  int index = 0;
  std::string result;
  std::string source;  ///< colours of sourceLooks()
  std::string metric;  ///< thresholdColour() of the probability that a difference is seen
  std::string reference;
  std::optional<double> percentVisible;  ///< of the frame's pixels, against the reference
};

struct SourceLook {
  SampleSource source;
  const char* key;   ///< for programs
  const char* name;  ///< for people
  Rgb colour;        ///< code values
};
/// How the source map is coloured (after Okabe and Ito: told apart by colour-blind people, too).
[[nodiscard]] const std::vector<SourceLook>& sourceLooks();

/// The largest size, at most that of the frames, with which the page of `kinds` pictures a frame stays below
/// about 15 MB. Looks at a few frames.
[[nodiscard]] Size pictureSize(const RenderedJob& job, int kinds);

/// Result and source of every frame that is there, and where the job has maps, the metric's map of the judged
/// middles. Memory holds one frame a thread.
[[nodiscard]] std::vector<FramePictures> framePictures(const RenderedJob& job, Size size,
                                                       const ProgressCallback& progress);

/// Adds reference, metric map and per cent of `reference`, a job of the same size, frame by frame: what a
/// viewer sees of the difference as the camera moves. Throws InputError if sizes differ or frames are
/// missing.
void addReference(std::vector<FramePictures>& pictures, const RenderedJob& job, const RenderedJob& reference,
                  Size size, const ProgressCallback& progress);

}  // namespace promenade::app
