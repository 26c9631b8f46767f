// The metric of animations: what motion hides.

#include <algorithm>
#include <cmath>

#include "tests/validation/chapters.h"
#include "tests/validation/stimuli.h"
#include "tests/validation/threshold.h"

namespace promenade::validation {

void reportMotion(Report& report) {
  report.heading("Motion");
  report.text(
      "A textured frame (noise of amplitude 1/f, 25 % rms, 512 x 512 pixels at 32 pixels per degree, 60 "
      "cd/m2) against itself with "
      "errors that grow from nothing at the left to a shift of a quarter of a pixel and noise of 3.5 % (1/f "
      "above 1 cycle per degree) at "
      "the right, under a flow of 0.25 to 0.75 degrees per second that is scaled by 1, 3 and 5. The "
      "published example (Myszkowski et "
      "al. 2000) has 10.56, 3.00 and 0.93 % of its pixels visible without tracking, 11.37 % with tracking: "
      "motion that the eye does not "
      "follow must hide, motion that it follows must not.");
  constexpr int kSide = 512;
  constexpr double kPpd = 32.0;
  const Raster texture = noise(kSide, kPpd, 0.25, 3, [](double f, double) { return 1.0 / std::max(f, 0.1); });
  const Raster grain = noise(kSide, kPpd, 0.035, 4, [](double f, double) { return 1.0 / std::max(f, 1.0); });
  Raster shifted = texture;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const auto at = [&](int column) {
        return static_cast<std::size_t>(y * kSide + std::min(column, kSide - 1));
      };
      const double growth = static_cast<double>(x) / kSide;
      const double shift = 0.25 * growth;
      shifted[at(x)] = (1.0 - shift) * texture[at(x)] + shift * texture[at(x + 1)] + growth * grain[at(x)];
    }
  }
  const Size size{kSide, kSide};
  const LuminanceMap reference = frameOf(size, 60.0, texture);
  const LuminanceMap test = frameOf(size, 60.0, shifted);
  const auto walk = [&](double scale) {
    VelocityMap velocity(size);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        // A slow walk along a wall.
        const double speed = scale * (0.25 + 0.5 * x / kSide);
        velocity(x, y) = glm::vec2(static_cast<float>(speed), static_cast<float>(0.2 * speed));
      }
    }
    return velocity;
  };
  const auto percent = [&](const VelocityMap& velocity, aqm::Eye eye, aqm::Settings settings) {
    settings.eye = eye;
    return aqm::percentVisible(aqm::compare(test, reference, velocity, settings).probability, {});
  };
  std::vector<std::vector<std::string>> table{
      {"metric", "still", "untracked, flow x 1", "x 3", "x 5", "tracked, x 1", "x 3", "x 5"}};
  for (const Named& kind : std::vector<Named>{
           {"aqm", aqm::aqm(kPpd)}, {"revised", aqm::revisedAqm(kPpd)}, {"aqm2000", aqm::aqm2000(kPpd)}}) {
    std::vector<std::string> row{kind.name, fixed(percent({}, aqm::Eye::kTracking, kind.settings), 2)};
    for (const aqm::Eye eye : {aqm::Eye::kFixating, aqm::Eye::kTracking}) {
      for (const double scale : {1.0, 3.0, 5.0}) {
        row.push_back(fixed(percent(walk(scale), eye, kind.settings), 2));
      }
    }
    table.push_back(row);
  }
  // Row 1 is aqm, row 3 aqm2000.
  const auto factors = [&](const std::vector<std::string>& row) {
    const double first = std::stod(row[2]);
    return fixed(first / std::stod(row[3]), 1) + " and " + fixed(first / std::stod(row[4]), 1);
  };
  report.verdict(
      "Motion: per cent visible at flow x 1, 3, 5",
      "aqm untracked " + table[1][2] + ", " + table[1][3] + ", " + table[1][4] + "; tracked " + table[1][5] +
          ", " + table[1][6] + ", " + table[1][7] + "; aqm2000 untracked " + table[3][2] + ", " +
          table[3][3] + ", " + table[3][4],
      "direction as published (10.56, 3.00, 0.93; tracked 11.37); aqm2000 falls about as published, "
      "aqm far more steeply");
  report.text(
      "The published frames are not available. The strength of the errors was chosen so that the first per "
      "cent of aqm is near the published one: what is tested is how it changes from there, by factors of 3.5 "
      "and 11.4 as published. aqm2000, which is the published metric, falls by " +
      factors(table[3]) + "; aqm by " + factors(table[1]) +
      ". Why: these errors grow in proportion from left to right, so that the share of visible pixels is 1 - "
      "threshold / largest error. aqm pools over half a degree, which makes errors of one strength visible "
      "all "
      "together or not at all: " +
      table[1][1] +
      " % are visible at rest, so that a sensitivity lower by a fifth leaves nothing. aqm2000 judges every "
      "pixel by itself, and the single responses to a noise spread widely, as errors of a rendered sequence "
      "do "
      "from place to place. What aqm2000 does not show here is how little the published flow hides untracked "
      "at x 1: 10.56 of 11.37, here " +
      table[3][2] + " of " + table[3][1] +
      ". That sequence moves more slowly, or its errors are coarser; which of them is not known.");
  report.text("Per cent of pixels with P > 0.75:");
  report.table(table);
}

}  // namespace promenade::validation
