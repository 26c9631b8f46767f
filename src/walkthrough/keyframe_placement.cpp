#include "src/walkthrough/keyframe_placement.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <memory>
#include <unordered_map>
#include <vector>

#include "ibr/source_lookup.h"

namespace promenade::walkthrough {
namespace {

/// Samples of a frame that are counted. 1800 gave the same within a tenth, for little less time.
constexpr double kCounted = 3600.0;
/// A frame is looked at in so many times as many rows and columns: what lies closer together than samples
/// cannot be told apart, so that coarser views are less often found to agree. Measured (docs/experiments.md).
constexpr int kFiner = 2;

/// The counted samples: a grid of about kCounted cells, each as near to a square as can be.
Size gridOf(Size shape) {
  const double aspect = static_cast<double>(shape.width) / shape.height;
  const double width = std::clamp(std::round(std::sqrt(kCounted * aspect)), 1.0, kCounted);
  const double height = std::clamp(std::round(kCounted / width), 1.0, kCounted);
  return {static_cast<int>(width), static_cast<int>(height)};
}

/// A bit for every counted sample.
using Bits = std::vector<std::uint64_t>;

/// What `isSet` says of the view's sample in every cell: another place in the cell from one to the next, so
/// that no line of the scene falls between all of them.
template <class IsSet>
Bits bitsOf(Size grid, const IsSet& isSet) {
  Bits bits((grid.area() + 63) / 64);
  std::size_t i = 0;
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x, ++i) {
      const bool set = isSet(kFiner * x + x % kFiner, kFiner * y + (x + y) % kFiner);
      bits[i / 64] |= std::uint64_t{set} << (i % 64);
    }
  }
  return bits;
}

/// The frames from a keyframe to the last that could be the next one, and what each of them finds in each.
class Window {
 public:
  Window(const paths::CameraPath& path, const Renderer& renderer, const PlacementSettings& settings)
      : path_(path),
        renderer_(renderer),
        settings_(settings),
        grid_(gridOf(settings.shape)),
        length_(std::min(settings.longest, settings.frames.count() - 1) + 1),
        seen_(static_cast<std::size_t>(length_)),
        fills_(seen_.size() * seen_.size()),
        next_(settings.frames.first) {
    assert(settings.frames.first >= 0 && settings.frames.last < path.frameCount());
    assert(settings.frames.count() >= 1 && settings.longest >= 1);
  }

  std::vector<std::int64_t> costsFrom(int first) {
    const int last = std::min(first + length_ - 1, settings_.frames.last);
    for (; next_ <= last; ++next_) lookAt(next_, first);
    std::vector<std::int64_t> costs(static_cast<std::size_t>(last - first));
    tbb::parallel_for(0, last - first, [&](int k) {
      const int end = first + 1 + k;
      costs[static_cast<std::size_t>(k)] =
          static_cast<std::int64_t>(grid_.area()) + holesBetween(first, end, {first, end});
    });
    return costs;
  }

 private:
  struct Seen {
    Visibility visibility;
    Bits matt;  ///< samples of items that look the same from everywhere
  };

  void lookAt(int frame, int first) {
    const Size size{kFiner * grid_.width, kFiner * grid_.height};
    Visibility visibility = renderer_.visibility(path_.camera(frame, size));
    Bits matt = mattOf(visibility);
    seen_[slot(frame)] = {std::move(visibility), std::move(matt)};
    tbb::parallel_for(first, frame, [&](int other) {
      fills_[pair(frame, other)] = foundIn(other, frame);
      fills_[pair(other, frame)] = foundIn(frame, other);
    });
  }

  [[nodiscard]] Bits mattOf(const Visibility& visibility) const {
    std::unordered_map<ItemId, bool> known;
    return bitsOf(grid_, [&](int x, int y) {
      const auto [entry, isNew] = known.try_emplace(visibility.item(x, y));
      if (isNew) entry->second = !renderer_.traits(entry->first).viewDependent;
      return entry->second;
    });
  }

  [[nodiscard]] Bits foundIn(int source, int target) const {
    const ibr::SourceLookup lookup(seen_[slot(source)].visibility, seen_[slot(target)].visibility,
                                   settings_.warp);
    return bitsOf(grid_, [&](int x, int y) { return lookup(x, y).validity == ibr::Validity::kValid; });
  }

  /// Of the inbetweens of (first, last), the middle first. `sources`: the two keyframes of their segment,
  /// then inbetweens of it.
  [[nodiscard]] std::int64_t holesBetween(int first, int last, const std::vector<int>& sources) const {
    if (last - first < 2) return 0;
    const int middle = first + (last - first) / 2;
    const std::int64_t holes = holesOf(middle, sources);
    std::vector<int> more = sources;
    if (holes > 0) more.push_back(middle);
    return holes + holesBetween(first, middle, more) + holesBetween(middle, last, more);
  }

  [[nodiscard]] std::int64_t holesOf(int target, const std::vector<int>& sources) const {
    const Bits& fromFirst = fills_[pair(target, sources[0])];
    const Bits& fromLast = fills_[pair(target, sources[1])];
    const Bits& matt = seen_[slot(target)].matt;
    auto holes = static_cast<std::int64_t>(grid_.area());
    for (std::size_t i = 0; i < matt.size(); ++i) {
      std::uint64_t shared = 0;
      for (std::size_t k = 2; k < sources.size(); ++k) shared |= fills_[pair(target, sources[k])][i];
      holes -= std::popcount(fromFirst[i] | fromLast[i] | (shared & matt[i]));
    }
    return holes;
  }

  [[nodiscard]] std::size_t slot(int frame) const { return static_cast<std::size_t>(frame % length_); }
  [[nodiscard]] std::size_t pair(int target, int source) const {
    return slot(target) * seen_.size() + slot(source);
  }

  const paths::CameraPath& path_;
  const Renderer& renderer_;
  PlacementSettings settings_;
  Size grid_;
  int length_;               ///< frames
  std::vector<Seen> seen_;   ///< by slot
  std::vector<Bits> fills_;  ///< what of one frame is found in another, by pair
  int next_;                 ///< to be looked at
};

}  // namespace

SegmentCosts tracingCosts(const paths::CameraPath& path, const Renderer& renderer,
                          const PlacementSettings& settings) {
  return [window = std::make_shared<Window>(path, renderer, settings)](int first) {
    return window->costsFrom(first);
  };
}

Plan placeKeyframes(const paths::CameraPath& path, const Renderer& renderer,
                    const PlacementSettings& settings, const ProgressCallback& progress) {
  const FrameRange frames = settings.frames;
  const auto total = static_cast<std::uint64_t>(frames.count() - 1);
  const SegmentCosts costs = tracingCosts(path, renderer, settings);
  return cheapestSegments(frames, [&](int first) {
    if (progress)
      progress({"keyframes placed to frame", static_cast<std::uint64_t>(first - frames.first), total});
    return costs(first);
  });
}

}  // namespace promenade::walkthrough
