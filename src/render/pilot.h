#pragma once
// How many paths a reflection gets until it is clean. Whoever stops by the paths that are averaged stops
// early where they found nothing bright, and goes on where they did: too dark (Kirk and Arvo, Unbiased
// Sampling Techniques for Image Synthesis, SIGGRAPH 1991). Their cure is a pilot that is thrown away. Here
// every sample keeps its pilot, and the pilots of the samples around it, not its own (but for bright dots),
// tell how many paths it gets; together they also know the variance far better than one of them. Not part of
// the folder's public face.

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "src/core/image.h"

namespace promenade::render {

struct SampleRadiance {
  Rgb diffuse{0.0f};
  Rgb viewDependent{0.0f};
};

/// The first paths of a reflection at the end of a line of sight.
struct Pilot {
  SampleRadiance sum;
  int paths = 0;
  int most = 0;               ///< paths in all, at least `paths`
  float variance = 0.0f;      ///< of one path, in the luminance that the eye gets
  float squaredLimit = 0.0f;  ///< square of the standard error at which the reflection is clean
  int wanted = 0;             ///< paths in all: `paths`, until somebody decides
};

/// Those of a sample, in the order in which its lines of sight meet them.
struct Pilots {
  std::vector<Pilot> lines;
  std::size_t next = 0;  ///< for whoever goes on
};

struct PilotedSample {
  glm::ivec2 position{0, 0};
  std::uint32_t instance = 0;  ///< that the eye sees there
  Pilots pilots;
};

/// Decides how many paths the reflections of neighbouring samples get: as many as those up to kPilotReach
/// samples away on the same instance need together, rounded down to the pilot's number times a power of two.
/// A sample that has fewer than kLeastPilots beside it asks its own too. And one whose own pilot leaves far
/// more noise than is clean, as it met what its neighbours did not, would be a bright dot among them: it gets
/// at least what brings that to kOutlier times the clean noise, rounded down as well.
void choosePaths(std::span<PilotedSample> samples);
constexpr float kOutlier = 3.0f;
constexpr int kPilotReach = 4;
constexpr int kLeastPilots = 4;

}  // namespace promenade::render
