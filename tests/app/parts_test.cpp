#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "src/app/compare_report.h"
#include "src/app/displays.h"
#include "src/app/fingerprint.h"
#include "src/app/machine.h"
#include "src/app/motion.h"
#include "src/app/output_folder.h"
#include "src/app/path_choice.h"
#include "src/app/progress_line.h"
#include "src/io/exr_frame.h"
#include "tests/app/refused.h"

namespace promenade::app {
namespace {

TEST(ProgressLine, SaysDoneTotalRateAndTimeLeft) {
  EXPECT_EQ(progressLine({"frames", 0, 200}, 5.0), "frames 0/200  0%");
  // 50 in 10 s: 5/s, 150 left: 30 s.
  EXPECT_EQ(progressLine({"frames", 50, 200}, 10.0), "frames 50/200  25%  5.0/s  30s left");
  // 2 in 61 s: 30.5 s each, 3 left: 91.5 s.
  EXPECT_EQ(progressLine({"frames", 2, 5}, 61.0), "frames 2/5  40%  30.5s each  1m 32s left");
  EXPECT_EQ(progressLine({"frames", 200, 200}, 100.0), "frames 200/200  100%  2.0/s");
  EXPECT_EQ(duration(7384.0), "2h 03m");
}

TEST(ProgressLine, BarFitsTheTerminal) {
  EXPECT_THAT(progressBar({"frames", 50, 200}, 10.0, 120),
              testing::HasSubstr("[##########..............................]"));
  for (int columns = 1; columns < 120; ++columns) {
    EXPECT_LT(static_cast<int>(progressBar({"frames", 50, 200}, 10.0, columns).size()), std::max(columns, 2))
        << columns;
  }
}

TEST(Displays, DefaultIsA24InchFullHdMonitorAt60Centimetres) {
  // 0.61 m / sqrt(1920^2 + 1080^2) = 0.27691 mm a pixel; 600 mm * tan(1 deg) = 10.4730 mm: 37.82 pixels.
  EXPECT_NEAR(displayNamed("fhd-24").pixelsPerDegree(), 37.82, 0.01);
  EXPECT_EQ(displayNamed("crt-100").peakLuminance, 100.0);
  expectRefused([] { (void)displayNamed("fhd24"); }, "did you mean 'fhd-24'?");
  EXPECT_THAT(displayList(), testing::HasSubstr("phone"));
  EXPECT_THAT(displayList(), testing::HasSubstr("1920x1080, 37.8 pixels/degree, 0.25 to 250 cd/m2, 50 lux"));
}

TEST(Displays, AnEmptyDescriptionIsTheDefaultPreset) {
  const DisplayModel preset = displayNamed("fhd-24");
  const DisplayModel empty = displayFromJson("{}", "fhd-24");
  EXPECT_EQ(empty.resolution, preset.resolution);
  EXPECT_EQ(empty.diagonalMetres, preset.diagonalMetres);
  EXPECT_EQ(empty.viewingDistanceMetres, preset.viewingDistanceMetres);
  EXPECT_EQ(empty.luminanceOf(Rgb(0.0f)), preset.luminanceOf(Rgb(0.0f)));
  EXPECT_EQ(empty.luminanceOf(Rgb(0.5f)), preset.luminanceOf(Rgb(0.5f)));
  EXPECT_EQ(empty.luminanceOf(Rgb(1.0f)), preset.luminanceOf(Rgb(1.0f)));
}

// Black plus E rho / pi, with the ambient light E in lux: 0.5 + 0 for the tube in a dark room; 0.001 + 250 *
// 0.005 / pi = 0.399 for the telephone, whose black is all reflection.
TEST(Displays, AmbientLightRaisesBlack) {
  EXPECT_NEAR(displayNamed("crt-100").luminanceOf(Rgb(0.0f)), 0.5, 1e-6);
  EXPECT_NEAR(displayNamed("phone").luminanceOf(Rgb(0.0f)), 0.3989, 1e-4);
}

TEST(Displays, MayBeDescribedInJson) {
  const DisplayModel d =
      displayFromJson(R"({"name":"x","resolution":[100,50],"peak":500,"transfer":"linear"})", "d.json");
  EXPECT_EQ(d.resolution, (Size{100, 50}));
  EXPECT_EQ(d.peakLuminance, 500.0);
  EXPECT_EQ(d.transfer, TransferFunction::kLinear);
  EXPECT_EQ(d.viewingDistanceMetres, 0.6);
  expectRefused([] { (void)displayFromJson(R"({"peek":500})", "d.json"); },
                "d.json: unknown key 'peek'; did you mean 'peak'?");
  expectRefused([] { (void)displayFromJson(R"({"peak":-1})", "d.json"); }, "peak: expected a number from");
  expectRefused([] { (void)displayFromJson(R"({"peak":1,"black":2})", "d.json"); },
                "black: expected less than");
  expectRefused([] { (void)displayFromJson("[]", "d.json"); }, "expected a JSON object");
}

TEST(Displays, MayHaveAGammaAndPrimariesOfTheirOwn) {
  const DisplayModel d = displayFromJson(
      R"({"transfer":"gamma2.35","signal":"native",
          "primaries":{"red":[0.625,0.34],"green":[0.28,0.595],"blue":[0.155,0.07],"white":[0.283,0.298]}})",
      "d.json");
  EXPECT_EQ(d.transfer, TransferFunction::kGamma);
  EXPECT_EQ(d.gamma, 2.35);
  EXPECT_EQ(d.signal, Signal::kNative);
  EXPECT_EQ(d.primaries.green, glm::dvec2(0.28, 0.595));
  EXPECT_EQ(displayNamed("crt-100").gamma, 2.2);
  const auto refused = [](const std::string& json, const std::string& why) {
    expectRefused([&] { (void)displayFromJson(json, "d.json"); }, "d.json: " + why);
  };
  refused(R"({"transfer":"gamma0.5"})",
          "transfer: expected 'srgb', 'linear' or 'gamma2.2', with any gamma from 1 to 4");
  refused(R"({"transfer":"gamma2.2x"})", "transfer: expected");
  refused(R"({"transfer":2.2})", "transfer: expected");
  refused(R"({"signal":"own"})", "signal: expected 'srgb' or 'native'");
  refused(R"({"primaries":[1,2]})", "primaries: expected an object");
  refused(R"({"primaries":{"red":[0.6,0.3]}})", "primaries: there is no green");
  refused(R"({"primaries":{"rot":[0.6,0.3]}})", "primaries: unknown key 'rot'; did you mean 'red'?");
  refused(R"({"primaries":{"red":[0.6],"green":[0.3,0.6],"blue":[0.15,0.06],"white":[0.31,0.33]}})",
          "primaries.red: expected a chromaticity [x, y]");
  refused(R"({"primaries":{"red":[0.6,0.3],"green":[0.3,0.6],"blue":[0.15,0.06],"white":[0.6,0.39]}})",
          "primaries: expected red, green and blue of a triangle with white inside of it");
}

