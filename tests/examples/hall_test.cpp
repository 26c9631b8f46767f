// The built-in example as the program itself reads it.

#include "examples/hall/hall.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <iterator>
#include <map>
#include <set>
#include <string>

#include "paths/from_animation.h"
#include "src/core/display.h"
#include "src/scene/load.h"

namespace promenade {
namespace {

namespace fs = std::filesystem;

/// A folder that goes away with the test.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& name)
      : path_(fs::temp_directory_path() / ("promenade-hall-" + name + "-" + std::to_string(getpid()))) {}
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    std::ifstream stream(entry.path(), std::ios::binary);
    files[entry.path().filename().string()] = {std::istreambuf_iterator<char>(stream), {}};
  }
  return files;
}

struct Bounds {
  glm::vec3 low{std::numeric_limits<float>::max()}, high{std::numeric_limits<float>::lowest()};
};

Bounds worldBounds(const Scene& scene, const Instance& instance) {
  Bounds b;
  for (const glm::vec3& p : scene.meshes[static_cast<std::size_t>(instance.mesh)].positions) {
    const glm::vec3 world = instance.worldFromObject * glm::vec4(p, 1.0f);
    b.low = glm::min(b.low, world);
    b.high = glm::max(b.high, world);
  }
  return b;
}

double emittedPower(const Scene& scene, const Instance& instance, double* largestTriangle) {
  const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
  const float radiance = luminance(scene.materials[static_cast<std::size_t>(mesh.material)].emission);
  double sum = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const auto at = [&](unsigned i) { return instance.worldFromObject * glm::vec4(mesh.positions[i], 1.0f); };
    const double area = 0.5 * glm::length(glm::cross(at(t.y) - at(t.x), at(t.z) - at(t.x)));
    sum += glm::pi<double>() * area * radiance;
    *largestTriangle = std::max(*largestTriangle, area);
  }
  return sum;
}

TEST(Hall, IsTheSameEveryTime) {
  const TemporaryFolder first("first"), second("second");
  static_cast<void>(hall::writeHall(first.path()));
  static_cast<void>(hall::writeHall(second.path()));
  const auto a = contents(first.path()), b = contents(second.path());
  ASSERT_EQ(a.size(), b.size());
  EXPECT_TRUE(a.contains("hall.gltf") && a.contains("hall.bin"));
  for (const auto& [name, bytes] : a) {
    ASSERT_TRUE(b.contains(name)) << name;
    EXPECT_TRUE(bytes == b.at(name)) << name << " differs";
  }
}

TEST(Hall, IsSoundAndFitsItsBudget) {
  const TemporaryFolder folder("sound");
  const hall::HallStatistics statistics = hall::writeHall(folder.path());
  std::size_t bytes = 0;
  for (const auto& [name, text] : contents(folder.path())) bytes += text.size();
  EXPECT_EQ(statistics.bytes, bytes);
  EXPECT_LE(bytes, 10'000'000U);

  const Scene scene = loadScene(folder.path() / "hall.gltf");
  for (const std::string& warning : scene.warnings) ADD_FAILURE() << warning;
  std::size_t triangles = 0;
  std::set<std::string> names;
  for (const Instance& instance : scene.instances) {
    triangles += scene.meshes[static_cast<std::size_t>(instance.mesh)].triangles.size();
    EXPECT_TRUE(names.insert(instance.name).second) << "two things are called " << instance.name;
  }
  EXPECT_GE(triangles, 100'000U);
  EXPECT_EQ(triangles, statistics.triangles);

  for (const Mesh& mesh : scene.meshes) {
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size()) << mesh.name;
    for (const glm::uvec3& t : mesh.triangles) {
      ASSERT_LT(std::max({t.x, t.y, t.z}), mesh.positions.size()) << mesh.name;
      const glm::vec3 a = mesh.positions[t.x];
      const glm::vec3 face = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
      for (const unsigned i : {t.x, t.y, t.z}) {
        ASSERT_NEAR(glm::length(mesh.normals[i]), 1.0f, 1e-4f) << mesh.name;
        ASSERT_GT(glm::dot(face, mesh.normals[i]), 0.0f) << mesh.name << ": a normal points into the surface";
      }
    }
  }
}

