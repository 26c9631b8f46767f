// The same call gives the same pixels, whatever the threads and whatever else is traced.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "src/render/path_renderer.h"
#include "tests/render/scenes.h"

namespace promenade::render {
namespace {

using tests::lookingAt;

Scene room() {
  Scene scene;
  scene.materials.push_back(tests::diffuseMaterial({0.7f, 0.6f, 0.5f}));
  scene.materials.push_back(tests::emitter(Rgb(5.0f)));
  Material metal;
  metal.roughness = 0.3f;
  scene.materials.push_back(metal);
  Material pane = tests::diffuseMaterial(Rgb(0.9f));
  pane.alphaMode = AlphaMode::kBlend;
  pane.baseColor.a = 0.5f;
  scene.materials.push_back(pane);
  tests::place(scene, tests::quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, 0));
  tests::place(scene, tests::sphere({0, 3, 0}, 0.3f, 16, 8, 1));
  tests::place(scene, tests::sphere({-1, 1, 0}, 0.8f, 16, 8, 2));
  tests::place(scene, tests::quad({0.2f, 0.1f, 1}, {1, 0, 0}, {0, 1, 0}, 3));
  scene.environment = tests::uniformSky(Rgb(0.3f));
  return scene;
}
const Camera kCamera = lookingAt({0, 1.5, 6}, {0, 1, 0}, {45, 31}, 0.7);

PathSettings withThreads(int threads) {
  PathSettings settings;
  settings.pathsPerSample = 3;
  settings.threads = threads;
  return settings;
}

void expectSame(const Frame& a, const Frame& b) {
  for (int y = 0; y < kCamera.size().height; ++y) {
    for (int x = 0; x < kCamera.size().width; ++x) {
      ASSERT_EQ(a.diffuse(x, y), b.diffuse(x, y)) << x << ' ' << y;
      ASSERT_EQ(a.viewDependent(x, y), b.viewDependent(x, y)) << x << ' ' << y;
      ASSERT_EQ(a.visibility.depth(x, y), b.visibility.depth(x, y));
      ASSERT_EQ(a.visibility.item(x, y), b.visibility.item(x, y));
      ASSERT_EQ(a.visibility.normal(x, y), b.visibility.normal(x, y));
    }
  }
}

TEST(PathRenderer, GivesIdenticalPixelsForAnyNumberOfThreads) {
  const Scene scene = room();
  const Frame one = makePathRenderer(scene, withThreads(1))->render(kCamera, 5);
  expectSame(one, makePathRenderer(scene, withThreads(2))->render(kCamera, 5));
  expectSame(one, makePathRenderer(scene, withThreads(0))->render(kCamera, 5));
}

Frame refined(const Renderer& renderer, int first, int most) {
  Frame frame = unshaded(renderer.visibility(kCamera));
  Mask open = renderer.refine(frame, Mask(kCamera.size(), 1), {0, first}, 5).open;
  for (int paths = first; paths < most; paths *= 2)
    open = renderer.refine(frame, open, {paths, paths}, 5).open;
  return frame;
}

TEST(PathRenderer, RefinesToIdenticalPixelsForAnyNumberOfThreads) {
  const Scene scene = room();
  const Frame one = refined(*makePathRenderer(scene, withThreads(1)), 4, 16);
  expectSame(one, refined(*makePathRenderer(scene, withThreads(3)), 4, 16));
}

TEST(PathRenderer, RefinedAtOnceIsRendered) {
  const Scene scene = room();
  const auto renderer = makePathRenderer(scene, withThreads(2));  // 3 paths a sample
  expectSame(refined(*renderer, 3, 3), renderer->render(kCamera, 5));
}

TEST(PathRenderer, FurtherPathsComeNearerToTheConvergedImage) {
  const Scene scene = room();
  const auto renderer = makePathRenderer(scene, withThreads(0));
  PathSettings many = withThreads(0);
  many.pathsPerSample = 512;
  many.seed = 1;
  const Frame converged = makePathRenderer(scene, many)->render(kCamera, 5);
  const auto error = [&](const Frame& frame) {
    const RadianceMap a = combinedRadiance(frame);
    const RadianceMap b = combinedRadiance(converged);
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
      const Rgb d = glm::min(a.pixels()[i], Rgb(2.0f)) - glm::min(b.pixels()[i], Rgb(2.0f));
      sum += glm::dot(d, d);
    }
    return std::sqrt(sum);
  };
  // Sixteen times the paths: a quarter of the error if they were independent of those before, and new.
  const double few = error(refined(*renderer, 4, 4));
  const double more = error(refined(*renderer, 4, 64));
  EXPECT_LT(more, 0.4 * few);
  EXPECT_GT(more, 0.05 * few);
}

TEST(PathRenderer, SeesTheSameWithAndWithoutShading) {
  const Scene scene = room();
  const auto renderer = makePathRenderer(scene, withThreads(2));
  const Frame frame = renderer->render(kCamera, 0);
  const Visibility seen = renderer->visibility(kCamera);
  for (int y = 0; y < kCamera.size().height; ++y) {
    for (int x = 0; x < kCamera.size().width; ++x) {
      ASSERT_EQ(frame.visibility.depth(x, y), seen.depth(x, y));
      ASSERT_EQ(frame.visibility.item(x, y), seen.item(x, y));
    }
  }
}

