// Walks made of frames that another renderer made: --from and --renderer.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <nlohmann/json.hpp>
#include <utility>

#include "src/io/exr_frame.h"
#include "tests/e2e/tiny_scene.h"

namespace promenade::e2e {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;
using testing::HasSubstr;

nlohmann::json reportOf(const std::string& folder) {
  return nlohmann::json::parse(contents(folder + "/report.json"));
}

// Pixels of the worst frame whose radiance is off by more than a hundredth.
int mostDifferingPixels(const std::string& test, const std::string& reference) {
  int most = 0;
  for (const auto& entry : fs::directory_iterator(reference + "/frames")) {
    const auto expected = io::readFrame(entry.path()).radiance;
    const auto radiance = io::readFrame(fs::path(test) / "frames" / entry.path().filename()).radiance;
    int differing = 0;
    for (std::size_t i = 0; i < expected.pixels().size(); ++i) {
      const auto difference = glm::abs(radiance.pixels()[i] - expected.pixels()[i]);
      differing += glm::any(glm::greaterThan(difference, 0.01f * expected.pixels()[i])) ? 1 : 0;
    }
    most = std::max(most, differing);
  }
  return most;
}

// Silhouettes are right to half a sample, so that a frame may differ along the outlines of the wall and
// between its two quads. It is 4 m by 3 m, 4 m away; 54 rows in 0.8 radians make 27 / tan(0.4) = 64 pixels a
// metre at 1 m, so 64 by 48 pixels: 2 * 64 + 3 * 48 of the 5184 pixels.
constexpr int kOutlinePixels = 272;

class Foreign : public InFolder {
 protected:
  // Every frame of a walk past two painted quads, as if another renderer had made them.
  void SetUp() override {
    InFolder::SetUp();
    scene_ = writeScene(folder_, "scene", With::kAll).string();
    expectDone(run({"render", scene_, "--out", at("all"), "--size", "96x54", "--supersample", "1", "--spp",
                    "4", "--integrator", "path", "--method", "full", "--exposure", "0"}));
  }

