// A job that was stopped, however, ends as if it had not been.

#include <signal.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "tests/e2e/small_disk.h"
#include "tests/e2e/tiny_scene.h"

namespace promenade::e2e {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;
using Seconds = std::chrono::duration<double>;

// Lasts long enough to be stopped midway; `more` is appended.
Arguments stoppable(const std::string& scene, const std::string& out, const Arguments& more) {
  Arguments all = {"render",        scene, "--out", out, "--size",     "48x27",
                   "--supersample", "1",   "--spp", "2", "--exposure", "0"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

class Resume : public InFolder {};

TEST_F(Resume, AfterThirtyKillsAtRandomMomentsEndsLikeOneRun) {
  std::mt19937 random(1);
  const auto scene = writeScene(folder_, "scene", With::kAll);
  const std::vector<Arguments> jobs = {
      {"--spacing", "4", "--tolerance", "0", "--integrator", "path"},
      {"--spacing", "8", "--exposure", "auto", "--maps", "--integrator", "path"},
      {"--spacing", "6", "--integrator", "walkthrough", "--frames", "0-12", "--spp", "auto"},
      {"--method", "full", "--integrator", "path"},
  };
  int kills = 0;
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    const std::string whole = at("whole" + std::to_string(k));
    const auto start = std::chrono::steady_clock::now();
    expectDone(run(stoppable(scene, whole, jobs[k])));
    const Seconds duration = std::chrono::steady_clock::now() - start;
    // Moments from before the first frame to after the last; the job is begun anew when it got to its end.
    std::uniform_real_distribution<double> moment(0.0, 0.9 * duration.count());
    const std::string out = at("out" + std::to_string(k));
    const int wanted = kills + (k + 1 < jobs.size() ? 8 : 30 - kills);
    for (int attempts = 0; kills < wanted && attempts < 100; ++attempts) {
      Process process(stoppable(scene, out, jobs[k]));
      std::this_thread::sleep_for(Seconds(moment(random)));
      process.send(SIGKILL);
      const Outcome outcome = process.wait();
      if (outcome.signal == SIGKILL) {
        ++kills;
        continue;
      }
      expectDone(outcome);
      expectSameResult(out, whole);
      fs::remove_all(out);
    }
    expectDone(run(stoppable(scene, out, jobs[k])));
    expectSameResult(out, whole);
    if (HasFailure()) return;
  }
  EXPECT_EQ(kills, 30);
}

TEST_F(Resume, ClearsAwayWhatAKilledRunWasWriting) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  const Arguments job = {"--frames", "0-4", "--maps", "--integrator", "path"};
  expectDone(run(stoppable(scene, at("whole"), job)));
  expectDone(run(stoppable(scene, at("out"), job)));
  // Of a process whose number is larger than any that Linux gives.
  for (const char* part : {"", "frames/", "parts/", "maps/"}) {
    writeText(at(std::string("out/") + part + ".000002.exr.4194305-0.promenade-tmp"), "half a file");
  }
  expectDone(run(stoppable(scene, at("out"), job)));
  expectSameResult(at("out"), at("whole"));
}

TEST_F(Resume, AfterAFullDiskGoesOnWhenThereIsRoom) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  const SmallDisk disk(at("disk"), "128k");
  if (!disk) GTEST_SKIP() << "SKIPPED: a small file system cannot be mounted here";
  const Arguments job = {"--spacing", "4", "--size", "128x72", "--integrator", "path"};
  expectDone(run(stoppable(scene, at("whole"), job)));
  EXPECT_EQ(run(stoppable(scene, at("disk/out"), job)).status, 3);
  EXPECT_GT(framesIn(at("disk/out")), 0);
  ASSERT_LT(framesIn(at("disk/out")), 25);
  ASSERT_TRUE(disk.resize("64m"));
  expectDone(run(stoppable(scene, at("disk/out"), job)));
  expectSameResult(at("disk/out"), at("whole"));
}

TEST_F(Resume, MakesAgainWhatIsMissingOrDamagedAndNothingElse) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  const Arguments job = {"--spacing", "8"};  // parts 0-8, 8-16, 16-24
  expectDone(run(stoppable(scene, at("whole"), job)));
  expectDone(run(stoppable(scene, at("out"), job)));
  const auto frameTime = [&](const char* frame) {
    return fs::last_write_time(at("out/frames") + "/" + frame);
  };
  const auto firstBefore = frameTime("000001.exr");
  const auto lastBefore = frameTime("000020.exr");
  fs::remove(at("out/frames/000010.exr"));
  fs::remove(at("out/report.json"));
  fs::remove(at("out/light-solution.bin"));
  expectDone(run(stoppable(scene, at("out"), job)));
  expectSameResult(at("out"), at("whole"));
  writeText(at("out/parts/000008.json"), contents(at("out/parts/000008.json")).substr(0, 100));
  expectDone(run(stoppable(scene, at("out"), job)));
  expectSameResult(at("out"), at("whole"));
  EXPECT_EQ(frameTime("000001.exr"), firstBefore);
  EXPECT_EQ(frameTime("000020.exr"), lastBefore);
}

TEST_F(Resume, WithAnotherLightIsRefused) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  const Arguments job = {"--integrator", "walkthrough",      "--frames",
                         "0-4",          "--light-solution", at("light.bin")};
  expectDone(run(stoppable(scene, at("out"), job)));
  fs::remove(at("out/frames/000002.exr"));
  std::ofstream(at("light.bin"), std::ios::app) << "more";
  expectRefused(run(stoppable(scene, at("out"), job)), "is not the light that this job began with");
}

TEST_F(Resume, KnowsAnotherJobByEverythingThatDecidesItsPixels) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  expectDone(run(stoppable(scene, at("out"), {"--frames", "0-2"})));
  const auto refused = [&](const Arguments& more) {
    Arguments job = {"--frames", "0-2"};
    job.insert(job.end(), more.begin(), more.end());
    expectRefused(run(stoppable(scene, at("out"), job)), "holds frames of another job");
  };
  refused({"--seed", "1"});
  refused({"--sky"});
  refused({"--tone", "linear"});
  refused({"--exposure", "1"});
  refused({"--spp", "4"});
  refused({"--integrator", "path"});
  refused({"--display", "phone"});
  // A material: the geometry is the same.
  auto root = nlohmann::json::parse(contents(scene));
  root["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][0] = 0.7;
  writeText(scene, root.dump());
  refused({});
}

TEST_F(Resume, DoesNotAskForTheSameWhereThePixelsAre) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  expectDone(run(stoppable(scene, at("out"), {"--frames", "0-2"})));
  const Outcome again =
      run(stoppable(scene, at("out"), {"--frames", "0-2", "--threads", "1", "--tone", "neutral", "--quiet"}));
  EXPECT_THAT(again.out, testing::HasSubstr("all frames of this job are there"));
}

}  // namespace
}  // namespace promenade::e2e
