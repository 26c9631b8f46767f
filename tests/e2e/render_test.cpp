// `promenade render` from the outside.

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/time.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "tests/e2e/small_disk.h"
#include "tests/e2e/tiny_scene.h"

namespace promenade::e2e {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Arguments = std::vector<std::string>;

// Small and quick; `more` is appended.
Arguments render(const std::string& scene, const std::string& out, const Arguments& more = {}) {
  Arguments all = {"render",        scene, "--out", out, "--size",     "32x18",
                   "--supersample", "1",   "--spp", "1", "--exposure", "0"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

class Render : public InFolder {};

TEST_F(Render, WritesFramesVideoAndReport) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  const Outcome outcome = run(render(scene, at("out"), {"--spacing", "8", "--maps"}));
  expectDone(outcome);
  EXPECT_EQ(framesIn(at("out")), 25);  // 1 s at 25 frames/s
  EXPECT_TRUE(fs::exists(at("out/walkthrough.mp4")));
  EXPECT_FALSE(fs::is_empty(at("out/maps")));
  const auto report = nlohmann::json::parse(contents(at("out/report.json")));
  EXPECT_EQ(report["job"]["size"], nlohmann::json::parse("[32, 18]"));
  EXPECT_EQ(report["totals"]["frames"], 25);
  EXPECT_EQ(report["totals"]["samples"], 25 * 32 * 18);
  EXPECT_EQ(report["frames"].size(), 25u);
  EXPECT_EQ(report["frames"][0]["kind"], "keyframe");
  EXPECT_GE(report["totals"]["keyframes"].get<int>(), 4);  // 0, 8, 16, 24
  EXPECT_LE(report["totals"]["traced_fraction"].get<double>(), 1.0);
  EXPECT_EQ(run({"compare", at("out"), at("out"), "--quiet"}).status, 0);
  expectOnlyWholeFiles(folder_);
}

TEST_F(Render, KeepsTheLightSolutionForLaterRendersOfTheScene) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  const auto solved = [&](const std::string& out, const Arguments& more) {
    Arguments all = render(scene, at(out), {"--frames", "0-2"});
    all.insert(all.end(), more.begin(), more.end());
    const Outcome outcome = run(all);
    expectDone(outcome);
    return outcome.err;
  };
  solved("first", {"--light-solution", at("light.bin")});
  const std::string light = contents(at("light.bin"));
  EXPECT_THAT(solved("second", {"--light-solution", at("light.bin")}), HasSubstr("used again"));
  EXPECT_EQ(contents(at("light.bin")), light);
  const auto lightReport = [&](const std::string& out) {
    return nlohmann::json::parse(contents(at(out + "/report.json")))["light_solution"];
  };
  EXPECT_GT(lightReport("first")["rays"].get<std::int64_t>(), 0);
  EXPECT_EQ(lightReport("first")["records_added"], lightReport("first")["records"]);
  EXPECT_EQ(lightReport("second")["rays"], 0);
  EXPECT_EQ(lightReport("second")["records_added"], 0);
  EXPECT_EQ(lightReport("second")["records"], lightReport("first")["records"]);
  EXPECT_EQ(lightReport("second")["cameras"], 25);  // the whole walk's, whatever part of it is rendered
  solved("third", {});                              // in its own folder, made anew
  EXPECT_EQ(contents(at("third/light-solution.bin")), light);
  for (const char* frame : {"frames/000000.exr", "frames/000001.exr", "frames/000002.exr"}) {
    EXPECT_EQ(contents(at("second") + "/" + frame), contents(at("first") + "/" + frame)) << frame;
  }
  // Another seed is another light; a damaged file is none: both are made anew and replaced.
  EXPECT_THAT(solved("fourth", {"--light-solution", at("light.bin"), "--seed", "1"}),
              HasSubstr("computed anew"));
  EXPECT_NE(contents(at("light.bin")), light);
  std::ofstream(at("light.bin"), std::ios::binary) << light.substr(0, light.size() / 2);
  EXPECT_THAT(solved("fifth", {"--light-solution", at("light.bin")}), HasSubstr("computed anew"));
  EXPECT_EQ(contents(at("light.bin")), light);
}

TEST_F(Render, GivesTheSameBytesForAnyNumberOfThreads) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  for (const char* paths : {"1", "auto"}) {
    SCOPED_TRACE(paths);
    const Arguments job = {"--frames", "0-6", "--spacing", "3", "--spp", paths, "--overwrite", "--threads"};
    const auto with = [&](const std::string& threads) {
      Arguments all = job;
      all.push_back(threads);
      return all;
    };
    expectDone(run(render(scene, at("one"), with("1"))));
    expectDone(run(render(scene, at("two"), with("3"))));
    for (int i = 0; i < 7; ++i) {
      const std::string name = "frames/00000" + std::to_string(i) + ".exr";
      EXPECT_TRUE(contents(folder_ / "one" / name) == contents(folder_ / "two" / name)) << name;
    }
  }
}

