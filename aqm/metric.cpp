#include "aqm/metric.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <sstream>
#include <vector>

#include "aqm/channels.h"
#include "aqm/contrast.h"
#include "aqm/cortex.h"
#include "aqm/fast_bank.h"
#include "aqm/filter_bank.h"
#include "aqm/fourier.h"
#include "aqm/layout.h"
#include "aqm/local_mean.h"
#include "aqm/masking.h"
#include "aqm/pooling.h"
#include "aqm/retina.h"
#include "aqm/spectrum.h"
#include "aqm/speed_field.h"
#include "aqm/speed_steps.h"
#include "src/core/errors.h"

namespace promenade::aqm {
namespace {

template <class... Parts>
[[noreturn]] void reject(const Parts&... parts) {
  std::ostringstream message;
  (message << ... << parts);
  throw InputError(message.str());
}

void checkSize(const char* what, Size found, Size expected) {
  if (found != expected) {
    reject(what, ": expected ", expected.width, " x ", expected.height,
           " pixels, as the test frame has, found ", found.width, " x ", found.height);
  }
}

/// Calls complain(x, y) at the first pixel, row by row, that is not good.
template <class Map, class Good, class Complain>
void checkPixels(const Map& map, const Good& isGood, const Complain& complain) {
  std::atomic<int> firstBad = map.height();
  tbb::parallel_for(tbb::blocked_range<int>(0, map.height(), 16), [&](const tbb::blocked_range<int>& range) {
    for (int y = range.begin(); y != range.end(); ++y) {
      bool good = true;
      for (const auto& value : map.row(y)) {
        good = good & isGood(value);
      }
      for (int first = firstBad; !good && y < first && !firstBad.compare_exchange_weak(first, y);) {
      }
    }
  });
  for (int x = 0; firstBad < map.height() && x < map.width(); ++x) {
    if (!isGood(map(x, firstBad))) {
      complain(x, firstBad.load());
    }
  }
}

void checkLuminance(const char* what, const LuminanceMap& luminance) {
  checkPixels(
      luminance, [](float value) { return (value > 0.0f) & (value <= std::numeric_limits<float>::max()); },
      [&](int x, int y) {
        reject(what, ": pixel (", x, ", ", y, "): expected a finite luminance above 0 cd/m2, found ",
               luminance(x, y));
      });
}

void checkVelocity(const VelocityMap& velocity) {
  checkPixels(
      velocity, [](glm::vec2 value) { return std::isfinite(value.x) & std::isfinite(value.y); },
      [&](int x, int y) {
        reject("velocity: pixel (", x, ", ", y, "): expected finite degrees per second, found (",
               velocity(x, y).x, ", ", velocity(x, y).y, ")");
      });
}

void checkSettings(const Settings& settings) {
  if (!(settings.pixelsPerDegree > 0.0 && settings.pixelsPerDegree <= kMostPixelsPerDegree)) {
    reject("pixels per degree: expected above 0 and at most ", kMostPixelsPerDegree, ", found ",
           settings.pixelsPerDegree);
  }
  if (settings.radialBands != 0 &&
      (settings.radialBands < kFewestRadialBands || settings.radialBands > kMostRadialBands)) {
    reject("radial bands: expected ", kFewestRadialBands, " to ", kMostRadialBands, ", or 0, found ",
           settings.radialBands);
  }
  if (settings.orientations < 1 || settings.orientations > kMostOrientations) {
    reject("orientations: expected 1 to ", kMostOrientations, ", found ", settings.orientations);
  }
  if (!(settings.viewingDistanceMetres > 0.0 && std::isfinite(settings.viewingDistanceMetres))) {
    reject("viewing distance: expected metres above 0, found ", settings.viewingDistanceMetres);
  }
  if (!(settings.masking.strength > 0.0 && std::isfinite(settings.masking.strength))) {
    reject("masking strength: expected above 0, found ", settings.masking.strength);
  }
  if (!(settings.onsetHertz >= 0.0 && settings.onsetHertz <= kMostOnsetHertz)) {
    reject("onset: expected 0 to ", kMostOnsetHertz, " Hz, found ", settings.onsetHertz);
  }
  if (!(settings.gain > 0.0 && std::isfinite(settings.gain))) {
    reject("gain: expected above 0, found ", settings.gain);
  }
}

void checkInputs(const LuminanceMap& test, const LuminanceMap& reference, const VelocityMap& velocity,
                 const Settings& settings) {
  checkSettings(settings);
  if (test.empty()) {
    reject("test frame: expected at least one pixel, found ", test.width(), " x ", test.height());
  }
  checkSize("reference frame", reference.size(), test.size());
  if (!velocity.empty()) {
    checkSize("velocity", velocity.size(), test.size());
  }
  checkLuminance("test frame", test);
  checkLuminance("reference frame", reference);
  checkVelocity(velocity);
}

bool areEqual(const LuminanceMap& a, const LuminanceMap& b) {
  return std::ranges::equal(a.pixels(), b.pixels());
}

Result noDifference(Size size, const Settings& settings) {
  return {JndMap(size), JndMap(size), ProbabilityMap(size),
          settings.signedMap == SignedMap::kYes ? SignedProbabilityMap(size) : SignedProbabilityMap()};
}

/// The channels that a bank of filters has: every band in every orientation, and the baseband.
std::vector<int> orientationsOf(const FilterBank& filters) {
  if (filters.orientations() == 1) {
    return {kUnoriented};
  }
  std::vector<int> orientations(static_cast<std::size_t>(filters.orientations()));
  std::iota(orientations.begin(), orientations.end(), 0);
  return orientations;
}

/// Where, and how surely.
Result judged(const Plane<float>& powers, const Plane<float>& changes, const Settings& settings) {
  Result result;
  result.jnd = sharpJnd(powers);
  if (settings.pooling == Pooling::kHalfDegree) {
    const Plane<float> pooled = pooledPowers(powers, settings.pixelsPerDegree);
    result.pooledJnd = pooledJnd(pooled);
    result.probability = detectionProbability(pooled);
  } else {
    result.pooledJnd = result.jnd.clone();
    result.probability = detectionProbability(powers);
  }
  if (settings.signedMap == SignedMap::kYes) {
    result.signedProbability = signedProbability(result.probability, changes);
  }
  return result;
}

}  // namespace

Result compare(const LuminanceMap& test, const LuminanceMap& reference, const VelocityMap& velocity,
               const Settings& settings) {
  checkInputs(test, reference, velocity, settings);
  if (areEqual(test, reference)) {
    // What follows would give the same, later.
    return noDifference(test.size(), settings);
  }
  const double ppd = settings.pixelsPerDegree;

  // The retina's response, as contrast.
  const double adaptation = adaptationLuminance(test, reference);
  const std::optional<SpeedSteps> fastSpeeds = speedsToRunFast(velocity, settings);
  const auto contrastOf = fastSpeeds ? fastContrast : contrast;
  const ContrastMap testContrast = contrastOf(test, adaptation);
  const ContrastMap referenceContrast = contrastOf(reference, adaptation);

  // Frequencies.
  const Layout layout =
      layoutOf(test.size(), ppd, settings.radialBands == 0 ? bandCount(ppd) : settings.radialBands);
  const FourierPlans plans(layout.padded);
  const Spectrum testSpectrum = spectrumOf(testContrast, layout, plans);
  const Spectrum referenceSpectrum = spectrumOf(referenceContrast, layout, plans);

  const FilterBank filters(settings.decomposition, layout.bands, settings.orientations);

  const double squareDegrees = static_cast<double>(test.size().area()) / (ppd * ppd);
  const Adaptation adapted{adaptation, squareDegrees, settings.viewingDistanceMetres};
  if (fastSpeeds) {
    return judged(
        fastPowers(layout, testSpectrum, referenceSpectrum, filters, settings, adapted, *fastSpeeds), {},
        settings);
  }

  // Channels (cortex filters and the CSF at the speed each of them sees), masked and summed.
  const ChannelModel model{filters, settings.csf, settings.csfPlacement, adapted, settings.gain};
  ChannelBank bank(layout, plans, testSpectrum, referenceSpectrum, model);
  if (settings.contrast == ContrastKind::kLocal) {
    bank.relateTo(localMeans(testSpectrum, layout, plans, adaptation),
                  localMeans(referenceSpectrum, layout, plans, adaptation));
  }
  DifferenceSum differences(test.size(), layout.bands, settings.masking, settings.signedMap);
  const VelocityMap retinal = retinalVelocities(velocity, settings.eye);
  const auto speedsOf = [&](int orientation, int band) {
    return speedField(retinal, test.size(), orientation, settings.orientations, settings.eye,
                      onsetSpeed(settings.onsetHertz, ppd * filters.centre(band)));
  };
  for (const int orientation : orientationsOf(filters)) {
    SpeedField speeds;
    for (int band = 1; band <= layout.bands; ++band) {
      if (band == 1 || settings.onsetHertz > 0.0) {
        speeds = speedsOf(orientation, band);
      }
      differences.add(bank.respond({band, orientation}, speeds), band);
    }
  }
  const int baseband = layout.bands + 1;
  const SpeedField speeds = speedsOf(kUnoriented, baseband);
  differences.add(bank.respond({baseband, kUnoriented}, speeds), baseband);

  return judged(differences.powers(), differences.changes(), settings);
}

double percentVisible(const ProbabilityMap& probability, const Mask& excluded) {
  if (!excluded.empty() && excluded.size() != probability.size()) {
    reject("excluded pixels: expected ", probability.width(), " x ", probability.height(),
           " pixels, as the probability map has, found ", excluded.width(), " x ", excluded.height());
  }
  std::size_t counted = 0;
  std::size_t visible = 0;
  const auto probabilities = probability.pixels();
  for (std::size_t i = 0; i < probabilities.size(); ++i) {
    if (excluded.empty() || excluded.pixels()[i] == 0) {
      ++counted;
      visible += probabilities[i] > kVisibleProbability ? 1u : 0u;
    }
  }
  return counted == 0 ? 0.0 : 100.0 * static_cast<double>(visible) / static_cast<double>(counted);
}

}  // namespace promenade::aqm