  std::string scene_;
};

TEST_F(Foreign, MissingFramesAreMadeFromThoseThatAreThere) {
  fs::create_directories(at("keys"));
  for (const char* frame : {"000000.exr", "000008.exr", "000016.exr", "000024.exr"}) {
    fs::copy(at("all/frames") + "/" + frame, at("keys") + "/shot." + frame);
  }
  expectDone(
      run({"render", "--from", at("keys"), "--out", at("out"), "--supersample", "1", "--exposure", "0"}));
  EXPECT_EQ(framesIn(at("out")), 25);
  const auto report = reportOf(at("out"));
  EXPECT_EQ(report["totals"]["keyframes"], 4);
  EXPECT_EQ(report["totals"]["samples_traced"], 4 * 96 * 54);
  EXPECT_LE(mostDifferingPixels(at("out"), at("all")), kOutlinePixels);
  // The camera passes sideways: both ends see all of the wall but what the borders cut off, and the
  // background.
  EXPECT_EQ(io::readFrame(at("out/frames/000004.exr")).source(48, 27), SampleSource::kBlended);
}

TEST_F(Foreign, FramesOnAPathOfTheirOwnBeginAndEndWithKnownOnes) {
  fs::create_directories(at("keys"));
  fs::copy(at("all/frames/000004.exr"), at("keys/000004.exr"));
  fs::copy(at("all/frames/000009.exr"), at("keys/000009.exr"));
  expectDone(run({"render", "--from", at("keys"), "--out", at("out"), "--supersample", "1"}));
  EXPECT_EQ(framesIn(at("out")), 6);
  expectRefused(
      run({"render", "--from", at("keys"), "--out", at("other"), "--supersample", "1", "--frames", "5-9"}),
      "expected frames 5 and 9");
  expectRefused(run({"render", "--from", at("nowhere"), "--out", at("other")}),
                "expected a folder of frames");
  expectRefused(run({"render", "--from", at("keys"), "--out", at("other"), "--supersample", "5"}),
                "no multiple of 5");
  expectRefused(
      run({"render", "--from", at("keys"), "--out", at("out"), "--supersample", "1", "--exposure", "1"}),
      "holds frames of another job");
}

TEST_F(Foreign, KeyframesAreAskedForOneByOne) {
  const std::string command = "printf '%d\\n' {frame} >> " + at("asked") + "; cp " + at("all") +
                              "/frames/$(printf %06d {frame}).exr {out}";
  const Arguments job = {"render",     scene_,  "--renderer",    command, "--out",     at("out"),
                         "--size",     "96x54", "--supersample", "1",     "--spacing", "8",
                         "--exposure", "0",     "--tolerance",   "13"};
  expectDone(run(job));
  EXPECT_EQ(framesIn(at("out")), 25);
  const auto report = reportOf(at("out"));
  const std::string asked = contents(at("asked"));
  EXPECT_EQ(std::count(asked.begin(), asked.end(), '\n'), report["totals"]["keyframes"].get<int>());
  EXPECT_LT(report["totals"]["keyframes"], 25);
  EXPECT_LE(mostDifferingPixels(at("out"), at("all")), kOutlinePixels);
  const auto request = nlohmann::json::parse(contents(at("out/external/000008.json")));
  EXPECT_EQ(request["width"], 96);
  EXPECT_NEAR(request["vertical_fov"].get<double>(), 0.8, 1e-6);
  // Going on asks for nothing that is there.
  fs::remove(at("out/frames/000003.exr"));
  expectDone(run(job));
  EXPECT_EQ(contents(at("asked")), asked);
}

TEST_F(Foreign, ARendererThatFailsEndsTheRunWithItsCommand) {
  const auto with = [&](const std::string& command) {
    return run({"render", scene_, "--renderer", command, "--out", at("out"), "--size", "96x54",
                "--supersample", "1"});
  };
  EXPECT_THAT(with("exit 7 # {frame} {out}").error(), HasSubstr("failed with exit status 7"));
  EXPECT_THAT(with("true {camera} {out}").error(), HasSubstr("left no"));
  expectRefused(with("true"), "expected a command with {out}");
  expectRefused(with("cp " + scene_ + " {out} # {frame}"), "is not an OpenEXR file");
}

class Blender : public InFolder {};

TEST_F(Blender, RendersKeyframesWhenItIsAsked) {
  if (std::system("blender --version > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "SKIPPED: blender is not installed (Debian: apt-get install blender python3-numpy)";
  }
  const auto scene = writeScene(folder_, "scene", With::kAll);
  const std::string command =
      std::string("blender -b --factory-startup -P ") + PROMENADE_SOURCE_DIR +
      "/examples/blender/render_frame.py -- --camera {camera} --out {out} --scene {scene} "
      "--samples 4 --environment 1,1,1";
  const Outcome outcome =
      Process({"render", scene, "--renderer", command, "--out", at("out"), "--size", "64x36", "--supersample",
               "1", "--frames", "0-2", "--spacing", "2", "--exposure", "0"})
          .wait(std::chrono::seconds(300));
  expectDone(outcome);
  EXPECT_EQ(framesIn(at("out")), 3);
  // Promenade's own depth of the same frame: the wall at z = -3, seen from z = 1.
  const auto frame = io::readFrame(at("out/frames/000000.exr"));
  EXPECT_NEAR(frame.depth(32, 18), 4.0f, 1e-3f);
  // Its left half, 0.8 of red, under a sky of radiance 1 and 3 lx straight from the front: 0.8 (1 + 3 / pi)
  // = 1.56, and what Blender's coat of specular 0.5 adds to it, at most a twentieth of (1 + 3 / pi). 300
  // pixels.
  double red = 0.0;
  for (int y = 11; y < 26; ++y) {
    for (int x = 17; x < 37; ++x) red += frame.radiance(x, y).r / 300.0;
  }
  EXPECT_GT(red, 1.53);
  EXPECT_LT(red, 1.69);
}

// A room of one bright wall, saved with settings that would spoil a frame that must be all of the picture:
// half the size, pixels of 2 to 1, a border, motion blur, a second layer of view. Its camera moves 0.1 m to
// the right in three frames; 1600 to 900 pixels through 50 mm in front of a sensor 36 mm wide.
constexpr const char* kMakeBlend = R"(
import bpy, math, sys
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
bpy.ops.mesh.primitive_plane_add(size=20, location=(0, 3, 0), rotation=(math.pi / 2, 0, 0))
paint = bpy.data.materials.new("paint")
paint.use_nodes = True
nodes = paint.node_tree.nodes
light = nodes.new("ShaderNodeEmission")
light.inputs["Color"].default_value = (0.25, 0.5, 0.75, 1)
paint.node_tree.links.new(light.outputs["Emission"], nodes["Material Output"].inputs["Surface"])
bpy.context.object.data.materials.append(paint)
lens = bpy.data.cameras.new("lens")
camera = bpy.data.objects.new("camera", lens)
camera.rotation_euler = (math.pi / 2, 0, 0)
scene.collection.objects.link(camera)
scene.camera = camera
for frame, x in ((1, 0.0), (3, 0.1)):
    camera.location = (x, -1, 0)
    camera.keyframe_insert("location", frame=frame)
for curve in camera.animation_data.action.fcurves:
    for point in curve.keyframe_points:
        point.interpolation = "LINEAR"
scene.frame_start, scene.frame_end = 1, 3
render = scene.render
render.resolution_x, render.resolution_y, render.resolution_percentage = 1600, 900, 50
render.use_border, render.border_max_x = True, 0.5
render.use_motion_blur = True
scene.view_layers.new("notes")
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[-1])
)";