TEST_F(Render, StopsWhenAViewerSeesNoNoise) {
  const auto scene = writeScene(folder_, "scene", With::kNoLight);  // under a uniform sky
  for (const char* integrator : {"path", "walkthrough"}) {
    SCOPED_TRACE(integrator);
    const std::string out = at(integrator);
    expectDone(run(render(scene, out, {"--integrator", integrator, "--spp", "auto", "--frames", "0-4"})));
    const auto report = nlohmann::json::parse(contents(out + "/report.json"));
    EXPECT_TRUE(report["job"]["spp"].is_null());
    EXPECT_LE(report["totals"]["stopping"]["predicted_percent_worst"].get<double>(), 1.0);
    EXPECT_EQ(report["totals"]["stopping"]["tiles_open"], 0);
    for (const auto& frame : report["frames"]) EXPECT_LE(frame["paths_most"].get<int>(), 1024);
    // A wall needs paths where its light is not solved: the rule was really asked.
    if (integrator == std::string("path")) {
      EXPECT_GT(report["totals"]["stopping"]["paths"].get<int>(), 0);
    }
  }
}

TEST_F(Render, NoSuchFileIsRefused) {
  expectRefused(run(render(at("missing.glb"), at("out"))), "missing.glb");
  EXPECT_FALSE(fs::exists(at("out")));
}

TEST_F(Render, WhatIsNotGltfIsRefused) {
  writeText(at("text.gltf"), "Once upon a time");
  writeText(at("noise.glb"), "glTF\x02\x01 but then nothing of the kind");
  writeText(at("empty.glb"), "");
  for (const char* name : {"text.gltf", "noise.glb", "empty.glb"}) {
    SCOPED_TRACE(name);
    expectRefused(run(render(at(name), at("out"))), name);
  }
}

TEST_F(Render, NoCameraAndNoPathIsRefused) {
  const auto scene = writeScene(folder_, "scene", With::kNoCamera);
  expectRefused(run(render(scene, at("out"))),
                "the scene has no camera; give a camera path with --path FILE");
}

TEST_F(Render, APathFileReplacesTheCameraOfTheScene) {
  const auto scene = writeScene(folder_, "scene", With::kNoCamera);
  writeText(at("walk.json"), R"({"fps": 10, "keys": [{"time": 0, "eye": [0,0,1], "target": [0,0,-3]},
                                                     {"time": 0.5, "eye": [1,0,1], "target": [0,0,-3]}]})");
  expectDone(run(render(scene, at("out"), {"--path", at("walk.json")})));
  EXPECT_EQ(framesIn(at("out")), 5);
  expectRefused(run(render(scene, at("out2"), {"--path", at("wlak.json")})), "--path: there is no such file");
}

TEST_F(Render, APathOfOneFrameIsAStill) {
  const auto scene = writeScene(folder_, "scene", With::kNoCamera);
  writeText(at("still.txt"), "0 0 0 1 1 0 0 0\n");  // turned half about x: looks along -z of the world
  expectDone(run(render(scene, at("out"), {"--path", at("still.txt")})));
  EXPECT_EQ(framesIn(at("out")), 1);
  const auto animated = writeScene(folder_, "animated", With::kAll);
  expectDone(run(render(animated, at("one"), {"--frames", "7"})));
  EXPECT_TRUE(fs::exists(at("one/frames/000007.exr")));
  EXPECT_EQ(framesIn(at("one")), 1);
}

