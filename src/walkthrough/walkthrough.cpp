#include "src/walkthrough/walkthrough.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "ibr/flow.h"
#include "src/core/errors.h"
#include "src/core/resolve.h"
#include "src/walkthrough/inbetween.h"
#include "src/walkthrough/judge.h"
#include "src/walkthrough/stopping.h"
#include "src/walkthrough/verify.h"

namespace promenade::walkthrough {
namespace {

void validate(const paths::CameraPath& path, const Settings& settings) {
  const FrameRange frames = settings.frames;
  if (frames.first < 0 || frames.last < frames.first || frames.last >= path.frameCount()) {
    throw InputError("frames " + std::to_string(frames.first) + "-" + std::to_string(frames.last),
                     "the path has frames 0-" + std::to_string(path.frameCount() - 1));
  }
  if (settings.size.width < 1 || settings.size.height < 1) throw InputError("size", "expected at least 1x1");
  if (settings.supersample < 1) throw InputError("supersample", "expected at least 1");
  if (const auto& rule = settings.stopping) {
    if (rule->firstPaths < 1 || rule->mostPaths < rule->firstPaths || rule->tile < 1) {
      throw InputError("stopping", "expected at least one path first, no fewer at most, tiles of a pixel");
    }
  }
  if (settings.keyframeSpacing < 1) throw InputError("spacing", "expected at least 1");
  if (!(settings.tolerancePercent >= 0.0 && settings.tolerancePercent <= 100.0)) {
    throw InputError("tolerance", "expected a per cent in [0, 100]");
  }
  if (!(settings.probeShare >= 0.0 && settings.probeShare <= 1.0)) {
    throw InputError("verify", "expected a share in [0, 1]");
  }
}

/// One walk from beginning to end. Holds the keyframes that are still needed and nothing older.
class Walk {
 public:
  Walk(const paths::CameraPath& path, const Renderer& renderer, const Settings& settings,
       const Outputs& outputs)
      : path_(path),
        settings_(settings),
        outputs_(outputs),
        stopping_(settings.stopping ? std::make_unique<StoppingRenderer>(renderer, settings) : nullptr),
        renderer_(stopping_ ? *stopping_ : renderer),
        raysBefore_(renderer.rayCounts()) {}

  Statistics run() {
    if (settings_.method == Method::kFull) {
      for (int frame = settings_.frames.first; frame <= settings_.frames.last; ++frame) {
        keyframe(frame);
        finishKeyframe(frame);
        keyframes_.clear();
      }
    } else {
      subdivide(
          settings_.frames, settings_.keyframeSpacing,
          [this](const Segment& segment) { return judge(segment); },
          [this](const Segment& segment) { finish(segment); });
    }
    statistics_.rays = renderer_.rayCounts() - raysBefore_;
    if (stopping_) {
      statistics_.seconds.trace -= stopping_->secondsInMetric();
      statistics_.seconds.metric += stopping_->secondsInMetric();
    }
    return std::move(statistics_);
  }

 private:
  struct Keyframe {
    Frame frame;
    FrameStatistics statistics;
    bool finished = false;
  };
  struct JudgedInbetween {
    int index = -1;
    WarpedPair warped;
    ItemVerdict verdict;
  };

  [[nodiscard]] Camera displayCamera(int frame) const { return path_.camera(frame, settings_.size); }
  [[nodiscard]] Camera sampleCamera(int frame) const {
    return displayCamera(frame).supersampled(settings_.supersample);
  }

  const Frame& keyframe(int index) {
    const auto found = keyframes_.find(index);
    if (found != keyframes_.end()) return found->second.frame;
    const double before = statistics_.seconds.trace;
    Keyframe made;
    {
      const Stopwatch watch(statistics_.seconds.trace);
      made.frame = renderer_.render(sampleCamera(index), index);
    }
    made.statistics.index = index;
    made.statistics.kind = FrameKind::kKeyframe;
    made.statistics.samples = made.frame.diffuse.size().area();
    made.statistics.samplesTraced = made.statistics.samples;
    made.statistics.seconds = statistics_.seconds.trace - before;
    if (stopping_) made.statistics.stopping = stopping_->spent();
    return keyframes_.emplace(index, std::move(made)).first->second.frame;
  }

