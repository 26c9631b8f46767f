#include "aqm/predecessors.h"

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>

#include "aqm/contrast.h"
#include "aqm/csf.h"
#include "aqm/spectrum.h"
#include "src/core/errors.h"

namespace promenade::aqm {
namespace {

void checkPair(const LuminanceMap& test, const LuminanceMap& reference) {
  if (test.empty() || test.size() != reference.size()) {
    throw InputError("frames: expected two of one size, found " + std::to_string(test.width()) + " x " +
                     std::to_string(test.height()) + " and " + std::to_string(reference.width()) + " x " +
                     std::to_string(reference.height()) + " pixels");
  }
  for (const LuminanceMap* map : {&test, &reference}) {
    for (std::size_t i = 0; i < map->pixels().size(); ++i) {
      const float value = map->pixels()[i];
      if (!(value > 0.0f && std::isfinite(value))) {
        const auto width = static_cast<std::size_t>(map->width());
        throw InputError((map == &test ? "test" : "reference") + std::string(" frame: pixel (") +
                         std::to_string(i % width) + ", " + std::to_string(i / width) +
                         "): expected a finite luminance above 0 cd/m2, found " + std::to_string(value));
      }
    }
  }
}

double meanOf(const LuminanceMap& map) {
  return std::accumulate(map.pixels().begin(), map.pixels().end(), 0.0) /
         static_cast<double>(map.size().area());
}

ContrastMap mapped(const LuminanceMap& luminance, const std::function<double(double)>& value) {
  ContrastMap result(luminance.size());
  for (std::size_t i = 0; i < result.pixels().size(); ++i) {
    result.pixels()[i] = static_cast<float>(value(static_cast<double>(luminance.pixels()[i])));
  }
  return result;
}

enum class Compared { kMagnitudes, kMagnitudesAndPhases };

/// The mean over all frequencies of the squared, weighted difference of the coefficients of an orthonormal
/// transform; `weight`(cycles per degree, angle).
double meanSquare(const ContrastMap& test, const ContrastMap& reference, double pixelsPerDegree,
                  Compared compared, const std::function<double(double, double)>& weight) {
  const Size size = test.size();
  const Layout layout{size, size, 0, 0, pixelsPerDegree};
  const FourierPlans plans(size);
  const Spectrum a = spectrumOf(test, layout, plans);
  const Spectrum b = spectrumOf(reference, layout, plans);
  const auto frequency = [&](int index, int length) {
    return pixelsPerDegree * (2 * index < length ? index : index - length) / length;
  };
  double sum = 0.0;
  for (int ix = 0; ix < layout.spectrumColumns(); ++ix) {
    // The half that is not stored mirrors this one.
    const double times = ix == 0 || 2 * ix == size.width ? 1.0 : 2.0;
    for (int iy = 0; iy < size.height; ++iy) {
      const double fx = frequency(ix, size.width);
      const double fy = frequency(iy, size.height);
      const std::complex<double> first(a.row(ix)[iy]);
      const std::complex<double> second(b.row(ix)[iy]);
      const double difference =
          compared == Compared::kMagnitudes ? std::abs(first) - std::abs(second) : std::abs(first - second);
      const double weighted = weight(std::hypot(fx, fy), std::atan2(fy, fx)) * difference;
      sum += times * weighted * weighted;
    }
  }
  const auto count = static_cast<double>(size.area());
  return sum / (count * count);
}

/// Daly's CSF with its peak of 250 taken off.
double dalyWeight(double rho, double angle, double luminance, Size size, double pixelsPerDegree) {
  const double area = static_cast<double>(size.area()) / (pixelsPerDegree * pixelsPerDegree);
  return dalySensitivity(rho, angle, {.luminance = luminance, .squareDegrees = area}) / 250.0;
}

}  // namespace

double rmse(const LuminanceMap& test, const LuminanceMap& reference) {
  checkPair(test, reference);
  double sum = 0.0;
  for (std::size_t i = 0; i < test.pixels().size(); ++i) {
    const double difference =
        static_cast<double>(test.pixels()[i]) - static_cast<double>(reference.pixels()[i]);
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(test.size().area()));
}

double psnr(const LuminanceMap& test, const LuminanceMap& reference, double peakLuminance) {
  const double error = rmse(test, reference);
  return error == 0.0 ? std::numeric_limits<double>::infinity() : 20.0 * std::log10(peakLuminance / error);
}

double rushmeierModel1(const LuminanceMap& test, const LuminanceMap& reference, double pixelsPerDegree) {
  checkPair(test, reference);
  const auto brightness = [](const LuminanceMap& map) {
    return mapped(map, [mean = meanOf(map)](double l) { return std::cbrt(l / mean); });
  };
  return meanSquare(brightness(test), brightness(reference), pixelsPerDegree, Compared::kMagnitudes,
                    [](double rho, double) { return mannosSakrisonSensitivity(rho) / 250.0; });
}

double rushmeierModel2(const LuminanceMap& test, const LuminanceMap& reference, double pixelsPerDegree) {
  checkPair(test, reference);
  const auto relative = [](const LuminanceMap& map) {
    return mapped(map, [mean = meanOf(map)](double l) { return l / mean; });
  };
  const auto weight = [&](double rho, double angle) {
    return dalyWeight(rho, angle, 100.0, test.size(), pixelsPerDegree);
  };
  return std::sqrt(meanSquare(relative(test), relative(reference), pixelsPerDegree,
                              Compared::kMagnitudesAndPhases, weight));
}

double rushmeierModel3(const LuminanceMap& test, const LuminanceMap& reference, double pixelsPerDegree) {
  checkPair(test, reference);
  const auto weight = [&](double rho, double angle) {
    return dalyWeight(rho, angle, 50.0, test.size(), pixelsPerDegree);
  };
  return meanSquare(mapped(test, coneResponse), mapped(reference, coneResponse), pixelsPerDegree,
                    Compared::kMagnitudes, weight);
}

}  // namespace promenade::aqm
