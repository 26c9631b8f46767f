// Versions, the log, the estimate, colours: what every user meets.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

#include "tests/e2e/tiny_scene.h"

namespace promenade::e2e {
namespace {

using testing::HasSubstr;
using testing::Not;

// What the program prints on a terminal.
std::string onTerminal(std::vector<std::string> arguments, const char* name, const char* value) {
  arguments.insert(arguments.begin(), PROMENADE_BINARY);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    setenv("TERM", "xterm", 1);
    unsetenv("NO_COLOR");
    setenv(name, value, 1);
    execv(argv[0], argv.data());
    _exit(127);
  }
  std::string text;
  std::array<char, 256> buffer{};
  for (ssize_t count = 0; (count = read(terminal, buffer.data(), buffer.size())) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  waitpid(child, nullptr, 0);
  close(terminal);
  return text;
}

class Everyday : public InFolder {
 protected:
  [[nodiscard]] Outcome rendered(const std::vector<std::string>& more) const {
    std::vector<std::string> all = {"render",        writeScene(folder_, "scene", With::kNoLight).string(),
                                    "--out",         at("out"),
                                    "--size",        "16x9",
                                    "--supersample", "1",
                                    "--spp",         "1",
                                    "--exposure",    "0",
                                    "--frames",      "0-4"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
};

TEST_F(Everyday, VersionNamesBuildAndLibraries) {
  const Outcome outcome = run({"--version"});
  expectDone(outcome);
  EXPECT_THAT(outcome.out, testing::StartsWith("promenade "));
  for (const char* name :
       {"revision", "build", "Embree", "OpenImageIO", "OpenEXR", "libavcodec", "FFTW", "TBB"}) {
    EXPECT_THAT(outcome.out, testing::ContainsRegex(std::string("\n  ") + name + " +[^ \n]")) << name;
  }
}

TEST_F(Everyday, TheLogTellsWhatWasSaidAndWhenEvenIfNothingWas) {
  expectDone(rendered({"--quiet"}));
  const std::string log = contents(at("out/promenade.log"));
  EXPECT_THAT(log, testing::ContainsRegex(
                       "^[0-9]{4}-[0-9]{2}-[0-9]{2} [0-9:]{8} info: promenade .*: promenade render "));
  EXPECT_THAT(log, HasSubstr("warning: "));  // the scene has no light
  EXPECT_THAT(log, HasSubstr("frames 5/5"));
  EXPECT_THAT(log, HasSubstr("for all 5 frames"));
  // A second run is added, and so is what ended it.
  EXPECT_EQ(rendered({"--resume", "--overwrite"}).status, 2);
  EXPECT_EQ(rendered({"--video", at("no/such/folder/walk.mp4"), "--overwrite"}).status, 2);
  const std::string both = contents(at("out/promenade.log"));
  EXPECT_THAT(both, testing::StartsWith(log));
  EXPECT_THAT(both, testing::ContainsRegex("error: .*no/such/folder"));
}

TEST_F(Everyday, AnEstimateComesAfterTheFirstKeyframe) {
  const Outcome outcome = rendered({});
  expectDone(outcome);
  EXPECT_THAT(outcome.err, testing::ContainsRegex("info: a keyframe takes [0-9.]+s: .* for all 5 frames"));
}

TEST_F(Everyday, ColoursAreForTerminals) {
  const std::vector<std::string> wrong = {"info", at("missing.glb")};
  EXPECT_THAT(run(wrong).err, Not(HasSubstr("\x1b[")));
  EXPECT_THAT(onTerminal(wrong, "TERM", "xterm"), HasSubstr("\x1b[31;1merror\x1b[m"));
  EXPECT_THAT(onTerminal(wrong, "TERM", "dumb"), Not(HasSubstr("\x1b[")));
  EXPECT_THAT(onTerminal(wrong, "NO_COLOR", "1"), Not(HasSubstr("\x1b[")));
}

// As `promenade ... | head` when head has ended: its work is done, its verdict stands, nothing is said.
TEST_F(Everyday, AReaderThatHasGoneIsNoError) {
  const auto withoutReader = [] {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) _exit(126);
    close(ends[0]);
    dup2(ends[1], STDOUT_FILENO);
  };
  for (const std::vector<std::string>& line :
       {std::vector<std::string>{"--help"}, {"--version"}, {"render", "--help"}}) {
    const Outcome outcome = run(line, withoutReader);
    EXPECT_EQ(outcome.status, 0) << line[0];
    EXPECT_EQ(outcome.err, "") << line[0];
  }
  expectDone(rendered({"--quiet"}));
  const Outcome same = run({"compare", at("out"), at("out"), "--quiet"}, withoutReader);
  EXPECT_EQ(same.status, 0);
  EXPECT_EQ(same.err, "");
}

TEST_F(Everyday, AStandardOutputThatIsFullIsAnError) {
  const Outcome outcome = run({"--help"}, [] { dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO); });
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("standard output: cannot write"));
}

}  // namespace
}  // namespace promenade::e2e
