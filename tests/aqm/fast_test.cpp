// The fast execution: its parts against their definitions, the whole against the plain execution.

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <random>

#include "aqm/csf.h"
#include "aqm/fast_bank.h"
#include "aqm/grid.h"
#include "aqm/passband.h"
#include "aqm/retina.h"
#include "aqm/speed_steps.h"
#include "aqm/speed_terms.h"
#include "aqm/transform_plan.h"
#include "aqm/transpose.h"
#include "tests/aqm/fast_against_plain.h"
#include "tests/aqm/patterns.h"

namespace promenade::aqm {
namespace {

using tests::BlobScene;
using tests::frameOf;
using tests::pi;
using tests::velocityOf;

// g(rho; v) straight from its formula (channels.h): w_j, S(rho_k, v) / S(rho_k, u_j), S(rho, u_j).
double bandFunction(const FilterBank& filters, int band, double ppd, double f, double octave) {
  const double centre = ppd * filters.centre(band);
  const double v = 0.15 * std::exp2(octave);
  double sum = 0.0;
  for (int level = 0; level <= 13; ++level) {
    const double weight = std::max(0.0, 1.0 - std::abs(octave - level));
    if (weight > 0.0) {
      const double u = std::ldexp(0.15, level);
      sum += weight * sensitivity(centre, v) / sensitivity(centre, u) * sensitivity(ppd * f, u);
    }
  }
  return 1.09 * filters.radial({f, 0.0}, band) * sum;
}

TEST(SpeedTerms, AreWithinTheirToleranceOfEveryBandAtEverySpeed) {
  const Settings settings = aqm(40.0);
  for (const auto decomposition : {Decomposition::kCortexEnergy, Decomposition::kCortexAmplitude}) {
    const FilterBank filters(decomposition, 6, 6);
    for (int band = 1; band <= 7; ++band) {
      const SpeedTerms terms =
          speedTerms(filters, band, settings, {}, speedLevels(Eye::kTracking), 0, 5, 0.02);
      EXPECT_LE(terms.shapes.size(), 4u) << "band " << band;
      for (int step = 0; step <= 5 * kSpeedSteps; step += 37) {
        const double octave = static_cast<double>(step) / kSpeedSteps;
        std::vector<double> expected;
        std::vector<double> found;
        for (int i = 0; i < kShapeSamples; i += 7) {
          const double f = terms.lowest + (terms.highest - terms.lowest) * i / (kShapeSamples - 1);
          expected.push_back(bandFunction(filters, band, 40.0, f, octave));
          double sum = 0.0;
          for (std::size_t m = 0; m < terms.shapes.size(); ++m) {
            sum += static_cast<double>(terms.shapes[m][static_cast<std::size_t>(i)]) *
                   static_cast<double>(terms.coefficients[m][static_cast<std::size_t>(step)]);
          }
          found.push_back(sum);
        }
        const double largest = *std::max_element(expected.begin(), expected.end());
        for (std::size_t i = 0; i < found.size(); ++i) {
          // 0.02 at the speeds for which the terms were chosen, up to half as much again between them.
          ASSERT_NEAR(found[i], expected[i], 0.03 * (largest + 2.0 * 1.09))
              << "band " << band << ", " << octave;
        }
      }
    }
  }
}

TEST(SpeedTerms, AreASingleOneWhereNothingMovesAndAtBandCentres) {
  const FilterBank filters(Decomposition::kCortexEnergy, 6, 6);
  const SpeedLevels levels = speedLevels(Eye::kTracking);
  const SpeedTerms still = speedTerms(filters, 3, aqm(40.0), {}, levels, 0, 0, 0.01);
  ASSERT_EQ(still.shapes.size(), 1u);
  ASSERT_EQ(still.coefficients[0].size(), 1u);
  EXPECT_EQ(speedTerms(filters, 3, aqm2000(40.0), {}, levels, 0, 9, 0.01).shapes.size(), 1u);
}

TEST(SpeedSteps, AreTheLogarithmOfTheChannelsSpeed) {
  const Size size{37, 5};
  const VelocityMap velocity =
      velocityOf(size, [](int x, int y) { return glm::dvec2(0.3 * x * x - 20.0, 11.0 * y - 13.0); });
  for (const Eye eye : {Eye::kTracking, Eye::kFixating, Eye::kStabilised}) {
    const SpeedSteps steps = speedSteps(velocity, 6, eye);
    const double slowest = slowestSpeed(eye);
    double fastest = 0.0;
    for (int x = 0; x < size.width; ++x) {
      for (int y = 0; y < size.height; ++y) {
        const glm::dvec2 retinal = retinalVelocity(glm::dvec2(velocity(x, y)), eye);
        for (int l = 0; l < 6; ++l) {
          const double speed = channelSpeed(retinal, acrossBars(l), slowest);
          ASSERT_NEAR(steps.of(l)->row(y)[x], kSpeedSteps * std::log2(speed / slowest), 0.6);
          fastest = std::max(fastest, speed);
        }
        const double speed = channelSpeed(retinal, slowest);
        ASSERT_NEAR(steps.of(kUnoriented)->row(y)[x], kSpeedSteps * std::log2(speed / slowest), 0.6);
        fastest = std::max(fastest, speed);
      }
    }
    EXPECT_EQ(steps.last, static_cast<int>(std::ceil(std::log2(fastest / slowest))));
  }
  EXPECT_EQ(speedSteps({}, 6, Eye::kTracking).of(3), nullptr);
}

TEST(PassedRows, HoldEveryCoefficientThatTheChannelPasses) {
  for (const auto decomposition : {Decomposition::kCortexEnergy, Decomposition::kCortexAmplitude}) {
    for (const int orientations : {1, 2, 3, 6}) {
      for (const Size padded : {Size{96, 80}, Size{45, 75}}) {
        const FilterBank filters(decomposition, 4, orientations);
        for (int band = 1; band <= 5; ++band) {
          for (int l = kUnoriented; l < (band == 5 ? 0 : orientations); ++l) {
            for (int ix = 0; ix <= padded.width / 2; ++ix) {
              const PassedRows rows = passedRows(filters, band, l, ix, padded, 1);
              for (int iy = 0; iy < padded.height; ++iy) {
                const Frequency f{signedFrequency(ix, padded.width), signedFrequency(iy, padded.height),
                                  2 * ix == padded.width, 2 * iy == padded.height};
                const bool passes = filters.radial(f, band) * filters.fan(f, l) > 1e-12;
                const auto holds = [iy](Interval i) { return iy >= i.begin && iy < i.end; };
                ASSERT_TRUE(!passes || holds(rows.positive) || holds(rows.negative))
                    << "band " << band << ", orientation " << l << " of " << orientations << ", " << ix
                    << ", " << iy;
              }
              for (const Interval interval : {rows.positive, rows.negative}) {
                ASSERT_GE(interval.begin, 0);
                ASSERT_LE(interval.end, padded.height);
              }
            }
          }
        }
      }
    }
  }
}

TEST(Grid, HasASiteOnEitherSideOfEveryPixel) {
  const Layout layout = layoutOf({101, 33}, 40.0);  // K = 6, margin 32
  EXPECT_EQ(gridStep(1, 6), 1);
  EXPECT_EQ(gridStep(3, 6), 1);
  EXPECT_EQ(gridStep(4, 6), 2);
  EXPECT_EQ(gridStep(6, 6), 8);
  EXPECT_EQ(gridStep(7, 6), 16);
  const Grid fine = gridOf(layout, 1);
  EXPECT_EQ(fine.sites, (Size{101, 33}));
  EXPECT_EQ(fine.margin, 32);
  // Sites at 0, 8 .. 96 and 104; 0, 8 .. 32 and 40.
  const Grid coarse = gridOf(layout, 8);
  EXPECT_EQ(coarse.sites, (Size{14, 6}));
  EXPECT_EQ(coarse.margin, 4);
  EXPECT_EQ(coarse.padded.width * 8, layout.padded.width);
}

// 10 pixels, sites at 0, 4, 8 and, beyond the image, 12. Pixel -4 mirrors pixel 3, -8 mirrors 7; 16
// mirrors 3.
TEST(Reflections, LieBetweenTheSitesOfTheMirroredPixels) {
  const Reflections reflections = reflectionsOf(10, 4, 4, 2);
  EXPECT_EQ(reflections.before[0].site, 1);  // site -2: 7 = 4 + 3/4 * 4
  EXPECT_EQ(reflections.before[0].weight, 0.75f);
  EXPECT_EQ(reflections.before[1].site, 0);  // site -1: 3
  EXPECT_EQ(reflections.before[1].weight, 0.75f);
  EXPECT_EQ(reflections.after[0].site, 0);  // site 4: pixel 16
  EXPECT_EQ(reflections.after[0].weight, 0.75f);
}

TEST(Interpolation, HalfwayBetweenSamplesIsWithinOnePerCentUpToASixthOfACycle) {
  for (const double f : {0.0, 0.05, 0.1, 0.15, 1.0 / 6.0}) {
    for (const double phase : {0.0, 1.0, 2.5}) {
      std::vector<float> samples;
      for (int i = -2; i <= 3; ++i) {
        samples.push_back(static_cast<float>(std::cos(2.0 * pi * f * i + phase)));
      }
      EXPECT_NEAR(halfway(samples.data() + 2, 1), std::cos(2.0 * pi * f * 0.5 + phase), 0.0105) << f;
    }
  }
}

TEST(Interpolation, OfPowersIsBilinear) {
  Plane<float> coarse(3, 2);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      coarse.row(y)[x] = static_cast<float>(10 * y + 4 * x);
    }
  }
  Plane<float> fine(4, 2);
  fine.row(1)[3] = 1.0f;
  addInterpolated(coarse, fine);
  EXPECT_EQ(fine.row(0)[0], 0.0f);
  EXPECT_EQ(fine.row(0)[3], 6.0f);          // between 4 and 8
  EXPECT_EQ(fine.row(1)[2], 9.0f);          // 4 + half of 10
  EXPECT_EQ(fine.row(1)[3], 1.0f + 11.0f);  // 6 + 5
}

