#include "aqm/layout.h"

#include <gtest/gtest.h>

#include <vector>

namespace promenade::aqm {
namespace {

TEST(BandCount, PutsTheEdgeOfTheBasebandAtOneCyclePerDegreeAtMost) {
  EXPECT_EQ(bandCount(32.0), 5);  // 2^-5 * 32 = 1
  EXPECT_EQ(bandCount(33.0), 6);
  EXPECT_EQ(bandCount(40.0), 6);
  EXPECT_EQ(bandCount(60.0), 6);
  EXPECT_EQ(bandCount(120.0), 7);
  EXPECT_EQ(bandCount(0.01), 2);
}

void expectLayout(Size image, int bands, double ppd, int margin, Size padded) {
  const Layout layout = layoutOf(image, ppd);
  EXPECT_EQ(layout.bands, bands);
  EXPECT_EQ(layout.margin, margin);
  EXPECT_EQ(layout.padded.width, padded.width);
  EXPECT_EQ(layout.padded.height, padded.height);
}

TEST(Layout, HasThePublishedSizes) {
  expectLayout({640, 480}, 6, 40.0, 32, {720, 576});
  expectLayout({1920, 1080}, 6, 60.0, 32, {2000, 1152});
  expectLayout({101, 77}, 4, 16.0, 8, {120, 96});
}

TEST(Layout, LeavesAMarginOnEverySideInMultiplesThatTransformFast) {
  for (int length = 1; length < 300; ++length) {
    const Layout layout = layoutOf({length, 1}, 30.0);
    const int padded = layout.padded.width;
    EXPECT_GE(padded, length + 2 * layout.margin);
    EXPECT_EQ(padded % 8, 0);  // 2^(5-2)
    int rest = padded;
    for (const int prime : {2, 3, 5}) {
      while (rest % prime == 0) {
        rest /= prime;
      }
    }
    EXPECT_EQ(rest, 1) << padded;
  }
}

TEST(Reflected, RepeatsTheBorderPixelAndTurnsBack) {
  // .. b a | a b c | c b a a b ..
  const std::vector<int> expected{1, 0, 0, 1, 2, 2, 1, 0, 0, 1};
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(reflected(i - 2, 3), expected[static_cast<std::size_t>(i)]) << i - 2;
  }
  EXPECT_EQ(reflected(-7, 3),
            0);  // = reflected(-1, 3), one period of 6 earlier
  for (int i = -5; i < 5; ++i) {
    EXPECT_EQ(reflected(i, 1), 0);
  }
}

}  // namespace
}  // namespace promenade::aqm
