#include "src/app/preview_run.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/app/refused.h"

namespace promenade::app {
namespace {

// Before anything is read: there is no such scene.
void refusePreview(const std::string& seconds, const std::vector<std::string>& more,
                   const std::string& part) {
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
    refusePreview(seconds, {}, "--preview: expected");
  }
}

TEST(Preview, RefusesOptionsOfAWalkAndOfAFixedNumberOfPaths) {
  using Words = std::vector<std::string>;
  for (const Words& more :
       {Words{"--method", "full"}, Words{"--spp", "4"}, Words{"--tolerance", "5"}, Words{"--spacing", "8"},
        Words{"--verify", "0"}, Words{"--footprint-limit", "4"}, Words{"--filter", "temporal"},
        Words{"--filter-radius", "2"}, Words{"--video", "a.mp4"}, Words{"--maps"}, Words{"--resume"},
        Words{"--overwrite"}, Words{"--from", "frames"}, Words{"--renderer", "true {camera} {out}"}}) {
    SCOPED_TRACE(more.front());
    refusePreview("1", more, more.front() + ": not with --preview");
  }
}

}  // namespace
}  // namespace promenade::app