TEST(TransposeRows, TakesRowsOutOfColumns) {
  Spectrum from(21, 13);
  for (int ix = 0; ix < 13; ++ix) {
    for (int iy = 0; iy < 21; ++iy) {
      from.row(ix)[iy] = {static_cast<float>(ix), static_cast<float>(iy)};
    }
  }
  for (const int count : {1, 3, 4, 8, 11}) {
    Spectrum to(13, count);
    transposeRows(from, 5, count, 2, 13, to);
    for (int i = 0; i < count; ++i) {
      EXPECT_EQ(to.row(i)[1], std::complex<float>(0.0f, 0.0f));
      for (int ix = 2; ix < 13; ++ix) {
        ASSERT_EQ(to.row(i)[ix], std::complex<float>(static_cast<float>(ix), static_cast<float>(5 + i)));
      }
    }
  }
}

void expectClose(const tests::Departure& found, const char* what) {
  EXPECT_GT(found.largestPooled, 0.2) << what;
  EXPECT_LT(found.pooled, 0.02) << what;
  EXPECT_LT(found.probability, 0.02) << what;
  // The sums of the coarsest channels are interpolated linearly; smooth stimuli, unlike rendered frames (1 to
  // 3 %), have nothing else that fills their zeros.
  EXPECT_LT(found.sharp, 0.2) << what;
}

