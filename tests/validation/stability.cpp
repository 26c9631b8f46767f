// What a verdict must not depend on: resolution, size of the frame, place in it.

#include <algorithm>
#include <cmath>

#include "tests/validation/chapters.h"
#include "tests/validation/stimuli.h"
#include "tests/validation/threshold.h"

namespace promenade::validation {
namespace {

double gaborThreshold(Size size, double ppd, double rho, double atX, double atY,
                      const aqm::Settings& settings) {
  const Pattern patch = gabor(rho, 90.0, 0.25, 0.25);
  const Raster raster = rasterOf(size, ppd, [&](double x, double y) { return patch(x - atX, y - atY); });
  const auto frame = [&](double contrast) {
    Raster scaled = raster;
    for (double& value : scaled) value *= contrast;
    return frameOf(size, 30.0, scaled);
  };
  return decibels(threshold(frame, LuminanceMap(size, 30.0f), {}, settings));
}

}  // namespace

void reportStability(Report& report) {
  report.heading("Independence of resolution, frame size and place");
  report.text(
      "Gabors of sigma 0.25 degrees, 30 cd/m2. Thresholds in dB, as differences from their mean over what "
      "should not matter: the range "
      "(largest less smallest).");
  std::vector<std::vector<std::string>> table{{"cycles per degree", "aqm: 70 to 120 pixels a degree",
                                               "aqm2000: the same", "aqm: 48 to 90",
                                               "aqm: frames of 2 to 6 degrees", "aqm: nine places"}};
  const auto range = [](const std::vector<double>& values) {
    return *std::ranges::max_element(values) - *std::ranges::min_element(values);
  };
  for (const double rho : {1.0, 2.0, 4.0, 8.0, 16.0}) {
    const auto overResolutions = [&](const std::vector<double>& resolutions, aqm::Settings settings) {
      std::vector<double> found;
      for (const double ppd : resolutions) {
        settings.pixelsPerDegree = ppd;
        const int side = static_cast<int>(std::lround(2.4 * ppd));
        found.push_back(gaborThreshold({side, side}, ppd, rho, 0.0, 0.0, settings));
      }
      return range(found);
    };
    std::vector<double> sizes;
    for (const int side : {80, 100, 160, 240}) {
      sizes.push_back(gaborThreshold({side, side}, 40.0, rho, 0.0, 0.0, aqm::aqm(40.0)));
    }
    std::vector<double> places;
    for (const double x : {-0.9, -0.013, 0.9}) {
      for (const double y : {-0.9, 0.007, 0.9}) {
        places.push_back(gaborThreshold({160, 160}, 40.0, rho, x, y, aqm::aqm(40.0)));
      }
    }
    table.push_back({fixed(rho, 0), fixed(overResolutions({70, 85, 100, 120}, aqm::aqm(70.0)), 2),
                     fixed(overResolutions({70, 85, 100, 120}, aqm::aqm2000(70.0)), 2),
                     fixed(overResolutions({48, 60, 63, 66, 90}, aqm::aqm(48.0)), 2), fixed(range(sizes), 2),
                     fixed(range(places), 2)});
  }
  report.verdict("Resolution, 70 to 120 pixels per degree",
                 "1 to 16 cycles per degree: aqm " + table[1][1] + " to " + table[5][1] +
                     " dB range, aqm2000 " + table[1][2] + " to " + table[5][2],
                 "aqm fits; aqm2000 does not");
  report.verdict("Frame size and place", "up to " + table[1][4] + " and " + table[5][5] + " dB range",
                 "fits");
  report.table(table);
  report.text(
      "Bands are octaves of the pixel grid, so that a frequency falls elsewhere in them at another "
      "resolution: this is the "
      "ripple again. Beside the borders a patch is pooled with nothing beyond the frame.");
}

}  // namespace promenade::validation
