#include "ibr/blend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "src/core/errors.h"
#include "tests/ibr/analytic_scene.h"
#include "tests/ibr/maps.h"

namespace promenade::ibr::tests {
namespace {

Visibility copy(const Visibility& v) {
  return {v.camera, v.depth.clone(), v.normal.clone(), v.item.clone()};
}

Visibility wall(Size size, float depth) {
  return {cameraAt({0, 0, 0}, size, 10.0), DepthMap(size, depth), NormalMap(size, glm::vec3(0, 0, 1)),
          ItemBuffer(size, 1U)};
}

Warped constant(Size size, float radiance, float depth, float footprint,
                Validity validity = Validity::kValid) {
  return {RadianceMap(size, Rgb(radiance)),
          RadianceMap(size, Rgb(2.0f * radiance)),
          ValidityMap(size, validity),
          decltype(Warped::footprint)(size, footprint),
          WarpSettings{}.footprintLimit,
          DepthMap(size, depth),
          ItemBuffer(size, 1U)};
}

float weightOfNext(float previousFootprint, float nextFootprint, double t) {
  const Size size{1, 1};
  const Blended b = blend(constant(size, 0.0f, 4.0f, previousFootprint),
                          constant(size, 1.0f, 4.0f, nextFootprint), wall(size, 4.0f), t);
  return b.frame.diffuse(0, 0).r;
}

TEST(Blend, WeighsByTemporalDistanceWhereBothAreAsGood) {
  for (const double t : {0.0, 0.125, 0.5, 0.75, 1.0}) {
    EXPECT_FLOAT_EQ(weightOfNext(1.0f, 1.0f, t), static_cast<float>(t));
    // Finer than the target is no better than as fine as the target.
    EXPECT_FLOAT_EQ(weightOfNext(0.3f, 0.8f, t), static_cast<float>(t));
  }
}

TEST(Blend, PrefersTheFinerFootprintAndFadesOutAtTheLimit) {
  // Quality of footprint 1.25 under the limit 2.5: (0.8 - 0.4) / (1 - 0.4) = 2/3, of 1: 1. Half way the
  // weights are 1 / (1 + 2/3) = 0.6 and 0.4.
  EXPECT_FLOAT_EQ(weightOfNext(1.0f, 1.25f, 0.5), 0.4f);
  EXPECT_FLOAT_EQ(weightOfNext(1.25f, 1.0f, 0.5), 0.6f);
  EXPECT_FLOAT_EQ(weightOfNext(1.0f, 2.5f, 0.5), 0.0f);
  EXPECT_NEAR(weightOfNext(1.0f, 2.499f, 0.5), 0.0f, 1e-3f);
  // Both at the limit: neither is better.
  EXPECT_FLOAT_EQ(weightOfNext(2.5f, 2.5f, 0.25), 0.25f);
}

TEST(Blend, HasWeightsThatAreContinuousInTime) {
  // Footprints that change along the segment as in a dolly from 5 m to 4 m, the next keyframe at the end of
  // it.
  float before = 0.0f;
  for (int i = 0; i <= 1000; ++i) {
    const double t = i / 1000.0;
    const double z = 5.0 - t;
    const float w = weightOfNext(static_cast<float>(25.0 / (z * z)), static_cast<float>(16.0 / (z * z)), t);
    EXPECT_GE(w, before);
    EXPECT_LT(w - before, 0.005f);
    before = w;
  }
  EXPECT_EQ(before, 1.0f);
}

TEST(Blend, IsTheKeyframeBitForBitAtItsEnds) {
  AnalyticScene scene;
  scene.setBackground(waves(0.5))
      .add(1, rectangle({-3, -1, -4}, {6, 0, 0}, {0, 3, 0}), stripes(0.1))
      .add(2, sphere({-0.4, 0, -3}, 0.6), waves(0.6));
  for (const Size size : {Size{1, 1}, Size{3, 2}, Size{41, 31}}) {
    const Camera first = cameraAt({0, 0, 0}, size, 0.8 * size.height);
    const Camera last = turnedCamera({0.3, 0.1, -0.2}, 0.05, 0, 0, size, 0.8 * size.height);
    const Frame a = scene.render(first);
    const Frame b = scene.render(last);
    const Blended atFirst =
        blend(gatherWarp(a, a.visibility, {}), gatherWarp(b, a.visibility, {}), copy(a.visibility), 0.0);
    EXPECT_TRUE(sameBits(atFirst.frame.diffuse, a.diffuse));
    EXPECT_TRUE(sameBits(atFirst.frame.viewDependent, a.viewDependent));
    const Blended atLast =
        blend(gatherWarp(a, b.visibility, {}), gatherWarp(b, b.visibility, {}), copy(b.visibility), 1.0);
    EXPECT_TRUE(sameBits(atLast.frame.diffuse, b.diffuse));
    EXPECT_TRUE(sameBits(atLast.frame.viewDependent, b.viewDependent));
    for (const auto hole : atLast.holes.pixels()) EXPECT_EQ(hole, 0);
    for (const auto source : atFirst.frame.source.pixels())
      EXPECT_EQ(source, SampleSource::kWarpedFromPrevious);
    for (const auto source : atLast.frame.source.pixels()) EXPECT_EQ(source, SampleSource::kWarpedFromNext);
  }
}

TEST(Blend, TakesTheOnlyValidSourceAndMarksHoles) {
  const Size size{2, 1};
  Warped previous = constant(size, 0.2f, 4.0f, 1.0f);
  Warped next = constant(size, 0.6f, 4.0f, 1.0f);
  previous.validity(0, 0) = Validity::kOccluded;
  previous.validity(1, 0) = Validity::kOccluded;
  next.validity(1, 0) = Validity::kOutside;
  const Blended b = blend(previous, next, wall(size, 4.0f), 0.25);
  EXPECT_EQ(b.frame.diffuse(0, 0), Rgb(0.6f));
  EXPECT_EQ(b.frame.viewDependent(0, 0), Rgb(1.2f));
  EXPECT_EQ(b.frame.source(0, 0), SampleSource::kWarpedFromNext);
  EXPECT_EQ(b.holes(0, 0), 0);
  EXPECT_EQ(b.frame.diffuse(1, 0), Rgb(0.0f));
  EXPECT_NE(b.holes(1, 0), 0);
  // A hole is not a source, until it is traced.
  EXPECT_EQ(b.frame.source(1, 0), SampleSource::kUnknown);
  // The mirror image in time.
  const Blended mirrored = blend(next, previous, wall(size, 4.0f), 0.75);
  EXPECT_EQ(mirrored.frame.source(0, 0), SampleSource::kWarpedFromPrevious);
  EXPECT_TRUE(sameBits(mirrored.frame.diffuse, b.frame.diffuse));
  EXPECT_TRUE(sameBits(mirrored.holes, b.holes));
}

TEST(Blend, TakesTheNearerSurfaceWhereTheDepthsDisagree) {
  const Size size{1, 1};
  // Half a sample at 4 m and 10 pixels of focal length is 0.2 m.
  const auto radiance = [&](float before, float after) {
    return blend(constant(size, 0.0f, before, 1.0f), constant(size, 1.0f, after, 1.0f), wall(size, 4.0f), 0.5)
        .frame.diffuse(0, 0)
        .r;
  };
  EXPECT_FLOAT_EQ(radiance(4.0f, 4.1f), 0.5f);
  EXPECT_EQ(radiance(4.0f, 4.3f), 0.0f);
  EXPECT_EQ(radiance(4.3f, 4.0f), 1.0f);
  EXPECT_EQ(radiance(kInfinitelyFar, 4.0f), 1.0f);
  EXPECT_EQ(radiance(4.0f, kInfinitelyFar), 0.0f);
  EXPECT_FLOAT_EQ(radiance(kInfinitelyFar, kInfinitelyFar), 0.5f);
  // Except at the ends, where the blend is the keyframe.
  const Blended first =
      blend(constant(size, 0.0f, 4.3f, 1.0f), constant(size, 1.0f, 4.0f, 1.0f), wall(size, 4.0f), 0.0);
  EXPECT_EQ(first.frame.diffuse(0, 0).r, 0.0f);
}

TEST(Blend, IsTheSameForBothDirectionsOfTime) {
  AnalyticScene scene;
  scene.add(1, rectangle({-3, -3, -4}, {6, 0, 0}, {0, 6, 0}), waves(0.4))
      .add(2, sphere({0, 0, -2}, 0.3), waves(0.2));
  const Size size{45, 33};
  const Frame a = scene.render(cameraAt({0, 0, 0}, size, 30.0));
  const Frame b = scene.render(cameraAt({0.4, 0, -0.3}, size, 30.0));
  const Visibility middle = scene.visibility(cameraAt({0.1, 0, -0.1}, size, 30.0));
  const Blended forth = blend(gatherWarp(a, middle, {}), gatherWarp(b, middle, {}), copy(middle), 0.25);
  const Blended back = blend(gatherWarp(b, middle, {}), gatherWarp(a, middle, {}), copy(middle), 0.75);
  EXPECT_TRUE(sameBits(forth.holes, back.holes));
  for (std::size_t i = 0; i < size.area(); ++i) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(forth.frame.diffuse.pixels()[i][c], back.frame.diffuse.pixels()[i][c], 1e-6f);
    }
  }
}

