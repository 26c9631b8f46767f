#pragma once
// How long a walk will take, from what its frames took up to now.

#include <optional>
#include <string>

namespace promenade::app {

/// Keyframes are rendered ahead of the frames that are finished, and cost many times what the others do: a
/// rate of finished frames alone would promise far too little time at first, or far too much. One thread at a
/// time.
class Forecast {
 public:
  /// `frames`, >= 1, of which so many, >= 1, are keyframes at the least.
  Forecast(int frames, int keyframes) : frames_(frames), fewestKeyframes_(keyframes) {}

  void keyframeRendered(double seconds);
  void frameFinished(bool keyframe);

  /// Once the first keyframe is measured: "a keyframe takes 12s: 2m 36s to 40m 00s for all 200 frames", from
  /// no more keyframes than planned and inbetweens that cost nothing to a keyframe for every frame.
  [[nodiscard]] std::string firstEstimate() const;

  /// `elapsed` seconds after the first frame was begun. What was spent on frames that are not finished yet is
  /// theirs: each of the frames that are left will take what those that are finished took, and the keyframes
  /// that wait are paid. Nothing before the first frame is finished.
  [[nodiscard]] std::optional<double> secondsLeft(double elapsed) const;

 private:
  [[nodiscard]] double keyframeSeconds() const;

  int frames_;
  int fewestKeyframes_;
  int keyframesRendered_ = 0;
  int keyframesFinished_ = 0;
  int framesFinished_ = 0;
  double secondsInKeyframes_ = 0.0;
};

}  // namespace promenade::app
