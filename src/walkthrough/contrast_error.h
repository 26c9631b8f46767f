#pragma once
// From the errors of a few scattered samples to an image of the error, without what is only noise.

#include <glm/vec2.hpp>
#include <span>

#include "src/core/image.h"

namespace promenade::walkthrough {

/// What a probe found: log(luminance traced / luminance warped), as the display shows a sample.
struct ProbeError {
  glm::vec2 pixel{0.0f};  ///< display pixels
  float error = 0.0f;
  float area = 1.0f;  ///< samples that it stands for
};

/// Logarithm of a ratio of luminances: for small values the local contrast of the error.
using ContrastErrorMap = Map<struct ContrastErrorTag, float>;

/// The mean error around each pixel under a Gaussian window of standard deviation `spacingPixels` (> 0, the
/// mean distance of probes), less three of its standard errors: 0 where the errors around do not agree, be it
/// because the traced samples are noisy or because edges are off by a part of a sample in both directions.
/// The standard errors come from the probes themselves, so that the noise need not be known. 0 where there
/// are fewer than about four probes.
[[nodiscard]] ContrastErrorMap contrastErrors(Size size, std::span<const ProbeError> probes,
                                              double spacingPixels);

}  // namespace promenade::walkthrough