  WarpedPair warpTo(int index, const Segment& segment) {
    const Frame& first = keyframe(segment.first);
    const Frame& last = keyframe(segment.last);
    WarpedPair pair;
    {
      const Stopwatch watch(statistics_.seconds.visibility);
      pair.target = renderer_.visibility(sampleCamera(index));
    }
    const Stopwatch watch(statistics_.seconds.warp);
    pair.fromFirst = ibr::gatherWarp(first, pair.target, settings_.warp);
    pair.fromLast = ibr::gatherWarp(last, pair.target, settings_.warp);
    return pair;
  }

  [[nodiscard]] VelocityMap velocityAt(int index, const Visibility& samples) const {
    const Visibility pixels = resolveVisibility(samples, settings_.supersample);
    const auto flowTo = [&](int other) {
      return other >= 0 && other < path_.frameCount() ? ibr::pixelFlow(pixels, displayCamera(other))
                                                      : PixelFlow();
    };
    return ibr::imageVelocity(flowTo(index - 1), flowTo(index + 1), path_.framesPerSecond,
                              settings_.display.pixelsPerDegree());
  }

  Decision judge(const Segment& segment) {
    JudgedInbetween middle;
    middle.index = segment.middle();
    middle.warped = warpTo(middle.index, segment);
    VelocityMap velocity;
    Judgement judgement;
    {
      const Stopwatch watch(statistics_.seconds.metric);
      velocity = velocityAt(middle.index, middle.warped.target);
      judgement = judgeMiddle(segment, middle.warped, velocity, renderer_, settings_);
    }
    if (judgement.statistics.decision == Decision::kAccept && settings_.probeShare > 0.0) {
      Verification verification = verifyMiddle(
          {middle.index, placeOf(middle.index, segment), middle.warped, velocity, judgement.items}, renderer_,
          settings_, statistics_.seconds);
      judgement.items = std::move(verification.items);
      judgement.statistics.probes = verification.probes;
      judgement.statistics.probeDifferencePercent = verification.differencePercent;
      judgement.statistics.decision = judgement.middle.decision = verification.decision;
    }
    statistics_.segments.push_back(judgement.statistics);
    const Decision decision = judgement.statistics.decision;
    if (outputs_.middle) outputs_.middle(std::move(judgement.middle));
    if (decision == Decision::kAccept) {
      middle.verdict = std::move(judgement.items);
      middle_ = std::move(middle);
    }
    return decision;
  }

  /// In (0, 1) between the keyframes of its segment.
  [[nodiscard]] static double placeOf(int index, const Segment& segment) {
    return static_cast<double>(index - segment.first) / static_cast<double>(segment.last - segment.first);
  }

  void finish(const Segment& segment) {
    keyframe(segment.first);
    finishKeyframe(segment.first);
    finishBetween(segment, segment.first, segment.last, {});
    keyframe(segment.last);
    finishKeyframe(segment.last);
    // Nothing before the segment's end is a source of anything that is still to come.
    keyframes_.erase(keyframes_.begin(), keyframes_.lower_bound(segment.last));
    middle_ = {};
  }

  /// The middle first, so that what was traced of it serves both halves. Frames leave in the order of time
  /// all the same: at any time only the middles around the current frame are held.
  void finishBetween(const Segment& segment, int first, int last,
                     const std::vector<const Inbetween*>& sources) {
    if (last - first < 2) return;
    const int middle = first + (last - first) / 2;
    const Inbetween made = makeInbetween(middle, segment, sources);
    std::vector<const Inbetween*> more = sources;
    if (made.statistics.holes > 0) more.push_back(&made);
    finishBetween(segment, first, middle, more);
    output(middle, made.frame, made.statistics);
    finishBetween(segment, middle, last, more);
  }

