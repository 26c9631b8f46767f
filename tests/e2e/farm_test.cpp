// plan, work, assemble from the outside: what many machines make together is what one makes alone.

#include <signal.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/e2e/tiny_scene.h"

namespace promenade::e2e {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;
using testing::HasSubstr;

Arguments job(const std::string& verb, const std::string& scene, const std::string& out,
              const Arguments& more) {
  Arguments all = {verb, scene, "--out", out, "--size", "64x36", "--supersample", "1", "--spp", "2"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

int tasksIn(const std::string& folder) {
  return static_cast<int>(nlohmann::json::parse(contents(folder + "/plan.json"))["tasks"].size());
}

Outcome work(const std::string& folder, int task) {
  return run({"work", folder, "--task", std::to_string(task), "--quiet"});
}

class Farm : public InFolder {};

TEST_F(Farm, MakesWhatALocalRunMakesInAnyOrderAndAnyNumberOfTimes) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  const std::vector<Arguments> jobs = {
      {"--spacing", "6", "--tolerance", "0", "--maps"},
      {"--spacing", "8", "--frames", "0-16", "--spp", "auto"},
      {"--method", "full", "--frames", "3-7"},
  };
  std::mt19937 random(7);
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    const std::string local = at("local" + std::to_string(k));
    const std::string farm = at("farm" + std::to_string(k));
    expectDone(run(job("render", scene, local, jobs[k])));
    expectDone(run(job("plan", scene, farm, jobs[k])));
    std::vector<int> order(static_cast<std::size_t>(tasksIn(farm)));
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
    std::shuffle(order.begin(), order.end(), random);
    for (const int task : order) expectDone(work(farm, task));
    EXPECT_THAT(work(farm, order.front()).out, HasSubstr("done already"));
    expectDone(run({"assemble", farm}));
    expectSameResult(farm, local);
    if (HasFailure()) return;
  }
}

TEST_F(Farm, TracesSharedKeyframesOnce) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  expectDone(run(job("plan", scene, at("farm"), {"--spacing", "12", "--frames", "0-24"})));
  expectDone(work(at("farm"), 1));  // keyframe 12, without the preparation: it prepares for itself
  const auto written = fs::last_write_time(at("farm/keyframes/000012.exr"));
  for (int task = 0; task < tasksIn(at("farm")); ++task) expectDone(work(at("farm"), task));
  EXPECT_EQ(fs::last_write_time(at("farm/keyframes/000012.exr")), written);
  expectDone(run({"assemble", at("farm")}));
  EXPECT_FALSE(fs::exists(at("farm/keyframes")));
  // What a local run would say: the folder is finished.
  const Outcome local = run(job("render", scene, at("farm"), {"--spacing", "12", "--frames", "0-24"}));
  EXPECT_THAT(local.out, HasSubstr("all frames of this job are there"));
}

TEST_F(Farm, SaysWhichTasksAreMissing) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  expectDone(run(job("plan", scene, at("farm"), {"--spacing", "12"})));  // 0, key 12, 0-12, 12-24
  expectDone(work(at("farm"), 2));
  expectRefused(run({"assemble", at("farm")}), "1 of 4 tasks are not done: 3");
  expectRefused(run({"work", at("farm"), "--task", "4"}), "--task");
  expectRefused(run({"work", at("nowhere"), "--task", "0"}), "promenade plan");
}

TEST_F(Farm, RefusesAJobThatChangedSinceItWasPlanned) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  expectDone(run(job("plan", scene, at("farm"), {"--frames", "0-4"})));
  writeText(scene, contents(scene) + "\n");
  expectRefused(work(at("farm"), 0), "is not the one that was planned");
}

TEST_F(Farm, ATaskThatWasKilledIsDoneAgain) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  const Arguments options = {"--spacing", "24", "--size", "160x90"};
  expectDone(run(job("render", scene, at("local"), options)));
  expectDone(run(job("plan", scene, at("farm"), options)));
  expectDone(work(at("farm"), 0));
  {
    Process process({"work", at("farm"), "--task", "1"});
    waitForFrames(at("farm"));
    process.send(SIGKILL);
    EXPECT_EQ(process.wait().signal, SIGKILL);
  }
  expectRefused(run({"assemble", at("farm")}), "1 of 2 tasks are not done: 1");
  expectDone(work(at("farm"), 1));
  expectDone(run({"assemble", at("farm")}));
  expectSameResult(at("farm"), at("local"));
}

}  // namespace
}  // namespace promenade::e2e
