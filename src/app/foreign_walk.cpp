#include "src/app/foreign_walk.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "src/app/exposure.h"
#include "src/app/external_renderer.h"
#include "src/app/fingerprint.h"
#include "src/app/frame_files.h"
#include "src/app/render_job.h"
#include "src/app/threads.h"
#include "src/app/walk_run.h"
#include "src/core/adaptation.h"
#include "src/core/errors.h"
#include "src/io/foreign_frame.h"
#include "src/io/sequence.h"
#include "src/walkthrough/frames_renderer.h"

namespace promenade::app {
namespace {

namespace fs = std::filesystem;

struct ForeignWalk {
  LoadedJob job;
  walkthrough::Plan parts;
  std::map<int, fs::path> files;  ///< of --from; empty: frames are asked for
};

void refuseWhatTheOtherDecides(const RenderOptions& options) {
  const char* by = options.from.empty() ? "--renderer" : "--from";
  for (const auto& [name, isGiven] :
       {std::pair("--environment", !options.environment.empty()), std::pair("--sky", options.sky),
        std::pair("--light-solution", !options.lightSolution.empty())}) {
    if (isGiven)
      throw InputError(std::string(name) + ": with " + by + " the other renderer lights the scene");
  }
}

LoadedJob foreignJob(const RenderOptions& options) {
  LoadedJob job;
  job.options = options;
  job.values = renderValues(options);
  job.options.integrator = "external";
  return job;
}

walkthrough::Settings foreignSettings(const LoadedJob& job) {
  walkthrough::Settings settings = settingsFor(job.options, job.values, job.path);
  settings.stopping.reset();
  settings.holes = walkthrough::Holes::kStay;
  settings.probeShare = 0.0;  // single samples cannot be had
  return settings;
}

// Of frames that are there: between each and the next.
ForeignWalk givenWalk(const RenderOptions& options) {
  ForeignWalk walk;
  walk.job = foreignJob(options);
  LoadedJob& job = walk.job;
  if (job.values.method == walkthrough::Method::kFull) {
    throw InputError("--method: with --from nothing can be rendered in full");
  }
  walk.files = frameFiles(options.from);
  job.path = options.path.empty() ? pathThrough(walk.files, job.values.framesPerSecond)
                                  : walkFor(options, job.values, Scene{});
  job.settings = foreignSettings(job);
  walkthrough::FrameRange& frames = job.settings.frames;
  if (options.frames.empty()) frames = {walk.files.begin()->first, walk.files.rbegin()->first};
  std::erase_if(walk.files,
                [&](const auto& file) { return file.first < frames.first || file.first > frames.last; });
  if (!walk.files.contains(frames.first) || !walk.files.contains(frames.last) ||
      frames.last >= job.path.frameCount()) {
    throw InputError(options.from,
                     "expected frames " + std::to_string(frames.first) + " and " +
                         std::to_string(frames.last) +
                         " (the first and the last that are asked for) to be there, and on the walk");
  }
  const Size samples = io::readForeignFrame(walk.files.begin()->second).radiance.size();
  const int factor = job.settings.supersample;
  if (samples.width % factor != 0 || samples.height % factor != 0) {
    throw InputError("--supersample: frames of " + toString(samples) + " samples are no multiple of " +
                     std::to_string(factor) + "; 1 takes them as they are");
  }
  job.settings.size = {samples.width / factor, samples.height / factor};
  // There are no other keyframes: what the metric finds is reported and changes nothing.
  job.settings.tolerancePercent = 100.0;
  Fingerprint fingerprint;
  fingerprint.add(jobHash(options, job.settings, Scene{}, job.path));
  for (auto file = walk.files.begin(); file != walk.files.end(); ++file) {
    addFile(fingerprint, file->second);
    const auto next = std::next(file);
    if (next != walk.files.end()) walk.parts.push_back({file->first, next->first, 0});
  }
  if (walk.parts.empty()) walk.parts.push_back({frames.first, frames.last, 0});
  job.hash = fingerprint.text();
  return walk;
}

// Of frames that a command makes when it is asked.
ForeignWalk askedWalk(const RenderOptions& options) {
  ForeignWalk walk;
  walk.job = foreignJob(options);
  LoadedJob& job = walk.job;
  job.path = externalPath(options, job.values);
  job.settings = foreignSettings(job);
  job.hash = jobHash(options, job.settings, Scene{}, job.path);
  walk.parts = equalPartsOf(job.settings);
  return walk;
}

/// At most seven frames, spread over the walk, that are keyframes whatever the metric says.
std::vector<int> certainKeyframes(const walkthrough::Plan& parts) {
  constexpr std::size_t kMost = 7;
  std::vector<int> all;
  for (const walkthrough::Segment& part : parts) all.push_back(part.first);
  if (parts.back().last != all.back()) all.push_back(parts.back().last);
  if (all.size() <= kMost) return all;
  std::vector<int> some;
  for (std::size_t k = 0; k < kMost; ++k) some.push_back(all[k * (all.size() - 1) / (kMost - 1)]);
  return some;
}

// As toneFor() does with frames that Promenade traces.
ToneMapping toneOf(const ForeignWalk& walk, ForeignFrames& frames) {
  const LoadedJob& job = walk.job;
  const ToneOptions& asked = job.values.tone;
  ToneMapping tone;
  tone.curve = asked.curve;
  tone.view = asked.view;
  std::map<int, fs::path> keyframes;
  if (!asked.exposureEv || modelsTheEye(tone.curve)) {
    for (const int index : certainKeyframes(walk.parts)) {
      const Camera camera = job.path.camera(index, job.settings.size).supersampled(job.settings.supersample);
      keyframes.emplace(index, frames.frame(camera, index));
    }
  }
  if (asked.exposureEv) {
    tone.exposureEv = *asked.exposureEv;
  } else {
    std::array<io::Sequence, 1> sequence;
    for (const auto& [index, file] : keyframes) sequence[0].images.push_back(file);
    tone.exposureEv = exposureFor(sequence);
  }
  tone.candelasPerUnit = asked.candelasPerUnit.value_or(candelasFromExposure(tone.exposureEv));
  if (modelsTheEye(tone.curve)) {
    std::vector<View> views;
    for (const auto& [index, file] : keyframes) {
      views.push_back(
          viewOf(index, fovealLuminances(io::readForeignFrame(file).radiance), tone.candelasPerUnit));
    }
    tone.adaptation = AdaptationCurve(std::move(views), job.path.framesPerSecond);
  }
  return tone;
}

}  // namespace

bool isForeign(const RenderOptions& options) {
  return !options.from.empty() || !options.renderer.empty();
}

ExitStatus runForeignWalk(const RenderOptions& options, Console& console) {
  if (!options.from.empty() && !options.renderer.empty()) {
    throw InputError("--from, --renderer: expected one of them, found both");
  }
  refuseWhatTheOtherDecides(options);
  const bool isAsked = options.from.empty();
  const ForeignWalk walk = isAsked ? askedWalk(options) : givenWalk(options);
  const LoadedJob& job = walk.job;
  const ThreadLimit threads(job.values.threads);
  const auto prepared = [&](const OutputFolder& folder) {
    std::shared_ptr<ForeignFrames> frames;
    if (isAsked) {
      frames = std::make_shared<ExternalRenderer>(options.renderer, options.scene, folder.file("external"),
                                                  console);
    } else {
      frames = std::make_shared<KnownFrames>(walk.files);
    }
    PreparedJob made;
    {
      const walkthrough::Stopwatch watch(made.choices.secondsChoosing);
      made.choices.tone = toneOf(walk, *frames);
    }
    made.renderer = std::make_unique<walkthrough::FramesRenderer>(
        [frames](const Camera& camera, int index) { return frameFrom(frames->frame(camera, index), camera); },
        job.settings.warp, isAsked ? job.settings.tolerancePercent : 100.0);
    return made;
  };
  return runWalk(job, walk.parts, threads.count(), prepared, console);
}

}  // namespace promenade::app
