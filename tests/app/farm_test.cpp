// Jobs divided for render farms: the plan, and its template for queues.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "src/app/farm_plan.h"
#include "src/app/open_job_description.h"
#include "tests/app/refused.h"

namespace promenade::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;

walkthrough::Settings walkOf(int frames, int spacing) {
  walkthrough::Settings settings;
  settings.frames = {0, frames - 1};
  settings.keyframeSpacing = spacing;
  return settings;
}

TEST(FarmPlan, HasTheKeyframesBetweenPartsAsTasksOfTheirOwn) {
  // 0-8, 8-16, 16-20: shared are 8 and 16.
  const auto tasks = tasksOf(walkOf(21, 8));
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
  walkthrough::Settings settings = walkOf(3, 8);
  settings.method = walkthrough::Method::kFull;
  const auto tasks = tasksOf(settings);
  EXPECT_EQ(tasks.size(), 4u);
  EXPECT_TRUE(sharedKeyframes(tasks).empty());
}

TEST(FarmPlan, ComesBackFromItsFile) {
  const auto folder =
      std::filesystem::path(testing::TempDir()) / ("promenade-plan-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const FarmPlan plan{"0123", "/somewhere/else", {"a b.glb", "--size=32x18"}, tasksOf(walkOf(21, 8))};
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
  const auto root = openJobTemplate("walk", tasksOf(walkOf(21, 8)));
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
  const auto root = openJobTemplate("{{Param.Folder}}", tasksOf(walkOf(3, 8)));
  EXPECT_THAT(root["name"].get<std::string>(), testing::Not(HasSubstr("{{")));
}

}  // namespace
}  // namespace promenade::app
