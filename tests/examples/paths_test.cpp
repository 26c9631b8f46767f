// The path files that come with the examples can be read and stay inside the hall's free space.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <string>

#include "paths/read_path.h"

namespace promenade::paths {
namespace {

CameraPath examplePath(const std::string& name) {
  const std::filesystem::path file =
      std::filesystem::path(PROMENADE_SOURCE_DIR) / "examples" / "paths" / name;
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_FALSE(text.empty()) << file;
  return parsePath(text, file.string(), ReadOptions{});
}

TEST(ExamplePaths, TheNaveIsWalkedFromEndToEnd) {
  const CameraPath path = examplePath("hall-nave.json");
  EXPECT_EQ(path.frameCount(), 300);  // 12 s at 25 frames a second
  for (const PathFrame& frame : path.frames) {
    // Between the band's border and the exhibits: beside the railing (0, -1.6) of radius 1.15 by 0.3 m and
    // more.
    EXPECT_GE(glm::distance(glm::dvec2(frame.pose.eye.x, frame.pose.eye.z), glm::dvec2(0.0, -1.6)), 1.45);
    EXPECT_LE(std::abs(frame.pose.eye.x), 2.75 - 0.31 - 0.05 - 0.3);
  }
  EXPECT_LT(path.frames.back().pose.eye.z, -4.0);
}

TEST(ExamplePaths, TheSculptureIsCircled) {
  const CameraPath path = examplePath("hall-sculpture.json");
  EXPECT_EQ(path.frameCount(), 150);  // 6 s at 25 frames a second
  const glm::dvec3 sculpture(0.0, 1.6, -1.6);
  for (const PathFrame& frame : path.frames) {
    EXPECT_GE(glm::distance(glm::dvec2(frame.pose.eye.x, frame.pose.eye.z), glm::dvec2(0.0, -1.6)), 1.45);
    // It stays in view: within 5 degrees of the middle of the image (keys look at it, rotations between them
    // nearly).
    EXPECT_GT(glm::dot(-frame.pose.worldFromCamera[2], glm::normalize(sculpture - frame.pose.eye)), 0.9962);
  }
}

}  // namespace
}  // namespace promenade::paths
