// The parts of the fast execution against their definitions.

#include <gtest/gtest.h>

#include <random>

#include "aqm/csf.h"
#include "aqm/fast_bank.h"
#include "aqm/fourier.h"
#include "aqm/grid.h"
#include "aqm/passband.h"
#include "aqm/retina.h"
#include "aqm/row_pairs.h"
#include "aqm/speed_steps.h"
#include "aqm/speed_terms.h"
#include "aqm/transpose.h"
#include "tests/aqm/patterns.h"

namespace promenade::aqm {
namespace {

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

// Two rows of known cosines. What a row of reals cannot have, an imaginary mean, must not reach the other
// row.
TEST(RowPairs, AreWhatEachRowIsByItself) {
  for (const int length : {12, 45, 80}) {
    const FourierPlans plans(Size{length, 1});
    const int columns = length / 2 + 1;
    const auto spectrumOfRow = [&](unsigned seed, int begin, int end) {
      std::mt19937 random(seed);
      Spectrum row(columns, 1);
      for (int ix = begin; ix < end; ++ix) {
        row.row(0)[ix] = {static_cast<float>(random() % 1000) - 500.0f,
                          static_cast<float>(random() % 1000) - 500.0f};
      }
      return row;
    };
    for (const auto& [begin, end] :
         {std::pair(0, columns), std::pair(1, 5), std::pair(2, columns), std::pair(3, 3)}) {
      std::vector<Plane<float>> expected;
      Spectrum packed(length, 1);
      const Spectrum a = spectrumOfRow(1, begin, end);
      const Spectrum b = spectrumOfRow(2, begin, end);
      packRows(a.row(0), b.row(0), begin, end, length, packed.row(0));
      for (const unsigned seed : {1u, 2u}) {
        Spectrum row = spectrumOfRow(seed, begin, end);
        expected.emplace_back(length, 1);
        plans.inverseRow(row.row(0), expected.back().row(0));
      }
      Spectrum pair(length + kPlaneUnit, 1);
      plans.inverseRowPair(packed.row(0), pair.row(0));
      Plane<float> weights(length, 2);
      std::fill_n(weights.row(0), length, 2.0f);
      std::fill_n(weights.row(1), length, -1.0f);
      Plane<float> sums(length, 2);
      std::fill_n(sums.row(1), length, 7.0f);
      addRowPair(pair.row(0), weights.row(0), weights.row(1), sums.row(0), sums.row(1), sums.stride());
      for (int x = 0; x < length; ++x) {
        // Sums of up to 80 numbers of up to 700 in single precision.
        ASSERT_NEAR(sums.row(0)[x], 2.0f * expected[0].row(0)[x], 0.02f) << length << ", " << begin;
        ASSERT_NEAR(sums.row(1)[x], 7.0f - expected[1].row(0)[x], 0.02f) << length << ", " << begin;
      }
    }
  }
}

}  // namespace
}  // namespace promenade::aqm
