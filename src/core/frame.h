#pragma once
// What a renderer delivers and what warping consumes: samples, each with exactly one primary hit.

#include <cstdint>

#include "src/core/camera.h"
#include "src/core/image.h"

namespace promenade {

/// How the radiance of a sample came about (the `Source` channel of the output).
enum class SampleSource : std::uint8_t {
  kTraced = 0,
  kWarpedFromPrevious = 1,
  kWarpedFromNext = 2,
  kBlended = 3,
  kTracedHole = 4,
  kTracedItem = 5,
  kUnknown = 6,  ///< coloured like its surroundings: nobody could trace it (walkthrough/frames_renderer.h)
};
using SourceMap = Map<struct SourceTag, SampleSource>;

/// What the primary rays of a camera see; no light in it. All maps have camera.size().
struct Visibility {
  Camera camera;
  DepthMap depth;
  NormalMap normal;
  ItemBuffer item;
};

/// A frame of samples (camera.size() of them). A supersampled frame is simply a larger Frame: a sample never
/// mixes two surfaces; resolve() (src/core/resolve.h) filters samples to display pixels as the last step.
/// The radiance of a sample is diffuse + viewDependent: `diffuse` looks the same from everywhere (diffuse
/// reflection and emission), `viewDependent` does not (specular reflection, transmission).
struct Frame {
  Visibility visibility;
  RadianceMap diffuse;
  RadianceMap viewDependent;
  SourceMap source;
};

/// Black, to be traced.
[[nodiscard]] Frame unshaded(Visibility&& visibility);

/// diffuse + viewDependent.
[[nodiscard]] RadianceMap combinedRadiance(const Frame& frame);

}  // namespace promenade
