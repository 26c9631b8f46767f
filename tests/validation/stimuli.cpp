#include "tests/validation/stimuli.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "aqm/cortex.h"
#include "aqm/fourier.h"
#include "aqm/spectrum.h"
#include "src/io/image_file.h"

namespace promenade::validation {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

Pattern window(double sx, double sy) {
  return [=](double x, double y) { return std::exp(-0.5 * (x * x / (sx * sx) + y * y / (sy * sy))); };
}

Pattern times(const Pattern& a, const Pattern& b) {
  return [=](double x, double y) { return a(x, y) * b(x, y); };
}

Pattern meanOf(const Pattern& a, const Pattern& b) {
  return [=](double x, double y) { return 0.5 * (a(x, y) + b(x, y)); };
}

/// Horizontal bars.
Pattern bars(double f) {
  return grating(f, 90.0);
}

double sign(double value) {
  return value > 0.0 ? 1.0 : value < 0.0 ? -1.0 : 0.0;
}

Pattern rowOfGabors(bool alternating) {
  return [=](double x, double y) {
    double sum = 0.0;
    for (int i = -2; i <= 2; ++i) {
      const double phase = alternating && i % 2 != 0 ? -1.0 : 1.0;
      sum += phase * gabor(8.0, 90.0, 0.07, 0.07)(x - 0.35 * i, y);
    }
    return sum;
  };
}

/// Patterns 1 .. 42 but 35, as the data's documentation gives them. A pixel is 1/120 degree.
Pattern patternOf(int stimulus) {
  constexpr std::array<double, 10> kFrequencies{1.12, 2.0, 2.83, 4.0, 5.66, 8.0, 11.3, 16.0, 22.6, 30.0};
  const Pattern wide = window(0.5, 0.5);
  const double pixel = 1.0 / kModelfestPpd;
  if (stimulus <= 10) return times(bars(kFrequencies[static_cast<std::size_t>(stimulus - 1)]), wide);
  switch (stimulus) {
    case 11:
      return gabor(2.0, 90.0, 0.28, 0.28);
    case 12:
      return gabor(4.0, 90.0, 0.14, 0.14);
    case 13:
      return gabor(8.0, 90.0, 0.07, 0.07);
    case 14:
      return gabor(16.0, 90.0, 0.035, 0.035);
    case 15:
      return gabor(4.0, 90.0, 0.5, 0.28);
    case 16:
      return gabor(8.0, 90.0, 0.5, 0.14);
    case 17:
      return gabor(16.0, 90.0, 0.5, 0.07);
    case 18:
      return gabor(4.0, 90.0, 0.28, 0.14);
    case 19:
      return gabor(4.0, 90.0, 0.5, 0.14);
    case 20:
      return gabor(4.0, 90.0, 0.14, 0.28);
    case 21:
      return gabor(4.0, 90.0, 0.14, 0.5);
    case 22:
      return times(meanOf(bars(2.0), bars(2.0 * std::numbers::sqrt2)), wide);
    case 23:
      return times(meanOf(bars(2.0), bars(4.0)), wide);
    case 24:
      return times(meanOf(bars(4.0), bars(4.0 * std::numbers::sqrt2)), wide);
    case 25:
      return times(meanOf(bars(4.0), bars(8.0)), wide);
    case 26:
      return wide;
    case 27:
      return window(8.43 / 60.0, 8.43 / 60.0);
    case 28:
      return window(2.106 / 60.0, 2.106 / 60.0);
    case 29:
      return window(1.05 / 60.0, 1.05 / 60.0);
    case 30:
      return [=](double x, double y) { return sign(y) * wide(x, y); };
    case 31:
      return [=](double x, double y) { return std::abs(y) < 0.5 * pixel ? wide(x, y) : 0.0; };
    case 32:
      return [=](double x, double y) {
        const double row = y / pixel;
        return (std::abs(row + 1.0) < 0.5 ? 1.0 : std::abs(row - 1.0) < 0.5 ? -1.0 : 0.0) * wide(x, y);
      };
    case 33:
      return rowOfGabors(false);
    case 34:
      return rowOfGabors(true);
    case 36:
      return gabor(4.0, 45.0, 0.14, 0.14);
    case 37:
      return gabor(4.0, 0.0, 0.14, 0.14);
    case 38:
      return meanOf(gabor(4.0, 0.0, 0.14, 0.14), gabor(4.0, 90.0, 0.14, 0.14));
    case 39:
      return meanOf(gabor(4.0, 45.0, 0.14, 0.14), gabor(4.0, 90.0, 0.14, 0.14));
    case 40:
      return [](double x, double y) { return std::hypot(x, y) <= 0.125 ? 1.0 : 0.0; };
    case 41:
      return [=](double x, double y) {
        return std::cyl_bessel_j(0.0, kTurn * 4.0 * std::hypot(x, y)) * wide(x, y);
      };
    default:
      return [=](double x, double y) {
        const double u = (x + y) / std::numbers::sqrt2;
        const double v = (x - y) / std::numbers::sqrt2;
        return sign(std::sin(kTurn * 2.81 * u) * std::sin(kTurn * 2.81 * v)) * wide(x, y);
      };
  }
}

}  // namespace

