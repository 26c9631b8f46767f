// Frames of other renderers: the command that makes one, the files that are there and the walk through them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "src/app/external_renderer.h"
#include "src/app/foreign_frames.h"
#include "src/app/frame_files.h"
#include "src/io/exr_frame.h"
#include "tests/app/refused.h"

namespace promenade::app {
namespace {

namespace fs = std::filesystem;

TEST(ExternalRenderer, FillsInWhatACommandNeedsForAShell) {
  EXPECT_EQ(filledIn("r {scene} -f {frame} -c {camera} -o {out}", 7, "/a b/c.json", "/o/it's.exr", "s.blend"),
            R"(r s.blend -f 7 -c '/a b/c.json' -o '/o/it'\''s.exr')");
  // What comes from a value is not looked at again; other braces are the shell's.
  EXPECT_EQ(filledIn("x {camera} ${HOME} {a,b} {out}", 0, "/{out}", "o.exr", ""),
            "x '/{out}' ${HOME} {a,b} o.exr");
  for (const char* command : {"r", "r {out}", "r {camera}"}) {
    expectRefused([&] { (void)filledIn(command, 0, {}, {}, {}); }, "expected a command with {out}");
  }
}

class FrameFilesOf : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("promenade-foreign-" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, double x) const {
    io::FrameFile frame;
    Pose pose;
    pose.eye.x = x;
    frame.metadata.camera = Camera(pose, 0.9, Size{4, 3});
    frame.metadata.framesPerSecond = 24.0;
    frame.radiance = RadianceMap(4, 3);
    frame.depth = DepthMap(4, 3, 2.0f);
    io::writeFrame(folder_ / name, frame);
  }

  fs::path folder_;
};

TEST_F(FrameFilesOf, AFolderAreNumberedByTheEndOfTheirNames) {
  write("shot.0012.exr", 0.0);
  write("shot.0008.exr", 0.0);
  write("beauty.exr", 0.0);
  const auto files = frameFiles(folder_.string());
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files.begin()->first, 8);
  EXPECT_EQ(files.at(12).filename(), "shot.0012.exr");
  write("12.exr", 0.0);
  expectRefused([&] { (void)frameFiles(folder_.string()); }, "two frames of number 12");
  expectRefused([&] { (void)frameFiles((folder_ / "none").string()); }, "expected a folder of frames");
}

TEST_F(FrameFilesOf, AWalkKeepTheirCamerasAndTheOthersLieBetween) {
  write("2.exr", 1.0);
  write("4.exr", 2.0);
  write("6.exr", 4.0);
  const auto path = pathThrough(frameFiles(folder_.string()), std::nullopt);
  EXPECT_EQ(path.framesPerSecond, 24.0);
  ASSERT_EQ(path.frameCount(), 7);
  const auto x = [&](std::size_t frame) { return path.frames[frame].pose.eye.x; };
  EXPECT_EQ(x(2), 1.0);
  EXPECT_EQ(x(4), 2.0);
  EXPECT_EQ(x(6), 4.0);
  EXPECT_TRUE(x(3) > 1.0 && x(3) < 2.0 && x(5) > 2.0 && x(5) < 4.0) << x(3) << " " << x(5);
  EXPECT_NEAR(path.frames[3].verticalFieldOfView, 0.9, 1e-9);
}

TEST_F(FrameFilesOf, AnotherSizeAreRefusedWithBothSizes) {
  write("0.exr", 0.0);
  expectRefused(
      [&] {
        (void)frameFrom(folder_ / "0.exr", Camera(Pose{}, 0.9, Size{8, 6}));
      },
      "expected 8x6 samples, found 4x3");
}

}  // namespace
}  // namespace promenade::app
