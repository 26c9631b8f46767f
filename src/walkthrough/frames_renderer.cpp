#include "src/walkthrough/frames_renderer.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "ibr/depth_raster.h"
#include "src/walkthrough/selected.h"

namespace promenade::walkthrough {
namespace {

void addNearer(Visibility& visibility, const ibr::Rastered& more) {
  const Size size = visibility.depth.size();
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      // Background is farther than every surface: it changes nothing.
      if (!(more.visibility.depth(x, y) < visibility.depth(x, y))) continue;
      visibility.depth(x, y) = more.visibility.depth(x, y);
      visibility.normal(x, y) = more.visibility.normal(x, y);
      visibility.item(x, y) = more.visibility.item(x, y);
    }
  }
}

}  // namespace

FramesRenderer::FramesRenderer(FrameMaker make, const ibr::WarpSettings& warp, double mostUnknownPercent)
    : make_(std::move(make)), warp_(warp), mostUnknownPercent_(mostUnknownPercent) {}

Frame FramesRenderer::render(const Camera& camera, int frameIndex) const {
  return make_(camera, frameIndex);
}

Visibility FramesRenderer::visibility(const Camera& camera) const {
  const Size size = camera.size();
  return {camera, DepthMap(size, std::numeric_limits<float>::infinity()), NormalMap(size), ItemBuffer(size)};
}

Visibility FramesRenderer::visibilityAmong(const Camera& camera, std::span<const Frame* const> known) const {
  Visibility seen = visibility(camera);
  for (const Frame* frame : known) {
    addNearer(seen, ibr::raster(ibr::SurfacePatches(*frame, camera, warp_.creaseDegrees), camera));
  }
  return seen;
}

void FramesRenderer::retrace(Frame& frame, const Mask& mask, SampleSource, int frameIndex) const {
  const auto open = static_cast<double>(countSelected(mask));
  if (open == 0.0) return;
  if (100.0 * open > mostUnknownPercent_ * static_cast<double>(mask.size().area())) {
    frame = make_(frame.visibility.camera, frameIndex);
    return;
  }
  Mask unknown = mask.clone();
  for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
    if (frame.source.pixels()[i] != SampleSource::kUnknown) unknown.pixels()[i] = 0;
  }
  const RadianceMap filled = surroundings(combinedRadiance(frame), frame.visibility.depth, unknown);
  for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
    if (unknown.pixels()[i] == 0) continue;
    frame.diffuse.pixels()[i] = filled.pixels()[i];
    frame.viewDependent.pixels()[i] = Rgb(0.0f);
  }
}

RadianceMap surroundings(const RadianceMap& radiance, const DepthMap& depth, const Mask& open) {
  RadianceMap filled = radiance.clone();
  DepthMap far = depth.clone();
  Mask left = open.clone();
  std::vector<std::pair<int, int>> todo;
  for (int y = 0; y < open.height(); ++y) {
    for (int x = 0; x < open.width(); ++x) {
      if (open(x, y) != 0) todo.emplace_back(x, y);
    }
  }
  struct Found {
    int x, y;
    Rgb colour;
    float depth;
  };
  while (!todo.empty()) {
    std::vector<Found> rim;
    std::vector<std::pair<int, int>> inside;
    for (const std::pair<int, int>& at : todo) {
      const auto x = at.first;
      const auto y = at.second;
      float farthest = -1.0f;
      const auto forNeighbours = [&](const auto& body) {
        for (int j = y - 1; j <= y + 1; ++j) {
          for (int i = x - 1; i <= x + 1; ++i) {
            if (left.contains(i, j) && left(i, j) == 0) body(i, j);
          }
        }
      };
      forNeighbours([&](int i, int j) { farthest = std::max(farthest, far(i, j)); });
      if (farthest < 0.0f) {
        inside.emplace_back(x, y);
        continue;
      }
      Rgb sum(0.0f);
      float count = 0.0f;
      forNeighbours([&](int i, int j) {
        if (!(far(i, j) >= 0.9f * farthest)) return;
        sum += filled(i, j);
        count += 1.0f;
      });
      rim.push_back({x, y, sum / count, farthest});
    }
    if (rim.empty()) break;  // nothing is known anywhere: black
    for (const Found& found : rim) {
      filled(found.x, found.y) = found.colour;
      far(found.x, found.y) = found.depth;
      left(found.x, found.y) = 0;
    }
    todo = std::move(inside);
  }
  return filled;
}

}  // namespace promenade::walkthrough
