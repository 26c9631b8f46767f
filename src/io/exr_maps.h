#pragma once
// The metric's maps as an OpenEXR file: float channels J, Jp and P, and SignedP
// where there is one.

#include <filesystem>
#include <span>

#include "src/core/image.h"

namespace promenade::io {

struct MetricMaps {
  const JndMap& jnd;                              ///< J
  const JndMap& pooledJnd;                        ///< Jp
  const ProbabilityMap& probability;              ///< P
  std::span<const float> signedProbability = {};  ///< SignedP, row by row; empty: no such channel
};

/// Float, because a threshold on P must give the same count after a round trip. Whole or not at all; the same
/// maps give the same bytes. Precondition (asserted): equal sizes, at least one pixel.
void writeMaps(const std::filesystem::path& file, const MetricMaps& maps);

/// The channel P of a file that writeMaps() wrote. Throws InputError if the file is missing, damaged, or has
/// no such channel.
[[nodiscard]] ProbabilityMap readProbability(const std::filesystem::path& file);

}  // namespace promenade::io