TEST_F(Render, FiltersFramesWithThoseAround) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  const auto temporal = [&](const std::string& out, const std::string& threads) {
    expectDone(
        run(render(scene, at(out),
                   {"--filter", "temporal", "--frames", "0-6", "--spacing", "3", "--threads", threads})));
  };
  temporal("one", "1");
  temporal("two", "3");
  for (int i = 0; i < 7; ++i) {
    const std::string name = "frames/00000" + std::to_string(i) + ".exr";
    EXPECT_TRUE(contents(folder_ / "one" / name) == contents(folder_ / "two" / name)) << name;
  }
  const auto job = nlohmann::json::parse(contents(at("one/report.json")))["job"];
  EXPECT_EQ(job["filter"], "temporal");
  EXPECT_EQ(job["filter_radius"], 3);
  expectRefused(run(render(scene, at("out"), {"--filter", "gauss"})), "--filter");
  expectRefused(run(render(scene, at("out"), {"--filter", "temporal", "--filter-radius", "0"})),
                "--filter-radius");
}

TEST_F(Render, ACameraThatStandsIsAStill) {
  expectDone(run(render(writeScene(folder_, "scene", With::kNoAnimation), at("out"))));
  EXPECT_EQ(framesIn(at("out")), 1);
}

TEST_F(Render, AnOutputFolderThatCannotBeIsRefusedBeforeAnyWork) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  writeText(at("file"), "in the way");
  expectRefused(run(render(scene, at("file"))), "file");
  expectRefused(run(render(scene, at("file/below"))), "file/below");
  expectRefused(run(render(scene, "/proc/promenade")), "/proc/promenade");
  EXPECT_EQ(contents(at("file")), "in the way");
}

TEST_F(Render, AFullDiskStopsWithStatus3AndWholeFiles) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  const SmallDisk disk(at("disk"), "128k");
  if (!disk) GTEST_SKIP() << "SKIPPED: a small file system cannot be mounted here";
  const Outcome outcome = run(render(scene, at("disk/out"), {"--size", "320x180"}));
  EXPECT_EQ(outcome.status, 3) << outcome.err;
  EXPECT_NE(outcome.error(), "") << outcome.err;
  EXPECT_LT(framesIn(at("disk/out")), 25);
  expectOnlyWholeFiles(at("disk"));
  EXPECT_FALSE(fs::exists(at("disk/out/walkthrough.mp4")));
  EXPECT_FALSE(fs::exists(at("disk/out/report.json")));
}

TEST_F(Render, AFileThatMayNotGrowStopsWithStatus3AndWholeFiles) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  const Outcome outcome = run(render(scene, at("out"), {"--size", "320x180"}), [] {
    const rlimit limit{4096, 4096};  // bytes a file
    setrlimit(RLIMIT_FSIZE, &limit);
  });
  EXPECT_EQ(outcome.status, 3) << outcome.err;
  EXPECT_EQ(framesIn(at("out")), 0);
  expectOnlyWholeFiles(folder_);
}

TEST_F(Render, CtrlCLeavesOnlyWholeFilesAndStatus130) {
  const auto scene = writeScene(folder_, "scene", With::kAll, 400.0f);
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string out = at("out" + std::to_string(signal));
    // Neither a solution nor keyframes to be placed for 10,000 frames first.
    Process process(render(scene, out, {"--integrator", "path", "--method", "full"}));
    waitForFrames(out);
    process.send(signal);
    const Outcome outcome = process.wait(std::chrono::seconds(20));
    EXPECT_EQ(outcome.status, 130) << outcome.err;
    EXPECT_THAT(outcome.error(), testing::HasSubstr("interrupted"));
    EXPECT_LT(framesIn(out), 10'000);
    EXPECT_FALSE(fs::exists(out + "/walkthrough.mp4"));
    expectOnlyWholeFiles(folder_);
    fs::remove_all(out);
  }
}

TEST_F(Render, FramesOfAnotherJobAreNotTouchedUnlessAsked) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  expectDone(run(render(scene, at("out"), {"--frames", "0-2"})));
  const std::string before = contents(at("out/frames/000000.exr"));
  expectRefused(run(render(scene, at("out"), {"--frames", "0-2", "--seed", "5"})),
                "holds frames of another job");
  EXPECT_TRUE(contents(at("out/frames/000000.exr")) == before);
  const Outcome again = run(render(scene, at("out"), {"--frames", "0-2"}));
  EXPECT_THAT(again.out, testing::HasSubstr("all frames of this job are there"));
  expectDone(run(render(scene, at("out"), {"--frames", "0-1", "--overwrite"})));
  EXPECT_EQ(framesIn(at("out")), 2);
}

