#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <numeric>

#include "aqm/metric.h"
#include "ibr/flow.h"
#include "src/app/compare_report.h"
#include "src/app/displays.h"
#include "src/app/exposure.h"
#include "src/app/folders.h"
#include "src/app/heatmap.h"
#include "src/app/motion.h"
#include "src/app/threads.h"
#include "src/app/values.h"
#include "src/app/verbs.h"
#include "src/core/errors.h"
#include "src/io/exr_frame.h"
#include "src/io/exr_maps.h"
#include "src/io/png.h"
#include "src/io/sequence.h"
#include "src/io/text_file.h"

namespace promenade::app {
namespace {

Metric metricFrom(const std::string& name) {
  const std::string chosen =
      choiceFrom(name, {"aqm", "rmse", "psnr", "aqm2000", "vdp", "model1", "model2", "model3"}, "--metric");
  if (chosen == "aqm") return Metric::kAqm;
  if (chosen == "rmse") return Metric::kRmse;
  if (chosen == "psnr") return Metric::kPsnr;
  throw InputError("--metric: '" + chosen + "' is not available yet; aqm, rmse and psnr are");
}

std::string sizeText(Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

std::string countText(int frames) {
  return std::to_string(frames) + (frames == 1 ? " frame" : " frames");
}

// How files become what a viewer sees.
struct Viewing {
  ToneMapping tone;
  DisplayModel display;
  double pixelsPerDegree = 0.0;
  double framesPerSecond = 0.0;
  bool absolute = false;
  std::optional<glm::vec2> velocity;  // degrees per second, everywhere
};

EncodedMap encodedOf(const io::ImageFile& image, const Viewing& viewing) {
  if (const auto* radiance = std::get_if<RadianceMap>(&image.colour))
    return encodeForDisplay(*radiance, viewing.tone);
  return std::get<EncodedMap>(image.colour).clone();
}

LuminanceMap luminanceOf(const io::ImageFile& image, const Viewing& viewing,
                         const std::filesystem::path& file) {
  if (!viewing.absolute) return displayLuminance(encodedOf(image, viewing), viewing.display);
  if (image.luminance.empty()) {
    throw InputError(file.string(), "--absolute: expected a channel Y (luminance in cd/m2), found none");
  }
  // The metric needs light everywhere; nobody sees a difference below this.
  constexpr float kDarkest = 1e-4f;
  LuminanceMap luminances = image.luminance.clone();
  for (float& l : luminances.pixels()) {
    if (l < kDarkest) l = kDarkest;
  }
  return luminances;
}

// Gives each frame its velocity from the flows of this frame and the one before.
class Motion {
 public:
  explicit Motion(const Viewing& viewing) : viewing_(viewing) {}

  VelocityMap next(const io::ImageFile& test, const io::ImageFile& reference, bool last) {
    const Size size = test.size();
    if (viewing_.velocity) return VelocityMap(size, *viewing_.velocity);
    PixelFlow toNext = meanFlow(test.flowToNext, reference.flowToNext);
    PixelFlow toPrevious = previous_.empty() ? PixelFlow() : flowToPrevious(previous_);
    previous_ = toNext.clone();
    if (last && !toPrevious.empty() && isStill(toNext)) toNext = PixelFlow();
    if (toNext.empty() && toPrevious.empty()) return VelocityMap();
    return ibr::imageVelocity(toPrevious, toNext, viewing_.framesPerSecond, viewing_.pixelsPerDegree);
  }

 private:
  const Viewing& viewing_;
  PixelFlow previous_;  // of the frame before, to this one
};

template <class T>
double meanOf(std::span<const T> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

FrameDifference aqmDifference(const aqm::Result& result) {
  FrameDifference f;
  const auto jnd = result.jnd.pixels();
  const auto pooled = result.pooledJnd.pixels();
  f.percentVisible = aqm::percentVisible(result.probability, Mask());
  f.jndMean = meanOf<float>(jnd);
  f.jndMax = static_cast<double>(*std::max_element(jnd.begin(), jnd.end()));
  f.pooledJndMax = static_cast<double>(*std::max_element(pooled.begin(), pooled.end()));
  f.probabilityMean = meanOf<float>(result.probability.pixels());
  return f;
}

FrameDifference squaredDifference(double sumOfSquares, double count) {
  FrameDifference f;
  f.rmse = std::sqrt(sumOfSquares / count);
  f.psnr = f.rmse > 0.0 ? -20.0 * std::log10(f.rmse) : std::numeric_limits<double>::infinity();
  return f;
}

FrameDifference rmsDifference(const EncodedMap& a, const EncodedMap& b) {
  double sum = 0.0;
  const auto first = a.pixels();
  const auto second = b.pixels();
  for (std::size_t i = 0; i < first.size(); ++i) {
    const glm::dvec3 d(glm::dvec3(first[i]) - glm::dvec3(second[i]));
    sum += d.x * d.x + d.y * d.y + d.z * d.z;
  }
  return squaredDifference(sum, 3.0 * static_cast<double>(first.size()));
}

FrameDifference rmsDifference(const LuminanceMap& a, const LuminanceMap& b) {
  double sum = 0.0;
  double peak = 0.0;
  const auto first = a.pixels();
  const auto second = b.pixels();
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double d = static_cast<double>(first[i]) - static_cast<double>(second[i]);
    peak = std::max({peak, static_cast<double>(first[i]), static_cast<double>(second[i])});
    sum += d * d;
  }
  return squaredDifference(sum / (peak * peak), static_cast<double>(first.size()));
}

// Of a video, of Promenade's frames, else 25.
double framesPerSecondOf(const CompareOptions& options, const io::Sequence& sequence,
                         const io::SequenceReader& reader) {
  if (!options.fps.empty()) return numberFrom(options.fps, 0.001, 10'000.0, "--fps");
  if (const auto fps = reader.framesPerSecond()) return *fps;
  if (!sequence.images.empty() && sequence.images.front().extension() == ".exr") {
    try {
      const double fps = io::readFrameMetadata(sequence.images.front()).framesPerSecond;
      if (fps > 0.0) return fps;
    } catch (const InputError&) {
      // Frames of another program do not say.
    }
  }
  return 25.0;
}

std::string mapName(int index, const char* extension) {
  char name[32];
  std::snprintf(name, sizeof(name), "%06d%s", index, extension);
  return name;
}

}  // namespace

ExitStatus runCompare(const CompareOptions& options, Console& console) {
  const ThreadLimit threads(integerFrom(options.threads, 0, 4096, "--threads"));
  SequenceDifference difference;
  difference.metric = metricFrom(options.metric);
  difference.test = options.test;
  difference.reference = options.reference;
  std::optional<double> failAbove;
  if (!options.failAbove.empty()) failAbove = numberFrom(options.failAbove, 0.0, 100.0, "--fail-above");
  const bool isAqm = difference.metric == Metric::kAqm;
  if (!isAqm && (failAbove || !options.maps.empty() || !options.heatmap.empty())) {
    throw InputError("--fail-above, --maps, --heatmap: only metric aqm has visible pixels and maps, '" +
                     options.metric + "' was chosen");
  }
  Viewing viewing;
  viewing.display = displayNamed(options.display);
  viewing.tone.curve = toneFrom(options.tone, "--tone");
  viewing.absolute = options.absolute;
  viewing.pixelsPerDegree = options.ppd.empty() ? viewing.display.pixelsPerDegree()
                                                : numberFrom(options.ppd, 1.0, 10'000.0, "--ppd");
  if (!options.velocity.empty()) viewing.velocity = pairFrom(options.velocity, "--velocity");

  const io::Sequence sequences[] = {io::resolveSequence(options.test),
                                    io::resolveSequence(options.reference)};
  io::SequenceReader test(sequences[0]);
  io::SequenceReader reference(sequences[1]);
  if (test.frameCount() != reference.frameCount()) {
    throw InputError(options.test + " has " + countText(test.frameCount()) + " and " + options.reference +
                     " has " + countText(reference.frameCount()) +
                     ": only sequences of equal length can be compared");
  }
  viewing.framesPerSecond = std::max(framesPerSecondOf(options, sequences[0], test),
                                     framesPerSecondOf(options, sequences[1], reference));
  viewing.tone.exposureEv = options.absolute ? 0.0 : chosenExposure(options.exposure, sequences);
  difference.pixelsPerDegree = viewing.pixelsPerDegree;
  difference.framesPerSecond = viewing.framesPerSecond;
  if (!options.maps.empty()) makeFolder(options.maps);
  if (!options.heatmap.empty()) makeFolder(options.heatmap);

  Motion motion(viewing);
  const ProgressCallback progress = console.progress();
  const auto count = static_cast<std::uint64_t>(test.frameCount());
  for (int index = 0; index < test.frameCount(); ++index) {
    progress({"frames", static_cast<std::uint64_t>(index), count});
    const auto a = test.next();
    const auto b = reference.next();
    if (!a || !b) throw InputError((a ? options.reference : options.test) + ": ends before its last frame");
    if (a->size() != b->size()) {
      throw InputError(test.file(index).string() + " is " + sizeText(a->size()) + " and " +
                       reference.file(index).string() + " is " + sizeText(b->size()) +
                       ": only images of equal size can be compared");
    }
    FrameDifference frame;
    if (isAqm) {
      const LuminanceMap seenTest = luminanceOf(*a, viewing, test.file(index));
      const LuminanceMap seenReference = luminanceOf(*b, viewing, reference.file(index));
      const VelocityMap velocity = motion.next(*a, *b, index + 1 == test.frameCount());
      // What is measured here is published: no shortcuts (they move 'per cent visible' by up to 2 points
      // where a regular pattern lies at the threshold).
      const aqm::Result result =
          aqm::compare(seenTest, seenReference, velocity,
                       {.pixelsPerDegree = viewing.pixelsPerDegree, .execution = aqm::Execution::kPlain});
      frame = aqmDifference(result);
      if (!options.maps.empty()) {
        io::writeMaps(std::filesystem::path(options.maps) / mapName(index, ".exr"),
                      {result.jnd, result.pooledJnd, result.probability});
      }
      if (!options.heatmap.empty()) {
        io::write8bit(std::filesystem::path(options.heatmap) / mapName(index, ".png"),
                      heatmap(result.probability, seenReference));
      }
    } else if (viewing.absolute) {
      frame = rmsDifference(luminanceOf(*a, viewing, test.file(index)),
                            luminanceOf(*b, viewing, reference.file(index)));
    } else {
      frame = rmsDifference(encodedOf(*a, viewing), encodedOf(*b, viewing));
    }
    frame.index = index;
    difference.frames.push_back(frame);
  }
  progress({"frames", count, count});
  console.endProgress();

  if (!options.csv.empty()) io::writeTextFile(options.csv, differenceCsv(difference));
  console.result(options.json ? differenceJson(difference) : differenceSummary(difference));
  const bool tooMuch = failAbove && difference.frames[worstFrame(difference)].percentVisible > *failAbove;
  return tooMuch ? ExitStatus::kDifferenceAboveLimit : ExitStatus::kDone;
}

}  // namespace promenade::app
