// `promenade compare`, `path`, `encode`, `info` and what all verbs share, from the outside.

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/e2e/tiny_scene.h"

namespace promenade::e2e {
namespace {

namespace fs = std::filesystem;

class Verbs : public InFolder {
 protected:
  // Renders `frames` frames of a quad into the folder `name`.
  std::string rendered(const std::string& name, const std::string& size, const std::string& frames) {
    const auto scene = writeScene(folder_, "scene", With::kAll);
    expectDone(run({"render", scene, "--out", at(name), "--size", size, "--supersample", "1", "--spp", "1",
                    "--exposure", "0", "--integrator", "path", "--frames", frames, "--quiet"}));
    return at(name);
  }
};

TEST_F(Verbs, HelpOfEachVerbHasAnExample) {
  for (const char* verb : {"render", "compare", "path", "encode", "report", "info", "converge"}) {
    const Outcome outcome = run({verb, "--help"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.out, testing::HasSubstr("Example:\n  promenade " + std::string(verb)));
  }
  EXPECT_EQ(run({"--help"}).status, 0);
  EXPECT_EQ(run({"--version"}).status, 0);
  expectRefused(run({}), "expected a verb");
  expectRefused(run({"compair"}), "did you mean 'compare'?");
}

TEST_F(Verbs, ConvergeWritesACurveForEachSolution) {
  const auto scene = writeScene(folder_, "scene", With::kNoLight);  // under a uniform sky
  const auto converge = [&](const std::string& frame, const std::string& most) {
    return run({"converge", scene, "--out", at("curves"), "--size", "48x32", "--supersample", "1", "--frame",
                frame, "--most-spp", most, "--converged-spp", "64", "--quiet"});
  };
  const Outcome outcome = converge("24", "8");
  expectDone(outcome);
  EXPECT_THAT(outcome.out, testing::HasSubstr("walkthrough"));
  std::istringstream csv(contents(at("curves/convergence.csv")));
  std::vector<std::string> lines;
  for (std::string line; std::getline(csv, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 1u + 4u + 4u);  // 1, 2, 4, 8 paths
  EXPECT_EQ(lines[0], "solution,seconds,paths,percent_visible,predicted_percent,jnd,predicted_jnd");
  EXPECT_THAT(lines[1], testing::MatchesRegex("path,[0-9.]+,1,[0-9.]+,,[0-9.]+,"));
  EXPECT_THAT(lines[8], testing::MatchesRegex("walkthrough,[0-9.]+,8,[0-9.]+,[0-9.]+,[0-9.]+,[0-9.]+"));
  EXPECT_THAT(contents(at("curves/convergence.svg")), testing::HasSubstr("Perceptual convergence"));
  EXPECT_THAT(contents(at("curves/difference.svg")), testing::HasSubstr("mean difference, JND"));
  expectRefused(converge("25", "8"), "--frame");
  expectRefused(converge("0", "6"), "--most-spp: expected a power of two, found 6");
}

TEST_F(Verbs, CompareOfEqualSequencesIsZeroAndSymmetric) {
  const std::string a = rendered("a", "40x30", "0-3");
  const std::string b = rendered("b", "40x30", "4-7");
  const Outcome same = run({"compare", a, a, "--json", "--quiet"});
  expectDone(same);
  const auto root = nlohmann::json::parse(same.out);
  EXPECT_EQ(root["metric"], "aqm");
  EXPECT_EQ(root["fps"], 25.0);
  EXPECT_EQ(root["frames"].size(), 4u);
  EXPECT_EQ(root["percent_visible_worst"], 0.0);
  EXPECT_EQ(root["frames"][3]["jnd_max"], 0.0);
  const Outcome there = run({"compare", a, b, "--json", "--quiet"});
  const Outcome back = run({"compare", b, a, "--json", "--quiet"});
  expectDone(there);
  EXPECT_EQ(there.out, back.out);
  EXPECT_GT(nlohmann::json::parse(there.out)["percent_visible_mean"].get<double>(), 0.0);
}

TEST_F(Verbs, CompareFailsAboveALimitWithStatus1) {
  const std::string a = rendered("a", "40x30", "0-0");
  const std::string b = rendered("b", "40x30", "20-20");
  const Outcome above = run({"compare", a, b, "--fail-above", "0.5"});
  EXPECT_EQ(above.status, 1) << above.err;
  EXPECT_EQ(std::count(above.out.begin(), above.out.end(), '\n'), 1);
  EXPECT_EQ(run({"compare", a, b, "--fail-above", "100"}).status, 0);
}

TEST_F(Verbs, CompareWritesMapsHeatmapsAndATable) {
  const std::string a = rendered("a", "40x30", "0-1");
  const std::string b = rendered("b", "40x30", "5-6");
  expectDone(run({"compare", a, b, "--maps", at("maps"), "--heatmap", at("heat"), "--csv", at("table.csv"),
                  "--velocity", "-3,4", "--display", "crt-100"}));
  EXPECT_TRUE(fs::exists(at("maps/000001.exr")));
  EXPECT_TRUE(fs::exists(at("heat/000001.png")));
  const std::string table = contents(at("table.csv"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3);
  EXPECT_EQ(run({"compare", at("heat/000000.png"), at("heat/000000.png")}).status, 0);
}

TEST_F(Verbs, CompareOfDifferentSizesOrLengthsStatesBoth) {
  const std::string a = rendered("a", "40x30", "0-2");
  const std::string b = rendered("b", "40x31", "0-2");
  const std::string c = rendered("c", "40x30", "0-1");
  const Outcome sizes = run({"compare", a, b});
  expectRefused(sizes, "40x30");
  EXPECT_THAT(sizes.error(), testing::HasSubstr("40x31"));
  const Outcome lengths = run({"compare", a, c});
  expectRefused(lengths, "has 3 frames");
  EXPECT_THAT(lengths.error(), testing::HasSubstr("has 2 frames"));
}

TEST_F(Verbs, CompareNamesWhatItCannotDo) {
  const std::string a = rendered("a", "8x8", "0-0");
  expectRefused(run({"compare", a, at("missing")}), "missing");
  expectRefused(run({"compare", a, a, "--display", "phon"}), "did you mean 'phone'?");
  expectRefused(run({"compare", a, a, "--absolute"}), "expected a channel Y");
  const Outcome list = run({"compare", a, a, "--display", "?"});
  EXPECT_EQ(list.status, 0);
  EXPECT_THAT(list.out, testing::HasSubstr("crt-100"));
}

TEST_F(Verbs, PathDescribesConvertsAndDraws) {
  writeText(at("walk.json"),
            R"({"interpolation": "linear", "keys": [{"time": 0, "eye": [0,0,0], "target": [0,0,-9]},
                                                                     {"time": 8, "eye": [4,0,0], "target": [4,0,-9]}]})");
  const Outcome outcome =
      run({"path", at("walk.json"), "--plot", at("walk.svg"), "--to", "gltf", at("walk.gltf")});
  expectDone(outcome);
  EXPECT_THAT(outcome.out, testing::HasSubstr("200 at 25 frames/s"));
  EXPECT_THAT(outcome.out, testing::HasSubstr("0.500 m/s mean, 0.500 m/s max"));
  EXPECT_THAT(contents(at("walk.svg")), testing::HasSubstr("</svg>"));
  // The glTF file goes through the scene reader and says the same.
  const Outcome again = run({"path", at("walk.gltf"), "--to", "tum", at("walk.txt")});
  expectDone(again);
  EXPECT_EQ(again.out, outcome.out);
  const Outcome tum = run({"path", at("walk.txt"), "--to", "nerfstudio", at("cameras.json")});
  EXPECT_EQ(tum.out, outcome.out);
  EXPECT_EQ(run({"path", at("cameras.json")}).out, outcome.out);
}

TEST_F(Verbs, PathNamesWhatIsWrong) {
  writeText(at("one.json"), R"({"keys": [{"time": 0, "eye": [0,0,0], "target": [0,0,-9]}]})");
  expectRefused(run({"path", at("one.json")}), "expected at least 2 keys, found 1");
  expectRefused(run({"path", at("missing.json")}), "missing.json");
  writeText(at("two.txt"), "0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n");
  expectRefused(run({"path", at("two.txt"), "--to", "tom", at("x")}),
                "unknown path format 'tom'; did you mean 'tum'?");
  expectRefused(run({"path", at("two.txt"), "--to", "tum", at("no/such/folder/x")}), "no/such/folder");
}

TEST_F(Verbs, EncodeMakesAVideoOfAPart) {
  const std::string a = rendered("a", "40x30", "0-4");
  const Outcome outcome = run({"encode", a, at("part.mkv"), "--frames", "1-3", "--crop", "20x10+4+5",
                               "--exposure", "-1", "--tone", "linear"});
  expectDone(outcome);
  EXPECT_THAT(outcome.out, testing::HasSubstr("3 frames"));
  EXPECT_EQ(run({"compare", at("part.mkv"), at("part.mkv"), "--quiet"}).status, 0);
  expectRefused(run({"encode", a, at("part.xyz")}), "part.xyz");
  expectRefused(run({"encode", a, at("part2.mkv"), "--crop", "41x10+0+0"}),
                "--crop: expected a part of the frames, which are 40x30");
  expectRefused(run({"encode", a, at("part2.mkv"), "--frames", "3-9"}), "expected frames within 0-4");
  EXPECT_FALSE(fs::exists(at("part2.mkv")));
}

TEST_F(Verbs, ReportMakesThePageAgain) {
  const std::string a = rendered("a", "40x30", "0-2");
  const std::string page = contents(at("a/report.html"));
  EXPECT_THAT(page, testing::HasSubstr("data:image/webp;base64,"));
  fs::remove(at("a/report.html"));
  expectDone(run({"report", a, "--quiet"}));
  EXPECT_EQ(contents(at("a/report.html")), page);
  const std::string b = rendered("b", "40x31", "0-2");
  expectRefused(run({"report", a, "--reference", b}), "a reference has the size of the result");
  const std::string c = rendered("c", "40x30", "0-1");
  expectRefused(run({"report", a, "--reference", c}), "000002.exr");
  expectRefused(run({"report", at("missing")}), "there is no report.json in it");
  writeText(at("a/report.json"), R"({"job": {}})");
  expectRefused(run({"report", a}), "not a report of Promenade");
}

TEST_F(Verbs, InfoSaysWhatWasRead) {
  const Outcome outcome = run({"info", writeScene(folder_, "scene", With::kAll).string()});
  expectDone(outcome);
  EXPECT_THAT(outcome.out, testing::HasSubstr("4 triangles"));
  EXPECT_THAT(outcome.out, testing::HasSubstr("walk"));
}

TEST_F(Verbs, QuietSaysNothingOnStderr) {
  const auto scene = writeScene(folder_, "scene", With::kNoLight);
  const Outcome outcome = run({"render", scene, "--out", at("out"), "--size", "8x8", "--supersample", "1",
                               "--spp", "1", "--frames", "0-1", "--quiet"});
  expectDone(outcome);
  EXPECT_EQ(outcome.err, "");
}

}  // namespace
}  // namespace promenade::e2e
