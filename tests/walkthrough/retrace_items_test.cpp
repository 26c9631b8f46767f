#include "src/walkthrough/retrace_items.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/walkthrough/analytic_renderer.h"

namespace promenade::walkthrough {
namespace {

using tests::AnalyticRenderer;
using tests::kPanel;
using tests::Panel;

constexpr Size kRetracedSize{128, 72};

/// A frame whose view-dependent layer is wrong wherever the panel is.
struct Wrong {
  Frame frame;
  Mask panel;
  std::size_t samples = 0;
};

Wrong wrongPanel(const AnalyticRenderer& renderer, Size size = kRetracedSize) {
  Wrong wrong{renderer.render(Camera(Pose{}, 1.0, size), 0), Mask(size)};
  for (std::size_t i = 0; i < size.area(); ++i) {
    wrong.frame.source.pixels()[i] = SampleSource::kBlended;
    if (wrong.frame.visibility.item.pixels()[i] != kPanel) continue;
    wrong.frame.viewDependent.pixels()[i] = Rgb(7.0f);
    wrong.panel.pixels()[i] = 1;
    ++wrong.samples;
  }
  return wrong;
}

std::size_t count(const Mask& mask) {
  return static_cast<std::size_t>(std::count(mask.pixels().begin(), mask.pixels().end(), 1));
}

float largestError(const RadianceMap& found, const RadianceMap& truth) {
  float largest = 0.0f;
  for (std::size_t i = 0; i < truth.pixels().size(); ++i) {
    largest = std::max(largest, std::abs(found.pixels()[i].r - truth.pixels()[i].r));
  }
  return largest;
}

TEST(RetraceItems, TracesOneSampleAPixelOfASmoothReflection) {
  const AnalyticRenderer renderer(Panel::kGlossy);
  const Frame truth = renderer.render(Camera(Pose{}, 1.0, kRetracedSize), 0);
  Wrong wrong = wrongPanel(renderer);
  const std::uint64_t before = renderer.shaded();
  const RetracedItems retraced = retraceItems(std::move(wrong.frame), wrong.panel, ItemSet(), 2, 0, renderer);
  EXPECT_EQ(renderer.shaded() - before, count(retraced.traced));
  // A quarter, and at the panel's four sides, where fewer than three are around, a few more.
  EXPECT_GT(count(retraced.traced), wrong.samples / 4);
  EXPECT_LT(count(retraced.traced), wrong.samples * 35 / 100);
  // The reflection changes by at most 0.5 * 1.5 / 65.9 = 0.011 from one sample to the next, by 4% of all that
  // the panel shows within two samples to either side. Inside a plane is closer to it than one step; a sample
  // at the panel's border, with nothing known beyond it, gets the nearest value, up to two steps away.
  EXPECT_LT(largestError(retraced.frame.viewDependent, truth.viewDependent), 0.023f);
  EXPECT_EQ(largestError(retraced.frame.diffuse, truth.diffuse), 0.0f);
}

TEST(RetraceItems, TracesOneSampleInTwoByTwoPixelsOfAReflectionThatHardlyChanges) {
  // As TracesOneSampleAPixelOfASmoothReflection, with eight times as many samples along each side: from one
  // to the next the reflection changes by an eighth of 0.011, by 1 % of all that is shown within four to
  // either side.
  const AnalyticRenderer renderer(Panel::kGlossy);
  const Size large{8 * kRetracedSize.width, 8 * kRetracedSize.height};
  const Frame truth = renderer.render(Camera(Pose{}, 1.0, large), 0);
  Wrong wrong = wrongPanel(renderer, large);
  const RetracedItems retraced = retraceItems(std::move(wrong.frame), wrong.panel, ItemSet(), 2, 0, renderer);
  // A sixteenth, and at the panel's four sides a few more.
  EXPECT_GT(count(retraced.traced), wrong.samples / 16);
  EXPECT_LT(count(retraced.traced), wrong.samples / 10);
  EXPECT_LT(largestError(retraced.frame.viewDependent, truth.viewDependent), 0.023f / 4.0f);
}

TEST(RetraceItems, TracesNearlyEverySampleOfASharpReflection) {
  const AnalyticRenderer renderer(Panel::kRippled);
  const Frame truth = renderer.render(Camera(Pose{}, 1.0, kRetracedSize), 0);
  Wrong wrong = wrongPanel(renderer);
  const RetracedItems retraced = retraceItems(std::move(wrong.frame), wrong.panel, ItemSet(), 2, 0, renderer);
  EXPECT_GT(count(retraced.traced), wrong.samples * 8 / 10);
  // But at the crests, where neighbours differ by less than 8% of what the panel shows, at most 1.7.
  EXPECT_LT(largestError(retraced.frame.viewDependent, truth.viewDependent), 0.5f * 0.08f * 1.7f);
}

TEST(RetraceItems, TracesEverySampleOfAMirror) {
  const AnalyticRenderer renderer(Panel::kMirrorLike);
  const Frame truth = renderer.render(Camera(Pose{}, 1.0, kRetracedSize), 0);
  Wrong wrong = wrongPanel(renderer);
  const RetracedItems retraced = retraceItems(std::move(wrong.frame), wrong.panel, ItemSet(), 2, 0, renderer);
  EXPECT_EQ(count(retraced.traced), wrong.samples);
  EXPECT_EQ(largestError(retraced.frame.viewDependent, truth.viewDependent), 0.0f);
}

TEST(RetraceItems, TracesEverySampleOfWhatLooksTheSameFromEverywhere) {
  const AnalyticRenderer renderer(Panel::kMatt);
  Wrong wrong = wrongPanel(renderer);
  const RetracedItems retraced = retraceItems(std::move(wrong.frame), wrong.panel, ItemSet(), 2, 0, renderer);
  EXPECT_EQ(count(retraced.traced), wrong.samples);
}

TEST(RetraceItems, TracesEverySampleWhereTheDiffuseLayerFailedAsWell) {
  const AnalyticRenderer renderer(Panel::kGlossy);
  Wrong wrong = wrongPanel(renderer);
  const RetracedItems retraced =
      retraceItems(std::move(wrong.frame), wrong.panel, ItemSet({kPanel}), 2, 0, renderer);
  EXPECT_EQ(count(retraced.traced), wrong.samples);
}

TEST(RetraceItems, TracesWhatTheWarpedLayerShowsBetweenTheTracedSamples) {
  const AnalyticRenderer renderer(Panel::kGlossy);
  // Inside of the panel, which spans x = 76 to 92 and y = 27 to 45, and not one of those that are traced
  // first.
  const int x = 84;
  const int y = 37;
  const auto isTraced = [&](float warped) {
    Wrong wrong = wrongPanel(renderer);
    EXPECT_EQ(wrong.panel(x, y), 1);
    wrong.frame.viewDependent(x, y) = Rgb(warped);
    const RetracedItems retraced =
        retraceItems(std::move(wrong.frame), wrong.panel, ItemSet(), 2, 0, renderer);
    return retraced.traced(x, y) != 0;
  };
  EXPECT_FALSE(isTraced(7.0f));  // as all around it: wrong, but smooth
  EXPECT_FALSE(isTraced(7.3f));  // by 4 per cent
  EXPECT_TRUE(isTraced(9.0f));   // a glint
}

TEST(RetraceItems, TracesEverySampleIfAPixelHasButOne) {
  const AnalyticRenderer renderer(Panel::kGlossy);
  Wrong wrong = wrongPanel(renderer);
  const RetracedItems retraced = retraceItems(std::move(wrong.frame), wrong.panel, ItemSet(), 1, 0, renderer);
  EXPECT_EQ(count(retraced.traced), wrong.samples);
}

TEST(RetraceItems, TracesNothingThatIsNotSelected) {
  const AnalyticRenderer renderer(Panel::kGlossy);
  Wrong wrong = wrongPanel(renderer);
  const std::uint64_t before = renderer.shaded();
  const RetracedItems retraced =
      retraceItems(std::move(wrong.frame), Mask(kRetracedSize), ItemSet(), 2, 0, renderer);
  EXPECT_EQ(renderer.shaded(), before);
  EXPECT_EQ(count(retraced.traced), 0u);
}

/// A glossy wall that fills the picture and mirrors an edge, along a row or a column of samples.
class EdgeRenderer final : public tests::RetracingRenderer {
 public:
  EdgeRenderer(bool isRow, int place) : isRow_(isRow), place_(place) {}

