#include "paths/read_path.h"

#include <cmath>

#include "tests/paths/near.h"

namespace promenade::paths {
namespace {

CameraPath read(const std::string& text) {
  return parsePath(text, "walk", {});
}

std::string walk(const std::string& settings, const std::string& keys) {
  return "{" + settings + "\"keys\":[" + keys + "]}";
}

const std::string kFirst = R"({"time":0,"eye":[0,0,0],"target":[0,0,-9]})";
const std::string kSecond = R"({"time":8,"eye":[4,0,0],"target":[4,0,-9]})";

TEST(PromenadeJson, EightSecondsAt25FramesPerSecondAre200Frames) {
  const CameraPath path = read(walk("", kFirst + "," + kSecond));
  EXPECT_EQ(path.framesPerSecond, 25.0);
  ASSERT_EQ(path.frameCount(), 200);
  // Half-open: the last frame is at 199/25 s of 8 s, 4 m * 199/200.
  expectNear(path.frames[0].pose.eye, {0, 0, 0});
  expectNear(path.frames[100].pose.eye, {2, 0, 0});
  expectNear(path.frames[199].pose.eye, {3.98, 0, 0});
  expectNear(path.frames[50].pose.worldFromCamera[2], {0, 0, 1});
  EXPECT_NEAR(path.frames[0].verticalFieldOfView, 55.0 * kDegree, 1e-12);
}

TEST(PromenadeJson, TheFrameRateAskedForWinsOverTheFilesOwn) {
  const std::string text = walk("\"fps\":10,", kFirst + "," + kSecond);
  EXPECT_EQ(read(text).frameCount(), 80);
  EXPECT_EQ(parsePath(text, "walk", {.framesPerSecond = 50.0}).frameCount(), 400);
}

TEST(PromenadeJson, AWalkShorterThanAFrameIsOneFrame) {
  EXPECT_EQ(read(walk("", kFirst + R"(,{"time":0.01,"eye":[4,0,0],"target":[4,0,-9]})")).frameCount(), 1);
}

TEST(PromenadeJson, ALinearTimedWalkPassesItsKeysAtTheirTimes) {
  const CameraPath path = read(walk(R"("fps":1,"interpolation":"linear",)",
                                    R"({"time":1,"eye":[0,0,0],"rotation":[0,0,0,1]},
                                       {"time":3,"eye":[1,0,0],"rotation":[0,0,0,1],"fov":40},
                                       {"time":5,"eye":[9,0,0],"rotation":[0,0,0,2]})"));
  ASSERT_EQ(path.frameCount(), 4);  // at 1, 2, 3, 4 s
  const double xs[] = {0.0, 0.5, 1.0, 5.0};
  const double fov[] = {55.0, 47.5, 40.0, 40.0};  // linear between keys; the last given holds
  for (std::size_t i = 0; i < 4; ++i) {
    expectNear(path.frames[i].pose.eye, {xs[i], 0, 0});
    EXPECT_NEAR(path.frames[i].verticalFieldOfView, fov[i] * kDegree, 1e-12);
  }
}

TEST(PromenadeJson, ConstantSpeedIgnoresTheTimesBetween) {
  // A right angle of 1 m and 3 m walked in 4 s: 1 m/s, so the corner is passed at 1 s, not at 3 s.
  const CameraPath path = read(walk(R"("fps":1,"interpolation":"linear","speed":"constant",)",
                                    R"({"time":0,"eye":[0,0,0],"rotation":[0,0,0,1],"fov":30},
                                       {"time":3,"eye":[1,0,0],"rotation":[0,0,0,1],"fov":60},
                                       {"time":4,"eye":[1,0,3],"rotation":[0,0,0,1],"fov":90})"));
  ASSERT_EQ(path.frameCount(), 4);
  expectNear(path.frames[1].pose.eye, {1, 0, 0});
  expectNear(path.frames[3].pose.eye, {1, 0, 2});
  EXPECT_NEAR(path.frames[1].verticalFieldOfView, 60.0 * kDegree, 1e-9);
  EXPECT_NEAR(path.frames[3].verticalFieldOfView, 80.0 * kDegree, 1e-9);
}

TEST(PromenadeJson, ConstantSpeedOnACurveIsConstant) {
  const CameraPath path = read(walk(R"("fps":50,"speed":"constant",)",
                                    R"({"time":0,"eye":[0,0,0],"rotation":[0,0,0,1]},
                                       {"time":1,"eye":[5,0,1],"rotation":[0,0,0,1]},
                                       {"time":9,"eye":[5,0,9],"rotation":[0,0,0,1]},
                                       {"time":10,"eye":[0,3,9],"rotation":[0,0,0,1]})"));
  const double first = glm::distance(path.frames[0].pose.eye, path.frames[1].pose.eye);
  for (std::size_t i = 1; i < path.frames.size(); ++i) {
    EXPECT_NEAR(glm::distance(path.frames[i - 1].pose.eye, path.frames[i].pose.eye) / first, 1.0, 1e-3) << i;
  }
}

TEST(PromenadeJson, OneTargetStaysInTheMiddleOfTheView) {
  const CameraPath path = read(walk("", R"({"time":0,"eye":[5,1,0],"target":[0,1,0]},
                                           {"time":1,"eye":[0,2,5],"target":[0,1,0]},
                                           {"time":3,"eye":[-5,1,0],"target":[0,1,0]})"));
  for (const PathFrame& frame : path.frames) {
    const glm::dvec3 view = glm::normalize(glm::dvec3(0, 1, 0) - frame.pose.eye);
    expectNear(-frame.pose.worldFromCamera[2], view);
    expectRotation(frame.pose.worldFromCamera);
  }
}

TEST(PromenadeJson, UpMayBeAnotherAxis) {
  const CameraPath path = read(walk(R"("up":[0,0,2],)", R"({"time":0,"eye":[0,0,0],"target":[0,5,0]},
                                                           {"time":1,"eye":[1,0,0],"target":[1,5,0]})"));
  expectNear(path.frames[0].pose.worldFromCamera[0], {1, 0, 0});
  expectNear(path.frames[0].pose.worldFromCamera[1], {0, 0, 1});
}

TEST(PromenadeJson, TurnsOnTheSpot) {
  const double s = std::sqrt(0.5);
  const CameraPath path = read(walk(R"("fps":2,)", R"({"time":0,"eye":[1,1,1],"rotation":[0,0,0,1]},
      {"time":1,"eye":[1,1,1],"rotation":[0,)" + std::to_string(s) +
                                                       ",0," + std::to_string(s) + "]}"));
  ASSERT_EQ(path.frameCount(), 2);
  // Half of 90 degrees to the left about +y: backward axis (sin 45, 0, cos 45).
  expectNear(path.frames[1].pose.worldFromCamera[2], {s, 0, s}, 1e-6);
}

TEST(PromenadeJson, NamesEveryDegenerateInput) {
  const auto refused = [](const std::string& text, const std::string& part) {
    SCOPED_TRACE(text);
    expectRefused([&] { (void)read(text); }, part);
  };
  refused(walk("", ""), "walk: expected at least 2 keys, found 0");
  refused(walk("", kFirst), "walk: expected at least 2 keys, found 1");
  refused(walk("", kFirst + "," + kFirst),
          "walk: keys[1]: expected a time after that of the key before, 0 s, found 0 s");
  refused(walk("", kSecond + "," + kFirst), "keys[1]: expected a time after");
  refused(walk("", R"({"time":0,"eye":[0,0,0],"rotation":[0,0,0,0]},)" + kSecond),
          "keys[0].rotation: expected a rotation");
  refused(walk("", kFirst + R"(,{"time":1,"eye":[1,2,3],"target":[1,2,3]})"),
          "keys[1]: expected an eye apart from");
  refused(walk("", kFirst + R"(,{"time":1,"eye":[1,2,3],"target":[1,5,3]})"),
          "keys[1]: expected a view that is not along 'up'");
  refused(walk("", kFirst + R"(,{"time":1,"eye":[1e400,2,3],"target":[1,5,3]})"), "walk: expected JSON");
  refused(walk("", kFirst + R"(,{"time":1,"eye":[null,2,3],"target":[1,5,3]})"),
          "keys[1].eye[0]: expected a number");
  refused(walk("", kFirst + R"(,{"time":1,"eye":[1e30,2,3],"target":[1,5,3]})"),
          "keys[1].eye[0]: expected a number of at most");
  refused(walk("", kFirst + R"(,{"time":NaN,"eye":[0,2,3],"target":[1,5,3]})"), "walk: expected JSON");
  refused(walk("", kFirst + R"(,{"time":1,"eye":[0,2],"target":[1,5,3]})"),
          "keys[1].eye: expected 3 numbers, found an array of 2");
  refused(walk("", kFirst + R"(,{"time":1,"eye":[0,2,3]})"),
          "keys[1]: expected 'target' or 'rotation', found neither");
  refused(walk("", kFirst + R"(,{"time":1,"eye":[0,2,3],"traget":[1,5,3]})"),
          "keys[1]: unknown key \"traget\"; did you mean 'target'?");
  refused(walk("\"fpss\":3,", kFirst + "," + kSecond), "unknown key \"fpss\"; did you mean 'fps'?");
  refused(walk("\"fps\":0,", kFirst + "," + kSecond), "fps: expected a frame rate above 0");
  refused(walk("\"speed\":\"slow\",", kFirst + "," + kSecond),
          "speed: expected one of 'timed', 'constant', found \"slow\"");
  refused(walk("\"up\":[0,0,0],", kFirst + "," + kSecond), "up: expected a direction of a length above 0");
  refused(walk("", kFirst + R"(,{"time":1,"eye":[0,2,3],"target":[1,5,3],"fov":0})"),
          "keys[1].fov: expected a vertical field of view");
  refused(walk("", kFirst + R"(,{"time":1e8,"eye":[1,2,3],"target":[1,2,0]})"),
          "expected at most 1000000 frames, found 2.5e+09");
  refused(walk("\"speed\":\"constant\",", kFirst + R"(,{"time":1,"eye":[0,0,0],"target":[1,0,0]})"),
          "because speed is 'constant'");
  refused("[1]", "expected an object, found an array of 1");
  refused("", "found an empty file");
  refused("{\"keys\":[}", "walk: expected JSON, found a syntax error at line 1, column 10");
}

TEST(PromenadeJson, NamesAnEyeThatMeetsItsTargetOnTheWay) {
  // The eye goes from x = -1 to 1, the target from 1 to -1: they meet in the middle, at 1 s.
  expectRefused(
      [] {
        (void)read(walk("", R"({"time":0,"eye":[-1,0,0],"target":[1,0,0]},
                                            {"time":2,"eye":[1,0,0],"target":[-1,0,0]})"));
      },
      "walk: at 1 s: expected an eye apart from its target");
}

TEST(Nerfstudio, ReadsRowMajorMatricesAndVerticalFieldOfView) {
  const CameraPath path = read(R"({"fps":30,"camera_type":"perspective","seconds":1,"camera_path":[
      {"camera_to_world":[0,0,2,1, 0,2,0,2, -2,0,0,3, 0,0,0,1],"fov":50,"aspect":1.5},
      {"camera_to_world":[1,0,0,4, 0,1,0,5, 0,0,1,6, 0,0,0,1],"fov":60,"aspect":1.5}]})");
  EXPECT_EQ(path.framesPerSecond, 30.0);
  ASSERT_EQ(path.frameCount(), 2);
  expectNear(path.frames[0].pose.eye, {1, 2, 3});
  expectNear(path.frames[0].pose.worldFromCamera[0], {0, 0, -1});  // first column, scaled by 2 in the file
  expectNear(path.frames[0].pose.worldFromCamera[2], {1, 0, 0});
  EXPECT_NEAR(path.frames[1].verticalFieldOfView, 60.0 * kDegree, 1e-12);
}

TEST(Nerfstudio, OneCameraIsOneFrame) {
  EXPECT_EQ(read(R"({"camera_path":[{"camera_to_world":[1,0,0,4, 0,1,0,5, 0,0,1,6, 0,0,0,1],"fov":60}]})")
                .frameCount(),
            1);
}

TEST(Nerfstudio, NamesWhatIsWrong) {
  const auto refused = [](const std::string& text, const std::string& part) {
    SCOPED_TRACE(text);
    expectRefused([&] { (void)read(text); }, part);
  };
  refused(R"({"camera_path":[]})", "expected an array 'camera_path' of at least one camera");
  refused(R"({"camera_path":[7]})", "camera_path[0]: expected an object with 'camera_to_world' and 'fov'");
  refused(R"({"camera_path":[{"fov":5,"camera_to_world":[1,2,3]}]})",
          "camera_to_world: expected 16 numbers, found an array of 3");
  refused(R"({"camera_path":[{"fov":5,"camera_to_world":[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1]}]})",
          "expected camera axes");
  refused(R"({"camera_path":[{"fov":5,"camera_to_world":[1,0,0,0,0,1,0,0,0,0,1,0,4,5,6,1]}]})",
          "expected a last row of 0 0 0 1");
  refused(R"({"camera_type":"fisheye","camera_path":[{}]})", "camera_type: expected 'perspective'");
}

TEST(Tum, ConvertsFromTheVisionConvention) {
  // The identity of TUM looks along +z with y down; as a Promenade pose: right (1,0,0), up (0,-1,0), backward
  // (0,0,-1).
  const CameraPath path = read("# a comment\n1305031102.0 1 2 3 0 0 0 1\n1305031102.2 3 2 3 0 0 0 1\n");
  ASSERT_EQ(path.frameCount(), 6);  // samples: both ends belong, 0.2 s * 25 + 1
  expectNear(path.frames[0].pose.worldFromCamera[0], {1, 0, 0});
  expectNear(path.frames[0].pose.worldFromCamera[1], {0, -1, 0});
  expectNear(path.frames[0].pose.worldFromCamera[2], {0, 0, -1});
  expectNear(path.frames[1].pose.eye, {1.4, 2, 3}, 1e-6);
  expectNear(path.frames[5].pose.eye, {3, 2, 3}, 1e-6);
}

TEST(Tum, TakesTabsWindowsLineEndsAndASinglePose) {
  EXPECT_EQ(read("0\t1 2 3\t0 0 0 1\r\n").frameCount(), 1);
}

TEST(Tum, NamesTheLineThatIsWrong) {
  const auto refused = [](const std::string& text, const std::string& part) {
    SCOPED_TRACE(text);
    expectRefused([&] { (void)read(text); }, part);
  };
  refused("# nothing\n", "expected at least one camera pose");
  refused("0 1 2 3 0 0 0 1\n0 1 2 3 0 0 0 1\n", "walk: line 2: expected a time after");
  refused("0 1 2 3 0 0 0 1\n1 1 2 3 0 0 0\n",
          "walk: line 2: expected 8 finite numbers (timestamp tx ty tz qx qy qz qw), found 7");
  refused("0 1 2 3 0 0 0 1 9\n", "line 1: expected 8 numbers");
  refused("0 1 nan 3 0 0 0 1\n", "line 1: expected 8 finite numbers");
  refused("0 1 2 3 0 0 0 0\n", "line 1: expected a rotation quaternion");
  refused("hello\n", "found 'hello' as the 1. value");
  refused("0 1 2 3 0 0 0 1\n1e9 1 2 3 0 0 0 1\n", "expected at most 1000000 frames");
}

TEST(Resampled, KeepsTheDurationAndHoldsTheLastFrame) {
  CameraPath path;
  path.framesPerSecond = 10.0;
  for (int i = 0; i < 3; ++i) path.frames.push_back({{glm::dmat3(1.0), glm::dvec3(i, 0, 0)}, 1.0 + i});
  const CameraPath twice = resampled(path, 20.0, "walk");
  ASSERT_EQ(twice.frameCount(), 6);
  const double xs[] = {0, 0.5, 1, 1.5, 2, 2};
  for (std::size_t i = 0; i < 6; ++i) {
    expectNear(twice.frames[i].pose.eye, {xs[i], 0, 0});
    EXPECT_NEAR(twice.frames[i].verticalFieldOfView, 1.0 + xs[i], 1e-9);
  }
  EXPECT_EQ(resampled(path, 0.1, "walk").frameCount(), 1);
}

}  // namespace
}  // namespace promenade::paths
