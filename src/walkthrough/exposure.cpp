// Automatic exposure (Reinhard, Stark, Shirley, Ferwerda 2002, eq. 1 and 2): the log-average luminance
// becomes middle grey.

#include <algorithm>
#include <cmath>

#include "src/walkthrough/walkthrough.h"

namespace promenade::walkthrough {

double automaticExposure(const paths::CameraPath& path, FrameRange frames, const Renderer& renderer,
                         Size size) {
  constexpr int kFrames = 7;
  constexpr int kWidth = 64;
  constexpr double kMiddleGrey = 0.18;
  // Of the log average: darker pixels count as this, so that a black corner does not decide.
  constexpr double kDarkest = 1e-4;
  const int height = std::clamp(kWidth * size.height / std::max(1, size.width), 1, 4 * kWidth);
  double sum = 0.0;
  double count = 0.0;
  for (int k = 0; k < kFrames; ++k) {
    const int index =
        frames.first + static_cast<int>(std::lround((frames.count() - 1) * k / double(kFrames - 1)));
    const Frame frame = renderer.render(path.camera(index, {kWidth, height}), index);
    const RadianceMap radiance = combinedRadiance(frame);
    double brightest = 0.0;
    for (const Rgb& value : radiance.pixels()) {
      const double l = luminance(value);
      if (std::isfinite(l)) brightest = std::max(brightest, l);
    }
    for (const Rgb& value : radiance.pixels()) {
      const double l = luminance(value);
      if (!std::isfinite(l)) continue;
      sum += std::log2(std::max(l, std::max(kDarkest * brightest, 1e-30)));
      count += 1.0;
    }
  }
  if (count == 0.0) return 0.0;
  const double ev = std::log2(kMiddleGrey) - sum / count;
  return std::round(10.0 * std::clamp(ev, -40.0, 40.0)) / 10.0;
}

}  // namespace promenade::walkthrough
