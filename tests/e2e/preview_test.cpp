// `promenade render --preview SECONDS` from the outside. Nothing here depends on how fast the machine is.

#include <gmock/gmock.h>

#include "src/core/display.h"
#include "src/io/exr_frame.h"
#include "tests/e2e/tiny_scene.h"

namespace promenade::e2e {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Arguments = std::vector<std::string>;

class Preview : public InFolder {
 protected:
  [[nodiscard]] Outcome preview(const std::string& seconds, const Arguments& more = {}) const {
    Arguments all = {"render",        (folder_ / "scene.gltf").string(),
                     "--out",         at("out"),
                     "--size",        "32x18",
                     "--supersample", "1",
                     "--exposure",    "0",
                     "--preview",     seconds};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
};

TEST_F(Preview, WritesOnePictureOfTheFirstFrame) {
  writeScene(folder_, "scene", With::kAll);
  const Outcome outcome = preview("0.2", {"--frames", "3-20"});
  expectDone(outcome);
  EXPECT_THAT(outcome.out, HasSubstr("preview.png: frame 3 after"));
  EXPECT_THAT(outcome.out, HasSubstr("\nstage "));
  const io::FrameFile frame = io::readFrame(at("out/preview.exr"));
  EXPECT_EQ(frame.metadata.frame, 3);
  EXPECT_EQ(frame.radiance.size(), (Size{32, 18}));
  EXPECT_FALSE(frame.depth.empty());
  EXPECT_GT(luminance(frame.radiance(16, 9)), 0.0f);
  EXPECT_TRUE(fs::exists(at("out/preview.png")));
  EXPECT_FALSE(fs::exists(at("out/frames")));
  expectOnlyWholeFiles(folder_);
}

TEST_F(Preview, OfNearlyNoTimeIsAPictureAllTheSame) {
  writeScene(folder_, "scene", With::kAll);
  const Outcome outcome = preview("0.01");
  expectDone(outcome);
  EXPECT_THAT(outcome.out, HasSubstr("frame 0 after"));
  EXPECT_TRUE(fs::exists(at("out/preview.png")));
}

TEST_F(Preview, LeavesTheWalkInItsFolderAlone) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  const Arguments walk = {"render",     scene, "--out",         at("out"), "--size", "32x18",
                          "--frames",   "0-1", "--supersample", "1",       "--spp",  "1",
                          "--exposure", "0",   "--quiet"};
  expectDone(preview("0.2"));
  expectDone(run(walk));
  const std::string frame = contents(at("out/frames/000000.exr"));
  const std::string light = contents(at("out/light-solution.bin"));
  const Outcome known = preview("0.01");
  expectDone(known);
  EXPECT_THAT(known.out, HasSubstr("stage 3 of 3, light solution"));  // by the walk's light, at once
  EXPECT_EQ(contents(at("out/frames/000000.exr")), frame);
  EXPECT_EQ(contents(at("out/light-solution.bin")), light);
  EXPECT_THAT(run(walk).out, HasSubstr("all frames of this job are there"));
}

TEST_F(Preview, IsMadeOfPathsAloneWhereThatIsAskedFor) {
  writeScene(folder_, "scene", With::kAll);
  const Outcome outcome = preview("0.2", {"--integrator", "path"});
  expectDone(outcome);
  EXPECT_THAT(outcome.out, HasSubstr("stage 1 of 3, path tracing"));
}

TEST_F(Preview, RefusesWhatMakesNoSense) {
  writeScene(folder_, "scene", With::kAll);
  expectRefused(preview("soon"), "--preview: expected");
  expectRefused(preview("1", {"--method", "full"}), "--method: not with --preview");
  EXPECT_FALSE(fs::exists(at("out")));
  expectRefused(run({"plan", at("scene.gltf"), "--out", at("out"), "--preview", "1"}),
                "unknown option '--preview'");
}

}  // namespace
}  // namespace promenade::e2e
