// A few steps through a room with everything that is known to go wrong when warping: columns (disocclusion),
// railings thinner than a sample, a grazing floor, a poster on a wall, curved and tessellated surfaces, a
// window to the sky.

#include <gtest/gtest.h>

#include "ibr/blend.h"
#include "src/core/resolve.h"
#include "tests/ibr/analytic_scene.h"
#include "tests/ibr/artefacts.h"

namespace promenade::ibr::tests {
namespace {

AnalyticScene gallery() {
  AnalyticScene scene;
  scene.setBackground(waves(0.4))
      .add(1, rectangle({-4, -1.5, -6}, {5.5, 0, 0}, {0, 3.5, 0}), stripes(0.4))  // open to the right
      .add(2, rectangle({-4, -1.5, -6}, {9, 0, 0}, {0, 0, 9}), stripes(0.5))      // floor
      .add(3, rectangle({-4, -1.5, -6}, {0, 0, 9}, {0, 3.5, 0}), waves(0.6))      // left wall
      .add(4, rectangle({-2, -0.2, -5.999}, {1.1, 0, 0}, {0, 0.9, 0}), waves(0.3))
      .add(5, prism({-0.8, -1.5, -4}, 0.22, 3.5, 24), waves(0.5))
      .add(6, prism({0.9, -1.5, -4.5}, 0.22, 3.5, 24), waves(0.5))
      .add(7, sphere({0.2, -1.0, -3.2}, 0.5), waves(0.4))
      .add(8, box({1.2, -1.5, -3.4}, {1.9, -0.8, -2.8}), waves(0.5));
  for (int i = 0; i < 16; ++i) {
    const double x = -2.6 + 0.11 * i;
    scene.add(9, box({x, -1.5, -2.402}, {x + 0.004, -0.75, -2.398}), uniform({0.9f, 0.8f, 0.1f}));
  }
  scene.add(9, box({-2.7, -0.75, -2.42}, {-0.9, -0.72, -2.38}), uniform({0.9f, 0.8f, 0.1f}));
  return scene;
}

TEST(Walk, InbetweensComeCloseToTheTruthAndHaveFewHoles) {
  const AnalyticScene scene = gallery();
  const Size size{400, 300};
  const auto camera = [&](double t) {
    return turnedCamera({-0.1 + 0.3 * t, 0.1, 0.2 - 0.2 * t}, 0.05 - 0.08 * t, -0.05, 0, size, 320.0);
  };
  const Frame first = scene.render(camera(0.0));
  const Frame last = scene.render(camera(1.0));
  saveForTheEye(first.diffuse, "walk_first");
  for (const double t : {0.25, 0.5}) {
    Frame truth = scene.render(camera(t));
    const Warped previous = gatherWarp(first, truth.visibility, {});
    const Warped next = gatherWarp(last, truth.visibility, {});
    const Blended blended = blend(previous, next, std::move(truth.visibility), t);
    // Holes are ray traced, then the samples are filtered to pixels.
    RadianceMap finished = blended.frame.diffuse.clone();
    int holes = 0;
    for (std::size_t i = 0; i < size.area(); ++i) {
      if (blended.holes.pixels()[i] == 0) continue;
      finished.pixels()[i] = truth.diffuse.pixels()[i];
      ++holes;
    }
    const double quality = psnr(resolveRadiance(finished, 4), resolveRadiance(truth.diffuse, 4), {});
    const std::string name = "walk_" + std::to_string(static_cast<int>(100 * t));
    saveForTheEye(truth.diffuse, name + "_truth");
    saveForTheEye(paintInvalid(previous), name + "_from_first");
    saveForTheEye(paintInvalid(next), name + "_from_last");
    saveForTheEye(paintHoles(blended), name + "_blended");
    saveForTheEye(difference(paintHoles(blended), truth.diffuse, 4.0f), name + "_difference");
    RecordProperty(name + "_psnr", std::to_string(quality));
    RecordProperty(name + "_holes", holes);
    // Stripes (edges of contrast 0.9, each a sample or less from where it belongs) are what a sample warp is
    // worst at.
    EXPECT_GT(quality, 31.0);
    EXPECT_LT(holes, 0.02 * static_cast<double>(size.area()));
  }
}

}  // namespace
}  // namespace promenade::ibr::tests
