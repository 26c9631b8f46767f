// Jobs divided for render farms: the plan, its template for queues, what is said to Slurm.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "src/app/farm_plan.h"
#include "src/app/open_job_description.h"
#include "src/app/slurm.h"
#include "src/app/subprocess.h"
#include "tests/app/refused.h"

namespace promenade::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;

walkthrough::Plan threeParts() {
  return {{0, 8, 0}, {8, 16, 0}, {16, 20, 0}};
}

walkthrough::Plan singleFrames(int count) {
  walkthrough::Plan frames;
  for (int frame = 0; frame < count; ++frame) frames.push_back({frame, frame, 0});
  return frames;
}

TEST(FarmPlan, HasTheKeyframesBetweenPartsAsTasksOfTheirOwn) {
  const auto tasks = tasksOf(threeParts());
  std::vector<std::string> described;
  for (const Task& task : tasks) described.push_back(describe(task));
  EXPECT_THAT(described, ElementsAre("light and exposure", "keyframe 8", "keyframe 16", "frames 0 to 8",
                                     "frames 8 to 16", "frames 16 to 20"));
  EXPECT_THAT(sharedKeyframes(tasks), ElementsAre(8, 16));
  const auto stages = stagesOf(tasks);
  ASSERT_EQ(stages.size(), 3u);
  EXPECT_EQ(stages[1].first, 1);
  EXPECT_EQ(stages[1].count, 2);
  EXPECT_EQ(stages[2].first, 3);
  EXPECT_EQ(stages[2].count, 3);
}

TEST(FarmPlan, OfAFullRenderSharesNothing) {
  const auto tasks = tasksOf(singleFrames(3));
  EXPECT_EQ(tasks.size(), 4u);
  EXPECT_TRUE(sharedKeyframes(tasks).empty());
}

TEST(FarmPlan, ComesBackFromItsFile) {
  const auto folder =
      std::filesystem::path(testing::TempDir()) / ("promenade-plan-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const FarmPlan plan{"0123", "/somewhere/else", {"a b.glb", "--size=32x18"}, tasksOf(threeParts())};
  writePlan(folder / "plan.json", plan);
  const FarmPlan read = readPlan(folder / "plan.json");
  EXPECT_EQ(read.jobHash, plan.jobHash);
  EXPECT_EQ(read.workingFolder, plan.workingFolder);
  EXPECT_EQ(read.arguments, plan.arguments);
  ASSERT_EQ(read.tasks.size(), plan.tasks.size());
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
    EXPECT_EQ(read.tasks[i].kind, plan.tasks[i].kind);
    EXPECT_EQ(read.tasks[i].part, plan.tasks[i].part);
  }
  std::ofstream(folder / "plan.json") << "{}";
  expectRefused([&] { (void)readPlan(folder / "plan.json"); }, "not a plan of this version");
  expectRefused([&] { (void)readPlan(folder / "no.json"); }, "promenade plan");
  std::filesystem::remove_all(folder);
}

TEST(FarmPlan, RemembersTheJobAndNotTheRun) {
  const auto options = parseCommandLine({"plan", "hall.glb", "--out", "walk", "--overwrite", "--maps",
                                         "--spp", "4", "--exposure=-1", "--quiet"})
                           .render;
  const auto arguments = argumentsOf(options);
  EXPECT_EQ(arguments.front(), "hall.glb");
  EXPECT_THAT(arguments, IsSupersetOf({"--maps=true", "--spp=4", "--exposure=-1", "--size=1280x720"}));
  std::vector<std::string> again{"render"};
  again.insert(again.end(), arguments.begin(), arguments.end());
  again.push_back("--out=elsewhere");
  const auto parsed = parseCommandLine(again).render;
  EXPECT_EQ(parsed.scene, "hall.glb");
  EXPECT_EQ(parsed.exposure, "-1");
  EXPECT_TRUE(parsed.maps);
  EXPECT_FALSE(parsed.overwrite);
}

