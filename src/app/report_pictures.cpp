#include "src/app/report_pictures.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <map>

#include "src/app/heatmap.h"
#include "src/core/errors.h"
#include "src/io/exr_frame.h"
#include "src/io/exr_maps.h"
#include "src/io/web_picture.h"

namespace promenade::app {
namespace {

namespace fs = std::filesystem;
using io::PictureCoding;

constexpr double kMostCharacters = 15e6;

Size scaled(Size frame, int width) {
  if (width >= frame.width) return frame;
  const double height = static_cast<double>(frame.height) * width / frame.width;
  return {width, std::clamp(static_cast<int>(height + 0.5), 1, frame.height)};
}

// One source a pixel, never a mean of two: the pixel in the middle of those that a smaller one covers.
EncodedMap sourcePicture(const SourceMap& source, Size size) {
  EncodedMap picture(size);
  for (int y = 0; y < size.height; ++y) {
    const int row = (2 * y + 1) * source.height() / (2 * size.height);
    for (int x = 0; x < size.width; ++x) {
      const SampleSource from = source((2 * x + 1) * source.width() / (2 * size.width), row);
      picture(x, y) = sourceLooks()[static_cast<std::size_t>(from)].colour;
    }
  }
  return picture;
}

EncodedMap metricPicture(const ProbabilityMap& probability, const EncodedMap& frame, Size size) {
  EncodedMap picture(frame.size());
  for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
    picture.pixels()[i] = thresholdColour(probability.pixels()[i], frame.pixels()[i]);
  }
  return io::reduced(picture, size);
}

FramePictures picturesOf(const RenderedJob& job, int index, const fs::path& maps, Size size) {
  const io::FrameFile frame = io::readFrame(job.frame(index));
  if (frame.radiance.size() != job.size) {
    throw InputError(job.frame(index).string(), "expected a frame of the size that report.json states");
  }
  const EncodedMap shown = encodeForDisplay(frame.radiance, job.toneOf(index));
  FramePictures pictures;
  pictures.index = index;
  pictures.result = io::dataUri(io::reduced(shown, size), PictureCoding::kPhoto);
  if (!frame.source.empty()) {
    pictures.source = io::dataUri(sourcePicture(frame.source, size), PictureCoding::kFlat);
  }
  if (!maps.empty()) {
    const ProbabilityMap probability = io::readProbability(maps);
    if (probability.size() == shown.size()) {
      pictures.metric = io::dataUri(metricPicture(probability, shown, size), PictureCoding::kPhoto);
    }
  }
  return pictures;
}

std::vector<int> framesThere(const RenderedJob& job) {
  std::vector<int> there;
  for (int index = job.frames.first; index <= job.frames.last; ++index) {
    if (fs::is_regular_file(job.frame(index))) there.push_back(index);
  }
  return there;
}

}  // namespace

const std::vector<SourceLook>& sourceLooks() {
  static const std::vector<SourceLook> looks = {
      {SampleSource::kTraced, "traced", "ray traced (keyframe)", Rgb(0.90f, 0.62f, 0.0f)},
      {SampleSource::kWarpedFromPrevious, "previous", "warped from the keyframe before",
       Rgb(0.34f, 0.71f, 0.91f)},
      {SampleSource::kWarpedFromNext, "next", "warped from the keyframe after", Rgb(0.80f, 0.47f, 0.65f)},
      {SampleSource::kBlended, "blended", "blended of both", Rgb(0.0f, 0.62f, 0.45f)},
      {SampleSource::kTracedHole, "hole", "hole, ray traced", Rgb(0.84f, 0.37f, 0.0f)},
      {SampleSource::kTracedItem, "item", "item, ray traced", Rgb(0.94f, 0.89f, 0.26f)},
      {SampleSource::kUnknown, "unknown", "nobody knows (keyframes of another renderer)", Rgb(0.35f)}};
  return looks;
}

Size pictureSize(const RenderedJob& job, int kinds) {
  constexpr std::array kWidths = {960, 800, 640, 512, 400, 320, 240, 160, 96, 48};
  constexpr std::size_t kLookAt = 5;
  const std::vector<int> there = framesThere(job);
  if (there.empty()) return job.size;
  std::vector<io::FrameFile> some;
  for (std::size_t k = 0; k < std::min(kLookAt, there.size()); ++k) {
    const std::size_t last = there.size() - 1;
    const std::size_t at = std::min(last, kLookAt > there.size() ? k : k * last / (kLookAt - 1));
    some.push_back(io::readFrame(job.frame(there[at])));
  }
  Size size = job.size;
  for (const int width : kWidths) {
    size = scaled(job.size, width);
    double photo = 0.0;
    double source = 0.0;
    for (const io::FrameFile& frame : some) {
      if (frame.radiance.size() != job.size) continue;  // told later, with its name
      const EncodedMap shown =
          io::reduced(encodeForDisplay(frame.radiance, job.toneOf(frame.metadata.frame)), size);
      photo += static_cast<double>(io::dataUri(shown, PictureCoding::kPhoto).size());
      if (frame.source.empty()) continue;
      source +=
          static_cast<double>(io::dataUri(sourcePicture(frame.source, size), PictureCoding::kFlat).size());
    }
    const double each = (photo * (kinds - 1) + source) / static_cast<double>(some.size());
    if (each * static_cast<double>(there.size()) <= kMostCharacters) break;
  }
  return size;
}

std::vector<FramePictures> framePictures(const RenderedJob& job, Size size,
                                         const ProgressCallback& progress) {
  std::map<int, fs::path> maps;  // of middles; what was judged last is what decided
  for (const RenderedJob::Judged& segment : job.segments) {
    if (fs::is_regular_file(job.maps(segment))) maps[segment.middle] = job.maps(segment);
  }
  const std::vector<int> there = framesThere(job);
  std::vector<FramePictures> pictures(there.size());
  const auto batch = static_cast<std::size_t>(tbb::info::default_concurrency());
  for (std::size_t begin = 0; begin < there.size(); begin += batch) {
    progress({"report pictures", begin, there.size()});
    tbb::parallel_for(begin, std::min(begin + batch, there.size()), [&](std::size_t i) {
      const auto found = maps.find(there[i]);
      pictures[i] = picturesOf(job, there[i], found == maps.end() ? fs::path() : found->second, size);
    });
  }
  progress({"report pictures", there.size(), there.size()});
  return pictures;
}

}  // namespace promenade::app