TEST(Machine, RefusesMoreMemoryThanThereIsWithBothNumbers) {
  EXPECT_NO_THROW(requireMemory(8e9, 8e9));
  expectRefused([] { requireMemory(9.24e12, 8e9); }, "need 9240.0 GB of memory and this machine has 8.0 GB");
  EXPECT_GT(availableMemoryBytes(), 1e8);
  EXPECT_GT(peakResidentBytes(), 1e6);
}

TEST(Motion, FollowsEveryPixelOfThePreviousFrameToWhereItGoes) {
  // Three pixels in a row: the first goes two to the right, the second leaves the image, the third is not
  // known.
  PixelFlow flow(3, 1);
  flow(0, 0) = {2.2f, 0.0f};
  flow(1, 0) = {5.0f, 0.0f};
  flow(2, 0) = glm::vec2(std::numeric_limits<float>::quiet_NaN());
  const PixelFlow back = flowToPrevious(flow);
  EXPECT_TRUE(std::isnan(back(0, 0).x));
  EXPECT_TRUE(std::isnan(back(1, 0).x));
  EXPECT_EQ(back(2, 0), glm::vec2(-2.2f, 0.0f));
}

TEST(Motion, MeanOfTwoFlowsDoesNotDependOnTheirOrder) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  PixelFlow a(2, 1, glm::vec2(1.0f, 3.0f));
  PixelFlow b(2, 1, glm::vec2(2.0f, 0.0f));
  b(1, 0) = glm::vec2(nan);
  for (const PixelFlow& mean : {meanFlow(a, b), meanFlow(b, a)}) {
    EXPECT_EQ(mean(0, 0), glm::vec2(1.5f, 1.5f));
    EXPECT_EQ(mean(1, 0), glm::vec2(1.0f, 3.0f));
  }
  EXPECT_EQ(meanFlow(a, PixelFlow())(0, 0), a(0, 0));
  EXPECT_TRUE(isStill(PixelFlow(3, 3)));
  EXPECT_FALSE(isStill(a));
  EXPECT_FALSE(isStill(PixelFlow()));
}

SequenceDifference twoDifferences() {
  SequenceDifference d;
  d.test = "a";
  d.reference = "b";
  d.pixelsPerDegree = 40.0;
  d.framesPerSecond = 25.0;
  d.frames = {{.index = 0,
               .percentVisible = 1.0,
               .jndMean = 0.5,
               .jndMax = 3.0,
               .pooledJndMax = 2.0,
               .probabilityMean = 0.1},
              {.index = 1,
               .percentVisible = 4.0,
               .jndMean = 1.5,
               .jndMax = 2.0,
               .pooledJndMax = 1.0,
               .probabilityMean = 0.2}};
  return d;
}

TEST(CompareReport, JsonHasExactlyTheStableKeys) {
  const auto root = nlohmann::json::parse(differenceJson(twoDifferences()));
  EXPECT_EQ(root, nlohmann::json::parse(R"({"metric":"aqm","ppd":40.0,"fps":25.0,"frames":[
      {"index":0,"percent_visible":1.0,"jnd_mean":0.5,"jnd_max":3.0,"pooled_jnd_max":2.0,"probability_mean":0.1},
      {"index":1,"percent_visible":4.0,"jnd_mean":1.5,"jnd_max":2.0,"pooled_jnd_max":1.0,"probability_mean":0.2}],
      "percent_visible_mean":2.5,"percent_visible_worst":4.0,"worst_frame":1})"));
}

