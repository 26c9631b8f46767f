// The fast execution against the plain one on what it is for: keyframes of real walks, ray traced with the
// noise that few paths leave, warped to the frame between them.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "examples/hall/hall.h"
#include "src/scene/load.h"
#include "tests/aqm/fast_against_plain.h"
#include "tests/aqm/frame_pairs.h"
#include "tests/render/scenes.h"
#include "tests/shared_data.h"

namespace promenade::aqm {
namespace {

namespace fs = std::filesystem;
using promenade::tests::FramePair;

/// What shortcuts may cost; docs/method.md states what they do.
void expectBounded(const FramePair& pair, const std::string& what) {
  for (const double ppd : {32.0, 60.0}) {
    for (const bool walks : {true, false}) {
      SCOPED_TRACE(what + ", " + std::to_string(ppd) + " pixels a degree" +
                   (walks ? ", walking" : ", still"));
      const VelocityMap velocity = walks ? pair.velocity.clone() : VelocityMap();
      const auto found = [&](const Settings& settings) {
        return tests::departure(pair.test, pair.reference, velocity, settings);
      };
      for (const Settings& settings : {aqm(ppd), revisedAqm(ppd)}) {
        const tests::Departure departure = found(settings);
        EXPECT_GT(departure.largestPooled, 0.3) << "nothing to compare";
        EXPECT_LT(departure.pooled, 0.015);
        EXPECT_LT(departure.probability, 0.01);
        EXPECT_LT(departure.sharp, 0.05);
        EXPECT_LT(departure.percent, 0.2);
      }
      // Nothing is pooled: what is largest is the departure of a single pixel.
      const tests::Departure sharp = found(aqm2000(ppd));
      EXPECT_LT(sharp.sharp, 0.1);
      EXPECT_LT(sharp.percent, 0.2);
    }
  }
  // Executed plainly whatever is asked for.
  const tests::Departure none = tests::departure(pair.test, pair.reference, {}, vdp(32.0, 0.5));
  EXPECT_GT(none.largestPooled, 0.3) << what;
  EXPECT_EQ(none.pooled, 0.0) << what;
  EXPECT_EQ(none.sharp, 0.0) << what;
  EXPECT_EQ(none.probability, 0.0) << what;
}

/// Goes away with the test.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("promenade-warped-hall-" + std::to_string(getpid()))) {}
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// A slow start down the nave, and a turn among polished sculptures.
TEST(WarpedFrames, OfTheHallAreJudgedTheSameFastAndPlainly) {
  const Folder folder;
  static_cast<void>(hall::writeHall(folder.path()));
  const Scene scene = loadScene(folder.path() / "hall.gltf");
  for (const int first : {8, 96}) {
    expectBounded(promenade::tests::warpedPair(scene, promenade::tests::walkOf(scene), first, first + 16, {}),
                  "from frame " + std::to_string(first));
  }
}

/// A camera that goes sideways past spheres, a metal one among them, and a pane, under a bright sky.
TEST(WarpedFrames, OfSpheresAreJudgedTheSameFastAndPlainly) {
  Scene scene;
  scene.materials.push_back(promenade::tests::diffuseMaterial({0.7f, 0.6f, 0.5f}));
  scene.materials.push_back(promenade::tests::diffuseMaterial({0.1f, 0.2f, 0.4f}));
  Material metal;
  metal.roughness = 0.1f;
  scene.materials.push_back(metal);
  Material pane = promenade::tests::diffuseMaterial(Rgb(0.9f));
  pane.alphaMode = AlphaMode::kBlend;
  pane.baseColor.a = 0.5f;
  scene.materials.push_back(pane);
  promenade::tests::place(scene, promenade::tests::quad({-8, 0, 5}, {16, 0, 0}, {0, 0, -15}, 0));
  for (int i = -3; i <= 3; ++i) {
    const auto x = static_cast<float>(i);
    promenade::tests::place(
        scene, promenade::tests::sphere({1.3f * x, 0.6f, -0.7f * x}, 0.6f, 24, 12, i % 2 == 0 ? 1 : 2));
  }
  promenade::tests::place(scene, promenade::tests::quad({-0.5f, 0.1f, 2}, {1, 0, 0}, {0, 1, 0}, 3));
  scene.environment = promenade::tests::uniformSky(Rgb(1.0f));
  for (const double step : {0.01, 0.06}) {
    paths::CameraPath walk;
    for (int frame = 0; frame <= 10; ++frame) {
      const glm::dvec3 eye(step * frame, 1.5, 6.0);
      const Camera camera = promenade::tests::lookingAt(eye, eye + glm::dvec3(0.0, -0.15, -1.0), {1, 1});
      walk.frames.push_back({camera.pose(), 0.7});
    }
    expectBounded(promenade::tests::warpedPair(scene, walk, 1, 9, {}), std::to_string(step) + " m a frame");
  }
}

FramePair sharedPair(const std::string& file, int first, int last) {
  const Scene scene = ensureLight(loadScene(promenade::tests::sharedPath(file)));
  return promenade::tests::warpedPair(scene, promenade::tests::walkOf(scene), first, last, {});
}

TEST(WarpedFrames, OfSponzaAreJudgedTheSameFastAndPlainly) {
  PROMENADE_NEEDS_SHARED("scenes/sponza-256/Sponza_walk.gltf");
  expectBounded(sharedPair("scenes/sponza-256/Sponza_walk.gltf", 40, 56), "Sponza");
}

/// A fast drive. What passes close by races at up to 450 degrees a second, where interpolation has no bounds
/// (docs/method.md, "Limit: very fast motion"): executed plainly. The same, cut to 100, is executed fast.
TEST(WarpedFrames, OfADriveAreJudgedTheSameFastAndPlainly) {
  PROMENADE_NEEDS_SHARED("scenes/city-kaykit/city_walk.gltf");
  constexpr float kMost = 100.0f;
  FramePair pair = sharedPair("scenes/city-kaykit/city_walk.gltf", 40, 48);
  const tests::Departure raced = tests::departure(pair.test, pair.reference, pair.velocity, aqm(32.0));
  EXPECT_GT(raced.largestPooled, 0.3);
  EXPECT_EQ(raced.pooled, 0.0);
  float fastest = 0.0f;
  for (glm::vec2& velocity : pair.velocity.pixels()) {
    const float speed = glm::length(velocity);
    fastest = std::max(fastest, speed);
    if (speed > kMost) velocity *= kMost / speed;
  }
  EXPECT_GT(fastest, kMost) << "a drive as fast as it was";
  expectBounded(pair, "city");
}

}  // namespace
}  // namespace promenade::aqm
