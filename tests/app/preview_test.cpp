#include "src/app/preview_run.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/app/refused.h"

namespace promenade::app {
namespace {

// Before anything is read: there is no such scene.
void refuse(const std::string& seconds, const std::vector<std::string>& more, const std::string& part) {
  std::vector<std::string> arguments = {"render",  "no-such-scene.gltf", "--out",
                                        "nowhere", "--preview",          seconds};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const CommandLine line = parseCommandLine(arguments);
  Console console({.quiet = true});
  expectRefused([&] { (void)runPreview(line.render, console); }, part);
}

TEST(Preview, AsksForANumberOfSeconds) {
  for (const char* seconds : {"0", "-1", "nan", "inf", "soon", "5s", "1e9"}) {
    SCOPED_TRACE(seconds);
    refuse(seconds, {}, "--preview: expected");
  }
}

TEST(Preview, RefusesOptionsOfAWalkAndOfAFixedNumberOfPaths) {
  using Arguments = std::vector<std::string>;
  for (const Arguments& more :
       {Arguments{"--method", "full"}, Arguments{"--spp", "4"}, Arguments{"--tolerance", "5"},
        Arguments{"--spacing", "8"}, Arguments{"--verify", "0"}, Arguments{"--filter", "temporal"},
        Arguments{"--filter-radius", "2"}, Arguments{"--video", "a.mp4"}, Arguments{"--maps"},
        Arguments{"--resume"}, Arguments{"--overwrite"}, Arguments{"--from", "frames"},
        Arguments{"--renderer", "true {camera} {out}"}}) {
    SCOPED_TRACE(more.front());
    refuse("1", more, more.front() + ": not with --preview");
  }
}

}  // namespace
}  // namespace promenade::app
