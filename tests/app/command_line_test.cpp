#include <filesystem>
#include <fstream>

#include "src/app/options.h"
#include "tests/app/refused.h"

namespace promenade::app {
namespace {

using Arguments = std::vector<std::string>;

std::string writtenConfig(const std::string& name, const std::string& text) {
  const std::string file = testing::TempDir() + name;
  std::ofstream(file) << text;
  return file;
}

TEST(CommandLine, ReadsOptionsOfAVerb) {
  const CommandLine line =
      parseCommandLine({"render", "hall.glb", "--out", "walk", "--size=64x36", "--exposure", "-2", "--maps",
                        "--quiet", "--max-triangles", "5"});
  EXPECT_EQ(line.verb, Verb::kRender);
  EXPECT_EQ(line.render.scene, "hall.glb");
  EXPECT_EQ(line.render.out, "walk");
  EXPECT_EQ(line.render.size, "64x36");
  EXPECT_EQ(line.render.exposure, "-2");
  EXPECT_EQ(line.render.load.maxTriangles, "5");
  EXPECT_TRUE(line.render.maps);
  EXPECT_FALSE(line.render.overwrite);
  EXPECT_TRUE(line.console.quiet);
}

TEST(CommandLine, ReadsNegativeVelocitiesAndPairs) {
  EXPECT_EQ(parseCommandLine({"compare", "a", "b", "--velocity", "-3,4"}).compare.velocity, "-3,4");
  const CommandLine line = parseCommandLine({"path", "walk.json", "--to", "tum", "walk.txt"});
  EXPECT_EQ(line.path.to, (Arguments{"tum", "walk.txt"}));
}

TEST(CommandLine, TakesTheLastOfARepeatedOption) {
  EXPECT_EQ(parseCommandLine({"info", "a", "--log-level", "error", "--log-level", "debug"}).console.logLevel,
            "debug");
}

TEST(CommandLine, NamesTheNearestOfWhatIsUnknown) {
  expectRefused([] { (void)parseCommandLine({"rendr"}); }, "unknown verb 'rendr'; did you mean 'render'?");
  expectRefused(
      [] {
        (void)parseCommandLine({"render", "a.glb", "--out", "b", "--sise", "3x3"});
      },
      "unknown option '--sise'; did you mean '--size'?");
  expectRefused(
      [] {
        (void)parseCommandLine({"render", "a.glb", "--ot=b"});
      },
      "unknown option '--ot'; did you mean '--out'?");
  expectRefused([] { (void)parseCommandLine({"--verson"}); }, "did you mean '--version'?");
  expectRefused([] { (void)parseCommandLine({}); }, "expected a verb");
  expectRefused([] { (void)parseCommandLine({"render", "a.glb"}); }, "--out");
  expectRefused([] { (void)parseCommandLine({"info", "a.glb", "b.glb"}); }, "more arguments than expected");
  expectRefused([] { (void)parseCommandLine({"path", "a", "--to", "tum"}); }, "--to");
}

TEST(CommandLine, TakesOptionsFromAFileButTypedOnesWin) {
  const std::string file =
      writtenConfig("options.toml", "out = \"from-file\"\nfps = 12\nmaps = true\noverwrite = false\n");
  const CommandLine line = parseCommandLine({"render", "a.glb", "--config", file, "--fps", "30"});
  EXPECT_EQ(line.render.out, "from-file");
  EXPECT_EQ(line.render.fps, "30");
  EXPECT_TRUE(line.render.maps);
  EXPECT_FALSE(line.render.overwrite);
}

TEST(CommandLine, NamesTheNearestOfAnUnknownKey) {
  const std::string file = writtenConfig("unknown.json", R"({"toleranse": 3})");
  expectRefused(
      [&] {
        (void)parseCommandLine({"render", "a.glb", "--out", "b", "--config", file});
      },
      "toleranse: unknown key 'toleranse'; did you mean 'tolerance'?");
  const std::string flag = writtenConfig("flag.toml", "maps = 3\n");
  expectRefused(
      [&] {
        (void)parseCommandLine({"render", "a.glb", "--out", "b", "--config", flag});
      },
      "line 1: expected true or false, found '3'");
  expectRefused(
      [] {
        (void)parseCommandLine({"render", "a.glb", "--out", "b", "--config", "/nonexistent.toml"});
      },
      "/nonexistent.toml");
}

TEST(CommandLine, HelpHasAnExampleForEveryVerb) {
  for (const char* verb : {"render", "compare", "path", "encode", "info", "converge"}) {
    const CommandLine line = parseCommandLine({verb, "--help"});
    EXPECT_EQ(line.verb, Verb::kHelpOnly);
    EXPECT_THAT(line.text, testing::HasSubstr("Example:\n  promenade " + std::string(verb)));
    EXPECT_THAT(line.text, testing::HasSubstr("Usage: promenade " + std::string(verb) + " [OPTIONS]"));
  }
  EXPECT_THAT(parseCommandLine({"--help"}).text, testing::HasSubstr("compare"));
  EXPECT_THAT(parseCommandLine({"--version"}).text, testing::StartsWith("promenade "));
}

}  // namespace
}  // namespace promenade::app
