// `promenade compare`: what is compared (layers, masks, frames that do not match) and by which choices of the
// metric.

#include <unistd.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/e2e/exr_files.h"

namespace promenade::e2e {
namespace {

double visibleIn(const nlohmann::json& root) {
  return root["percent_visible_worst"].get<double>();
}

TEST_F(Compare, SwappingTheArgumentsChangesNothingWhateverTheMetric) {
  writeLuminance(at("reference.exr"), 96, 64, grating(0.3, 12.0));
  writeLuminance(at("test.exr"), 96, 64, grating(0.4, 12.0));
  for (const char* metric :
       {"aqm", "revised", "aqm2000", "vdp", "model1", "model2", "model3", "rmse", "psnr"}) {
    const auto say = [&](const char* first, const char* second) {
      const Outcome outcome = run({"compare", at(first), at(second), "--absolute", "--ppd", "32", "--metric",
                                   metric, "--json", "--quiet"});
      expectDone(outcome);
      return outcome.out;
    };
    EXPECT_EQ(say("test.exr", "reference.exr"), say("reference.exr", "test.exr")) << metric;
  }
}

TEST_F(Compare, OnlyWhatTheMaskSelectsCounts) {
  // A visible grating in the left quarter, of which nothing is seen four degrees away.
  writeLuminance(at("reference.exr"), 256, 64, constant(50.0));
  writeLuminance(at("test.exr"), 256, 64,
                 [](int x, int y) { return x < 64 ? grating(0.05, 8.0)(x, y) : 50.0; });
  const auto select = [&](const Value& white) { writeExr(at("mask.exr"), 256, 64, {{"Y", white}}); };
  EXPECT_GT(visibleIn(compared({})), 20.0);
  select([](int x, int) { return x >= 192 ? 1.0 : 0.0; });
  EXPECT_EQ(visibleIn(compared({"--mask", at("mask.exr")})), 0.0);
  EXPECT_EQ(compared({"--mask", at("mask.exr"), "--metric", "rmse"})["rmse_worst"], 0.0);
  select([](int x, int) { return x < 32 ? 1.0 : 0.0; });
  EXPECT_EQ(visibleIn(compared({"--mask", at("mask.exr"), "--heatmap", at("heat")})), 100.0);
}

TEST_F(Compare, AMaskThatDoesNotFitIsRefused) {
  writeGrating(0.1);
  const auto refused = [&](int width, double white, const std::string& part) {
    writeExr(at("mask.exr"), width, 128, {{"Y", constant(white)}});
    expectRefused(
        run({"compare", at("test.exr"), at("reference.exr"), "--absolute", "--mask", at("mask.exr")}), part);
  };
  refused(127, 1.0, "mask.exr: --mask: expected the size of the frames, 128x128, found 127x128");
  refused(128, 0.0, "mask.exr: --mask: expected white where pixels count, found none");
  refused(128, std::numeric_limits<double>::quiet_NaN(), "found none");
  expectRefused(
      run({"compare", at("test.exr"), at("reference.exr"), "--metric", "model1", "--mask", at("mask.exr")}),
      "the models compare whole frames");
}

TEST_F(Compare, LayersOfOpenExrFilesAreComparedByName) {
  const auto write = [&](const char* name, double diffuse) {
    std::vector<std::pair<std::string, Value>> channels;
    for (const char* c : {"R", "G", "B"})
      channels.emplace_back(std::string("View.Combined.") + c, grating(0.2, 8.0));
    for (const char* c : {"R", "G", "B"})
      channels.emplace_back(std::string("View.DiffCol.") + c, grating(diffuse, 8.0));
    writeExr(at(name), 128, 32, channels);
  };
  write("a.exr", 0.2);
  write("b.exr", 0.8);
  const auto visible = [&](std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"compare", at("a.exr"), at("b.exr"), "--exposure", "-7", "--json", "--quiet"});
    const Outcome outcome = run(options);
    expectDone(outcome);
    return visibleIn(nlohmann::json::parse(outcome.out, nullptr, false));
  };
  EXPECT_EQ(visible({}), 0.0);
  EXPECT_GT(visible({"--layer", "DiffCol"}), 50.0);
  expectRefused(run({"compare", at("a.exr"), at("b.exr"), "--layer", "Gloss"}),
                "expected one of the layers View.Combined, View.DiffCol, found 'Gloss'");
}