TEST(Blend, LeavesFewHolesBetweenTwoKeyframesAndComesCloseToTheTruth) {
  AnalyticScene scene;
  scene.add(1, rectangle({-9, -9, -4}, {18, 0, 0}, {0, 18, 0}), waves(0.5))
      .add(2, rectangle({-0.3, -9, -2}, {0.6, 0, 0}, {0, 18, 0}), waves(0.4));
  const Size size{120, 30};
  const Frame a = scene.render(cameraAt({0, 0, 0}, size, 100.0));
  const Frame b = scene.render(cameraAt({0.2, 0, 0}, size, 100.0));
  const Frame truth = scene.render(cameraAt({0.1, 0, 0}, size, 100.0));
  const Warped previous = gatherWarp(a, truth.visibility, {});
  const Warped next = gatherWarp(b, truth.visibility, {});
  const Blended middle = blend(previous, next, copy(truth.visibility), 0.5);
  // What one source lost behind the column the other saw, and the same at the borders of the image.
  int holes = 0;
  Mask counts(size);
  for (std::size_t i = 0; i < size.area(); ++i) {
    holes += middle.holes.pixels()[i] != 0 ? 1 : 0;
    counts.pixels()[i] = middle.holes.pixels()[i] == 0 ? 1 : 0;
  }
  EXPECT_EQ(holes, 0);
  EXPECT_GT(psnr(middle.frame.diffuse, truth.diffuse, counts), 55.0);
}

