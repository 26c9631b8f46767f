#include <algorithm>
#include <filesystem>
#include <span>

#include "src/app/chosen_tone.h"
#include "src/app/displays.h"
#include "src/app/values.h"
#include "src/app/verbs.h"
#include "src/core/errors.h"
#include "src/io/exr_frame.h"
#include "src/io/sequence.h"
#include "src/io/video.h"

namespace promenade::app {
namespace {

EncodedMap cropped(const EncodedMap& image, const Crop& crop) {
  EncodedMap part(crop.size);
  for (int y = 0; y < crop.size.height; ++y) {
    const auto row = image.row(crop.y + y).subspan(static_cast<std::size_t>(crop.x));
    std::copy_n(row.begin(), crop.size.width, part.row(y).begin());
  }
  return part;
}

double framesPerSecondOf(const EncodeOptions& options, const io::Sequence& sequence,
                         const io::SequenceReader& reader) {
  if (!options.fps.empty()) return numberFrom(options.fps, 0.01, 1000.0, "--fps");
  if (const auto fps = reader.framesPerSecond()) return *fps;
  if (sequence.images.front().extension() == ".exr") {
    try {
      const double fps = io::readFrameMetadata(sequence.images.front()).framesPerSecond;
      if (fps > 0.0) return fps;
    } catch (const InputError&) {
      // Frames of another program do not say.
    }
  }
  return 25.0;
}

DisplayModel displayOf(const EncodeOptions& options, const io::Sequence& sequence) {
  if (!options.display.empty()) return displayNamed(options.display);
  return renderedDisplay(sequence.argument).value_or(displayNamed("fhd-24"));
}

}  // namespace

ExitStatus runEncode(const EncodeOptions& options, Console& console) {
  (void)io::videoFormatOf(options.output);  // an unknown extension is refused before any work
  const io::Sequence sequence = io::resolveSequence(options.input);
  io::SequenceReader reader(sequence);
  const Frames frames = options.frames.empty() ? Frames{0, reader.frameCount() - 1}
                                               : framesFrom(options.frames, reader.frameCount(), "--frames");
  std::optional<Crop> crop;
  if (!options.crop.empty()) crop = cropFrom(options.crop, "--crop");
  const double framesPerSecond = framesPerSecondOf(options, sequence, reader);
  const io::FrameRate rate = io::frameRateFrom(framesPerSecond);
  const DisplayModel display = displayOf(options, sequence);
  const ChosenTone tone =
      chosenTone(toneOptionsFrom(options.tone, options.exposure, options.unit, options.ocio),
                 std::span(&sequence, 1), framesPerSecond);

  std::optional<io::VideoWriter> writer;
  const ProgressCallback progress = console.progress();
  const auto total = static_cast<std::uint64_t>(frames.last - frames.first + 1);
  for (int index = 0; index <= frames.last; ++index) {
    const auto image = reader.next();
    if (!image) throw InputError(options.input, "ends before its last frame");
    if (index < frames.first) continue;
    progress({"frames", static_cast<std::uint64_t>(index - frames.first), total});
    const auto* radiance = std::get_if<RadianceMap>(&image->colour);
    EncodedMap encoded = radiance != nullptr
                             ? encodeForDisplay(*radiance, tone.mapping.at(tone.firstFrame + index, display))
                             : std::get<EncodedMap>(image->colour).clone();
    if (crop) {
      if (crop->x > encoded.width() - crop->size.width || crop->y > encoded.height() - crop->size.height) {
        throw InputError("--crop: expected a part of the frames, which are " +
                         std::to_string(encoded.width()) + "x" + std::to_string(encoded.height()) +
                         ", found '" + options.crop + "'");
      }
      encoded = cropped(encoded, *crop);
    }
    if (!writer) writer.emplace(options.output, encoded.size(), rate);
    writer->write(encoded);
  }
  progress({"frames", total, total});
  writer->finish();
  console.endProgress();
  console.result(options.output + ": " + std::to_string(total) + " frames at " +
                 std::to_string(rate.numerator) + "/" + std::to_string(rate.denominator) + " frames/s\n");
  return ExitStatus::kDone;
}

}  // namespace promenade::app