TEST_F(Blender, RendersABlendAlongTheWalkOfItsCamera) {
  if (std::system("blender --version > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "SKIPPED: blender is not installed (Debian: apt-get install blender python3-numpy)";
  }
  writeText(at("make.py"), kMakeBlend);
  const std::string scripts = std::string(PROMENADE_SOURCE_DIR) + "/examples/blender/";
  const auto blender = [&](const std::string& arguments) {
    return std::system(("blender -b " + arguments + " > " + at("said") + " 2>&1").c_str());
  };
  ASSERT_EQ(blender("--factory-startup -P " + at("make.py") + " -- " + at("room.blend")), 0)
      << contents(at("said"));
  ASSERT_EQ(blender(at("room.blend") + " --factory-startup -P " + scripts + "export_walk.py -- --out " +
                    at("walk.json")),
            0)
      << contents(at("said"));
  const Outcome outcome = Process({"render", at("room.blend"), "--path", at("walk.json"), "--renderer",
                                   "blender -b {scene} --factory-startup -P " + scripts +
                                       "render_frame.py -- --camera {camera} --out {out} --samples 1",
                                   "--out", at("out"), "--size", "64x36", "--supersample", "1", "--spacing",
                                   "2", "--exposure", "0"})
                              .wait(std::chrono::seconds(300));
  expectDone(outcome);
  ASSERT_EQ(framesIn(at("out")), 3);
  // The wall is at z = -3 of glTF, the camera at z = 1; the frame between is warped from the two.
  for (const char* name : {"000000.exr", "000001.exr", "000002.exr"}) {
    const auto frame = io::readFrame(at("out/frames/") + name);
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(32, 18), std::pair(63, 35)}) {
      EXPECT_NEAR(frame.depth(x, y), 4.0f, 1e-3f) << name;
      EXPECT_NEAR(frame.radiance(x, y).r, 0.25f, 1e-3f) << name;
      EXPECT_NEAR(frame.radiance(x, y).b, 0.75f, 1e-3f) << name;
    }
  }
  const Camera last = io::readFrame(at("out/frames/000002.exr")).metadata.camera;
  EXPECT_NEAR(last.pose().eye.x, 0.1, 1e-5);
  EXPECT_NEAR(last.pose().eye.z, 1.0, 1e-5);
  // Half of the sensor's 36 mm over 50 mm, times 900 / 1600.
  EXPECT_NEAR(std::tan(last.verticalFieldOfView() / 2.0), 0.36 * 900.0 / 1600.0, 1e-5);
}

}  // namespace
}  // namespace promenade::e2e