/// Radiance at `time` of keyframes with 0 at times 0 and 4 and another source with 1 at time 2.
float amongThree(double time, float footprintOfTheOther, Validity validityOfTheOther = Validity::kValid) {
  const Size size{1, 1};
  const Warped first = constant(size, 0.0f, 4.0f, 1.0f);
  const Warped other = constant(size, 1.0f, 4.0f, footprintOfTheOther, validityOfTheOther);
  const Warped last = constant(size, 0.0f, 4.0f, 1.0f);
  const std::array<BlendSource, 3> sources{{{&first, 0.0}, {&other, 2.0}, {&last, 4.0}}};
  return blend(sources, wall(size, 4.0f), time).frame.diffuse(0, 0).r;
}

TEST(Blend, GivesAHoleWhatSourcesSampledTooCoarselyForThoseWhoCannotTraceIt) {
  const Size size{1, 1};
  const auto sourceWith = [&](float radiance, float footprint, Validity validity) {
    return constant(size, radiance, 4.0f, footprint, validity);
  };
  // 1 / (4 * 0.25) and 1 / (8 * 0.75): shares of 6/7 and 1/7.
  const Warped previous = sourceWith(0.7f, 4.0f, Validity::kUndersampled);
  const Blended both =
      blend(previous, sourceWith(1.4f, 8.0f, Validity::kUndersampled), wall(size, 4.0f), 0.25);
  EXPECT_NE(both.holes(0, 0), 0);
  EXPECT_FLOAT_EQ(both.frame.diffuse(0, 0).r, 0.8f);
  EXPECT_FLOAT_EQ(both.frame.viewDependent(0, 0).r, 1.6f);
  EXPECT_EQ(both.frame.source(0, 0), SampleSource::kBlended);
  const Blended one = blend(previous, sourceWith(1.4f, 8.0f, Validity::kOccluded), wall(size, 4.0f), 0.25);
  EXPECT_NE(one.holes(0, 0), 0);
  EXPECT_EQ(one.frame.diffuse(0, 0), Rgb(0.7f));
  EXPECT_EQ(one.frame.source(0, 0), SampleSource::kWarpedFromPrevious);
  // Never where a source is fine enough.
  const Blended fine = blend(previous, sourceWith(1.4f, 1.0f, Validity::kValid), wall(size, 4.0f), 0.25);
  EXPECT_EQ(fine.holes(0, 0), 0);
  EXPECT_EQ(fine.frame.diffuse(0, 0), Rgb(1.4f));
}

