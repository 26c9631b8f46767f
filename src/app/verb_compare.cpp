#include <tbb/global_control.h>

#include <algorithm>
#include <filesystem>

#include "aqm/metric.h"
#include "src/app/chosen_tone.h"
#include "src/app/compare_metrics.h"
#include "src/app/compare_region.h"
#include "src/app/compare_report.h"
#include "src/app/compare_settings.h"
#include "src/app/displays.h"
#include "src/app/folders.h"
#include "src/app/formatted.h"
#include "src/app/heatmap.h"
#include "src/app/threads.h"
#include "src/app/values.h"
#include "src/app/verbs.h"
#include "src/app/viewing.h"
#include "src/core/errors.h"
#include "src/io/exr_frame.h"
#include "src/io/exr_maps.h"
#include "src/io/png.h"
#include "src/io/sequence.h"
#include "src/io/text_file.h"

namespace promenade::app {
namespace {

std::string countText(int frames) {
  return std::to_string(frames) + (frames == 1 ? " frame" : " frames");
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
  return formatted("%06d%s", index, extension);
}

struct Pair {
  const io::ImageFile& test;
  const io::ImageFile& reference;
  const std::filesystem::path& testFile;
  const std::filesystem::path& referenceFile;
  const Shown& shown;
};

struct ComparedFrame {
  const CompareOptions& options;
  Metric metric;
  int index;
};

EncodedMap pictureOf(const io::ImageFile& image, const Viewing& viewing, const Shown& shown,
                     const LuminanceMap& seen, float white) {
  return viewing.absolute ? greyPicture(seen, white) : encodedOf(image, shown);
}

// A metric of visibility, and its files.
FrameDifference judged(const Pair& pair, const Viewing& viewing, const VelocityMap& velocity,
                       const aqm::Settings& settings, const ComparedFrame& frame, const Mask& excluded) {
  const LuminanceMap test = luminanceOf(pair.test, viewing, pair.shown, pair.testFile);
  const LuminanceMap reference = luminanceOf(pair.reference, viewing, pair.shown, pair.referenceFile);
  const aqm::Result result = aqm::compare(test, reference, velocity, settings);
  const FrameDifference difference = visibility(result, excluded);
  if (!frame.options.maps.empty()) {
    io::writeMaps(std::filesystem::path(frame.options.maps) / mapName(frame.index, ".exr"),
                  {result.jnd, result.pooledJnd, result.probability, result.signedProbability.pixels()});
  }
  if (!frame.options.heatmap.empty()) {
    const float white =
        std::max(*std::ranges::max_element(test.pixels()), *std::ranges::max_element(reference.pixels()));
    const EncodedMap shownTest = pictureOf(pair.test, viewing, pair.shown, test, white);
    const EncodedMap shownReference = pictureOf(pair.reference, viewing, pair.shown, reference, white);
    const std::string title = formatted(
        "Frame %d: %.2f%% of the pixels visibly different. %s, %.40s, %.1f pixels a degree", frame.index,
        difference.percentVisible, nameOf(frame.metric),
        viewing.absolute ? "cd/m2 as given" : viewing.display.name.c_str(), viewing.pixelsPerDegree);
    io::write8bit(
        std::filesystem::path(frame.options.heatmap) / mapName(frame.index, ".png"),
        heatmap({shownTest, shownReference, result.probability, result.pooledJnd, excluded}, title));
  }
  return difference;
}

// What was asked for and the metric cannot do.
void refuseWhatIsIgnored(const CompareOptions& options, Metric metric) {
  const Finding finding = findingOf(metric);
  if (finding == Finding::kVisibility) return;
  const std::string chosen = "'" + options.metric + "' was chosen";
  if (!options.failAbove.empty() || !options.maps.empty() || !options.heatmap.empty()) {
    throw InputError(
        "--fail-above, --maps, --heatmap: only aqm, aqm2000, revised and vdp have visible pixels and maps, " +
        chosen);
  }
  if (!options.velocity.empty() || !options.eye.empty()) {
    throw InputError("--velocity, --eye: only aqm, aqm2000 and revised know of motion, " + chosen);
  }
  if (const auto choices = made(options.pipeline); !choices.empty()) {
    throw InputError("--" + choices.front().first +
                     ": only aqm, aqm2000, revised and vdp have such choices, " + chosen);
  }
  if (finding == Finding::kDistance && !options.mask.empty()) {
    throw InputError("--mask: the models compare whole frames, " + chosen);
  }
}

// A metric that is one number.
FrameDifference measured(const Pair& pair, const Viewing& viewing, Metric metric, const Mask& excluded) {
  if (findingOf(metric) == Finding::kSquaredError && !viewing.absolute)
    return squaredError(encodedOf(pair.test, pair.shown), encodedOf(pair.reference, pair.shown), excluded);
  const LuminanceMap test = luminanceOf(pair.test, viewing, pair.shown, pair.testFile);
  const LuminanceMap reference = luminanceOf(pair.reference, viewing, pair.shown, pair.referenceFile);
  return findingOf(metric) == Finding::kDistance
             ? modelDistance(metric, test, reference, viewing.pixelsPerDegree)
             : squaredError(test, reference, excluded);
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
  const Metric metric = difference.metric;
  const bool showsVisibility = findingOf(metric) == Finding::kVisibility;
  difference.settings = made(options.pipeline);
  refuseWhatIsIgnored(options, metric);
  Viewing viewing;
  viewing.display = displayNamed(options.display);
  if (!options.ambient.empty()) {
    viewing.display.ambientIlluminance = numberFrom(options.ambient, 0.0, 1e6, "--ambient");
  }
  const ToneOptions toneOptions = toneOptionsFrom(options.tone, options.exposure, options.unit, options.ocio);
  viewing.absolute = options.absolute;
  viewing.pixelsPerDegree = options.ppd.empty() ? viewing.display.pixelsPerDegree()
                                                : numberFrom(options.ppd, 1.0, 10'000.0, "--ppd");
  if (!options.velocity.empty()) viewing.velocity = pairFrom(options.velocity, "--velocity");

  const Viewer viewer{viewing.pixelsPerDegree, viewing.display.viewingDistanceMetres,
                      options.eye.empty() ? aqm::Eye::kTracking : eyeFrom(options.eye)};
  aqm::Settings settings = settingsOf(metric, viewer, options.pipeline);
  if (options.exact) settings.execution = aqm::Execution::kPlain;
  if (showsVisibility && !knowsOfMotion(settings) && !(options.velocity.empty() && options.eye.empty())) {
    throw InputError(
        "--velocity, --eye: only aqm, aqm2000 and revised know of motion, and not with --csf daly or mannos");
  }

  io::Sequence sequences[] = {io::resolveSequence(options.test), io::resolveSequence(options.reference)};
  for (io::Sequence& sequence : sequences) sequence.layer = options.layer;
  io::SequenceReader test(sequences[0]);
  io::SequenceReader reference(sequences[1]);
  if (test.frameCount() != reference.frameCount()) {
    throw InputError(options.test + " has " + countText(test.frameCount()) + " and " + options.reference +
                     " has " + countText(reference.frameCount()) +
                     ": only sequences of equal length can be compared");
  }
  viewing.framesPerSecond = std::max(framesPerSecondOf(options, sequences[0], test),
                                     framesPerSecondOf(options, sequences[1], reference));
  if (!options.absolute) {
    ChosenTone chosen = chosenTone(toneOptions, sequences, viewing.framesPerSecond);
    viewing.tone = std::move(chosen.mapping);
    viewing.firstFrame = chosen.firstFrame;
  }
  difference.pixelsPerDegree = viewing.pixelsPerDegree;
  difference.framesPerSecond = viewing.framesPerSecond;
  if (!options.maps.empty()) makeFolder(options.maps);
  if (!options.heatmap.empty()) makeFolder(options.heatmap);

  Region region(options.mask, test.frameCount());
  Motion motion(viewing);
  const ProgressCallback progress = console.progress();
  const auto count = static_cast<std::uint64_t>(test.frameCount());
  for (int index = 0; index < test.frameCount(); ++index) {
    progress({"frames", static_cast<std::uint64_t>(index), count});
    const auto a = test.next();
    const auto b = reference.next();
    if (!a || !b) throw InputError((a ? options.reference : options.test) + ": ends before its last frame");
    if (a->size() != b->size()) {
      throw InputError(test.file(index).string() + " is " + toString(a->size()) + " and " +
                       reference.file(index).string() + " is " + toString(b->size()) +
                       ": only images of equal size can be compared");
    }
    const Shown shown = shownBoth(*a, *b, viewing, index);
    const Pair pair{*a, *b, test.file(index), reference.file(index), shown};
    const Mask& excluded = region.next(a->size());
    FrameDifference frame;
    if (showsVisibility) {
      const VelocityMap velocity =
          knowsOfMotion(settings) ? motion.next(*a, *b, index + 1 == test.frameCount()) : VelocityMap();
      frame = judged(pair, viewing, velocity, settings, {options, metric, index}, excluded);
    } else {
      frame = measured(pair, viewing, metric, excluded);
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