TEST_F(Compare, FramesOfOtherChannelsAreComparedByWhatTheyShare) {
  // Grey against colour of equal parts; flow in one of them only: it is the flow of both.
  const Value value = grating(0.2, 8.0);
  writeExr(at("grey.exr"), 128, 32, {{"Y", value}});
  writeExr(at("rgb.exr"), 128, 32, {{"R", value}, {"G", value}, {"B", value}, {"Z", constant(1.0)}});
  const Outcome same =
      run({"compare", at("grey.exr"), at("rgb.exr"), "--metric", "rmse", "--json", "--quiet"});
  expectDone(same);
  EXPECT_EQ(nlohmann::json::parse(same.out, nullptr, false)["rmse_worst"], 0.0);
  const auto flow = constant(12.8);  // 10 degrees per second at 32 pixels per degree and 25 frames a second
  writeExr(at("test.exr"), 128, 128, {{"Y", grating(0.02, 8.0)}});
  writeExr(at("reference.exr"), 128, 128,
           {{"Y", constant(50.0)}, {"Vector.X", flow}, {"Vector.Y", constant(0.0)}});
  EXPECT_EQ(compared({}).dump(), compared({"--velocity", "10,0"}).dump());
  expectRefused(run({"compare", at("grey.exr"), at("rgb.exr"), "--absolute"}),
                "rgb.exr: --absolute: expected a channel Y");
}

TEST_F(Compare, EveryChoiceOfThePipelineChangesTheVerdictAndIsNoted) {
  // A grating on a masking one, moving, with a dark border so that local contrast is another one.
  writeLuminance(at("reference.exr"), 128, 96,
                 [](int x, int y) { return y < 48 ? grating(0.3, 8.0)(x, y) : 5.0; });
  writeLuminance(at("test.exr"), 128, 96, [](int x, int y) {
    return y < 48 ? grating(0.3, 8.0)(x, y) + 3.0 * std::cos(0.6 * x + 0.3 * y) : 5.0;
  });
  const auto base = compared({})["frames"].dump();
  const std::vector<std::pair<std::string, std::string>> choices = {
      {"contrast", "local"}, {"filters", "amplitude"}, {"filters", "laplacian"}, {"bands", "3"},
      {"orientations", "3"}, {"csf", "moving"},        {"csf", "daly"},          {"csf", "mannos"},
      {"csf-at", "centres"}, {"masking", "none"},      {"masking", "test"},      {"masking", "reference"},
      {"elevation", "daly"}, {"pooling", "none"},      {"onset", "2"},           {"gain", "2"}};
  for (const auto& [name, value] : choices) {
    const auto root = compared({"--" + name, value});
    EXPECT_NE(root["frames"].dump(), base) << name << " " << value;
    EXPECT_EQ(root["settings"][name], value);
  }
  EXPECT_FALSE(compared({}).contains("settings"));
  const std::string a = at("test.exr");
  expectRefused(run({"compare", a, a, "--masking", "nonne"}), "did you mean 'none'?");
  expectRefused(run({"compare", a, a, "--bands", "1"}), "--bands");
  expectRefused(run({"compare", a, a, "--csf", "daly", "--velocity", "1,0"}),
                "know of motion, and not with --csf daly");
}

TEST_F(Compare, AVerdictStandsThoughNobodyReadsIt) {
  writeGrating(0.2);
  const Outcome outcome =
      run({"compare", at("test.exr"), at("reference.exr"), "--absolute", "--fail-above", "1"}, [] {
        std::array<int, 2> ends{};
        if (pipe(ends.data()) != 0) _exit(126);
        close(ends[0]);
        dup2(ends[1], STDOUT_FILENO);
      });
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.error(), "");
}

}  // namespace
}  // namespace promenade::e2e
