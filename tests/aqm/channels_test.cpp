#include "aqm/channels.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "aqm/contrast.h"
#include "aqm/cortex.h"
#include "aqm/csf.h"
#include "aqm/masking.h"
#include "tests/aqm/patterns.h"

namespace promenade::aqm {
namespace {

using tests::bars;
using tests::pi;

/// The contrast image itself, so that amplitudes below are those of the formulas.
ContrastMap contrastOf(Size size, const std::function<double(int, int)>& contrast) {
  ContrastMap map(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      map(x, y) = static_cast<float>(contrast(x, y));
    }
  }
  return map;
}

ChannelModel modelOf(const Layout& layout) {
  return {FilterBank(Decomposition::kCortexEnergy, layout.bands, kOrientations)};
}

double amplitude(const Plane<float>& plane) {
  double result = 0.0;
  for (int y = 0; y < plane.height(); ++y) {
    for (int x = 0; x < plane.width(); ++x) {
      result = std::max(result, std::abs(static_cast<double>(plane.row(y)[x])));
    }
  }
  return result;
}

// At 32 pixels per degree K = 5 and the margin is 16; 128 + 32 = 160 = 8 * 20 needs no more padding. bars()
// is symmetric about both borders, so that its reflection is itself: 10 periods in 160 pixels, a single
// frequency.
class StaticGrating : public ::testing::Test {
 protected:
  const Size size_{128, 128};
  const Layout layout_ = layoutOf(size_, 32.0);
  const FourierPlans plans_{layout_.padded};
  const Spectrum grating_ =
      spectrumOf(contrastOf(size_, [](int x, int) { return 0.01 * bars(x); }), layout_, plans_);
  const Spectrum flat_ = spectrumOf(contrastOf(size_, [](int, int) { return 0.0; }), layout_, plans_);
  const SpeedField still_ = speedField({}, size_, 0);
};

// 1/16 cycles per pixel = 2 cycles per degree, along x: only orientation 0, and of the octave bands only
// 2/3 2^-k < 1/16 < 8/3 2^-k, so k = 4 and 5. G S(2, 0.15) H is the gain.
TEST_F(StaticGrating, IsSeenByTheTwoBandsAroundItsFrequencyInItsOrientation) {
  ChannelBank bank(layout_, plans_, grating_, flat_, modelOf(layout_));
  for (int band = 1; band <= layout_.bands; ++band) {
    for (int l = 0; l < kOrientations; ++l) {
      const Responses& responses = bank.respond({band, l}, still_);
      const double expected =
          l == 0 ? 0.01 * 1.09 * sensitivity(2.0, 0.15) * bandAmplitude(1.0 / 16.0, band) : 0.0;
      // The peaks of bars() lie half-way between pixels: cos(pi / 16) of them is sampled.
      EXPECT_NEAR(amplitude(responses.test), expected * std::cos(pi / 16.0), 2e-4 * expected + 1e-5)
          << "band " << band << ", orientation " << l;
      EXPECT_EQ(amplitude(responses.reference), 0.0);
    }
  }
}

TEST_F(StaticGrating, GivesTheSameBitsInBothFrames) {
  const Spectrum again =
      spectrumOf(contrastOf(size_, [](int x, int) { return 0.01 * bars(x); }), layout_, plans_);
  ChannelBank bank(layout_, plans_, grating_, again, modelOf(layout_));
  DifferenceSum differences(size_, layout_.bands, Masking{});
  for (int band = 1; band <= layout_.bands; ++band) {
    const Responses& responses = bank.respond({band, 0}, still_);
    for (int y = 0; y < size_.height; ++y) {
      ASSERT_TRUE(
          std::equal(responses.test.row(y), responses.test.row(y) + size_.width, responses.reference.row(y)));
    }
    differences.add(responses, band);
  }
  EXPECT_EQ(amplitude(differences.powers()), 0.0);
}

// Half-way between two speed levels in octaves, the response to a grating at the band's centre frequency is
// still exactly that of the formula: only the shape inside the band is interpolated.
TEST(ChannelBank, GivesTheCsfAtTheBandsCentreFrequencyForAnySpeed) {
  // 24 pixels per degree: K = 5, margin 16; 64 + 32 = 96 pixels; band 3 is centred on 1/6 cycle per pixel, 16
  // periods in 96.
  const Size size{64, 64};
  const Layout layout = layoutOf(size, 24.0);
  ASSERT_EQ(layout.padded.width, 96);
  const FourierPlans plans(layout.padded);
  // Given as a spectrum, because no reflected image of 64 pixels has this period.
  Spectrum grating(layout.padded.height, layout.spectrumColumns());
  grating.row(16)[0] = static_cast<float>(0.01 * 0.5 * 96.0 * 96.0);
  ChannelBank bank(layout, plans, grating, grating, modelOf(layout));
  for (const double speed : {0.15, 0.2, 0.25, 0.9, 4.4, 10.0}) {
    VelocityMap retinal(size, {static_cast<float>(speed), 0.0f});
    const Responses& responses = bank.respond({3, 0}, speedField(retinal, size, 0));
    const double expected = 0.01 * 1.09 * sensitivity(4.0, speed);
    EXPECT_NEAR(responses.test.row(30)[32], expected * std::cos(2.0 * pi * (32 + 16) / 6.0), 1e-4 * expected)
        << speed;
  }
}

}  // namespace
}  // namespace promenade::aqm
