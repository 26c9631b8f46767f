// Every choice of the pipeline, on a stimulus whose response is known in closed form: a grating at the centre
// frequency of one channel.

#include "aqm/settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "aqm/contrast.h"
#include "aqm/csf.h"
#include "aqm/local_mean.h"
#include "aqm/metric.h"
#include "src/core/errors.h"
#include "tests/aqm/patterns.h"

namespace promenade::aqm {
namespace {

using tests::frameOf;
using tests::largest;
using tests::pi;
using tests::velocityOf;

// 1/6 cycle per pixel is the centre of band 3 (4/3 2^-3), along x that of orientation 0; at 24 pixels per
// degree it is 4 cycles per degree. 66 pixels and, with K = 4, 5 or 6, the padded 96, 120 or 144 are whole
// numbers of half periods: the reflected image is one frequency, and only one channel sees it, with
// amplitude 1.
constexpr double kPpd = 24.0;
constexpr Size kSize{66, 66};
constexpr double kContrast = 1e-3;
constexpr int kAnyRow = 31;

double cosineAt(int x) {
  return std::cos(2.0 * pi * (x + 0.5) / 6.0);
}

LuminanceMap gratingFrame(double contrast) {
  return frameOf(kSize, [=](int x, int) { return 50.0 * (1.0 + contrast * cosineAt(x)); });
}

LuminanceMap flatFrame() {
  return frameOf(kSize, [](int, int) { return 50.0; });
}

/// Executed plainly: fast_test.cpp holds the fast execution against it.
Result faintGrating(Settings settings, const VelocityMap& velocity = {}) {
  settings.execution = Execution::kPlain;
  return compare(gratingFrame(kContrast), flatFrame(), velocity, settings);
}

/// J = contrast * sensitivity * |grating|: the flat frame masks nothing.
void expectSensitivity(const Result& result, double expected) {
  for (const int x : {0, 1, 29, 30, 64}) {
    const double jnd = kContrast * expected * std::abs(cosineAt(x));
    // Amplitude nonlinearity: a second harmonic of about 1e-3 / 3 of the amplitude.
    EXPECT_NEAR(result.jnd(x, kAnyRow), jnd, 1e-3 * kContrast * expected) << "at column " << x;
  }
}

Settings unpooled() {
  Settings settings = aqm(kPpd);
  settings.pooling = Pooling::kNone;
  settings.gain = 1.0;
  return settings;
}

// At 2 Hz a grating of 4 cycles per degree is to the CSF what one is that drifts at 0.5 degrees per second
// besides the eye's own 0.15.
TEST(Settings, AnOnsetIsATemporalFrequencyInQuadratureWithThatOfTheMotion) {
  Settings settings = unpooled();
  settings.onsetHertz = 2.0;
  expectSensitivity(faintGrating(settings), sensitivity(4.0, std::hypot(0.15, 0.5)));
  const VelocityMap moving = velocityOf(kSize, [](int, int) { return glm::dvec2(1.2, 0.0); });
  settings.eye = Eye::kFixating;
  expectSensitivity(faintGrating(settings, moving), sensitivity(4.0, std::hypot(1.2, 0.5)));
}

std::vector<Settings> allKinds() {
  std::vector<Settings> kinds{aqm(kPpd), aqm2000(kPpd), vdp(kPpd, 0.5), revisedAqm(kPpd)};
  const auto with = [&](auto member, auto value) {
    for (Settings settings : {aqm(kPpd), aqm2000(kPpd), vdp(kPpd, 0.5)}) {
      settings.*member = value;
      kinds.push_back(settings);
    }
  };
  with(&Settings::contrast, ContrastKind::kLocal);
  with(&Settings::decomposition, Decomposition::kLaplacianPyramid);
  with(&Settings::decomposition, Decomposition::kCortexEnergy);
  with(&Settings::radialBands, 3);
  with(&Settings::orientations, 1);
  with(&Settings::orientations, 4);
  with(&Settings::csf, Csf::kMannosSakrison);
  with(&Settings::csf, Csf::kDaly);
  with(&Settings::csf, Csf::kKellyDaly);
  with(&Settings::csf, Csf::kDalyMoving);
  with(&Settings::csfPlacement, CsfPlacement::kBandCentres);
  with(&Settings::eye, Eye::kFixating);
  with(&Settings::eye, Eye::kStabilised);
  with(&Settings::masking, Masking{Elevation::kNone, MaskExtent::kPoint, MaskSource::kMutual});
  with(&Settings::masking, Masking{Elevation::kDaly, MaskExtent::kChannel, MaskSource::kMutual});
  with(&Settings::masking, Masking{Elevation::kUnitKnee, MaskExtent::kPoint, MaskSource::kTest});
  with(&Settings::pooling, Pooling::kHalfDegree);
  with(&Settings::signedMap, SignedMap::kYes);
  with(&Settings::execution, Execution::kPlain);
  return kinds;
}

TEST(Settings, OfThePublishedMetricsAreTheirChoices) {
  EXPECT_EQ(aqm2000(60.0).pixelsPerDegree, 60.0);
  EXPECT_EQ(aqm2000(60.0).decomposition, Decomposition::kCortexAmplitude);
  EXPECT_EQ(aqm2000(60.0).csfPlacement, CsfPlacement::kBandCentres);
  EXPECT_EQ(aqm2000(60.0).pooling, Pooling::kNone);
  EXPECT_EQ(vdp(60.0, 0.7).csf, Csf::kDaly);
  EXPECT_EQ(revisedAqm(60.0).csf, Csf::kDalyMoving);
  EXPECT_EQ(vdp(60.0, 0.7).viewingDistanceMetres, 0.7);
  EXPECT_EQ(vdp(60.0, 0.7).masking, (Masking{Elevation::kDaly, MaskExtent::kChannel, MaskSource::kMutual}));
  EXPECT_EQ(vdp(60.0, 0.7).signedMap, SignedMap::kYes);
}

TEST(Settings, AqmGivesTheSensitivityAtACentreFrequencyTimesItsGain) {
  expectSensitivity(faintGrating(aqm(kPpd)), 1.09 * sensitivity(4.0, 0.15));
}

TEST(Settings, Aqm2000GivesTheSensitivityAtTheCentreAndTheProbabilityOfThePixel) {
  const Result result = faintGrating(aqm2000(kPpd));
  expectSensitivity(result, sensitivity(4.0, 0.15));
  EXPECT_TRUE(std::ranges::equal(result.pooledJnd.pixels(), result.jnd.pixels()));
  const double jnd = static_cast<double>(result.jnd(30, kAnyRow));
  EXPECT_NEAR(result.probability(30, kAnyRow), 1.0 - std::exp(-std::pow(jnd, 3.5)), 1e-6);
  EXPECT_TRUE(result.signedProbability.empty());
}

// On the border between bands 3 and 4 (1/8 cycle per pixel, 3 cycles per degree) both filters have amplitude
// 1/2, and each is scaled by S at its own centre, 4 and 2: (1/2) c (S(4)^3.5 + S(2)^3.5)^(1/3.5). 68 pixels
// are 17 half periods; padded to 120.
TEST(Settings, Aqm2000SplitsAGratingBetweenTwoBands) {
  const Size size{68, 68};
  const auto wave = [](int x) { return std::cos(2.0 * pi * (x + 0.5) / 8.0); };
  const LuminanceMap test = frameOf(size, [&](int x, int) { return 50.0 * (1.0 + kContrast * wave(x)); });
  const Result result = compare(test, frameOf(size, [](int, int) { return 50.0; }), {}, aqm2000(kPpd));
  const double sum = std::pow(sensitivity(4.0, 0.15), 3.5) + std::pow(sensitivity(2.0, 0.15), 3.5);
  const double expected = 0.5 * kContrast * std::pow(sum, 1.0 / 3.5) * std::abs(wave(32));
  EXPECT_NEAR(result.jnd(32, kAnyRow), expected, 2e-3 * expected);
}

// The image is (66 / 24)^2 square degrees, seen by an eye adapted to 50 cd/m2.
TEST(Settings, VdpGivesDalysSensitivityAndTheSignOfTheChange) {
  const Result result = faintGrating(vdp(kPpd, 0.7));
  const double area = 66.0 * 66.0 / (24.0 * 24.0);
  expectSensitivity(result, dalySensitivity(4.0, 0.0, {50.0, area, 0.7}));
  ASSERT_EQ(result.signedProbability.size(), kSize);
  for (int x = 0; x < kSize.width; ++x) {
    const float expected = std::copysign(result.probability(x, kAnyRow), static_cast<float>(cosineAt(x)));
    if (std::abs(cosineAt(x)) > 0.1) {
      ASSERT_EQ(result.signedProbability(x, kAnyRow), expected) << x;
    }
  }
}

// The mask m = 0.02 S(4) cos is in the same channel: T = (1 + (k1 k2 |m|)^4)^(1/4), slope 1 in band 3 of 5,
// is low-passed with sigma = 3 pixels, of which its period of 3 pixels leaves only the mean: two of three
// pixels are at |cos| = 0.866, one at 0. Frames of 2 % and 2.1 %: the nonlinearity moves both by less than 1
// %.
TEST(Settings, VdpElevatesTheThresholdByTheReference) {
  const Result result = compare(gratingFrame(0.021), gratingFrame(0.020), {}, vdp(kPpd, 0.5));
  const double s = dalySensitivity(4.0, 0.0, {50.0, 66.0 * 66.0 / 576.0, 0.5});
  const double mask = 0.020 * s * std::abs(cosineAt(30));
  const double peak = std::pow(1.0 + std::pow(0.0153 * 392.5 * mask, 4.0), 0.25);
  const double elevation = (2.0 * peak + 1.0) / 3.0;
  const double expected = 0.001 * s * std::abs(cosineAt(30)) / elevation;
  EXPECT_GT(elevation, 8.0);
  EXPECT_NEAR(result.jnd(30, kAnyRow), expected, 0.02 * expected);
}

TEST(Settings, CsfOfMannosAndSakrison) {
  Settings settings = unpooled();
  settings.csf = Csf::kMannosSakrison;
  expectSensitivity(faintGrating(settings), mannosSakrisonSensitivity(4.0));
  settings.csfPlacement = CsfPlacement::kBandCentres;
  expectSensitivity(faintGrating(settings), mannosSakrisonSensitivity(4.0));
}

// At rest Daly's static CSF; at speed v, changed by S_Kelly(4, v) / S_Kelly(4, 0.15).
TEST(Settings, DalysCsfMayMoveAsKellysDoes) {
  const double still = dalySensitivity(4.0, 0.0, {50.0, 66.0 * 66.0 / 576.0, 0.5});
  const VelocityMap across = velocityOf(kSize, [](int, int) { return glm::dvec2(2.0, 0.0); });
  for (const auto placement : {CsfPlacement::kWithinBands, CsfPlacement::kBandCentres}) {
    Settings settings = unpooled();
    settings.csf = Csf::kDalyMoving;
    settings.csfPlacement = placement;
    expectSensitivity(faintGrating(settings), still);
    expectSensitivity(faintGrating(settings, across),
                      still * sensitivity(4.0, 0.21) / sensitivity(4.0, 0.15));
  }
}

// At 2 degrees per second across the bars a tracking eye leaves 2 - (0.82 * 2 + 0.15) = 0.21.
TEST(Settings, TheEyeTracksOrFixatesOrIsStabilised) {
  const VelocityMap across = velocityOf(kSize, [](int, int) { return glm::dvec2(2.0, 0.0); });
  for (Settings settings : {unpooled(), aqm2000(kPpd)}) {
    settings.eye = Eye::kTracking;
    expectSensitivity(faintGrating(settings, across), sensitivity(4.0, 0.21));
    settings.eye = Eye::kFixating;
    expectSensitivity(faintGrating(settings, across), sensitivity(4.0, 2.0));
    expectSensitivity(faintGrating(settings), sensitivity(4.0, 0.15));
    settings.eye = Eye::kStabilised;
    expectSensitivity(faintGrating(settings, across), sensitivity(4.0, 2.0));
    expectSensitivity(faintGrating(settings), sensitivity(4.0, 0.15 / 16.0));
  }
}

TEST(Settings, AStaticCsfKnowsNoMotion) {
  const VelocityMap across = velocityOf(kSize, [](int, int) { return glm::dvec2(8.0, 0.0); });
  const Result still = faintGrating(vdp(kPpd, 0.5));
  const Result moving = faintGrating(vdp(kPpd, 0.5), across);
  EXPECT_TRUE(std::ranges::equal(still.jnd.pixels(), moving.jnd.pixels()));
}

// The grating is at the centre of orientation 0 whatever its number of neighbours, and of band 3.
TEST(Settings, TheNumbersOfBandsAndOrientationsDoNotMoveAChannelsCentre) {
  for (const int orientations : {1, 2, 3, 4, 6, 8, 12}) {
    Settings settings = unpooled();
    settings.orientations = orientations;
    expectSensitivity(faintGrating(settings), sensitivity(4.0, 0.15));
  }
  for (const int bands : {4, 5, 6}) {
    Settings settings = unpooled();
    settings.radialBands = bands;
    expectSensitivity(faintGrating(settings), sensitivity(4.0, 0.15));
  }
}

// Between two fans of n, each has the amplitude sqrt(1/2) (energy) or 1/2 (amplitude), so that J falls by
// 2^(1/3.5) times that. A grating along the diagonal, 45 degrees, lies between fans 0 and 1 of 2. Its bands:
// at 0.1768 = sqrt(2)/8 cycles per pixel, band 3 has the amplitudes below. 64 x 64 pixels are 8 periods;
// padded to 96, 12 periods.
TEST(Settings, OfTwoOrientationsEachSeesHalfOfADiagonalGrating) {
  const Size size{64, 64};
  const LuminanceMap test = frameOf(size, [](int x, int y) {
    return 50.0 *
           (1.0 + kContrast * std::cos(2.0 * pi * (x + 0.5) / 8.0) * std::cos(2.0 * pi * (y + 0.5) / 8.0));
  });
  const LuminanceMap flat = frameOf(size, [](int, int) { return 50.0; });
  Settings one = unpooled();
  one.orientations = 1;
  Settings two = one;
  two.orientations = 2;
  const double jnd = static_cast<double>(compare(test, flat, {}, one).jnd(32, 24));
  ASSERT_GT(jnd, 0.05);
  EXPECT_NEAR(compare(test, flat, {}, two).jnd(32, 24), std::pow(2.0, 1.0 / 3.5) * std::sqrt(0.5) * jnd,
              1e-3 * jnd);
  one.decomposition = two.decomposition = Decomposition::kCortexAmplitude;
  const double sharp = static_cast<double>(compare(test, flat, {}, one).jnd(32, 24));
  EXPECT_NEAR(compare(test, flat, {}, two).jnd(32, 24), std::pow(2.0, 1.0 / 3.5) * 0.5 * sharp, 1e-3 * sharp);
}

// Along x, G_k = prod_{j<k} cos^4(pi 2^j / 6): G_1 = 9/16, G_2 = 9/16 * 1/16, G_3 = G_2 / 16 ..; band k
// passes G_{k-1} - G_k: 7/16, 135/256, 135/4096, .. in orientation 0 of 4.
TEST(Settings, ThePyramidsBandsAreDifferencesOfBinomialLowPasses) {
  Settings settings = unpooled();
  settings.decomposition = Decomposition::kLaplacianPyramid;
  settings.orientations = 4;
  const double norm = std::pow(std::pow(7.0 / 16.0, 3.5) + std::pow(135.0 / 256.0, 3.5), 1.0 / 3.5);
  expectSensitivity(faintGrating(settings), norm * sensitivity(4.0, 0.15));
}

// A uniform frame of another luminance than the adaptation's: R(L) / R(Lm) exactly.
TEST(LocalMean, IsTheRatioOfTheRetinasResponses) {
  const Size size{21, 13};
  const Layout layout = layoutOf(size, 10.0);
  const FourierPlans plans(layout.padded);
  for (const double luminance : {5.0, 50.0, 300.0}) {
    const ContrastMap map = contrast(frameOf(size, [=](int, int) { return luminance; }), 50.0);
    const Plane<float> means = localMeans(spectrumOf(map, layout, plans), layout, plans, 50.0);
    EXPECT_NEAR(means.row(6)[20], coneResponse(luminance) / coneResponse(50.0), 1e-5);
  }
  const ContrastMap dark = contrast(frameOf(size, [](int, int) { return 1e-20; }), 50.0);
  EXPECT_EQ(localMeans(spectrumOf(dark, layout, plans), layout, plans, 50.0).row(0)[0], 0.1f);
}

// At 200 cd/m2 in one frame pair: mean luminance equals adaptation, so local and global contrast agree; and a
// channel's response in a frame's dark part is relative to the dark.
TEST(Settings, LocalContrastIsGlobalContrastOnAUniformField) {
  Settings settings = unpooled();
  settings.contrast = ContrastKind::kLocal;
  expectSensitivity(faintGrating(settings), sensitivity(4.0, 0.15));
}

TEST(Settings, LocalContrastRaisesWhatIsInTheDark) {
  const Size size{128, 64};
  const auto frame = [&](double contrast) {
    return frameOf(size, [=](int x, int) {
      return (x < 64 ? 10.0 : 90.0) * (1.0 + contrast * std::cos(2.0 * pi * (x + 0.5) / 6.0));
    });
  };
  Settings settings = unpooled();
  settings.masking.elevation = Elevation::kNone;
  const Result global = compare(frame(1e-2), frame(0.0), {}, settings);
  settings.contrast = ContrastKind::kLocal;
  const Result local = compare(frame(1e-2), frame(0.0), {}, settings);
  // Far from the edge between the halves: R(50) / R(10) = 0.25246 / 0.15687 = 1.609, R(50) / R(90) = 0.8475.
  const double dark = static_cast<double>(local.jnd(12, 32)) / static_cast<double>(global.jnd(12, 32));
  const double bright = static_cast<double>(local.jnd(114, 32)) / static_cast<double>(global.jnd(114, 32));
  EXPECT_NEAR(dark, coneResponse(50.0) / coneResponse(10.0), 0.1);
  EXPECT_NEAR(bright, coneResponse(50.0) / coneResponse(90.0), 0.05);
}

TEST(Settings, OfEveryKindFindNoDifferenceInEqualFramesAndAreFiniteOnAnySize) {
  for (const Settings& settings : allKinds()) {
    const LuminanceMap same = gratingFrame(0.3);
    const Result none = compare(same, same, {}, settings);
    EXPECT_EQ(largest(none.jnd), 0.0);
    EXPECT_EQ(largest(none.probability), 0.0);
    for (const Size size : {Size{1, 1}, Size{7, 1}, Size{1, 5}, Size{13, 9}}) {
      const LuminanceMap a = frameOf(size, [](int x, int y) { return 10.0 + 7.0 * ((x * 5 + y * 3) % 11); });
      const LuminanceMap b = frameOf(size, [](int x, int y) { return 15.0 + 5.0 * ((x * 3 + y * 7) % 13); });
      const VelocityMap velocity = velocityOf(size, [](int x, int y) { return glm::dvec2(x, 3.0 * y); });
      const Result result = compare(a, b, velocity, settings);
      for (const float value : result.jnd.pixels()) {
        ASSERT_TRUE(std::isfinite(value) && value >= 0.0f);
      }
      for (const float value : result.probability.pixels()) {
        ASSERT_TRUE(value >= 0.0f && value <= 1.0f);
      }
    }
  }
}

TEST(Settings, OfEveryKindAreSymmetricUnlessOneFrameIsTheMask) {
  const tests::BlobScene scene;
  for (Settings settings : allKinds()) {
    settings.pixelsPerDegree = 12.0;
    const Result forth = compare(scene.withBlob, scene.plain, scene.velocity, settings);
    const Result back = compare(scene.plain, scene.withBlob, scene.velocity, settings);
    const bool isSymmetric = settings.masking.source == MaskSource::kMutual;
    EXPECT_GT(largest(forth.jnd), 0.05);
    EXPECT_EQ(std::ranges::equal(forth.jnd.pixels(), back.jnd.pixels()), isSymmetric);
    if (isSymmetric && settings.signedMap == SignedMap::kYes) {
      for (std::size_t i = 0; i < forth.jnd.pixels().size(); ++i) {
        ASSERT_EQ(forth.signedProbability.pixels()[i], -back.signedProbability.pixels()[i]);
      }
    }
  }
}

std::string complaint(const std::function<void(Settings&)>& change) {
  Settings settings = aqm(kPpd);
  change(settings);
  try {
    (void)compare(LuminanceMap(2, 2, 1.0f), LuminanceMap(2, 2, 1.0f), {}, settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

TEST(Settings, OutOfRangeAreNamed) {
  EXPECT_EQ(complaint([](Settings& s) { s.radialBands = 1; }),
            "radial bands: expected 2 to 12, or 0, found 1");
  EXPECT_EQ(complaint([](Settings& s) { s.orientations = 0; }), "orientations: expected 1 to 24, found 0");
  EXPECT_THAT(complaint([](Settings& s) { s.viewingDistanceMetres = 0.0; }),
              ::testing::HasSubstr("viewing distance: expected metres above 0"));
  EXPECT_EQ(complaint([](Settings& s) { s.onsetHertz = -1.0; }), "onset: expected 0 to 60 Hz, found -1");
  EXPECT_THAT(complaint([](Settings& s) { s.gain = std::nan(""); }), ::testing::HasSubstr("gain: expected"));
}

}  // namespace
}  // namespace promenade::aqm