TEST(Blend, OfManySourcesWeighsByTheInverseDistanceInTime) {
  // 1/1, 1/1, 1/3.
  EXPECT_FLOAT_EQ(amongThree(1.0, 1.0f), 3.0f / 7.0f);
  EXPECT_EQ(amongThree(0.0, 1.0f), 0.0f);
  EXPECT_EQ(amongThree(2.0, 1.0f), 1.0f);
  EXPECT_EQ(amongThree(4.0, 1.0f), 0.0f);
}

TEST(Blend, OfManySourcesHasWeightsThatAreContinuousInTime) {
  // 1 / (1 + |t - 2| (1/t + 1/(4 - t))): at t = 2 the slope is 1, nowhere more.
  float before = amongThree(0.0, 1.0f);
  for (int i = 1; i <= 1000; ++i) {
    const float now = amongThree(i * 0.004, 1.0f);
    EXPECT_LT(std::abs(now - before), 0.005f) << i;
    before = now;
  }
}

TEST(Blend, OfManySourcesLosesOneWithoutAJump) {
  // As its footprint nears the limit of 2.5 it fades to what is there without it.
  EXPECT_NEAR(amongThree(1.0, 2.4999f), amongThree(1.0, 2.5001f, Validity::kUndersampled), 1e-3f);
  EXPECT_EQ(amongThree(1.0, 2.5001f, Validity::kUndersampled), 0.0f);
}

TEST(Blend, OfManySourcesSaysWhetherTheyWereEarlierOrLater) {
  const Size size{1, 1};
  const auto sourceWith = [&](Validity first, Validity other, Validity last) {
    const Warped a = constant(size, 0.1f, 4.0f, 1.0f, first);
    const Warped b = constant(size, 0.1f, 4.0f, 1.0f, other);
    const Warped c = constant(size, 0.1f, 4.0f, 1.0f, last);
    const std::array<BlendSource, 3> sources{{{&a, 0.0}, {&b, 1.0}, {&c, 2.0}}};
    return blend(sources, wall(size, 4.0f), 1.5).frame.source(0, 0);
  };
  constexpr Validity kNo = Validity::kOccluded;
  constexpr Validity kYes = Validity::kValid;
  EXPECT_EQ(sourceWith(kNo, kYes, kNo), SampleSource::kWarpedFromPrevious);
  EXPECT_EQ(sourceWith(kYes, kYes, kNo), SampleSource::kWarpedFromPrevious);
  EXPECT_EQ(sourceWith(kNo, kNo, kYes), SampleSource::kWarpedFromNext);
  EXPECT_EQ(sourceWith(kNo, kYes, kYes), SampleSource::kBlended);
}

