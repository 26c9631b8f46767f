// The fast execution against the plain one on a rendered frame (the hall of the README) and what happens to
// frames in walkthroughs: they are warped a fraction of a pixel wrong, filtered, noisy.

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "src/core/display.h"
#include "src/io/image_file.h"
#include "tests/aqm/fast_against_plain.h"
#include "tests/aqm/patterns.h"

namespace promenade::aqm {
namespace {

class RenderedFrame : public ::testing::Test {
 protected:
  RenderedFrame() {
    const io::ImageFile file =
        io::readImage(std::filesystem::path(PROMENADE_SOURCE_DIR) / "docs" / "images" / "hall.png");
    frame_ = displayLuminance(std::get<EncodedMap>(file.colour), DisplayModel{});
  }

  /// As when walking forward: 0 at the centre, 20 degrees per second in the corners.
  [[nodiscard]] VelocityMap forward() const {
    return tests::velocityOf(frame_.size(), [&](int x, int y) {
      const glm::dvec2 centre(0.5 * frame_.width(), 0.5 * frame_.height());
      return 17.4 * (glm::dvec2(x, y) - centre) / centre.x;
    });
  }

  /// frame_ shifted by a fraction of a pixel that grows from 0 at the left to `most` at the right.
  [[nodiscard]] LuminanceMap warped(double most) const {
    return tests::frameOf(frame_.size(), [&](int x, int y) {
      const double from = std::min(x + most * x / frame_.width(), frame_.width() - 1.0);
      const int left = static_cast<int>(from);
      const int right = std::min(left + 1, frame_.width() - 1);
      const double weight = from - left;
      return (1.0 - weight) * static_cast<double>(frame_(left, y)) +
             weight * static_cast<double>(frame_(right, y));
    });
  }

  [[nodiscard]] LuminanceMap noisy(double contrast) const {
    std::mt19937 random(11);
    return tests::frameOf(frame_.size(), [&](int x, int y) {
      const double sample = static_cast<double>(random()) / 4294967295.0 - 0.5;
      return static_cast<double>(frame_(x, y)) * (1.0 + contrast * sample);
    });
  }

  static void expectClose(const tests::Departure& found) {
    EXPECT_GT(found.largestPooled, 0.5) << "nothing to compare";
    EXPECT_LT(found.pooled, 0.01);
    EXPECT_LT(found.probability, 0.01);
    EXPECT_LT(found.sharp, 0.05);
    EXPECT_LT(found.percent, 0.2);
  }

  LuminanceMap frame_;
};

TEST_F(RenderedFrame, WarpedWrongIsJudgedTheSameFastAndPlainly) {
  for (const double pixels : {0.5, 2.0}) {
    expectClose(tests::departure(warped(pixels), frame_, {}, aqm(40.0)));
    expectClose(tests::departure(warped(pixels), frame_, forward(), aqm(40.0)));
  }
}

TEST_F(RenderedFrame, WithNoiseIsJudgedTheSameFastAndPlainly) {
  for (const double contrast : {0.1, 1.0}) {
    expectClose(tests::departure(noisy(contrast), frame_, {}, aqm(40.0)));
    expectClose(tests::departure(noisy(contrast), frame_, forward(), aqm(40.0)));
  }
}

TEST_F(RenderedFrame, IsJudgedTheSameFastAndPlainlyOnAnyDisplay) {
  for (const double ppd : {20.0, 32.0, 60.0, 120.0}) {
    expectClose(tests::departure(warped(2.0), frame_, forward(), aqm(ppd)));
    expectClose(tests::departure(warped(2.0), frame_, forward(), revisedAqm(ppd)));
    // Nothing is pooled: the largest departure is that of a single pixel.
    const tests::Departure sharp = tests::departure(warped(2.0), frame_, forward(), aqm2000(ppd));
    EXPECT_LT(sharp.sharp, 0.1);
    EXPECT_LT(sharp.percent, 0.2);
  }
}

}  // namespace
}  // namespace promenade::aqm
