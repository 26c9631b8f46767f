#include "src/walkthrough/walkthrough.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "src/core/errors.h"
#include "src/core/resolve.h"
#include "src/walkthrough/finishing.h"
#include "src/walkthrough/inbetween.h"
#include "src/walkthrough/judge.h"
#include "src/walkthrough/keyframe_placement.h"
#include "src/walkthrough/stopping.h"
#include "src/walkthrough/verify.h"
#include "src/walkthrough/view.h"

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
  if (const auto& antialiasing = settings.antialiasing) {
    if (antialiasing->radius < 1 || !(antialiasing->deviationFrames > 0.0) ||
        !(antialiasing->narrowingSpeed > 0.0)) {
      throw InputError("antialiasing", "expected at least one frame, a deviation and a speed above 0");
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

/// The first of the frames up to `frame` that all have its camera; `frame` itself where the camera moves.
int stillSince(const paths::CameraPath& path, int frame) {
  const auto alike = [](const paths::PathFrame& a, const paths::PathFrame& b) {
    return a.pose.worldFromCamera == b.pose.worldFromCamera && a.pose.eye == b.pose.eye &&
           a.verticalFieldOfView == b.verticalFieldOfView;
  };
  auto i = static_cast<std::size_t>(frame);
  while (i > 0 && alike(path.frames[i - 1], path.frames[i])) --i;
  return static_cast<int>(i);
}

/// One walk from beginning to end. Holds the keyframes that are still needed and nothing older.
class Walk {
 public:
  Walk(const paths::CameraPath& path, const Renderer& renderer, const Settings& settings,
       const Outputs& outputs, const KeyframeStore* store)
      : path_(path),
        settings_(settings),
        outputs_(outputs),
        store_(store),
        stopping_(settings.stopping ? std::make_unique<StoppingRenderer>(renderer, settings) : nullptr),
        renderer_(stopping_ ? *stopping_ : renderer),
        finishing_(path, settings, [this](FinishedFrame&& frame) { deliver(std::move(frame)); }) {}

  Statistics run(const Plan& parts) {
    for (const Segment& part : parts) {
      total_ += static_cast<std::uint64_t>(framesOf(part, settings_.frames).count());
    }
    // The clock of rate and time left starts here.
    if (outputs_.progress) outputs_.progress({"frames", 0, total_});
    Statistics all;
    for (const Segment& part : parts) {
      statistics_ = {};
      const double stoppingBefore = secondsStopping();
      run(part);
      statistics_.seconds.filter += finishing_.takeSeconds();
      statistics_.seconds.trace -= secondsStopping() - stoppingBefore;
      statistics_.seconds.metric += secondsStopping() - stoppingBefore;
      if (outputs_.part) outputs_.part(part, statistics_);
      all.append(statistics_);
    }
    return all;
  }

  Keyframe trace(int index) {
    Keyframe made;
    double& seconds = statistics_.seconds.trace;
    const double before = seconds;
    {
      const Stopwatch watch(seconds);
      const RayMeter meter(renderer_, made.statistics.rays);
      // While the camera stands every frame gets the same random numbers: nobody may see noise come and go.
      // Another renderer is asked for frames by their number.
      const int numbers = settings_.holes == Holes::kStay ? index : stillSince(path_, index);
      made.frame = renderer_.render(sampleCamera(path_, settings_, index), numbers);
    }
    made.statistics.index = index;
    made.statistics.kind = FrameKind::kKeyframe;
    made.statistics.samples = made.frame.diffuse.size().area();
    made.statistics.samplesTraced = made.statistics.samples;
    made.statistics.seconds = seconds - before;
    if (stopping_) made.statistics.stopping = stopping_->spent();
    return made;
  }

 private:
  struct JudgedInbetween {
    int index = -1;
    WarpedPair warped;
    ItemVerdict verdict;
  };

  void run(const Segment& part) {
    // Between parts that do not follow each other nothing is shared.
    keyframes_.erase(keyframes_.begin(), keyframes_.lower_bound(part.first));
    finishing_.begin({part.first, part.last});
    if (settings_.method == Method::kFull) {
      traceAll(part);
    } else {
      subdivide(
          part, [this](const Segment& segment) { return judge(segment); },
          [this](const Segment& segment) { finish(segment); });
    }
    if (part.first == part.last) return;
    if (part.last == settings_.frames.last) {
      finishKeyframe(part.last);
    } else if (settings_.antialiasing) {
      const auto next = keyframe(part.last);
      finishing_.addContext(part.last, {next, &next->frame});
    }
  }

  void traceAll(const Segment& part) {
    const int end = std::max(part.first + 1, part.last);
    for (int frame = part.first; frame < end; ++frame) {
      finishKeyframe(frame);
      keyframes_.erase(frame);
    }
  }

  /// Of the metric, inside of render() and retrace().
  [[nodiscard]] double secondsStopping() const { return stopping_ ? stopping_->secondsInMetric() : 0.0; }

  std::shared_ptr<const Keyframe> keyframe(int index) {
    const auto found = keyframes_.find(index);
    if (found != keyframes_.end()) return found->second;
    const auto hold = [&](Keyframe&& keyframe) {
      return keyframes_.emplace(index, std::make_shared<const Keyframe>(std::move(keyframe))).first->second;
    };
    if (store_ != nullptr) {
      if (auto kept = store_->find(index)) return hold(std::move(*kept));
    }
    const auto made = hold(trace(index));
    if (outputs_.keyframe) outputs_.keyframe(made->statistics.seconds);
    if (store_ != nullptr) store_->keep(index, *made);
    return made;
  }

  // Apart from what is done with them, so that each frame's rays and seconds are its own.
  void traceKeyframes(const Segment& segment) {
    keyframe(segment.first);
    keyframe(segment.last);
  }

  WarpedPair warpTo(int index, const Segment& segment, const std::vector<const Inbetween*>& others) {
    const auto first = keyframe(segment.first);
    const auto last = keyframe(segment.last);
    WarpedPair pair;
    {
      const Stopwatch watch(statistics_.seconds.visibility);
      std::vector<const Frame*> known{&first->frame, &last->frame};
      for (const Inbetween* other : others) known.push_back(&other->frame);
      pair.target = renderer_.visibilityAmong(sampleCamera(path_, settings_, index), known);
    }
    const Stopwatch watch(statistics_.seconds.warp);
    ibr::WarpSettings settings = settings_.warp;
    settings.viewDependent = [this](ItemId item) { return renderer_.traits(item).viewDependent; };
    pair.fromFirst = ibr::gatherWarp(first->frame, pair.target, settings);
    pair.fromLast = ibr::gatherWarp(last->frame, pair.target, settings);
    pair.disputed = disputedSamples(pair);
    return pair;
  }

  Decision judge(const Segment& segment) {
    traceKeyframes(segment);
    JudgedInbetween middle;
    middle.index = segment.middle();
    Judgement judgement;
    RayCounts rays;
    {
      const RayMeter meter(renderer_, rays);
      middle.warped = warpTo(middle.index, segment, {});
      judgement = judgementOf(segment, middle.warped);
    }
    judgement.statistics.rays = rays;
    statistics_.segments.push_back(judgement.statistics);
    const Decision decision = judgement.statistics.decision;
    if (outputs_.middle) outputs_.middle(std::move(judgement.middle));
    if (decision == Decision::kAccept) {
      middle.verdict = std::move(judgement.items);
      middle_ = std::move(middle);
    }
    return decision;
  }

  Judgement judgementOf(const Segment& segment, const WarpedPair& warped) {
    const int index = segment.middle();
    VelocityMap velocity;
    Judgement judgement;
    {
      const Stopwatch watch(statistics_.seconds.metric);
      const Visibility pixels = resolveVisibility(warped.target, settings_.supersample);
      velocity = velocityOf(path_, settings_, pixels, index);
      judgement = judgeMiddle(segment, warped, velocity, renderer_, settings_);
    }
    if (judgement.statistics.decision == Decision::kAccept && settings_.probeShare > 0.0) {
      Verification verification =
          verifyMiddle({index, placeOf(index, segment), warped, velocity, judgement.items}, renderer_,
                       settings_, statistics_.seconds);
      judgement.items = std::move(verification.items);
      judgement.statistics.probes = verification.probes;
      judgement.statistics.probeDifferencePercent = verification.differencePercent;
      judgement.statistics.decision = judgement.middle.decision = verification.decision;
    }
    return judgement;
  }

  /// In (0, 1) between the keyframes of its segment.
  [[nodiscard]] static double placeOf(int index, const Segment& segment) {
    return static_cast<double>(index - segment.first) / static_cast<double>(segment.last - segment.first);
  }

  // The last keyframe is finished by what begins with it.
  void finish(const Segment& segment) {
    finishKeyframe(segment.first);
    if (segment.hasInbetweens()) traceKeyframes(segment);
    finishBetween(segment, segment.first, segment.last, {});
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
    const auto made = std::make_shared<const Inbetween>(makeInbetween(middle, segment, sources));
    std::vector<const Inbetween*> more = sources;
    // What nobody knows is no source of anything.
    if (made->statistics.holes > 0 && made->statistics.samplesTraced > 0) more.push_back(made.get());
    finishBetween(segment, first, middle, more);
    finish(middle, {made, &made->frame}, made->statistics);
    finishBetween(segment, middle, last, more);
  }

  Inbetween makeInbetween(int index, const Segment& segment, const std::vector<const Inbetween*>& others) {
    const auto start = std::chrono::steady_clock::now();
    RayCounts rays;
    Inbetween made;
    {
      const RayMeter meter(renderer_, rays);
      InbetweenSources sources;
      sources.keyframes = index == middle_.index ? std::move(middle_.warped) : warpTo(index, segment, others);
      sources.others = others;
      made = synthesise(std::move(sources), segment, index, middle_.verdict, renderer_, settings_,
                        statistics_.seconds);
    }
    made.statistics.rays = rays;
    if (stopping_) made.statistics.stopping = stopping_->spent();
    made.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return made;
  }

  void finishKeyframe(int index) {
    const auto key = keyframe(index);
    finish(index, {key, &key->frame}, key->statistics);
  }

  void finish(int index, std::shared_ptr<const Frame> samples, FrameStatistics statistics) {
    const FrameKind kind = statistics.kind;
    statistics_.frames.push_back(std::move(statistics));
    finishing_.add(index, std::move(samples), kind);
  }

  void deliver(FinishedFrame&& frame) {
    {
      const Stopwatch watch(statistics_.seconds.output);
      if (outputs_.frame) outputs_.frame(std::move(frame));
    }
    ++delivered_;
    if (outputs_.progress) outputs_.progress({"frames", delivered_, total_});
  }

  const paths::CameraPath& path_;
  const Settings& settings_;
  const Outputs& outputs_;
  const KeyframeStore* store_;                        ///< null: parts share nothing but through this walk
  const std::unique_ptr<StoppingRenderer> stopping_;  ///< null: the renderer's own number of paths
  const Renderer& renderer_;
  std::map<int, std::shared_ptr<const Keyframe>> keyframes_;
  Finishing finishing_;
  JudgedInbetween middle_;  ///< of the segment that was accepted last
  Statistics statistics_;   ///< of the part at hand
  std::uint64_t delivered_ = 0;
  std::uint64_t total_ = 0;
};

}  // namespace

Plan partsOf(const paths::CameraPath& path, const Renderer& renderer, const Settings& settings,
             const ProgressCallback& progress) {
  validate(path, settings);
  if (settings.method == Method::kFull) return equalPartsOf(settings);
  return placeKeyframes(path, renderer,
                        {settings.frames, settings.keyframeSpacing, settings.size, settings.warp}, progress);
}

Statistics renderParts(const paths::CameraPath& path, const Renderer& renderer, const Settings& settings,
                       const Plan& parts, const Outputs& outputs, const KeyframeStore* store) {
  validate(path, settings);
  return Walk(path, renderer, settings, outputs, store).run(parts);
}

Keyframe traceKeyframe(const paths::CameraPath& path, const Renderer& renderer, const Settings& settings,
                       int frame) {
  validate(path, settings);
  const Outputs none;
  return Walk(path, renderer, settings, none, nullptr).trace(frame);
}

Statistics renderWalkthrough(const paths::CameraPath& path, const Renderer& renderer,
                             const Settings& settings, const Outputs& outputs) {
  return renderParts(path, renderer, settings, partsOf(path, renderer, settings), outputs);
}

}  // namespace promenade::walkthrough
