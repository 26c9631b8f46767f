// The part of a report's pictures that needs a reference.

#include "aqm/metric.h"
#include "src/app/heatmap.h"
#include "src/app/report_pictures.h"
#include "src/app/viewing.h"
#include "src/core/errors.h"
#include "src/io/image_file.h"
#include "src/io/web_picture.h"

namespace promenade::app {

void addReference(std::vector<FramePictures>& pictures, const RenderedJob& job, const RenderedJob& reference,
                  Size size, const ProgressCallback& progress) {
  if (reference.size != job.size) {
    throw InputError(reference.folder.string() + " has frames of " + toString(reference.size) + " and " +
                     job.folder.string() + " of " + toString(job.size) +
                     ": a reference has the size of the result");
  }
  Viewing viewing;
  viewing.tone = job.tone;  // one mapping for both frames of every comparison
  viewing.display = job.display;
  viewing.pixelsPerDegree = job.display.pixelsPerDegree();
  viewing.framesPerSecond = job.framesPerSecond;
  const aqm::Settings settings = aqm::aqm(viewing.pixelsPerDegree);
  Motion motion(viewing);
  std::uint64_t done = 0;
  for (FramePictures& frame : pictures) {
    progress({"comparison with the reference", done++, pictures.size()});
    const io::ImageFile shown = io::readImage(job.frame(frame.index));
    const io::ImageFile traced = io::readImage(reference.frame(frame.index));
    if (traced.size() != shown.size()) {
      throw InputError(reference.frame(frame.index).string(),
                       "expected " + toString(shown.size()) + ", found " + toString(traced.size()));
    }
    const Shown both = shownBoth(shown, traced, viewing, frame.index);
    const EncodedMap test = encodedOf(shown, both);
    const EncodedMap wanted = encodedOf(traced, both);
    const VelocityMap velocity = motion.next(shown, traced, frame.index == job.frames.last);
    const aqm::Result seen = aqm::compare(displayLuminance(test, viewing.display),
                                          displayLuminance(wanted, viewing.display), velocity, settings);
    frame.percentVisible = aqm::percentVisible(seen.probability, Mask());
    EncodedMap map(wanted.size());
    for (std::size_t i = 0; i < map.pixels().size(); ++i) {
      map.pixels()[i] = thresholdColour(seen.probability.pixels()[i], wanted.pixels()[i]);
    }
    frame.metric = io::dataUri(io::reduced(map, size), io::PictureCoding::kPhoto);
    frame.reference = io::dataUri(io::reduced(wanted, size), io::PictureCoding::kPhoto);
  }
  progress({"comparison with the reference", done, pictures.size()});
}

}  // namespace promenade::app