TEST(CompareReport, SummaryIsOneLineWithMeanWorstAndJnd) {
  EXPECT_EQ(differenceSummary(twoDifferences()),
            "a against b, 2 frames: 2.500% of pixels visibly different (worst frame 1: 4.000%), JND mean "
            "1.0000, max 3.000\n");
}

TEST(CompareReport, CsvHasALineAFrame) {
  EXPECT_EQ(differenceCsv(twoDifferences()),
            "index,percent_visible,jnd_mean,jnd_max,pooled_jnd_max,probability_mean\n0,1,0.5,3,2,0.1\n1,4,1."
            "5,2,1,0.2\n");
}

TEST(CompareReport, EqualImagesHaveAnInfinitePsnrThatJsonWritesAsNull) {
  SequenceDifference d = twoDifferences();
  d.metric = Metric::kPsnr;
  for (FrameDifference& f : d.frames) f.psnr = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(nlohmann::json::parse(differenceJson(d))["psnr_worst"].is_null());
}

Scene sceneWithCameras() {
  Scene scene;
  scene.source = "hall.glb";
  CameraAnimation rest;
  rest.cameraName = "door";
  rest.rootToCamera.emplace_back();
  CameraAnimation walk = rest;
  walk.name = "stroll";
  walk.rootToCamera[0].translationTrack =
      Track<glm::vec3>{Interpolation::kLinear, {0.0f, 2.0f}, {{0, 0, 0}, {1, 0, 0}}};
  scene.cameras = {rest, walk};
  return scene;
}

TEST(PathChoice, TakesTheFirstAnimationThenACameraAtRest) {
  EXPECT_EQ(pathOfScene(sceneWithCameras(), "", std::nullopt).frameCount(), 50);
  EXPECT_EQ(pathOfScene(sceneWithCameras(), "stroll", 10.0).frameCount(), 20);
  EXPECT_EQ(pathOfScene(sceneWithCameras(), "door", std::nullopt).frameCount(), 1);
  Scene still = sceneWithCameras();
  still.cameras.pop_back();
  EXPECT_EQ(pathOfScene(still, "", std::nullopt).frameCount(), 1);
  expectRefused([] { (void)pathOfScene(sceneWithCameras(), "strol", std::nullopt); },
                "hall.glb: no camera animation or camera is called 'strol'; did you mean 'stroll'?");
  expectRefused([] { (void)pathOfScene(Scene{}, "", std::nullopt); },
                "the scene has no camera; give a camera path with --path FILE");
}

TEST(Fingerprint, TellsApartWhatConcatenationWouldNot) {
  const auto of = [](std::initializer_list<std::string> texts) {
    Fingerprint f;
    for (const std::string& text : texts) f.add(text);
    return f.text();
  };
  EXPECT_EQ(of({"ab", "c"}), of({"ab", "c"}));
  EXPECT_NE(of({"ab", "c"}), of({"a", "bc"}));
  EXPECT_NE(of({""}), of({}));
  EXPECT_NE(of({std::string("a\0", 2)}), of({"a"}));
  EXPECT_EQ(of({"x"}).size(), 16u);
}

class OutputFolderTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ =
        std::filesystem::path(testing::TempDir()) / ("promenade-" + std::to_string(getpid()) + "-" + test);
    std::filesystem::remove_all(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void writeFrame(int index, const std::string& hash) {
    io::FrameFile frame;
    frame.metadata.camera = Camera(Pose{}, 1.0, Size{2, 1});
    frame.metadata.frame = index;
    frame.metadata.jobHash = hash;
    frame.radiance = RadianceMap(2, 1);
    io::writeFrame(folder_ / "frames" / io::frameFileName(index), frame);
  }

  std::filesystem::path folder_;
};

TEST_F(OutputFolderTest, RefusesFramesOfAnotherJobUnlessTheyAreToBeReplaced) {
  { const OutputFolder folder(folder_, "job", Existing::kResume); }
  writeFrame(0, "another");
  expectRefused([&] { const OutputFolder folder(folder_, "job", Existing::kResume); },
                "holds frames of another job (000000.exr)");
  std::ofstream(folder_ / "frames" / "notes.txt") << "mine";
  std::ofstream(folder_ / "parts" / "000000.json") << "a record";
  const OutputFolder folder(folder_, "job", Existing::kOverwrite);
  EXPECT_FALSE(std::filesystem::exists(folder.frame(0)));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "parts" / "000000.json"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "frames" / "notes.txt"));
}

TEST_F(OutputFolderTest, RefusesAFileInItsPlace) {
  std::ofstream(folder_) << "a file";
  expectRefused([&] { const OutputFolder folder(folder_, "job", Existing::kResume); },
                "cannot make the folder");
}

}  // namespace
}  // namespace promenade::app