TEST(OpenJobDescription, HasAStepAStageEachAfterTheOneBefore) {
  const auto root = openJobTemplate("walk", tasksOf(threeParts()));
  EXPECT_EQ(root["specificationVersion"], "jobtemplate-2023-09");
  const auto& steps = root["steps"];
  ASSERT_EQ(steps.size(), 4u);
  EXPECT_FALSE(steps[0].contains("dependencies"));
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(steps[i]["dependencies"][0]["dependsOn"], steps[i - 1]["name"]);
  }
  const auto range = [&](int step) {
    return steps[static_cast<std::size_t>(step)]["parameterSpace"]["taskParameterDefinitions"][0]["range"];
  };
  EXPECT_EQ(range(0), "0");
  EXPECT_EQ(range(1), "1-2");
  EXPECT_EQ(range(2), "3-5");
}

TEST(OpenJobDescription, NamesNoJobAfterAFormatString) {
  const auto root = openJobTemplate("{{Param.Folder}}", tasksOf(singleFrames(3)));
  EXPECT_THAT(root["name"].get<std::string>(), testing::Not(HasSubstr("{{")));
}

TEST(Slurm, ArraysAreNoLargerThanClustersAllow) {
  // 2500 parts of one frame, after one preparation: arrays of 1000, 1000 and 500.
  SubmitOptions options;
  options.cpus = "4";
  const auto tasks = tasksOf(singleFrames(2500));
  std::vector<int> all(tasks.size());
  std::iota(all.begin(), all.end(), 0);
  const auto submissions = submissionsOf(tasks, all, "/job", options);
  ASSERT_EQ(submissions.size(), 5u);
  EXPECT_THAT(submissions[0].arguments, IsSupersetOf({"--array=0", "--cpus-per-task=4"}));
  EXPECT_THAT(submissions[1].arguments, IsSupersetOf({"--array=0-999", "1"}));
  EXPECT_THAT(submissions[3].arguments, IsSupersetOf({"--array=0-499", "2001"}));
  EXPECT_EQ(submissions[1].stage, submissions[3].stage);
  EXPECT_GT(submissions[4].stage, submissions[3].stage);
}

TEST(Slurm, OnlyWhatIsMissingIsSubmittedAgain) {
  // 0: light, 1-2: keyframes 8 and 16, 3-5: parts.
  const auto submissions = submissionsOf(tasksOf(threeParts()), {3, 5}, "/job", {});
  ASSERT_EQ(submissions.size(), 2u);  // parts, assembly
  EXPECT_THAT(submissions[0].arguments, IsSupersetOf({"--array=0,2", "3"}));
  EXPECT_EQ(submissions[0].stage, 0);
  EXPECT_EQ(submissions[1].stage, 1);
  EXPECT_EQ(submissionsOf(tasksOf(threeParts()), {}, "/job", {}).size(), 1u);
  EXPECT_EQ(arrayOf({0, 1, 2, 5, 7, 8}), "0-2,5,7-8");
}

TEST(Slurm, ScriptsSurviveNamesWithQuotesAndBlanks) {
  EXPECT_THAT(taskScript("/opt/it's here/promenade", "/a b"),
              HasSubstr(R"(exec '/opt/it'\''s here/promenade' work '/a b' --task)"));
}

TEST(RunProgram, ReturnsWhatTheProgramSaidAndHowItEnded) {
  const auto said = runProgram({"sh", "-c", "echo one; echo two; exit 3"});
  EXPECT_EQ(said.output, "one\ntwo\n");
  EXPECT_EQ(said.status, 3);
  EXPECT_EQ(runProgram({"sh", "-c", "kill -9 $$"}).status, 128 + 9);
  expectRefused([] { (void)runProgram({"no-such-program-anywhere"}); }, "cannot run this program");
}

}  // namespace
}  // namespace promenade::app