TEST(Blend, OfManySourcesThatAgreeIsTheirValueToTheBit) {
  const Size size{1, 1};
  const Warped warped = constant(size, 0.3f, 4.0f, 1.7f);
  const std::array<BlendSource, 4> sources{{{&warped, 0.0}, {&warped, 1.0}, {&warped, 4.0}, {&warped, 5.0}}};
  EXPECT_EQ(blend(sources, wall(size, 4.0f), 1.7).frame.diffuse(0, 0), Rgb(0.3f));
}

/// Of a wall 10 m ahead at x = 0, which the source sees under a cosine of e^-change: tan^2 = 1 / cos^2 - 1.
Warped slanted(double change, Validity validity = Validity::kValid) {
  Warped source = constant({1, 1}, 1.0f, 10.0f, 1.0f, validity);
  source.eye.x = 10.0 * std::sqrt(std::exp(2.0 * change) - 1.0);
  return source;
}

TEST(Blend, SaysHowMuchLessSlantedOneSideSawASurface) {
  const Warped hidden = slanted(2.0, Validity::kOccluded);
  EXPECT_NEAR(blend(hidden, slanted(0.3), wall({1, 1}, 10.0f), 0.5).slantChange(0, 0), 0.3f, 1e-5f);
  EXPECT_NEAR(blend(slanted(0.3), hidden, wall({1, 1}, 10.0f), 0.5).slantChange(0, 0), 0.3f, 1e-5f);
  // The mean of 0.05 and 0.3 at distances 1 and 2: (0.05 + 0.15) / 1.5.
  const Warped near = slanted(0.05);
  const Warped far = slanted(0.3);
  const BlendSource sources[] = {{&hidden, 0.0}, {&near, 3.0}, {&far, 4.0}};
  EXPECT_NEAR(blend(sources, wall({1, 1}, 10.0f), 2.0).slantChange(0, 0), 0.2f / 1.5f, 1e-5f);
}

TEST(Blend, SaysHowMuchMoreSlantedOneSideSawASurface) {
  // cos = 0.8 here, and 1 for a source that stands where the normal points, as far away.
  Visibility target = wall({1, 1}, 10.0f);
  target.normal(0, 0) = glm::vec3(0.6f, 0.0f, 0.8f);
  Warped source = slanted(0.0);
  source.eye = {6.0, 0.0, 8.0 - 10.0};
  EXPECT_NEAR(blend(slanted(2.0, Validity::kOccluded), source, std::move(target), 0.5).slantChange(0, 0),
              std::log(1.0 / 0.8), 1e-5);
}

TEST(Blend, SaysHowMuchTheLineOfSightOfOneSideIsTurned) {
  // A wall 10 m ahead, seen from aside by 10 m and by a millimetre.
  const Warped hidden = slanted(2.0, Validity::kOccluded);
  const auto turnFrom = [&](double aside) {
    Warped source = slanted(0.0);
    source.eye.x = aside;
    return blend(hidden, source, wall({1, 1}, 10.0f), 0.5).turn(0, 0);
  };
  EXPECT_NEAR(turnFrom(10.0), std::atan(1.0), 1e-6);
  EXPECT_NEAR(turnFrom(0.001), 1e-4, 1e-8);
  EXPECT_EQ(turnFrom(0.0), 0.0f);
  EXPECT_EQ(blend(slanted(0.3), slanted(0.3), wall({1, 1}, 10.0f), 0.5).turn(0, 0), 0.0f);
}

