// What is known of a walk's light before it is rendered, from small frames along it. Automatic exposure
// (Reinhard, Stark, Shirley, Ferwerda 2002, eq. 1 and 2): the log-average luminance becomes middle grey.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "src/core/resolve.h"
#include "src/walkthrough/walkthrough.h"

namespace promenade::walkthrough {

double exposureOf(std::vector<double> luminances) {
  constexpr double kMiddleGrey = 0.18;
  // Darker parts count as this share of the mean, so that a black corner does not decide.
  constexpr double kDarkest = 1e-2;
  std::erase_if(luminances, [](double l) { return !std::isfinite(l); });
  std::sort(luminances.begin(), luminances.end());
  for (double& l : luminances) l = std::max(l, 0.0);
  const auto count = std::max<double>(1.0, static_cast<double>(luminances.size()));
  const double mean = std::accumulate(luminances.begin(), luminances.end(), 0.0) / count;
  if (!(mean > 0.0)) return 0.0;
  double sum = 0.0;
  for (const double l : luminances) sum += std::log2(std::max(l, kDarkest * mean));
  const double ev = std::log2(kMiddleGrey) - sum / count;
  return std::round(10.0 * std::clamp(ev, -40.0, 40.0)) / 10.0;
}

double automaticExposure(const paths::CameraPath& path, FrameRange frames, const Renderer& renderer,
                         Size size) {
  constexpr int kFrames = 7;
  constexpr int kPaths = 16;
  constexpr int kBlock = 8;
  constexpr int kColumns = 8;  // of blocks
  const int rows =
      std::clamp(static_cast<int>(std::lround(double(kColumns) * size.height / size.width)), 1, 4 * kColumns);
  std::vector<double> blocks;
  for (int k = 0; k < kFrames; ++k) {
    const int index =
        frames.first + static_cast<int>(std::lround((frames.count() - 1) * k / double(kFrames - 1)));
    Frame frame = unshaded(renderer.visibility(path.camera(index, {kColumns * kBlock, rows * kBlock})));
    // The same exposure whatever number of paths the frames will have.
    (void)renderer.refine(frame, Mask(frame.diffuse.size(), 1), {.before = 0, .count = kPaths}, index);
    const RadianceMap means = resolveRadiance(combinedRadiance(frame), kBlock);
    for (const Rgb& mean : means.pixels()) blocks.push_back(luminance(mean));
  }
  return exposureOf(std::move(blocks));
}

AdaptationCurve adaptationAlong(const paths::CameraPath& path, FrameRange frames, const Renderer& renderer,
                                Size size, double candelasPerUnit) {
  constexpr int kColumns = 64;  // of foveal parts
  constexpr int kBlock = 2;     // samples along a part's edge
  constexpr int kPaths = 4;     // a part has four times as many
  const int rows =
      std::clamp(static_cast<int>(std::lround(double(kColumns) * size.height / size.width)), 1, 4 * kColumns);
  std::vector<View> views;
  for (const int index : framesToView(frames.first, frames.last, path.framesPerSecond)) {
    Frame frame = unshaded(renderer.visibility(path.camera(index, {kColumns * kBlock, rows * kBlock})));
    (void)renderer.refine(frame, Mask(frame.diffuse.size(), 1), {.before = 0, .count = kPaths}, index);
    views.push_back(viewOf(index, fovealLuminances(combinedRadiance(frame), kColumns), candelasPerUnit));
  }
  return {std::move(views), path.framesPerSecond};
}

}  // namespace promenade::walkthrough