Pattern gabor(double cyclesPerDegree, double degrees, double sx, double sy) {
  return times(grating(cyclesPerDegree, degrees), window(sx, sy));
}

Pattern grating(double cyclesPerDegree, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  const double fx = kTurn * cyclesPerDegree * std::cos(angle);
  const double fy = kTurn * cyclesPerDegree * std::sin(angle);
  return [=](double x, double y) { return std::cos(fx * x + fy * y); };
}

Raster rasterOf(Size size, double pixelsPerDegree, const Pattern& pattern) {
  Raster raster;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      raster.push_back(
          pattern((x - size.width / 2) / pixelsPerDegree, (y - size.height / 2) / pixelsPerDegree));
    }
  }
  return raster;
}

LuminanceMap frameOf(Size size, double luminance, const Raster& contrast) {
  LuminanceMap frame(size);
  for (std::size_t i = 0; i < contrast.size(); ++i) {
    frame.pixels()[i] = static_cast<float>(luminance * std::max(1e-3, 1.0 + contrast[i]));
  }
  return frame;
}

LuminanceMap frameOf(Size size, double pixelsPerDegree, double luminance, double contrast,
                     const Pattern& pattern) {
  Raster raster = rasterOf(size, pixelsPerDegree, pattern);
  for (double& value : raster) value *= contrast;
  return frameOf(size, luminance, raster);
}

Raster noise(int side, double pixelsPerDegree, double rms, unsigned seed,
             const std::function<double(double, double)>& amplitude) {
  std::mt19937 random(seed);
  const aqm::FourierPlans plans({side, side});
  aqm::Spectrum spectrum(side, side / 2 + 1);
  for (int ix = 0; ix <= side / 2; ++ix) {
    for (int iy = 0; iy < side; ++iy) {
      const double fx = pixelsPerDegree * aqm::signedFrequency(ix, side);
      const double fy = pixelsPerDegree * aqm::signedFrequency(iy, side);
      const double phase = kTurn * static_cast<double>(random()) / 4294967296.0;
      if (ix == 0 && iy == 0) continue;
      const double value = amplitude(std::hypot(fx, fy), std::atan2(fy, fx) * 180.0 / std::numbers::pi);
      spectrum.row(ix)[iy] = std::complex<float>(std::polar(value, phase));
    }
  }
  // The first column holds both halves: make them conjugate. (Nyquist's need not be exact.)
  for (int iy = 1; iy < side / 2; ++iy) spectrum.row(0)[side - iy] = std::conj(spectrum.row(0)[iy]);
  aqm::Spectrum columns(side, side / 2 + 1);
  for (int ix = 0; ix <= side / 2; ++ix) plans.inverseColumn(spectrum.row(ix), columns.row(ix));
  Raster raster;
  aqm::Plane<float> row(side, 1);
  aqm::Spectrum halfRow(side / 2 + 1, 1);
  for (int y = 0; y < side; ++y) {
    for (int ix = 0; ix <= side / 2; ++ix) halfRow.row(0)[ix] = columns.row(ix)[y];
    plans.inverseRow(halfRow.row(0), row.row(0));
    for (int x = 0; x < side; ++x) raster.push_back(static_cast<double>(row.row(0)[x]));
  }
  double sum = 0.0;
  for (const double value : raster) sum += value * value;
  const double scale = rms / std::sqrt(sum / static_cast<double>(raster.size()));
  for (double& value : raster) value *= scale;
  return raster;
}

Raster modelfest(int stimulus, const std::filesystem::path& data) {
  if (stimulus != 35 && stimulus != 43) {
    return rasterOf(kModelfestSize, kModelfestPpd, patternOf(stimulus));
  }
  const io::ImageFile file =
      io::readImage(data / (stimulus == 35 ? "modelfest_noise.tif" : "modelfest_natural_scene.tif"));
  const auto& codes = std::get<EncodedMap>(file.colour);
  Raster raster;
  for (const Rgb& code : codes.pixels()) {
    raster.push_back((255.0 * static_cast<double>(code.g) - 128.0) / 127.0);
  }
  return raster;
}

}  // namespace promenade::validation
