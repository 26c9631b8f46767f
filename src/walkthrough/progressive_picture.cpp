#include "src/walkthrough/progressive_picture.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

#include "src/core/resolve.h"
#include "src/walkthrough/seen.h"
#include "src/walkthrough/stopping.h"

namespace promenade::walkthrough {

double rmsContrast(const LuminanceMap& a, const LuminanceMap& b) {
  assert(a.size() == b.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const double one = a.pixels()[i];
    const double other = b.pixels()[i];
    const double contrast = 2.0 * (one - other) / (one + other);
    sum += contrast * contrast;
  }
  return std::sqrt(sum / static_cast<double>(a.pixels().size()));
}

ProgressivePicture::ProgressivePicture(const Renderer& renderer, const Camera& camera,
                                       const Settings& settings, const Clock& clock)
    : renderer_(renderer),
      settings_(settings),
      clock_(clock),
      frame_(unshaded(renderer.visibility(camera.supersampled(settings.supersample)))),
      open_(frame_.diffuse.size(), 1) {}

void ProgressivePicture::trace(int count) {
  assert(paths_ == 0 ? count == 1 : count >= 1 && paths_ % count == 0);
  if (std::has_single_bit(static_cast<unsigned>(paths_))) {
    before_ = picture();
    pathsBefore_ = paths_;
  }
  const double start = clock_();
  open_ = renderer_.refine(frame_, open_, {.before = paths_, .count = count}, settings_.frames.first).open;
  const double spent = clock_() - start;
  seconds_ += spent;
  secondsPerPath_ = spent / count;
  paths_ += count;
  predictedPercent_.reset();
  isClean_ = std::all_of(open_.pixels().begin(), open_.pixels().end(), [](auto open) { return open == 0; });
}

int ProgressivePicture::affordable(double seconds, int most) const {
  const int largest = paths_ == 0 ? 1 : 1 << std::countr_zero(static_cast<unsigned>(paths_));
  for (int count = largest; count >= 1; count /= 2) {
    if (count <= most && secondsFor(count) <= seconds) return count;
  }
  return 0;
}

RadianceMap ProgressivePicture::picture() const {
  return resolveRadiance(combinedRadiance(frame_), settings_.supersample);
}

ProgressivePicture::Parts ProgressivePicture::parts() const {
  assert(pathsBefore_ > 0);
  Parts parts{before_.clone(), picture()};
  const auto all = static_cast<float>(paths_);
  const auto before = static_cast<float>(pathsBefore_);
  for (std::size_t i = 0; i < parts.later.pixels().size(); ++i) {
    Rgb& value = parts.later.pixels()[i];
    value = (all * value - before * parts.earlier.pixels()[i]) / (all - before);
  }
  return parts;
}

ProgressivePicture::Seen ProgressivePicture::seen() const {
  const RadianceMap now = picture();
  const int index = settings_.frames.first;
  const Surroundings surroundings = surroundingsOf(now, index, settings_);
  return {seenOnDisplay(now, index, settings_, surroundings),
          seenOnDisplay(before_, index, settings_, surroundings)};
}

double ProgressivePicture::deviationScale() const {
  return std::sqrt(static_cast<double>(pathsBefore_) / (paths_ - pathsBefore_));
}

std::optional<double> ProgressivePicture::error() const {
  if (pathsBefore_ == 0) return std::nullopt;
  const Seen pictures = seen();
  return deviationScale() * rmsContrast(pictures.now, pictures.before);
}

std::optional<double> ProgressivePicture::predictedPercent() const {
  if (pathsBefore_ == 0 || predictedPercent_) return predictedPercent_;
  const Seen pictures = seen();
  JndMap jnd = aqm::compare(pictures.now, pictures.before, VelocityMap(),
                            aqm::Settings{settings_.display.pixelsPerDegree()})
                   .pooledJnd;
  for (float& value : jnd.pixels()) value *= static_cast<float>(deviationScale());
  predictedPercent_ = walkthrough::predictedPercent(jnd);
  return predictedPercent_;
}

}  // namespace promenade::walkthrough