  [[nodiscard]] Visibility visibility(const Camera& camera) const override {
    const Size size = camera.size();
    return {camera, DepthMap(size, 6.0f), NormalMap(size, glm::vec3(0.0f, 0.0f, 1.0f)),
            ItemBuffer(size, kPanel)};
  }
  void retrace(Frame& frame, const Mask& mask, SampleSource source, int) const override {
    for (int y = 0; y < mask.height(); ++y) {
      for (int x = 0; x < mask.width(); ++x) {
        if (mask(x, y) == 0) continue;
        frame.diffuse(x, y) = Rgb(0.0f);
        frame.viewDependent(x, y) = Rgb((isRow_ ? y : x) < place_ ? 0.2f : 0.3f);
        frame.source(x, y) = source;
      }
    }
  }
  [[nodiscard]] ItemTraits traits(ItemId) const override { return {.viewDependent = true, .noise = 1e-4f}; }

 private:
  bool isRow_;
  int place_;
};

class EdgeBetweenLattices : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(RetraceItems, EdgeBetweenLattices, testing::Values(2, 3, 4));

TEST_P(EdgeBetweenLattices, IsFoundWhereverItLies) {
  const int supersample = GetParam();
  const Size size{24 * supersample, 24 * supersample};
  for (const bool isRow : {true, false}) {
    for (int place = 8 * supersample; place < 16 * supersample; ++place) {
      const EdgeRenderer renderer(isRow, place);
      const Frame truth = renderer.render(Camera(Pose{}, 1.0, size), 0);
      Frame warped = renderer.render(Camera(Pose{}, 1.0, size), 0);
      warped.viewDependent = RadianceMap(size, Rgb(0.25f));
      const RetracedItems retraced =
          retraceItems(std::move(warped), Mask(size, 1), ItemSet(), supersample, 0, renderer);
      EXPECT_LT(largestError(retraced.frame.viewDependent, truth.viewDependent), 1e-6f)
          << (isRow ? "row " : "column ") << place;
      EXPECT_LT(count(retraced.traced), size.area() * 35 / 100);
    }
  }
}

}  // namespace
}  // namespace promenade::walkthrough
