#pragma once
// What `promenade compare` says. Pure functions from numbers to text.

#include <string>
#include <utility>
#include <vector>

namespace promenade::app {

enum class Metric { kAqm, kAqm2000, kRevised, kVdp, kRmse, kPsnr, kModel1, kModel2, kModel3 };

/// What a metric says of a frame.
enum class Finding {
  kVisibility,    ///< maps: what a viewer sees
  kSquaredError,  ///< rmse and psnr
  kDistance       ///< one number without a unit
};
[[nodiscard]] Finding findingOf(Metric metric);
/// As typed.
[[nodiscard]] const char* nameOf(Metric metric);

struct FrameDifference {
  int index = 0;  ///< from 0 within the sequence
  // kVisibility
  double percentVisible = 0.0;  ///< pixels with P > 0.75
  double jndMean = 0.0;
  double jndMax = 0.0;
  double pooledJndMax = 0.0;
  double probabilityMean = 0.0;
  // kSquaredError
  double rmse = 0.0;  ///< of display code values in [0, 1]; with --absolute relative to the brightest pixel
                      ///< of both frames
  double psnr = 0.0;  ///< decibels; infinite for equal frames
  // kDistance
  double distance = 0.0;
};

struct SequenceDifference {
  Metric metric = Metric::kAqm;
  std::string test, reference;
  double pixelsPerDegree = 0.0;
  double framesPerSecond = 0.0;
  std::vector<std::pair<std::string, std::string>> settings;  ///< choices that differ from the metric's
  std::vector<FrameDifference> frames;                        ///< at least one
};

/// The frame with the largest difference (the first of equals): an index into `frames`.
[[nodiscard]] std::size_t worstFrame(const SequenceDifference& difference);

/// Keys in docs/formats.md. A PSNR that is infinite is written as null.
[[nodiscard]] std::string differenceJson(const SequenceDifference& difference);
/// A header and a line a frame.
[[nodiscard]] std::string differenceCsv(const SequenceDifference& difference);
/// One line for people.
[[nodiscard]] std::string differenceSummary(const SequenceDifference& difference);

}  // namespace promenade::app
