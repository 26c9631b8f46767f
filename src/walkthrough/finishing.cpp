#include "src/walkthrough/finishing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "aqm/retina.h"
#include "ibr/temporal_filter.h"
#include "src/core/resolve.h"
#include "src/walkthrough/view.h"

namespace promenade::walkthrough {
namespace {

/// Narrower where the image moves faster over the retina.
ibr::WindowMap windows(const VelocityMap& velocity, const Antialiasing& antialiasing) {
  ibr::WindowMap map(velocity.size(), static_cast<float>(antialiasing.deviationFrames));
  for (std::size_t i = 0; i < map.pixels().size(); ++i) {
    const double speed = glm::length(aqm::retinalVelocity(glm::dvec2(velocity.pixels()[i])));
    if (speed <= antialiasing.narrowingSpeed) continue;
    map.pixels()[i] *= static_cast<float>(antialiasing.narrowingSpeed / speed);
  }
  return map;
}

}  // namespace

FrameRange windowOf(int frame, FrameRange part, const Settings& settings) {
  if (!settings.antialiasing) return {frame, frame};
  const int more = settings.antialiasing->frames() - 1;
  const int first = std::clamp(frame - more / 2, part.first, std::max(part.first, part.last - more));
  return {first, std::min(first + more, part.last)};
}

Finishing::Finishing(const paths::CameraPath& path, const Settings& settings, Sink sink)
    : path_(path), settings_(settings), sink_(std::move(sink)) {}

void Finishing::begin(FrameRange part) {
  part_ = part;
  held_.clear();
  next_ = delivers_ = part.first;
}

void Finishing::add(int index, std::shared_ptr<const Frame> samples, FrameKind kind) {
  delivers_ = index + 1;
  hold(index, {std::move(samples), kind});
}

void Finishing::addContext(int index, std::shared_ptr<const Frame> samples) {
  hold(index, {std::move(samples), FrameKind::kKeyframe});
}

void Finishing::hold(int index, Held held) {
  held_.emplace(index, std::move(held));
  while (next_ < delivers_ && windowOf(next_, part_, settings_).last <= index) {
    FinishedFrame frame;
    {
      const Stopwatch watch(seconds_);
      frame = finished(next_);
    }
    ++next_;
    held_.erase(held_.begin(), held_.lower_bound(windowOf(next_, part_, settings_).first));
    sink_(std::move(frame));
  }
}

FinishedFrame Finishing::finished(int index) const {
  const Held& held = held_.at(index);
  FinishedFrame frame;
  frame.index = index;
  frame.kind = held.kind;
  frame.visibility = resolveVisibility(held.samples->visibility, settings_.supersample);
  frame.radiance = pixelsOf(index, frame.visibility);
  frame.source = resolveSource(held.samples->source, settings_.supersample);
  frame.flowToNext = flowTo(path_, settings_, frame.visibility, index + 1);
  if (frame.flowToNext.empty()) frame.flowToNext = PixelFlow(settings_.size, glm::vec2(0.0f));
  return frame;
}

RadianceMap Finishing::pixelsOf(int index, const Visibility& visibility) const {
  const Frame& samples = *held_.at(index).samples;
  std::vector<ibr::NearbyFrame> others;
  const FrameRange window = windowOf(index, part_, settings_);
  for (auto held = held_.lower_bound(window.first); held != held_.upper_bound(window.last); ++held) {
    if (held->first != index) others.push_back({held->second.samples.get(), held->first - index});
  }
  if (others.empty()) return resolveRadiance(combinedRadiance(samples), settings_.supersample);
  return ibr::temporalFilter(
      samples, settings_.supersample, others,
      windows(velocityOf(path_, settings_, visibility, index), *settings_.antialiasing),
      {.footprintLimit = settings_.warp.footprintLimit, .creaseDegrees = settings_.warp.creaseDegrees});
}

}  // namespace promenade::walkthrough
