#pragma once
// What the walkthrough needs of a renderer, so that another renderer can stand in its place.

#include <cstdint>
#include <span>

#include "src/core/frame.h"

namespace promenade {

/// What the planner must know of an item to decide whether its look may change with the viewpoint.
struct ItemTraits {
  /// Strongly specular, glossy or transparent by its material: warping may show a wrong reflection.
  bool viewDependent = false;
  /// Standard deviation of a traced sample's view-dependent radiance, as a share of all it shows, that may be
  /// taken for noise where neighbours are compared. 0: none, and what it shows may change from sample to
  /// sample, as in a mirror, or where a texture shapes the reflection.
  float noise = 0.0f;
};

/// Ray counts since the renderer was made, all threads.
struct RayCounts {
  std::uint64_t visibility = 0;  ///< primary rays that were not shaded
  std::uint64_t primary = 0;     ///< primary rays of shaded samples
  std::uint64_t scattered = 0;   ///< every later ray of a path
  std::uint64_t shadow = 0;

  RayCounts& operator+=(const RayCounts& more);
  bool operator==(const RayCounts&) const = default;
};

/// What the textures took since the renderer was made.
struct TextureUse {
  std::uint64_t bytes = 0;            ///< of decoded texels that are kept now
  std::uint64_t levelsRead = 0;       ///< mip levels that were decoded or made
  std::uint64_t levelsReadAgain = 0;  ///< of these, how many had been dropped for want of memory
};

/// A stretch of a sample's paths.
struct PathRange {
  int before = 0;  ///< paths that the sample has had: 0, or a multiple of `count`
  int count = 1;   ///< paths to trace now, >= 1; powers of two stratify best
};

struct Refined {
  Mask open;                ///< of the samples asked for, those that more paths would still change
  std::uint64_t paths = 0;  ///< traced
};

[[nodiscard]] RayCounts operator-(const RayCounts& now, const RayCounts& before);

class Renderer {
 public:
  Renderer() = default;
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;
  virtual ~Renderer() = default;

  /// Primary rays only: a few per cent of the cost of render().
  [[nodiscard]] virtual Visibility visibility(const Camera& camera) const = 0;

  /// The same, where frames of the walk around it are known: a renderer that cannot trace has nothing else to
  /// go by.
  [[nodiscard]] virtual Visibility visibilityAmong(const Camera& camera,
                                                   std::span<const Frame* const> known) const;

  /// Shades the samples selected by `mask` (the size of the camera) and writes them into `frame`, whose
  /// visibility is that of `camera`, marking them with `source`. `frameIndex` seeds the random numbers with
  /// pixel and sample: the same call gives the same pixels for any number of threads.
  virtual void retrace(Frame& frame, const Mask& mask, SampleSource source, int frameIndex) const = 0;

  /// Traces a stretch of the paths of the samples selected by `mask` and averages it with those that they
  /// have had (before == 0: replaces what is there), for whoever decides when to stop
  /// (walkthrough/stopping.h). The samples become SampleSource::kTraced. Repeatable as retrace() is. A
  /// renderer whose number of paths is its own business keeps this default: everything at once, and nothing
  /// stays open.
  [[nodiscard]] virtual Refined refine(Frame& frame, const Mask& mask, PathRange paths, int frameIndex) const;

  /// Every sample traced and shaded.
  [[nodiscard]] virtual Frame render(const Camera& camera, int frameIndex) const = 0;

  [[nodiscard]] virtual ItemTraits traits(ItemId item) const = 0;
  [[nodiscard]] virtual RayCounts rayCounts() const = 0;
  /// Nothing for a renderer that reads none.
  [[nodiscard]] virtual TextureUse textureUse() const { return {}; }
};

}  // namespace promenade
