#pragma once
// 3D warping of ray-traced samples to another view. Two methods, one result: gatherWarp (needs the target's
// visibility: exact silhouettes) and, for frames that another renderer made, forwardWarp (needs the frame
// alone). Sources: McMillan 1997; Mark, McMillan, Bishop 1997; Nehab et al. 2007 (reverse reprojection).

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>

#include "ibr/crease.h"
#include "src/core/frame.h"

namespace promenade::ibr {

enum class Validity : std::uint8_t {
  kValid = 0,
  kOutside,       ///< the source does not cover this direction
  kOccluded,      ///< the source sees another surface there, or this one from behind
  kUndersampled,  ///< the source sampled the surface too coarsely (footprint above the limit)
  kNotTraced,     ///< what the source has there it warped itself: a warped sample is never a source
  kNotWanted,     ///< outside the mask of samples asked for
};
using ValidityMap = Map<struct ValidityTag, Validity>;

/// Source samples as seen from the target, at the target's sample resolution.
struct Warped {
  RadianceMap diffuse;        ///< 0 where neither valid nor undersampled
  RadianceMap viewDependent;  ///< 0 where neither valid nor undersampled
  ValidityMap validity;       ///< radiance is meaningful where kValid; where kUndersampled it is blurred
  /// Surface area of a source sample over that of the target sample (for background: solid angles). 1 for
  /// equal cameras; +inf where the source cannot see the surface from its front, or traced nothing there.
  Map<struct FootprintTag, float> footprint;
  /// Of the settings it was made with: as a footprint nears it, blend() fades it out.
  double footprintLimit = 2.5;
  // What forwardWarp() found that the target sees. Empty: what the target is known to see.
  DepthMap depth;
  ItemBuffer item;
  glm::dvec3 eye{0.0};  ///< the source's: from where its samples were seen
};

struct WarpSettings {
  /// A target sample is valid only if the source sample's area on the surface is at most this many times its
  /// own. > 0.
  double footprintLimit = 2.5;
  double creaseDegrees = kCreaseDegrees;  ///< in (0, 180]
  /// Items that look different from elsewhere; empty: none. Where a surface is turned by an angle, what it
  /// mirrors is turned by twice that, so of these the sample that answers may be turned by half the crease
  /// angle only.
  std::function<bool(ItemId)> viewDependent = {};
  /// A target sample that sees its surface at a smaller cosine to the normal is valid only amid four source
  /// samples that agree, else undersampled: there samples are far apart on the surface, and what lies between
  /// them is not known from one. In [0, 1].
  double grazingCosine = 0.0;
};

/// Fetches each target sample from `source`, of whose samples only the ray-traced ones count (kTraced,
/// kTracedHole, kTracedItem). `target` is the exact visibility of the target camera; the two cameras may
/// differ in everything, resolution too. Where the source has the same camera and the same surface, its
/// radiance comes back bit for bit. What is seen through a transparent item, or mirrored in it, moves with
/// the surface of that item: it is for the caller to trace such items again (ItemTraits). Throws InputError
/// if a map is not of its camera's size.
[[nodiscard]] Warped gatherWarp(const Frame& source, const Visibility& target, const WarpSettings& settings);
/// The same for the samples that `wanted` (the size of the target) selects; the rest is kNotWanted.
[[nodiscard]] Warped gatherWarp(const Frame& source, const Visibility& target, const Mask& wanted,
                                const WarpSettings& settings);

/// What a source shows at one sample of the target: what gatherWarp() puts into its maps.
struct WarpedSample {
  Validity validity = Validity::kNotWanted;
  float footprint = std::numeric_limits<float>::infinity();
  Rgb diffuse{0.0f};
  Rgb viewDependent{0.0f};
};

/// gatherWarp() sample by sample, for a source that answers few of them: no maps are filled. Keeps references
/// to `source`, `target` and `wanted`. Throws InputError as gatherWarp() does.
class SampleGather {
 public:
  SampleGather(const Frame& source, const Visibility& target, const Mask& wanted,
               const WarpSettings& settings);
  SampleGather(SampleGather&&) noexcept;
  SampleGather& operator=(SampleGather&&) noexcept;
  ~SampleGather();

  /// Precondition: sample (x, y) is in the target.
  [[nodiscard]] WarpedSample operator()(int x, int y) const;
  [[nodiscard]] Size size() const;
  [[nodiscard]] double footprintLimit() const;
  /// As Warped::eye.
  [[nodiscard]] glm::dvec3 eye() const;

 private:
  class Gather;
  std::unique_ptr<const Gather> gather_;
};

/// Needs nothing but the frame: its samples are joined to surfaces, which are drawn into the target's image
/// with a z-buffer; the radiance is fetched as by gatherWarp, by the same rules. Depth and item are those of
/// the drawn surfaces, +inf and 0 where nothing of the source fell: kOccluded there if the source looks in
/// that direction, else kOutside. Silhouettes are right to half a source sample. Surfaces that reach behind
/// the target's eye are cut off a sample early. Throws InputError as gatherWarp does.
[[nodiscard]] Warped forwardWarp(const Frame& source, const Camera& target, const WarpSettings& settings);

/// Throws InputError unless every map of `source` has its camera's size and the settings are within their
/// ranges.
void requireValid(const Frame& source, const WarpSettings& settings);

}  // namespace promenade::ibr
