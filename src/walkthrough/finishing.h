#pragma once
// The last step of a frame: from samples to pixels, alone or with the frames around it
// (Settings::antialiasing).

#include <functional>
#include <map>
#include <memory>
#include <utility>

#include "paths/camera_path.h"
#include "src/walkthrough/walkthrough.h"

namespace promenade::walkthrough {

/// The frames of a part that the pixels of one of them are made of: the nearest Antialiasing::frames() of the
/// part, so that at its ends they lie to one side; the frame alone without antialiasing. A part never looks
/// beyond its ends, and so comes out the same whoever renders it.
[[nodiscard]] FrameRange windowOf(int frame, FrameRange part, const Settings& settings);

/// Takes the samples of a part's frames in the order of time and hands on their pixels, those of a frame as
/// soon as the last of its window is there. Holds the samples of one window.
class Finishing {
 public:
  using Sink = std::function<void(FinishedFrame&&)>;
  /// `path` and `settings` must outlive this.
  Finishing(const paths::CameraPath& path, const Settings& settings, Sink sink);

  /// A part begins: `part` are all of its frames, those it delivers and its last keyframe, which it need not.
  void begin(FrameRange part);
  /// The next frame of the part, to be delivered.
  void add(int index, std::shared_ptr<const Frame> samples, FrameKind kind);
  /// The next frame of the part, which another part delivers: it only serves the others.
  void addContext(int index, std::shared_ptr<const Frame> samples);
  /// Wall seconds since the last call, the sink's left out.
  [[nodiscard]] double takeSeconds() { return std::exchange(seconds_, 0.0); }

 private:
  struct Held {
    std::shared_ptr<const Frame> samples;
    FrameKind kind = FrameKind::kKeyframe;
  };
  void hold(int index, Held held);
  [[nodiscard]] FinishedFrame finished(int index) const;
  [[nodiscard]] RadianceMap pixelsOf(int index, const Visibility& visibility) const;

  const paths::CameraPath& path_;
  const Settings& settings_;
  Sink sink_;
  FrameRange part_;
  std::map<int, Held> held_;
  int next_ = 0;      ///< to be delivered
  int delivers_ = 0;  ///< frames before this one are for delivery
  double seconds_ = 0.0;
};

}  // namespace promenade::walkthrough
