// What is known of a walk's light before it is rendered, from small frames along it. Automatic exposure
// (Reinhard, Stark, Shirley, Ferwerda 2002, eq. 1 and 2): the log-average luminance becomes middle grey.

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "src/core/adaptation.h"
#include "src/core/resolve.h"
#include "src/walkthrough/walkthrough.h"

namespace promenade::walkthrough {

namespace {

struct Detail {
  int columns;  ///< of parts that are told apart
  int block;    ///< samples along a part's edge
  int paths;    ///< of a sample, whatever number of them the walk's frames will have
  /// Samples of a frame of that shape.
  [[nodiscard]] Size samples(Size shape) const {
    const double rows = std::round(double(columns) * shape.height / shape.width);
    return {columns * block, static_cast<int>(std::clamp(rows, 1.0, 4.0 * columns)) * block};
  }
};

RadianceMap glimpse(const paths::CameraPath& path, const Renderer& renderer, int index, Size shape,
                    const Detail& detail) {
  Frame frame = unshaded(renderer.visibility(path.camera(index, detail.samples(shape))));
  (void)renderer.refine(frame, Mask(frame.diffuse.size(), 1), {.before = 0, .count = detail.paths}, index);
  return combinedRadiance(frame);
}

}  // namespace

double exposureOf(std::vector<double> luminances) {
  constexpr double kMiddleGrey = 0.18;
  std::erase_if(luminances, [](double l) { return !std::isfinite(l); });
  for (double& l : luminances) l = std::max(l, 0.0);
  const double average = logAverage(std::move(luminances));
  if (!(average > 0.0)) return 0.0;
  return std::round(10.0 * std::clamp(std::log2(kMiddleGrey / average), -40.0, 40.0)) / 10.0;
}

double automaticExposure(const paths::CameraPath& path, FrameRange frames, const Renderer& renderer,
                         Size size) {
  constexpr int kFrames = 7;
  constexpr Detail kDetail{.columns = 8, .block = 8, .paths = 16};
  std::vector<double> blocks;
  for (int k = 0; k < kFrames; ++k) {
    const int index =
        frames.first + static_cast<int>(std::lround((frames.count() - 1) * k / double(kFrames - 1)));
    const RadianceMap means = resolveRadiance(glimpse(path, renderer, index, size, kDetail), kDetail.block);
    for (const Rgb& mean : means.pixels()) blocks.push_back(luminance(mean));
  }
  return exposureOf(std::move(blocks));
}

AdaptationCurve adaptationAlong(const paths::CameraPath& path, FrameRange frames, const Renderer& renderer,
                                Size size, double candelasPerUnit) {
  constexpr Detail kFoveal{.columns = 64, .block = 2, .paths = 4};
  std::vector<View> views;
  for (const int index : framesToView(frames.first, frames.last, path.framesPerSecond)) {
    const RadianceMap seen = glimpse(path, renderer, index, size, kFoveal);
    views.push_back(viewOf(index, fovealLuminances(seen, kFoveal.columns), candelasPerUnit));
  }
  return {std::move(views), path.framesPerSecond};
}

}  // namespace promenade::walkthrough
