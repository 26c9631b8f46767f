#include "src/core/frame.h"

#include <utility>

#include <cassert>

namespace promenade {

Frame unshaded(Visibility&& visibility) {
  Frame frame;
  frame.visibility = std::move(visibility);
  const Size size = frame.visibility.camera.size();
  frame.diffuse = RadianceMap(size);
  frame.viewDependent = RadianceMap(size);
  frame.source = SourceMap(size, SampleSource::kTraced);
  return frame;
}

RadianceMap combinedRadiance(const Frame& frame) {
  assert(frame.diffuse.size() == frame.viewDependent.size());
  RadianceMap sum(frame.diffuse.size());
  const auto diffuse = frame.diffuse.pixels();
  const auto viewDependent = frame.viewDependent.pixels();
  const auto out = sum.pixels();
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = diffuse[i] + viewDependent[i];
  return sum;
}

}  // namespace promenade
