#pragma once
// The whole road from a path to finished frames: plan, warp, judge, blend, retrace, resolve.
// Source: Myszkowski, Rokita, Tawara 1999, 2000; docs/method.md.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "aqm/metric.h"
#include "ibr/warp.h"
#include "paths/camera_path.h"
#include "src/core/display.h"
#include "src/core/progress.h"
#include "src/core/renderer.h"
#include "src/core/tone_mapping.h"
#include "src/walkthrough/plan.h"
#include "src/walkthrough/statistics.h"

namespace promenade::walkthrough {

enum class Method {
  kImageBased,  ///< keyframes traced, inbetweens warped
  kFull,        ///< every frame traced: the reference
};

/// What becomes of samples that no keyframe fills.
enum class Holes {
  kTraced,  ///< the renderer traces them: they cost, and are right
  kStay,    ///< nobody can: a viewer sees them, and they count as differences when a segment is judged
};

/// When a frame has had enough paths (stopping.h).
struct StoppingRule {
  /// Tiles of which at most so many per cent of the pixels differ visibly between two frames rendered like
  /// this get no more.
  double tolerancePercent = 1.0;
  int firstPaths = 16;   ///< of a sample, then doubled; a power of two
  int mostPaths = 1024;  ///< more would take days: better a warning
  int tile = 16;         ///< display pixels along a tile's edge
};

/// The motion-compensated filter (ibr/temporal_filter.h) and the sub-pixel offsets that feed it.
struct Antialiasing {
  int radius = 3;  ///< frames before and after that a frame is made of, >= 1
  /// Standard deviation of the window in time, frames, > 0; +inf: all frames count alike.
  double deviationFrames = std::numeric_limits<double>::infinity();
  /// Degrees per second over the retina, from where the window is narrower in proportion. > 0.
  double narrowingSpeed = std::numeric_limits<double>::infinity();

