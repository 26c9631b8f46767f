#include "paths/write_path.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "paths/plot.h"
#include "paths/read_path.h"
#include "paths/statistics.h"
#include "tests/paths/near.h"

namespace promenade::paths {
namespace {

CameraPath spiral(int frames, double fps) {
  CameraPath path;
  path.framesPerSecond = fps;
  for (int i = 0; i < frames; ++i) {
    const double a = 0.3 * i;
    const glm::dquat q = glm::angleAxis(a, glm::normalize(glm::dvec3(0.2, 1.0, 0.1)));
    path.frames.push_back({{glm::mat3_cast(q), {std::cos(a), 0.1 * i, std::sin(a)}}, 0.9});
  }
  return path;
}

void expectSame(const CameraPath& a, const CameraPath& b, double tolerance) {
  ASSERT_EQ(a.frameCount(), b.frameCount());
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    SCOPED_TRACE(i);
    expectNear(a.frames[i].pose.eye, b.frames[i].pose.eye, tolerance);
    for (int c = 0; c < 3; ++c) {
      expectNear(a.frames[i].pose.worldFromCamera[c], b.frames[i].pose.worldFromCamera[c], tolerance);
    }
  }
}

TEST(WritePath, EveryTextFormatReadsBackAsTheSameWalk) {
  for (const int frames : {1, 2, 3, 50}) {
    for (const double fps : {25.0, 24.0, 30.0, 29.97, 7.0}) {
      SCOPED_TRACE(testing::Message() << frames << " frames at " << fps);
      const CameraPath path = spiral(frames, fps);
      const ReadOptions same{.framesPerSecond = fps};
      for (const std::string& text : {toPromenadeJson(path), toNerfstudio(path), toTum(path)}) {
        expectSame(parsePath(text, "walk", same), path, 1e-6);
      }
      EXPECT_EQ(parsePath(toPromenadeJson(path), "walk", {}).framesPerSecond, fps);
      EXPECT_NEAR(parsePath(toNerfstudio(path), "walk", {}).frames[0].verticalFieldOfView, 0.9, 1e-9);
    }
  }
}

TEST(WritePath, GltfHoldsOneKeyAFrameAndAClosingOne) {
  const auto root = nlohmann::json::parse(toGltf(spiral(3, 25.0)));
  EXPECT_EQ(root["asset"]["version"], "2.0");
  EXPECT_EQ(root["accessors"][0]["count"], 4);
  EXPECT_NEAR(root["accessors"][0]["max"][0].get<double>(), 0.12, 1e-6);
  // 4 keys of 4 + 12 + 16 bytes; base64 of 128 bytes is 172 characters.
  EXPECT_EQ(root["buffers"][0]["byteLength"], 128);
  const auto uri = root["buffers"][0]["uri"].get<std::string>();
  EXPECT_EQ(uri.size() - uri.find(',') - 1, 172u);
  // Times 0 and 0.04f = 0x3d23d70a, little-endian 00 00 00 00 0a d7 23 3d: base64 "AAAAAArXIz0...".
  EXPECT_EQ(uri.substr(uri.find(',') + 1, 10), "AAAAAArXIz");
}

TEST(WritePath, GltfRefusesAChangingFieldOfView) {
  CameraPath path = spiral(3, 25.0);
  path.frames[2].verticalFieldOfView = 1.0;
  expectRefused([&] { (void)toGltf(path); }, "cannot change the field of view");
}

TEST(Statistics, AreThoseOfACircleWalkedAtOneDegreeAFrame) {
  // Radius 2 m, 90 steps of 1 degree at 10 frames/s: chords 4 sin(0.5 deg), 10 degrees per second.
  CameraPath path;
  path.framesPerSecond = 10.0;
  const double degree = 3.14159265358979 / 180.0;
  for (int i = 0; i <= 90; ++i) {
    const glm::dquat q = glm::angleAxis(-i * degree, glm::dvec3(0, 1, 0));
    path.frames.push_back(
        {{glm::mat3_cast(q), {2 * std::cos(i * degree), 0, 2 * std::sin(i * degree)}}, degree * 60});
  }
  const Statistics s = statisticsOf(path);
  const double chord = 4.0 * std::sin(0.5 * degree);
  EXPECT_EQ(s.frames, 91);
  EXPECT_NEAR(s.durationSeconds, 9.1, 1e-12);
  EXPECT_NEAR(s.lengthMetres, 90.0 * chord, 1e-9);
  EXPECT_NEAR(s.meanSpeed, 10.0 * chord, 1e-9);
  EXPECT_NEAR(s.maxSpeed, 10.0 * chord, 1e-9);
  EXPECT_NEAR(s.meanTurnRate, 10.0, 1e-6);
  EXPECT_NEAR(s.maxTurnRate, 10.0, 1e-6);
  EXPECT_NEAR(s.minVerticalFieldOfView, 60.0, 1e-9);
}

TEST(Statistics, OfOneFrameAreZeroSpeeds) {
  const Statistics s = statisticsOf(spiral(1, 25.0));
  EXPECT_EQ(s.lengthMetres, 0.0);
  EXPECT_EQ(s.maxSpeed, 0.0);
  EXPECT_EQ(s.meanTurnRate, 0.0);
}

TEST(Plot, HasTheThreePanelsWithUnitsAndOnlyFiniteNumbers) {
  for (const int frames : {1, 2, 500}) {
    const std::string svg = plotSvg(spiral(frames, 25.0));
    for (const char* part : {"x [m]", "z [m]", "speed [m/s]", "turn rate [deg/s]", "time [s]", "</svg>"}) {
      EXPECT_THAT(svg, testing::HasSubstr(part));
    }
    EXPECT_THAT(svg, testing::Not(testing::HasSubstr("nan")));
    EXPECT_THAT(svg, testing::Not(testing::HasSubstr("inf")));
  }
}

TEST(Plot, OfALongWalkStaysSmall) {
  EXPECT_LT(plotSvg(spiral(100'000, 25.0)).size(), 200'000u);
}

}  // namespace
}  // namespace promenade::paths