LuminanceMap noise(Size size, unsigned seed, double contrast) {
  std::mt19937 random(seed);
  return frameOf(size, [&](int, int) {
    return 50.0 * (1.0 + contrast * (static_cast<double>(random()) / 4294967295.0 - 0.5));
  });
}

TEST(FastExecution, FindsWhatThePlainOneFindsInEveryCoveredSetting) {
  const Size size{203, 150};
  const LuminanceMap test = noise(size, 1, 0.5);
  const LuminanceMap reference = noise(size, 2, 0.4);
  const VelocityMap velocity =
      velocityOf(size, [](int x, int y) { return glm::dvec2(x - 100, y - 70) * 0.12; });
  std::vector<std::pair<const char*, Settings>> cases{{"aqm", aqm(30.0)}};
  const auto with = [&](const char* name, const auto& change) {
    cases.emplace_back(name, aqm(30.0));
    change(cases.back().second);
  };
  with("amplitude filters", [](Settings& s) { s.decomposition = Decomposition::kCortexAmplitude; });
  with("band centres", [](Settings& s) { s.csfPlacement = CsfPlacement::kBandCentres; });
  with("another CSF", [](Settings& s) { s.csf = Csf::kDalyMoving; });
  with("an onset", [](Settings& s) { s.onsetHertz = 2.0; });
  with("revised", [](Settings& s) { s = revisedAqm(30.0); });
  with("strong masking", [](Settings& s) { s.masking.strength = 2.0; });
  with("fixating", [](Settings& s) { s.eye = Eye::kFixating; });
  with("stabilised", [](Settings& s) { s.eye = Eye::kStabilised; });
  with("one orientation", [](Settings& s) { s.orientations = 1; });
  with("four orientations", [](Settings& s) { s.orientations = 4; });
  with("three bands", [](Settings& s) { s.radialBands = 3; });
  with("two bands", [](Settings& s) { s.radialBands = 2; });
  with("no masking", [](Settings& s) { s.masking.elevation = Elevation::kNone; });
  with("masking at a point", [](Settings& s) { s.masking.extent = MaskExtent::kPoint; });
  with("masking by the test", [](Settings& s) { s.masking.source = MaskSource::kTest; });
  with("masking by the reference", [](Settings& s) { s.masking.source = MaskSource::kReference; });
  for (const auto& [name, settings] : cases) {
    ASSERT_TRUE(isCovered(settings));
    expectClose(tests::departure(test, reference, velocity, settings), name);
    expectClose(tests::departure(test, reference, {}, settings), name);
  }
}