TEST_F(Render, UnknownOptionsAndKeysAreAnsweredWithTheNearest) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  expectRefused(run(render(scene, at("out"), {"--tolerence", "3"})), "did you mean '--tolerance'?");
  writeText(at("job.toml"), "fsp = 25\n");
  expectRefused(run(render(scene, at("out"), {"--config", at("job.toml")})),
                "job.toml: line 1: unknown key 'fsp'; did you mean 'fps'?");
  writeText(at("walk.json"), R"({"kyes": []})");
  expectRefused(run(render(scene, at("out"), {"--path", at("walk.json")})),
                "unknown key \"kyes\"; did you mean 'keys'?");
  EXPECT_FALSE(fs::exists(at("out")));
}

TEST_F(Render, AConfigFileStandsInForOptions) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  writeText(
      at("job.toml"),
      "size = \"16x9\"\nsupersample = 1\nspp = 1\nexposure = 0\nframes = \"0-1\"\n[compare]\nppd = 30\n");
  expectDone(run({"render", scene, "--out", at("out"), "--config", at("job.toml")}));
  EXPECT_EQ(framesIn(at("out")), 2);
}

TEST_F(Render, NumbersOutOfTheirRangeAreRefused) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  for (const char* option : {"--footprint-limit", "--spacing", "--supersample"}) {
    expectRefused(run(render(scene, at("out"), {option, "0"})), std::string(option) + ": expected");
  }
}

TEST_F(Render, AbsurdSizesAreRefusedWithTheMemoryTheyNeed) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  expectRefused(run({"render", scene, "--out", at("out"), "--size", "65536x65536", "--supersample", "16"}),
                "GB of memory and this machine has");
  expectRefused(run(render(scene, at("out"), {"--size", "99999999x1"})), "--size: expected WIDTHxHEIGHT");
  expectRefused(run(render(scene, at("out"), {"--size", "0x0"})), "--size: expected WIDTHxHEIGHT");
  expectRefused(run(render(scene, at("out"), {"--fps", "1e300"})), "--fps");
  expectRefused(run(render(writeScene(folder_, "long", With::kAll, 1e9f), at("out"))),
                "expected at most 1000000 frames");
  EXPECT_FALSE(fs::exists(at("out")));
}

TEST_F(Render, ASceneWithoutLightsIsRenderedUnderASkyWithANotice) {
  const Outcome outcome =
      run(render(writeScene(folder_, "scene", With::kNoLight), at("out"), {"--frames", "0-1"}));
  expectDone(outcome);
  EXPECT_THAT(outcome.err, testing::HasSubstr("no light"));
}

TEST_F(Render, ASceneWithoutMeshesIsSkyOnly) {
  expectDone(
      run(render(writeScene(folder_, "scene", With::kNoMesh), at("out"), {"--frames", "0-1", "--sky"})));
  EXPECT_EQ(framesIn(at("out")), 2);
}

TEST_F(Render, AMillionNodesAreRead) {
  auto scene = nlohmann::json::parse(contents(writeScene(folder_, "scene", With::kAll)));
  std::string text = scene.dump();
  // Empty nodes, all children of the scene, appended as text: quicker than a million JSON objects.
  const int first = static_cast<int>(scene["nodes"].size());
  std::string nodes;
  std::string children;
  for (int i = 0; i < 1'000'000; ++i) {
    nodes += ",{\"mesh\":0}";
    children += "," + std::to_string(first + i);
  }
  const auto insertBeforeEnd = [&text](const std::string& key, const std::string& addition) {
    const std::size_t begin = text.find(key);
    ASSERT_NE(begin, std::string::npos);
    text.insert(text.find(']', begin), addition);
  };
  // The last "nodes" array of numbers is the scene's; the one of objects ends with the last node.
  const std::size_t objects = text.find("\"nodes\":[{");
  ASSERT_NE(objects, std::string::npos);
  int depth = 0;
  std::size_t end = objects + 8;
  for (; end < text.size(); ++end) {
    if (text[end] == '[') ++depth;
    if (text[end] == ']' && --depth == 0) break;
  }
  text.insert(end, nodes);
  insertBeforeEnd("\"scenes\":[{\"nodes\":[", children);
  writeText(at("million.gltf"), text);
  const Outcome outcome = Process({"info", at("million.gltf")}).wait(std::chrono::seconds(120));
  expectDone(outcome);
  EXPECT_THAT(outcome.out, testing::HasSubstr("2000002 instances"));  // two primitives a node
}

}  // namespace
}  // namespace promenade::e2e
