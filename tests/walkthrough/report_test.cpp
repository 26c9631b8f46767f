#include "src/walkthrough/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "src/walkthrough/statistics_json.h"

namespace promenade::walkthrough {
namespace {

using nlohmann::json;

Report threeFrames() {
  Report r;
  r.version = "1.2.3";
  r.job = {.scene = "a<b>.glb",
           .path = "walk",
           .framesPerSecond = 24.0,
           .integrator = "path",
           .light = "scene",
           .pathsPerSample = 64,
           .seed = 7,
           .threads = 2,
           .command = "promenade render 'a<b>.glb'",
           .directory = "/home/me"};
  r.settings.size = {10, 5};
  r.settings.supersample = 2;
  r.settings.frames = {4, 6};
  r.settings.display.name = "fhd-24";
  r.settings.tone.exposureEv = 1.5;
  r.settings.tone.curve = ToneCurve::kWard;
  r.settings.tone.candelasPerUnit = 20.0;
  r.settings.tone.adaptation = AdaptationCurve({{4, 30.0}, {6, 40.5}}, 24.0);
  const auto keyframe = [](int index, double seconds) {
    FrameStatistics f;
    f.index = index;
    f.samples = 200;
    f.samplesTraced = 200;
    f.rays = {.visibility = 0, .primary = 200, .scattered = 450, .shadow = 225};
    f.seconds = seconds;
    return f;
  };
  FrameStatistics inbetween;
  inbetween.index = 5;
  inbetween.kind = FrameKind::kInbetween;
  inbetween.samples = 200;
  inbetween.samplesTraced = 20;
  inbetween.holes = 5;
  inbetween.itemSamples = 15;
  inbetween.disputed = 4;
  inbetween.itemsTraced = {3, 9};
  inbetween.warped = 180;
  inbetween.reused = 7;
  inbetween.layered = 30;
  inbetween.rays = {.visibility = 200, .primary = 20, .scattered = 100, .shadow = 50};
  inbetween.seconds = 0.5;
  r.statistics.frames = {keyframe(4, 2.0), inbetween, keyframe(6, 2.5)};
  r.statistics.segments = {{.segment = {4, 6, 1},
                            .decision = Decision::kAccept,
                            .differencePercent = 1.25,
                            .maskedPercent = 10.0,
                            .unverifiedPercent = 0.5,
                            .probes = 6,
                            .probeDifferencePercent = 0.25,
                            .rays = {.visibility = 40}}};
  r.statistics.seconds = {
      .trace = 4.0, .visibility = 0.1, .warp = 0.2, .metric = 0.3, .filter = 0.4, .output = 0.5};
  r.seconds = {.load = 1.0, .indirect = 0.0, .prepare = 0.6, .encode = 0.2, .write = 0.3};
  r.wallSeconds = 8.0;
  r.peakResidentBytes = 1e6;
  r.textures = {.bytes = 2048, .levelsRead = 7, .levelsReadAgain = 2};
  return r;
}

TEST(ReportJson, HasTheStableKeysWithTheirMeaning) {
  const json root = json::parse(reportJson(threeFrames()));
  EXPECT_EQ(root["version"], "1.2.3");
  const json& job = root["job"];
  EXPECT_EQ(job["scene"], "a<b>.glb");
  EXPECT_EQ(job["path"], "walk");
  EXPECT_EQ(job["size"], json::parse("[10, 5]"));
  EXPECT_EQ(job["supersample"], 2);
  EXPECT_EQ(job["fps"], 24.0);
  EXPECT_EQ(job["frames"], 3);
  EXPECT_EQ(job["method"], "ibr");
  EXPECT_EQ(job["tolerance"], 3.0);
  EXPECT_EQ(job["display"], "fhd-24");
  EXPECT_EQ(job["seed"], 7);
  EXPECT_EQ(job["threads"], 2);
  EXPECT_EQ(job["command"], "promenade render 'a<b>.glb'");
  EXPECT_EQ(job["directory"], "/home/me");
  EXPECT_EQ(job["display_model"]["resolution"], json::parse("[1920, 1080]"));
  EXPECT_EQ(job["display_model"]["transfer"], "srgb");
  EXPECT_EQ(job["display_model"]["primaries"]["white"], json::parse("[0.3127, 0.329]"));
  EXPECT_EQ(job["tone"], "ward");
  EXPECT_EQ(job["luminance_unit"], 20.0);
  EXPECT_EQ(job["adaptation"], json::parse("[[4, 30.0], [6, 40.5]]"));
  const json& totals = root["totals"];
  EXPECT_EQ(totals["frames"], 3);
  EXPECT_EQ(totals["keyframes"], 2);
  EXPECT_EQ(totals["samples"], 600);
  EXPECT_EQ(totals["samples_traced"], 426);  // 420 of the frames, 6 probes
  EXPECT_EQ(totals["samples_probed"], 6);
  EXPECT_EQ(totals["samples_disputed"], 4);
  EXPECT_DOUBLE_EQ(totals["traced_fraction"].get<double>(), 0.71);  // 426 / 600
  EXPECT_EQ(totals["rays"], 2 * 875 + 170);                         // without the visibility rays
  EXPECT_EQ(totals["visibility_rays"], 200 + 40);
  EXPECT_EQ(totals["seconds_wall"], 8.0);
  EXPECT_EQ(totals["textures"], json::parse(R"({"bytes": 2048, "levels_read": 7, "levels_read_again": 2})"));
  // Two keyframes took 4.5 s for 400 samples, so 600 samples 6.75 s; loading, preparing, filtering, encoding
  // and writing 1 + 0.6 + 0.4 + 0.2 + 0.3 = 2.5 s either way: 9.25 s over 8 s.
  EXPECT_DOUBLE_EQ(totals["speedup_estimated"].get<double>(), 9.25 / 8.0);
  EXPECT_EQ(totals["peak_rss_bytes"], 1000000);
  for (const char* part :
       {"load", "indirect", "trace", "visibility", "warp", "metric", "filter", "encode", "write"}) {
    EXPECT_TRUE(totals["seconds"].contains(part)) << part;
  }
  EXPECT_EQ(totals["seconds"]["trace"], 4.0);
  EXPECT_EQ(totals["seconds"]["write"], 0.3);
  EXPECT_EQ(root["segments"], json::parse(R"([{"first": 4, "last": 6, "middle": 5, "difference_percent": 1.25,
      "masked_percent": 10.0, "unverified_percent": 0.5, "probes": 6, "probe_difference_percent": 0.25,
      "decision": "accept", "depth": 1, "rays": {"visibility": 40, "primary": 0, "scattered": 0, "shadow": 0}}])"));
  EXPECT_EQ(root["frames"][1],
            json::parse(R"({"index": 5, "kind": "inbetween", "samples": 200, "samples_traced": 20, "holes": 5,
      "items_traced": 15, "disputed": 4, "items": [3, 9], "warped": 180, "reused": 7, "layered": 30, "unknown": 0,
      "seconds": 0.5,
      "rays": {"visibility": 200, "primary": 20, "scattered": 100, "shadow": 50}})"));
  EXPECT_EQ(root["frames"][0]["kind"], "keyframe");
}

TEST(ReportJson, TellsWhatPerceptualStoppingSpentAndPredicts) {
  Report r = threeFrames();
  EXPECT_TRUE(json::parse(reportJson(r))["totals"]["stopping"].is_null());
  r.job.pathsPerSample.reset();
  r.settings.stopping = StoppingRule{};
  for (FrameStatistics& frame : r.statistics.frames) {
    frame.stopping = StoppingStatistics{.paths = 1000, .mostPaths = 32, .predictedPercent = 0.25};
  }
  r.statistics.frames[1].stopping =
      StoppingStatistics{.paths = 400, .mostPaths = 1024, .predictedPercent = 1.0, .openTiles = 2};
  const json root = json::parse(reportJson(r));
  EXPECT_TRUE(root["job"]["spp"].is_null());
  EXPECT_EQ(root["job"]["spp_automatic"], true);
  // (0.25 + 1 + 0.25) / 3
  EXPECT_EQ(root["totals"]["stopping"], json::parse(R"({"paths": 2400, "predicted_percent_mean": 0.5,
      "predicted_percent_worst": 1.0, "tiles_open": 2})"));
  EXPECT_EQ(root["frames"][1]["paths"], 400);
  EXPECT_EQ(root["frames"][1]["paths_most"], 1024);
  EXPECT_EQ(root["frames"][1]["predicted_percent"], 1.0);
  EXPECT_EQ(root["frames"][1]["tiles_open"], 2);
}

TEST(ReportJson, TellsWhatTheLightSolutionCost) {
  Report r = threeFrames();
  EXPECT_FALSE(json::parse(reportJson(r)).contains("light_solution"));
  r.light = LightReport{.file = "out/l.bin", .records = 90, .recordsAdded = 40, .cameras = 6, .rays = 5000};
  r.seconds.indirect = 2.5;
  EXPECT_EQ(json::parse(reportJson(r))["light_solution"], json::parse(R"({"file": "out/l.bin", "records": 90,
      "records_added": 40, "cameras": 6, "rays": 5000, "seconds": 2.5})"));
}

TEST(StatisticsJson, ComesBackExactly) {
  Statistics s = threeFrames().statistics;
  s.frames[1].seconds = 0.1 + 0.2;  // no short decimal
  s.segments[0].differencePercent = 1.0 / 3.0;
  s.frames[2].stopping =
      StoppingStatistics{.paths = 400, .mostPaths = 1024, .predictedPercent = 2.0 / 3.0, .openTiles = 2};
  const std::string text = toJson(s).dump();
  const auto read = statisticsFrom(json::parse(text));
  ASSERT_TRUE(read);
  EXPECT_EQ(toJson(*read).dump(), text);
  EXPECT_EQ(read->rays(), s.rays());
  EXPECT_EQ(read->frames[1].itemsTraced, s.frames[1].itemsTraced);
  EXPECT_EQ(read->seconds.metric, s.seconds.metric);
}

TEST(StatisticsJson, OfAnotherProgramIsNothing) {
  EXPECT_FALSE(statisticsFrom(json::parse("[]")));
  EXPECT_FALSE(statisticsFrom(json::parse(R"({"frames": [], "segments": []})")));
  EXPECT_FALSE(
      statisticsFrom(json::parse(R"({"frames": [{"index": "one"}], "segments": [], "seconds": {}})")));
}

TEST(ReportJson, SurvivesNamesThatAreNotUtf8) {
  Report r = threeFrames();
  r.job.scene = "\xff\xfe.glb";
  EXPECT_TRUE(json::accept(reportJson(r)));
}

}  // namespace
}  // namespace promenade::walkthrough