TEST(FastExecution, FindsWhatThePlainOneFindsOnAnySize) {
  for (const Size size : {Size{1, 90}, Size{90, 1}, Size{17, 64}, Size{65, 33}, Size{131, 7}}) {
    const VelocityMap velocity = velocityOf(size, [](int x, int y) { return glm::dvec2(0.2 * x, -0.1 * y); });
    for (const double ppd : {5.0, 16.0, 40.0, 90.0}) {
      const tests::Departure found =
          tests::departure(noise(size, 3, 1.2), noise(size, 4, 1.0), velocity, aqm(ppd));
      EXPECT_LT(found.pooled, 0.05) << size.width << " x " << size.height << " at " << ppd;
      EXPECT_LT(found.probability, 0.05) << size.width << " x " << size.height << " at " << ppd;
    }
  }
}

// A grating of one frequency is the worst case of sampling: nothing averages it out.
TEST(FastExecution, FindsWhatThePlainOneFindsInAGratingAndABlob) {
  for (const double period : {3.0, 5.0, 7.0, 10.0, 16.0, 23.0, 40.0}) {
    const Size size{160, 128};
    const LuminanceMap grating = frameOf(size, [=](int x, int y) {
      return 50.0 * (1.0 + 0.05 * std::cos(2.0 * pi * (x + 0.4 * y) / period));
    });
    const tests::Departure found =
        tests::departure(grating, frameOf(size, [](int, int) { return 50.0; }), {}, aqm(32.0));
    EXPECT_LT(found.pooled, 0.015) << period;
    EXPECT_LT(found.probability, 0.02) << period;
  }
  const BlobScene scene;
  expectClose(tests::departure(scene.withBlob, scene.plain, scene.velocity, aqm(30.0)), "moving blob");
  expectClose(tests::departure(scene.withBlob, scene.plain, {}, aqm(30.0)), "still blob");
}

TEST(FastExecution, IsSymmetricExactAndIndependentOfThreads) {
  const BlobScene scene;
  const Result forth = compare(scene.withBlob, scene.plain, scene.velocity, aqm(30.0));
  const Result back = compare(scene.plain, scene.withBlob, scene.velocity, aqm(30.0));
  EXPECT_TRUE(std::ranges::equal(forth.jnd.pixels(), back.jnd.pixels()));
  EXPECT_TRUE(std::ranges::equal(forth.pooledJnd.pixels(), back.pooledJnd.pixels()));
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Result single = compare(scene.withBlob, scene.plain, scene.velocity, aqm(30.0));
  EXPECT_TRUE(std::ranges::equal(forth.jnd.pixels(), single.jnd.pixels()));
}

// 1280 x 720 at 40 pixels per degree: K = 6, margin 32, padded to 1440 x 800. Two frames forth; back, bands 1
// to 3 in 6 orientations at full size, bands 4, 5, 6 at D = 2, 4, 8 and the baseband at 16. Plainly, 6 * 6 +
// 1 channels.
TEST(PlannedTransforms, AreThoseOfTheChannelsOfBothFrames) {
  const auto plan = plannedTransforms({1280, 720}, {}, aqm(40.0));
  ASSERT_EQ(plan.size(), 5u);
  EXPECT_EQ(plan[0].size, (Size{1440, 800}));
  EXPECT_EQ(plan[0].forward, 2);
  EXPECT_EQ(plan[0].inverse, 2 * 6 * 3);
  EXPECT_EQ(plan[3].size, (Size{180, 100}));
  EXPECT_EQ(plan[3].inverse, 2 * 6);
  EXPECT_EQ(plan[4].size, (Size{90, 50}));
  EXPECT_EQ(plan[4].inverse, 2);
  Settings plain = aqm(40.0);
  plain.execution = Execution::kPlain;
  const auto plainly = plannedTransforms({1280, 720}, {}, plain);
  ASSERT_EQ(plainly.size(), 1u);
  EXPECT_EQ(plainly[0].inverse, 2 * 37);
}

TEST(FastExecution, LeavesToThePlainOneWhatItDoesNotCover) {
  EXPECT_TRUE(isCovered(aqm2000(40.0)));
  EXPECT_FALSE(isCovered(vdp(40.0, 0.5)));
  Settings settings = aqm(40.0);
  settings.contrast = ContrastKind::kLocal;
  EXPECT_FALSE(isCovered(settings));
}

}  // namespace
}  // namespace promenade::aqm
