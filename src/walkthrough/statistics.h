#pragma once
// What a run did and what it cost. report.json says the same (docs/formats.md).

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "src/core/renderer.h"
#include "src/walkthrough/plan.h"

namespace promenade::walkthrough {

enum class FrameKind { kKeyframe, kInbetween };

/// What perceptual stopping spent on a frame, and what it predicts (stopping.h).
struct StoppingStatistics {
  std::uint64_t paths = 0;        ///< traced, of all samples
  int mostPaths = 0;              ///< that any sample got
  double predictedPercent = 0.0;  ///< of the pixels would differ visibly between two frames like this
  int openTiles = 0;              ///< still noisier than asked for when the paths ran out
};

struct FrameStatistics {
  int index = 0;
  FrameKind kind = FrameKind::kKeyframe;
  std::uint64_t samples = 0;
  std::uint64_t samplesTraced = 0;  ///< fully shaded; a sample shaded twice counts twice
  std::uint64_t holes = 0;          ///< samples that nothing traced before could fill (traced)
  std::uint64_t itemSamples = 0;    ///< samples of items whose warped look a viewer could tell (traced)
  std::uint64_t disputed = 0;       ///< of itemSamples: of other items, where both keyframes disagree
  std::vector<ItemId> itemsTraced;  ///< those items, sorted
  std::uint64_t warped = 0;         ///< samples taken from keyframes and other inbetweens
  /// Of these, samples of such items of which only the diffuse layer was: the view-dependent one is that of
  /// traced samples of the same frame around them.
  std::uint64_t layered = 0;
  std::uint64_t reused = 0;                    ///< of the warped, samples that no keyframe could fill
  std::uint64_t unknown = 0;                   ///< holes that nobody could trace (SampleSource::kUnknown)
  std::optional<StoppingStatistics> stopping;  ///< nothing: the number of paths was given
  RayCounts rays;                              ///< for this frame alone
  double seconds = 0.0;
};

struct SegmentStatistics {
  Segment segment;
  Decision decision = Decision::kAccept;
  /// Per cent of the remaining (not masked) pixels of the middle frame where a viewer sees a difference.
  double differencePercent = 0.0;
  double maskedPercent = 0.0;      ///< pixels that will be traced anyway: holes and failing items
  double unverifiedPercent = 0.0;  ///< pixels that only one keyframe fills: nothing was compared there
  /// Samples of the middle that were ray traced to check its warp, besides those of the frame itself. None
  /// where the two warps differ too much already.
  std::uint64_t probes = 0;
  /// Per cent of the remaining pixels where a viewer sees what the probes found; 0 without probes.
  double probeDifferencePercent = 0.0;
  RayCounts rays;  ///< for the judgement, probes included; keyframes are not in it
};

/// Wall seconds by part; the parts do not overlap.
struct PartSeconds {
  double trace = 0.0;
  double visibility = 0.0;
  double warp = 0.0;
  double metric = 0.0;
  double filter = 0.0;
  double output = 0.0;  ///< inside the frame sink
};

struct Statistics {
  std::vector<FrameStatistics> frames;      ///< in the order of time
  std::vector<SegmentStatistics> segments;  ///< in the order of judgement
  PartSeconds seconds;

  /// Adds what a later part of the walk did.
  void append(const Statistics& more);

  [[nodiscard]] RayCounts rays() const;
  [[nodiscard]] std::uint64_t samples() const;
  /// Fully shaded samples, those of keyframes and probes included.
  [[nodiscard]] std::uint64_t samplesTraced() const;
  [[nodiscard]] std::uint64_t probes() const;
  [[nodiscard]] std::uint64_t disputed() const;
  [[nodiscard]] int keyframes() const;
  /// samplesTraced() over all samples of all frames.
  [[nodiscard]] double tracedFraction() const;
};

/// Adds the wall time of its scope to a number of seconds.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  double& seconds_;
  Clock::time_point start_ = Clock::now();
};

/// Adds the rays that are traced in its scope to a count.
class RayMeter {
 public:
  RayMeter(const Renderer& renderer, RayCounts& rays)
      : renderer_(renderer), rays_(rays), before_(renderer.rayCounts()) {}
  RayMeter(const RayMeter&) = delete;
  RayMeter& operator=(const RayMeter&) = delete;
  ~RayMeter() { rays_ += renderer_.rayCounts() - before_; }

 private:
  const Renderer& renderer_;
  RayCounts& rays_;
  RayCounts before_;
};

}  // namespace promenade::walkthrough
