#include "src/app/config_file.h"

#include "tests/app/refused.h"

namespace promenade::app {
namespace {

const std::vector<std::string> kVerbs = {"render", "compare"};

std::vector<ConfigEntry> toml(const std::string& text) {
  return parseConfig(text, "job.toml", "render", kVerbs);
}
std::vector<ConfigEntry> json(const std::string& text) {
  return parseConfig(text, "job.json", "render", kVerbs);
}

std::string asText(const std::vector<ConfigEntry>& entries) {
  std::string text;
  for (const ConfigEntry& entry : entries) text += entry.key + "=" + entry.value + ";";
  return text;
}

TEST(Config, TomlGivesWhatStandsOutsideOfTablesAndInTheVerbsOwn) {
  EXPECT_EQ(asText(toml("# a job\nsize = \"640x360\"  # small\nfps=25\r\n\n[compare]\nppd = "
                        "30\n[render]\noverwrite = true\n"
                        "path = 'C:\\walk.json'\nvideo = \"a \\\"b\\\" \\\\ #c\"\n")),
            "size=640x360;fps=25;overwrite=true;path=C:\\walk.json;video=a \"b\" \\ #c;");
}

TEST(Config, JsonGivesTheSame) {
  EXPECT_EQ(asText(json(
                R"({"size": "640x360", "fps": 25, "compare": {"ppd": 30}, "render": {"overwrite": true}})")),
            "size=640x360;fps=25;overwrite=true;");
}

TEST(Config, NamesThePlaceOfEveryMistake) {
  expectRefused([] { (void)toml("fps = 25\nsize 640\n"); },
                "job.toml: line 2: expected KEY = VALUE, found 'size 640'");
  expectRefused([] { (void)toml("size = 640x360\n"); }, "line 1: expected a string in quotes");
  expectRefused([] { (void)toml("size = \"640\n"); }, "line 1: expected a string in quotes");
  expectRefused([] { (void)toml("size = \"640\" 3\n"); }, "line 1: expected a string in quotes");
  expectRefused([] { (void)toml("size = [1, 2]\n"); }, "line 1: expected a string in quotes");
  expectRefused([] { (void)toml("fps = 1\nfps = 2\n"); }, "line 2: the key 'fps' is given twice");
  expectRefused([] { (void)toml("[rendr]\n"); }, "line 1: unknown table 'rendr'; did you mean 'render'?");
  expectRefused([] { (void)toml("[render\n"); }, "line 1: expected ']'");
  expectRefused([] { (void)json("[1]"); }, "job.json: expected a JSON object of options");
  expectRefused([] { (void)json("{"); }, "job.json: expected a JSON object of options");
  expectRefused([] { (void)json(R"({"size": [1, 2]})"); },
                "job.json: size: expected a string, a number, true or false");
  expectRefused([] { (void)json(R"({"rendr": {}})"); }, "unknown table 'rendr'; did you mean 'render'?");
}

}  // namespace
}  // namespace promenade::app
