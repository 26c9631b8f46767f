#pragma once
// Where keyframes pay, told from what the frames of the walk see, before anything is shaded: what of a frame
// could be warped from which other frame follows from depth alone.
// Beyond the papers (Myszkowski, Rokita, Tawara 2000 begin with segments of equal length); docs/method.md.

#include "ibr/warp.h"
#include "paths/camera_path.h"
#include "src/core/progress.h"
#include "src/core/renderer.h"
#include "src/walkthrough/plan.h"

namespace promenade::walkthrough {

struct PlacementSettings {
  FrameRange frames;  ///< of the path
  int longest = 1;    ///< frames from keyframe to keyframe at most, >= 1
  Size shape;         ///< of frames that are rendered: their aspect alone counts
  ibr::WarpSettings warp;
};

/// What has to be ray traced of first segments, in samples of which a frame has about 3600: all of their
/// first keyframe, and of the inbetweens what no source fills. As in finishing a segment (walkthrough.cpp),
/// sources of an inbetween are both keyframes and, for items that look the same from everywhere, the
/// inbetweens that are made before it; a source fills what gatherWarp() would find in it. `renderer` only
/// looks. The answer has an entry for every segment up to `longest` frames that ends within the range; it is
/// the same for any number of threads. What it is asked for may not go back in time. Holds what a window of
/// `longest` frames sees. `path` and `renderer` must outlive it. Preconditions (asserted): the frames are on
/// the path, longest
/// >= 1.
[[nodiscard]] SegmentCosts tracingCosts(const paths::CameraPath& path, const Renderer& renderer,
                                        const PlacementSettings& settings);

/// The first segments that cost least by tracingCosts(). Time grows with frames times `longest`, at first,
/// then with its square; memory with its square. `progress` may be empty; may throw Interrupted.
[[nodiscard]] Plan placeKeyframes(const paths::CameraPath& path, const Renderer& renderer,
                                  const PlacementSettings& settings, const ProgressCallback& progress);

}  // namespace promenade::walkthrough