  Inbetween makeInbetween(int index, const Segment& segment, const std::vector<const Inbetween*>& others) {
    const auto start = std::chrono::steady_clock::now();
    InbetweenSources sources;
    sources.keyframes = index == middle_.index ? std::move(middle_.warped) : warpTo(index, segment);
    {
      const Stopwatch watch(statistics_.seconds.warp);
      const Visibility& target = sources.keyframes.target;
      const Mask shared = sharedAmongInbetweens(target.item, renderer_);
      for (const Inbetween* other : others) {
        sources.others.push_back(
            {other->statistics.index, ibr::gatherWarp(other->frame, target, shared, settings_.warp)});
      }
    }
    Inbetween made = synthesise(std::move(sources), segment, index, middle_.verdict, renderer_,
                                settings_.supersample, statistics_.seconds);
    if (stopping_) made.statistics.stopping = stopping_->spent();
    made.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return made;
  }

  void finishKeyframe(int index) {
    Keyframe& key = keyframes_.at(index);
    if (std::exchange(key.finished, true)) return;
    output(index, key.frame, key.statistics);
  }

  void output(int index, const Frame& frame, FrameStatistics statistics) {
    FinishedFrame finished;
    finished.index = index;
    finished.kind = statistics.kind;
    {
      const Stopwatch watch(statistics_.seconds.filter);
      const int factor = settings_.supersample;
      finished.radiance = resolveRadiance(combinedRadiance(frame), factor);
      finished.visibility = resolveVisibility(frame.visibility, factor);
      finished.source = resolveSource(frame.source, factor);
      finished.flowToNext = index + 1 < path_.frameCount()
                                ? ibr::pixelFlow(finished.visibility, displayCamera(index + 1))
                                : PixelFlow(settings_.size, glm::vec2(0.0f));
    }
    statistics_.frames.push_back(std::move(statistics));
    {
      const Stopwatch watch(statistics_.seconds.output);
      if (outputs_.frame) outputs_.frame(std::move(finished));
    }
    if (outputs_.progress) {
      outputs_.progress(
          {"frames", statistics_.frames.size(), static_cast<std::uint64_t>(settings_.frames.count())});
    }
  }

  const paths::CameraPath& path_;
  const Settings& settings_;
  const Outputs& outputs_;
  const std::unique_ptr<StoppingRenderer> stopping_;  ///< null: the renderer's own number of paths
  const Renderer& renderer_;
  const RayCounts raysBefore_;  ///< choosing the exposure
  std::map<int, Keyframe> keyframes_;
  JudgedInbetween middle_;  ///< of the segment that was accepted last
  Statistics statistics_;
};

}  // namespace

Statistics renderWalkthrough(const paths::CameraPath& path, const Renderer& renderer,
                             const Settings& settings, const Outputs& outputs) {
  validate(path, settings);
  return Walk(path, renderer, settings, outputs).run();
}

double memoryNeededBytes(const Settings& settings) {
  // A sample of a frame takes 45 bytes, one of a warped source 45. At once: the keyframes of the current line
  // of splits and the inbetweens around the current frame, as many together as the spacing can be halved; as
  // many warps; the middle's and an inbetween's visibility and two warps each, the blended frame. A display
  // pixel takes at most 1 kB in the metric and the maps around it.
  const double samples =
      static_cast<double>(settings.size.area()) * settings.supersample * settings.supersample;
  const double halvings = std::ceil(std::log2(settings.keyframeSpacing));
  const double frames = settings.method == Method::kFull ? 1.0 : 3.0 + 2.0 * halvings;
  const double others = settings.method == Method::kFull ? 1.0 : 8.0;
  const double metric = settings.method == Method::kFull ? 200.0 : 1000.0;
  return samples * 45.0 * (frames + others) + static_cast<double>(settings.size.area()) * metric;
}

}  // namespace promenade::walkthrough