TEST(Blend, SaysNothingOfSlantWhereBothSidesCountOrNothingIsSeen) {
  EXPECT_EQ(blend(slanted(0.3), slanted(0.3), wall({1, 1}, 10.0f), 0.5).slantChange(0, 0), 0.0f);
  const Warped hidden = slanted(0.3, Validity::kOccluded);
  EXPECT_EQ(blend(hidden, hidden, wall({1, 1}, 10.0f), 0.5).slantChange(0, 0), 0.0f);
  Warped sky = slanted(0.3);
  constexpr float kFar = std::numeric_limits<float>::infinity();
  sky.depth(0, 0) = kFar;
  EXPECT_EQ(blend(hidden, sky, wall({1, 1}, kFar), 0.5).slantChange(0, 0), 0.0f);
}

TEST(Blend, RejectsWhatDoesNotFit) {
  const Size size{4, 3};
  const Warped good = constant(size, 0.5f, 4.0f, 1.0f);
  EXPECT_THROW((void)blend(good, constant({4, 2}, 0.5f, 4.0f, 1.0f), wall(size, 4.0f), 0.5), InputError);
  EXPECT_THROW((void)blend(good, good, wall({5, 3}, 4.0f), 0.5), InputError);
  EXPECT_THROW((void)blend(good, good, wall(size, 4.0f), -0.1), InputError);
  EXPECT_THROW((void)blend(good, good, wall(size, 4.0f), std::nan("")), InputError);
  EXPECT_THROW((void)blend({}, wall(size, 4.0f), 0.0), InputError);
  const std::array<BlendSource, 2> backwards{{{&good, 1.0}, {&good, 0.0}}};
  EXPECT_THROW((void)blend(backwards, wall(size, 4.0f), 0.5), InputError);
}

TEST(Blend, OfSourcesAskedSampleBySampleIsThatOfTheirMaps) {
  const AnalyticScene scene = AnalyticScene()
                                  .setBackground(waves(0.5))
                                  .add(1, rectangle({-3, -1, -4}, {6, 0, 0}, {0, 3, 0}), waves(0.8))
                                  .add(2, sphere({-0.5, 0, -3}, 0.6), waves(0.6));
  const Size size{33, 21};
  const Frame first = scene.render(cameraAt({0, 0, 0}, size, 25.0));
  Frame other = scene.render(cameraAt({0.2, 0, 0}, size, 25.0));
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; x += 3) other.source(x, y) = SampleSource::kBlended;
  }
  const Frame last = scene.render(cameraAt({0.4, 0, 0}, size, 25.0));
  const auto target = [&] { return scene.visibility(cameraAt({0.1, 0, 0}, size, 25.0)); };
  const Visibility seen = target();
  Mask wanted(size, 1);
  for (int y = 0; y < size.height; ++y) wanted(20, y) = 0;
  const Warped a = gatherWarp(first, seen, {});
  const Warped b = gatherWarp(other, seen, wanted, {});
  const Warped c = gatherWarp(last, seen, {});
  const SampleGather gather(other, seen, wanted, {});
  const std::array<BlendSource, 3> maps{{{&a, 0.0}, {&b, 2.0}, {&c, 4.0}}};
  const std::array<BlendSource, 3> samples{{{&a, 0.0}, {&gather, 2.0}, {&c, 4.0}}};
  const Blended expected = blend(maps, target(), 1.0);
  const Blended found = blend(samples, target(), 1.0);
  EXPECT_TRUE(sameBits(found.frame.diffuse, expected.frame.diffuse));
  EXPECT_TRUE(sameBits(found.frame.viewDependent, expected.frame.viewDependent));
  EXPECT_TRUE(sameBits(found.frame.source, expected.frame.source));
  EXPECT_TRUE(sameBits(found.holes, expected.holes));
  // The other one has a say.
  const std::array<BlendSource, 2> without{{{&a, 0.0}, {&c, 4.0}}};
  EXPECT_FALSE(sameBits(found.frame.diffuse, blend(without, target(), 1.0).frame.diffuse));
}

}  // namespace
}  // namespace promenade::ibr::tests
