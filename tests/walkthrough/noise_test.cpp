#include "src/walkthrough/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace promenade::walkthrough {
namespace {

/// A grey wall whose noise falls with the root of the paths, as that of path tracing does.
class NoisyWall final : public Renderer {
 public:
  NoisyWall(double contrastOfOnePath, int paths, std::uint64_t seed)
      : contrast_(contrastOfOnePath / std::sqrt(static_cast<double>(paths))), seed_(seed) {}

  [[nodiscard]] Visibility visibility(const Camera& camera) const override {
    return {camera, DepthMap(camera.size(), 1.0f), NormalMap(camera.size()), ItemBuffer(camera.size(), 1u)};
  }
  void retrace(Frame&, const Mask&, SampleSource, int) const override {}
  [[nodiscard]] Frame render(const Camera& camera, int frameIndex) const override {
    Frame frame{visibility(camera), RadianceMap(camera.size()), RadianceMap(camera.size()),
                SourceMap(camera.size())};
    std::mt19937 random(static_cast<unsigned>(seed_) * 7919u + static_cast<unsigned>(frameIndex));
    std::normal_distribution<double> normal(0.0, contrast_);
    for (Rgb& value : frame.diffuse.pixels()) value = Rgb(static_cast<float>(0.3 * (1.0 + normal(random))));
    return frame;
  }
  [[nodiscard]] ItemTraits traits(ItemId) const override { return {}; }
  [[nodiscard]] RayCounts rayCounts() const override { return {}; }

 private:
  double contrast_;
  std::uint64_t seed_;
};

struct Trial {
  NoiseVerdict verdict;
  std::vector<int> asked;
};

Trial pathsFor(double contrastOfOnePath) {
  paths::CameraPath path;
  path.frames.assign(5, {Pose{}, 1.0});
  Settings settings;
  settings.size = {96, 54};
  settings.supersample = 1;
  settings.frames = {0, 4};
  Trial trial;
  trial.verdict = pathsForInvisibleNoise(path, settings,
                                         [&](int paths, std::uint64_t seed) {
                                           trial.asked.push_back(paths);
                                           return std::make_unique<NoisyWall>(contrastOfOnePath, paths, seed);
                                         },
                                         {});
  return trial;
}

TEST(Noise, WithoutAnyTheFewestPathsSuffice) {
  const Trial trial = pathsFor(0.0);
  EXPECT_EQ(trial.verdict.pathsPerSample, 16);
  EXPECT_EQ(trial.verdict.worstPercent, 0.0);
  EXPECT_EQ(trial.asked, (std::vector<int>{16, 16}));  // two seeds
}

TEST(Noise, TwiceTheNoiseTakesFourTimesThePaths) {
  // What counts is contrast / sqrt(paths): twice the contrast is as visible with four times the paths.
  const NoiseVerdict once = pathsFor(0.04).verdict;
  const NoiseVerdict twice = pathsFor(0.08).verdict;
  EXPECT_GT(once.pathsPerSample, 16);
  EXPECT_LT(twice.pathsPerSample, 1024);
  EXPECT_EQ(twice.pathsPerSample, 4 * once.pathsPerSample);
  EXPECT_LE(once.worstPercent, 1.0);
}

TEST(Noise, ThatCannotBeHelpedEndsAtTheMostPathsAndSaysWhatRemains) {
  const NoiseVerdict verdict = pathsFor(1e4).verdict;
  EXPECT_EQ(verdict.pathsPerSample, 1024);
  EXPECT_GT(verdict.worstPercent, 1.0);
}

}  // namespace
}  // namespace promenade::walkthrough
