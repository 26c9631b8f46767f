// A job on a real Slurm cluster of two nodes: a task that is killed and given back to the queue, one that
// fails.

#include <signal.h>

#include <thread>

#include "tests/e2e/slurm_cluster.h"
#include "tests/e2e/tiny_scene.h"

namespace promenade::e2e {
namespace {

using Arguments = std::vector<std::string>;
using testing::HasSubstr;

class Slurm : public InFolder {};

// The number of a job that renders a part now; empty if none begins in time.
std::string runningPart() {
  for (int i = 0; i < 600; ++i) {
    const std::string jobs = outputOf("squeue --noheader --states=RUNNING --name=promenade-part --format=%A");
    if (!jobs.empty()) return jobs.substr(0, jobs.find('\n'));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return {};
}

TEST_F(Slurm, RendersWhatALocalRunRendersThoughATaskIsKilledAndRequeued) {
  const SlurmCluster cluster;
  if (!cluster.reason().empty()) GTEST_SKIP() << "SKIPPED: " << cluster.reason();
  const auto scene = writeScene(folder_, "scene", With::kAll);
  const auto job = [&](const std::string& verb, const std::string& out) {
    return Arguments{verb,        scene, "--out", out,  "--size",      "160x90", "--supersample", "1",
                     "--spacing", "8",   "--spp", "16", "--tolerance", "0",      "--integrator",  "path"};
  };
  expectDone(run(job("render", at("local"))));
  expectDone(run(job("plan", at("farm"))));
  {
    Process submit({"submit", at("farm"), "--slurm"});
    const std::string part = runningPart();
    ASSERT_NE(part, "") << outputOf("squeue");
    EXPECT_EQ(outputOf("scontrol requeue " + part + " && echo requeued"), "requeued\n");
    EXPECT_THAT(outputOf("scontrol show job " + part), HasSubstr("Restarts=1"));
    submit.send(SIGINT);
    const Outcome interrupted = submit.wait(std::chrono::seconds(20));
    EXPECT_EQ(interrupted.status, 130);
    EXPECT_THAT(interrupted.err, HasSubstr("the jobs go on"));
  }
  Process again({"submit", at("farm"), "--slurm"});
  const Outcome outcome = again.wait(std::chrono::seconds(150));
  expectDone(outcome);
  EXPECT_THAT(outcome.out, HasSubstr("already in the queue"));
  expectSameResult(at("farm"), at("local"));
  EXPECT_THAT(run({"submit", at("farm"), "--slurm"}).out, HasSubstr("done already"));
}

TEST_F(Slurm, TellsOfTasksThatFailedAndGoesOnWithThem) {
  const SlurmCluster cluster;
  if (!cluster.reason().empty()) GTEST_SKIP() << "SKIPPED: " << cluster.reason();
  const auto scene = writeScene(folder_, "scene", With::kAll);
  expectDone(run({"plan", scene, "--out", at("farm"), "--size", "16x9", "--spp", "1", "--frames", "0-1"}));
  const std::string planned = contents(scene);
  writeText(scene, planned + "\n");  // no longer the job that was planned
  const Outcome failed = Process({"submit", at("farm"), "--slurm"}).wait(std::chrono::seconds(60));
  EXPECT_EQ(failed.status, 3);
  EXPECT_THAT(failed.error(), HasSubstr("tasks are not done: 0,1"));
  EXPECT_THAT(outputOf("cat " + at("farm") + "/slurm/promenade-prepare-*.txt"),
              HasSubstr("is not the one that was planned"));
  writeText(scene, planned);
  const Outcome outcome = Process({"submit", at("farm"), "--slurm"}).wait(std::chrono::seconds(60));
  expectDone(outcome);
  EXPECT_THAT(outcome.out, HasSubstr("2 of 2 tasks submitted"));
}

TEST_F(Slurm, IsMissedWithOneClearLine) {
  const auto scene = writeScene(folder_, "scene", With::kAll);
  expectDone(run({"plan", scene, "--out", at("farm"), "--size", "16x9", "--spp", "1", "--frames", "0-1"}));
  expectRefused(Process({"submit", at("farm"), "--slurm"}, [] { setenv("PATH", "/nowhere", 1); }).wait(),
                "sbatch: cannot run this program");
  expectRefused(run({"submit", at("farm")}), "expected --slurm");
}

}  // namespace
}  // namespace promenade::e2e
