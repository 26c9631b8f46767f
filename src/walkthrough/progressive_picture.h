#pragma once
// A frame that gets more and more paths, and what is known of its error while it does.

#include <functional>
#include <optional>
#include <utility>

#include "src/walkthrough/walkthrough.h"

namespace promenade::walkthrough {

/// Seconds since some moment, from any thread.
using Clock = std::function<double()>;

/// Root of the mean square of the contrast 2 (a - b) / (a + b) of two pictures on the display, in [0, 2]: for
/// small differences the relative one. Both are of one size and not black anywhere, as no display is.
[[nodiscard]] double rmsContrast(const LuminanceMap& a, const LuminanceMap& b);

class ProgressivePicture {
 public:
  /// Of settings.frames.first, whose camera at display resolution is `camera`. All must outlive this.
  ProgressivePicture(const Renderer& renderer, const Camera& camera, const Settings& settings,
                     const Clock& clock);

  /// Traces so many more paths of every sample that they would still change: 1 at first, then a power of two
  /// that divides paths(), so that all of them stay stratified.
  void trace(int count);
  /// The most that trace() takes, up to `most` and so that it is expected to end within `seconds`; 0: none.
  [[nodiscard]] int affordable(double seconds, int most) const;

  [[nodiscard]] int paths() const { return paths_; }
  /// No sample would be changed by more paths.
  [[nodiscard]] bool isClean() const { return isClean_; }
  /// That tracing took.
  [[nodiscard]] double seconds() const { return seconds_; }
  /// That as many paths are expected to take as the last ones did, in proportion.
  [[nodiscard]] double secondsFor(int count) const { return count * secondsPerPath_; }
  /// Ends it.
  [[nodiscard]] Frame take() { return std::move(frame_); }
  /// Resolved to settings.size.
  [[nodiscard]] RadianceMap picture() const;

  /// Pictures of the first M paths and of all later ones, M being the last power of two before paths(), of
  /// which there are two at least.
  struct Parts {
    RadianceMap earlier, later;
  };
  [[nodiscard]] Parts parts() const;

  /// Standard deviation of the picture from what it converges to, as rmsContrast(); nothing before there are
  /// two paths. The picture is compared with itself after M of its N paths (parts()). Their difference has
  /// the variance s^2 (1/M - 1/N), if s^2 is that of a single path, and the picture s^2 / N: M / (N - M)
  /// times as much, which is 1 after half of the paths (stopping.h).
  [[nodiscard]] std::optional<double> error() const;
  /// Per cent of pixels that would differ visibly between two such pictures (stopping.h), from the same.
  [[nodiscard]] std::optional<double> predictedPercent() const;

 private:
  struct Seen {
    LuminanceMap now, before;
  };
  [[nodiscard]] Seen seen() const;
  [[nodiscard]] double deviationScale() const;

  const Renderer& renderer_;
  const Settings& settings_;
  const Clock& clock_;
  Frame frame_;
  Mask open_;
  RadianceMap before_;  ///< the picture after pathsBefore_ paths
  int pathsBefore_ = 0;
  int paths_ = 0;
  bool isClean_ = false;
  mutable std::optional<double> predictedPercent_;  ///< of paths_, if it was asked for
  double seconds_ = 0.0;
  double secondsPerPath_ = 0.0;
};

}  // namespace promenade::walkthrough