  [[nodiscard]] int frames() const { return 2 * radius + 1; }
};

struct Settings {
  Size size{1280, 720};  ///< display pixels
  int supersample = 2;   ///< samples along a pixel's edge, >= 1
  FrameRange frames;     ///< of the path
  Method method = Method::kImageBased;
  double tolerancePercent = 3.0;  ///< of the remaining pixels with P > 0.75; above it a segment is split
  int keyframeSpacing = 16;       ///< frames of the longest first segment
  Holes holes = Holes::kTraced;
  /// Share of the warped samples of a segment's middle that are ray traced to check the warp, in [0, 1]; 0:
  /// none.
  double probeShare = 0.01;
  std::uint64_t seed = 0;  ///< of which samples these are
  /// Nothing: the renderer's own number of paths.
  std::optional<StoppingRule> stopping;
  /// Nothing: a pixel is the mean of its frame's own samples.
  std::optional<Antialiasing> antialiasing;
  ToneMapping tone;
  DisplayModel display;
  ibr::WarpSettings warp;
};

/// A frame at display resolution, ready for output. Maps have Settings::size.
struct FinishedFrame {
  int index = 0;
  FrameKind kind = FrameKind::kKeyframe;
  RadianceMap radiance;
  Visibility visibility;
  PixelFlow flowToNext;  ///< to the path's next frame; zero on the path's last
  SourceMap source;
};

/// What the metric saw in the middle of a judged segment. Maps have Settings::size.
struct JudgedMiddle {
  Segment segment;
  Decision decision = Decision::kAccept;
  EncodedMap fromFirst;
  EncodedMap fromLast;
  Mask excluded;
  aqm::Result metric;
};

/// A frame that was ray traced whole, and what that took.
struct Keyframe {
  Frame frame;
  FrameStatistics statistics;
};

/// Where parts that are rendered apart hand the keyframes that they share to each other.
class KeyframeStore {
 public:
  KeyframeStore() = default;
  KeyframeStore(const KeyframeStore&) = delete;
  KeyframeStore& operator=(const KeyframeStore&) = delete;
  virtual ~KeyframeStore() = default;
  /// Nothing if it is not there: then it is traced.
  [[nodiscard]] virtual std::optional<Keyframe> find(int frame) const = 0;
  /// Told of every keyframe that was traced.
  virtual void keep(int frame, const Keyframe& keyframe) const = 0;
};

struct Outputs {
  std::function<void(FinishedFrame&&)> frame;  ///< frames come in the order of time, each exactly once
  std::function<void(JudgedMiddle&&)> middle;  ///< may be empty
  /// Told of every part when all of its frames were handed over. May be empty.
  std::function<void(const Segment& part, const Statistics&)> part;
  /// Told of every keyframe that was traced, ahead of its delivery. May be empty.
  std::function<void(double seconds)> keyframe;
  ProgressCallback progress;  ///< may be empty; may throw Interrupted
};

/// The parts of a walk that can be rendered apart from each other, on any machine, in any order, with the
/// same result: first segments, divided where it costs least (keyframe_placement.h); single frames with
/// Method::kFull, or first segments of equal length if frames are filtered together. A function of the job:
/// the number of threads changes nothing. `progress` may be empty; may throw Interrupted. Throws InputError
/// as renderParts() does.
[[nodiscard]] Plan partsOf(const paths::CameraPath& path, const Renderer& renderer, const Settings& settings,
                           const ProgressCallback& progress = {});

/// The same where nobody can say what frames see before they are made, or need not: first segments of equal
/// length. Preconditions as of equalSegments().
[[nodiscard]] Plan equalPartsOf(const Settings& settings);

/// The frames that a part delivers and counts: all but its last keyframe, which belongs to the part that
/// begins with it.
[[nodiscard]] FrameRange framesOf(const Segment& part, FrameRange walk);

/// Renders these parts of a division of settings.frames, in the order of time. Memory does not grow with
/// their number. Throws InputError if the settings make no sense for the path (frames outside of it, sizes <
/// 1, tolerance outside [0, 100], probes outside [0, 1]).
Statistics renderParts(const paths::CameraPath& path, const Renderer& renderer, const Settings& settings,
                       const Plan& parts, const Outputs& outputs, const KeyframeStore* store = nullptr);

/// What renderParts() would trace for this frame.
[[nodiscard]] Keyframe traceKeyframe(const paths::CameraPath& path, const Renderer& renderer,
                                     const Settings& settings, int frame);

/// Renders settings.frames of `path`: all parts.
[[nodiscard]] Statistics renderWalkthrough(const paths::CameraPath& path, const Renderer& renderer,
                                           const Settings& settings, const Outputs& outputs);

/// The stops that bring the log-average of these luminances to the middle grey of 0.18 (Reinhard et al. 2002,
/// eq. 1 and 2), rounded to a tenth. They should be means of parts of an image: the noise of single samples
/// must not enter the logarithm. What is not finite does not count; 0 if there is no light. Their order
/// changes nothing.
[[nodiscard]] double exposureOf(std::vector<double> luminances);

/// exposureOf() the blocks of a few small frames spread over the walk: one exposure for all of it.
[[nodiscard]] double automaticExposure(const paths::CameraPath& path, FrameRange frames,
                                       const Renderer& renderer, Size size);

/// What the eyes adapt to on the walk: views of a few small frames (framesToView()), known before the walk is
/// rendered and the same whenever it is. `candelasPerUnit`: cd/m2 of a radiance of 1.
[[nodiscard]] AdaptationCurve adaptationAlong(const paths::CameraPath& path, FrameRange frames,
                                              const Renderer& renderer, Size size, double candelasPerUnit);

/// Upper bound of the bytes that renderWalkthrough holds at once for these settings (scene and solution not
/// counted).
[[nodiscard]] double memoryNeededBytes(const Settings& settings);

}  // namespace promenade::walkthrough