TEST(PathRenderer, RetracesMaskedSamplesExactlyAsAFullFrameAndLeavesTheRest) {
  const Scene scene = room();
  const auto renderer = makePathRenderer(scene, withThreads(2));
  const Frame full = renderer->render(kCamera, 9);
  Frame frame;
  frame.visibility = renderer->visibility(kCamera);
  frame.diffuse = RadianceMap(kCamera.size(), Rgb(-1.0f));
  frame.viewDependent = RadianceMap(kCamera.size(), Rgb(-1.0f));
  frame.source = SourceMap(kCamera.size(), SampleSource::kBlended);
  Mask mask(kCamera.size());
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) mask(x, y) = (x * 7 + y * 13) % 5 == 0 ? 1 : 0;
  }
  renderer->retrace(frame, mask, SampleSource::kTracedHole, 9);
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      const bool selected = mask(x, y) != 0;
      EXPECT_EQ(frame.diffuse(x, y), selected ? full.diffuse(x, y) : Rgb(-1.0f));
      EXPECT_EQ(frame.viewDependent(x, y), selected ? full.viewDependent(x, y) : Rgb(-1.0f));
      EXPECT_EQ(frame.source(x, y), selected ? SampleSource::kTracedHole : SampleSource::kBlended);
    }
  }
}

TEST(PathRenderer, DifferentFramesAndSeedsGiveDifferentNoise) {
  const Scene scene = room();
  PathSettings settings = withThreads(2);
  const auto renderer = makePathRenderer(scene, settings);
  settings.seed = 1;
  const auto other = makePathRenderer(scene, settings);
  const Frame a = renderer->render(kCamera, 0);
  const Frame b = renderer->render(kCamera, 1);
  const Frame c = other->render(kCamera, 0);
  int frames = 0, seeds = 0;
  for (int x = 0; x < kCamera.size().width; ++x) {
    frames += a.diffuse(x, 25) != b.diffuse(x, 25) ? 1 : 0;
    seeds += a.diffuse(x, 25) != c.diffuse(x, 25) ? 1 : 0;
  }
  EXPECT_GT(frames, 30);
  EXPECT_GT(seeds, 30);
}

TEST(PathRenderer, CountsOnePrimaryRayASample) {
  const Scene scene = room();
  const auto renderer = makePathRenderer(scene, withThreads(2));
  static_cast<void>(renderer->visibility(kCamera));
  EXPECT_EQ(renderer->rayCounts().visibility, kCamera.size().area());
  EXPECT_EQ(renderer->rayCounts().primary, 0u);
  static_cast<void>(renderer->render(kCamera, 0));
  EXPECT_EQ(renderer->rayCounts().primary, kCamera.size().area());
  EXPECT_GT(renderer->rayCounts().scattered, kCamera.size().area());
  EXPECT_GT(renderer->rayCounts().shadow, kCamera.size().area());
}

TEST(PathRenderer, PutsADiffuseReflectionInTheDiffuseRadianceAndAMirrorInTheOther) {
  Scene scene = room();
  const Frame frame = makePathRenderer(scene, withThreads(2))->render(kCamera, 0);
  for (int y = 0; y < kCamera.size().height; ++y) {
    for (int x = 0; x < kCamera.size().width; ++x) {
      const ItemId item = frame.visibility.item(x, y);
      if (item == 1) {
        EXPECT_EQ(frame.viewDependent(x, y), Rgb(0.0f));
      }
      if (item == 3) {
        EXPECT_EQ(frame.diffuse(x, y), Rgb(0.0f));
      }
    }
  }
}

TEST(ItemTraits, NameWhatLooksDifferentFromElsewhere) {
  Scene scene = room();
  const auto renderer = makePathRenderer(scene, withThreads(1));
  EXPECT_FALSE(renderer->traits(kNoItem).viewDependent);
  EXPECT_FALSE(renderer->traits(1).viewDependent);  // Lambert
  EXPECT_FALSE(renderer->traits(2).viewDependent);  // emitter
  EXPECT_TRUE(renderer->traits(3).viewDependent);   // metal of roughness 0.3
  EXPECT_TRUE(renderer->traits(4).viewDependent);   // blended
}

TEST(ItemTraits, NameWhatIsReflectedByChance) {
  Scene scene = room();
  const auto rough = makePathRenderer(scene, withThreads(1));
  EXPECT_GT(rough->traits(3).noise, 0.0f);  // metal of roughness 0.3
  const auto metal = static_cast<std::size_t>(scene.meshes[2].material);
  scene.materials[metal].baseColorTexture = tests::uniformTexture(scene, {255, 255, 255, 255});
  EXPECT_EQ(makePathRenderer(scene, withThreads(1))->traits(3).noise,
            0.0f);  // what a texture draws is no noise
  scene.materials[metal].baseColorTexture.reset();
  scene.materials[metal].roughness = 0.08f;
  EXPECT_GT(makePathRenderer(scene, withThreads(1))->traits(3).noise, 0.0f);
  scene.materials[metal].roughness = 0.0f;
  const auto mirrored = makePathRenderer(scene, withThreads(1));
  EXPECT_EQ(mirrored->traits(3).noise, 0.0f);
  EXPECT_EQ(mirrored->traits(4).noise, 0.0f);  // blended: what is seen through it is as sharp as anything
}

}  // namespace
}  // namespace promenade::render