TEST(Hall, IsLitByFewLargeSurfaces) {
  const TemporaryFolder folder("light");
  static_cast<void>(hall::writeHall(folder.path()));
  const Scene scene = loadScene(folder.path() / "hall.gltf");
  EXPECT_TRUE(scene.lights.empty());
  double total = 0.0, large = 0.0;
  int luminous = 0;
  for (const Instance& instance : scene.instances) {
    double largestTriangle = 0.0;
    const double power = emittedPower(scene, instance, &largestTriangle);
    if (power <= 0.0) continue;
    ++luminous;
    total += power;
    if (largestTriangle > 1.0) large += power;
  }
  EXPECT_GT(total, 0.0);
  EXPECT_LE(luminous, 32);
  EXPECT_GE(large, 0.95 * total);
}

TEST(Hall, TheWalkIsSmoothAndKeepsClearOfEverything) {
  const TemporaryFolder folder("walk");
  static_cast<void>(hall::writeHall(folder.path()));
  const Scene scene = loadScene(folder.path() / "hall.gltf");
  const auto animated = std::find_if(scene.cameras.begin(), scene.cameras.end(),
                                     [](const CameraAnimation& c) { return c.name == "walk"; });
  ASSERT_NE(animated, scene.cameras.end());
  const paths::CameraPath path = paths::pathFromAnimation(*animated, std::nullopt, "hall.gltf");
  ASSERT_EQ(path.frameCount(), 200);  // 8 s at 25 frames a second
  EXPECT_DOUBLE_EQ(path.framesPerSecond, 25.0);

  std::vector<Bounds> bounds;
  for (const Instance& instance : scene.instances) bounds.push_back(worldBounds(scene, instance));
  for (int i = 0; i < path.frameCount(); ++i) {
    const glm::vec3 eye(path.frames[static_cast<std::size_t>(i)].pose.eye);
    for (std::size_t k = 0; k < bounds.size(); ++k) {
      const float distance = glm::distance(eye, glm::clamp(eye, bounds[k].low, bounds[k].high));
      ASSERT_GE(distance, 0.3f) << "frame " << i << " is too near to " << scene.instances[k].name;
    }
  }

  double distance = 0.0, previousSpeed = 0.0, left = 0.0, right = 0.0;
  for (std::size_t i = 1; i < path.frames.size(); ++i) {
    const Pose& a = path.frames[i - 1].pose;
    const Pose& b = path.frames[i].pose;
    const double speed = glm::distance(a.eye, b.eye) * 25.0;
    distance += speed / 25.0;
    EXPECT_LE(speed, 1.7) << "frame " << i;
    // At rest at both ends, and never a jolt: at most 3 m/s^2.
    EXPECT_LE(std::abs(speed - previousSpeed) * 25.0, 3.0) << "frame " << i;
    previousSpeed = speed;
    const glm::dvec3 from = -a.worldFromCamera[2], to = -b.worldFromCamera[2];
    const double turn = glm::degrees(std::asin(glm::clamp(glm::cross(from, to).y, -1.0, 1.0)));
    EXPECT_LE(std::abs(turn) * 25.0, 60.0) << "frame " << i;
    (turn > 0.0 ? left : right) += std::abs(turn);
    EXPECT_NEAR(b.worldFromCamera[1].y, 1.0, 1e-6) << "the camera stays upright";
  }
  EXPECT_GT(distance, 6.0);
  EXPECT_LT(distance, 11.0);
  EXPECT_GE(right, 90.0);
  // It ends in front of the wall of pictures and looks straight at it.
  EXPECT_LT(-path.frames.back().pose.worldFromCamera[2].x, 1.0 + 1e-9);
  EXPECT_GT(-path.frames.back().pose.worldFromCamera[2].x, 0.99);
}

}  // namespace
}  // namespace promenade
