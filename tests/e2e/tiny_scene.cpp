#include "tests/e2e/tiny_scene.h"

#include <unistd.h>

#include <array>
#include <chrono>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "src/io/exr_frame.h"

namespace promenade::e2e {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Buffer {
  std::string bytes;
  Json views = Json::array();
  Json accessors = Json::array();

  template <class T, std::size_t N>
  int add(const std::array<T, N>& values, const char* type, int components, int componentType) {
    const std::size_t size = N * sizeof(T);
    views.push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}});
    bytes.append(reinterpret_cast<const char*>(values.data()), size);
    accessors.push_back({{"bufferView", views.size() - 1},
                         {"componentType", componentType},
                         {"count", N / static_cast<std::size_t>(components)},
                         {"type", type}});
    return static_cast<int>(accessors.size()) - 1;
  }
};

constexpr int kFloat = 5126;
constexpr int kUint = 5125;

Json withoutSeconds(const fs::path& report) {
  Json root = Json::parse(contents(report));
  for (const char* key : {"command", "directory"}) root["job"].erase(key);
  for (const char* key : {"seconds", "seconds_wall", "speedup_estimated", "peak_rss_bytes"}) {
    root["totals"].erase(key);
  }
  for (Json& frame : root["frames"]) frame.erase("seconds");
  if (root.contains("light_solution")) {
    root["light_solution"].erase("seconds");
    root["light_solution"].erase("file");
  }
  return root;
}

}  // namespace

void waitForFrames(const fs::path& folder) {
  for (int i = 0; i < 4000 && framesIn(folder) < 3; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_GE(framesIn(folder), 3);
}

void expectSameResult(const fs::path& folder, const fs::path& reference) {
  EXPECT_EQ(framesIn(folder), framesIn(reference));
  for (const auto& entry : fs::directory_iterator(reference / "frames")) {
    const auto name = entry.path().filename();
    EXPECT_TRUE(contents(entry.path()) == contents(folder / "frames" / name)) << folder << ": " << name;
  }
  EXPECT_TRUE(fs::exists(folder / "report.html")) << folder;
  EXPECT_TRUE(contents(folder / "walkthrough.mp4") == contents(reference / "walkthrough.mp4")) << folder;
  EXPECT_EQ(withoutSeconds(folder / "report.json").dump(1),
            withoutSeconds(reference / "report.json").dump(1));
  expectOnlyWholeFiles(folder);
}

void writeText(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

fs::path writeScene(const fs::path& folder, const std::string& name, With with, float seconds) {
  Buffer b;
  // Two quads side by side, 4 m wide and 3 m high together, in the plane z = -3.
  const int positions = b.add(std::array<float, 24>{-2, -1.5f, -3, 0, -1.5f, -3, 0, 1.5f, -3, -2, 1.5f, -3,
                                                    0,  -1.5f, -3, 2, -1.5f, -3, 2, 1.5f, -3, 0,  1.5f, -3},
                              "VEC3", 3, kFloat);
  b.accessors[static_cast<std::size_t>(positions)]["min"] = {-2.0, -1.5, -3.0};
  b.accessors[static_cast<std::size_t>(positions)]["max"] = {2.0, 1.5, -3.0};
  const int left = b.add(std::array<unsigned, 6>{0, 1, 2, 0, 2, 3}, "SCALAR", 1, kUint);
  const int right = b.add(std::array<unsigned, 6>{4, 5, 6, 4, 6, 7}, "SCALAR", 1, kUint);
  const int times = b.add(std::array<float, 2>{0.0f, seconds}, "SCALAR", 1, kFloat);
  b.accessors[static_cast<std::size_t>(times)]["min"] = {0.0};
  b.accessors[static_cast<std::size_t>(times)]["max"] = {seconds};
  const int places = b.add(std::array<float, 6>{-0.5f, 0, 1, 0.5f, 0, 1}, "VEC3", 3, kFloat);

  Json nodes = Json::array();
  if (with != With::kNoMesh) nodes.push_back({{"mesh", 0}});
  if (with != With::kNoLight) {
    nodes.push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  }
  if (with != With::kNoCamera) nodes.push_back({{"camera", 0}, {"translation", {0.0, 0.0, 1.0}}});
  Json indices = Json::array();
  for (std::size_t i = 0; i < nodes.size(); ++i) indices.push_back(i);

  Json root = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"nodes", nodes}};
  root["scenes"] = Json::array({{{"nodes", indices}}});
  root["buffers"] = Json::array({{{"byteLength", b.bytes.size()}, {"uri", name + ".bin"}}});
  root["bufferViews"] = b.views;
  root["accessors"] = b.accessors;
  if (with != With::kNoMesh) {
    const auto primitive = [&](int triangles, int material) {
      return Json{{"attributes", {{"POSITION", positions}}}, {"indices", triangles}, {"material", material}};
    };
    root["meshes"] = Json::array({{{"primitives", Json::array({primitive(left, 0), primitive(right, 1)})}}});
    const auto material = [](double r, double g, double bl) {
      return Json{
          {"doubleSided", true},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {r, g, bl, 1.0}}, {"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}}};
    };
    root["materials"] = Json::array({material(0.8, 0.3, 0.2), material(0.2, 0.5, 0.8)});
  }
  if (with != With::kNoLight) {
    root["extensionsUsed"] = {"KHR_lights_punctual"};
    root["extensions"]["KHR_lights_punctual"]["lights"] =
        Json::array({{{"type", "directional"}, {"intensity", 3.0}, {"color", {1.0, 1.0, 1.0}}}});
  }
  if (with != With::kNoCamera) {
    root["cameras"] =
        Json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.01}}}}});
  }
  if (with != With::kNoCamera && with != With::kNoAnimation) {
    root["animations"] = Json::array(
        {{{"name", "walk"},
          {"samplers", Json::array({{{"input", times}, {"output", places}}})},
          {"channels", Json::array({{{"sampler", 0},
                                     {"target", {{"node", nodes.size() - 1}, {"path", "translation"}}}}})}}});
  }
  writeText(folder / (name + ".bin"), b.bytes);
  writeText(folder / (name + ".gltf"), root.dump(1));
  return folder / (name + ".gltf");
}

void InFolder::SetUp() {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  folder_ = fs::temp_directory_path() / ("promenade-" + std::to_string(getpid()) + "-" + info->name());
  fs::remove_all(folder_);
  fs::create_directories(folder_);
}

void InFolder::TearDown() {
  fs::remove_all(folder_);
}

void expectRefused(const Outcome& outcome, const std::string& part) {
  EXPECT_EQ(outcome.status, 2) << outcome.err << " signal " << outcome.signal << " timed out "
                               << outcome.timedOut;
  EXPECT_THAT(outcome.error(), testing::HasSubstr(part)) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

void expectDone(const Outcome& outcome) {
  EXPECT_EQ(outcome.status, 0) << outcome.err << " signal " << outcome.signal << " timed out "
                               << outcome.timedOut;
  EXPECT_EQ(outcome.error(), "");
}

void expectOnlyWholeFiles(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    EXPECT_THAT(entry.path().filename().string(), testing::Not(testing::HasSubstr("promenade-tmp")))
        << entry.path();
    if (entry.path().extension() != ".exr" || entry.path().parent_path().filename() != "frames") continue;
    EXPECT_NO_THROW((void)io::readFrame(entry.path())) << entry.path();
  }
}

int framesIn(const fs::path& folder) {
  if (!fs::is_directory(folder / "frames")) return 0;
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder / "frames"))
    count += entry.path().extension() == ".exr" ? 1 : 0;
  return count;
}

}  // namespace promenade::e2e
