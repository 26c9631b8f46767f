// `--tone` and `--display` from the outside.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "src/core/tone_mapping.h"
#include "tests/e2e/exr_files.h"

namespace promenade::e2e {
namespace {

using Arguments = std::vector<std::string>;
using testing::HasSubstr;

class Tone : public InFolder {
 protected:
  Outcome render(const std::string& out, const Arguments& more) {
    Arguments all = {"render",        writeScene(folder_, "scene", With::kAll).string(),
                     "--out",         at(out),
                     "--size",        "32x18",
                     "--spp",         "1",
                     "--frames",      "0-4",
                     "--supersample", "1",
                     "--integrator",  "path"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
  /// Root of the mean squared difference of two videos' code values.
  double difference(const std::string& a, const std::string& b) {
    const Outcome outcome = run({"compare", at(a), at(b), "--metric", "rmse", "--json"});
    expectDone(outcome);
    return nlohmann::json::parse(outcome.out)["rmse_mean"].get<double>();
  }
  nlohmann::json jobOf(const std::string& out) {
    return nlohmann::json::parse(contents(at(out + "/report.json")))["job"];
  }
};

TEST_F(Tone, OfTheEyeTakesPunctualLightsInLux) {
  expectDone(render("out", {"--tone", "ward"}));
  const nlohmann::json job = jobOf("out");
  EXPECT_EQ(job["tone"], "ward");
  EXPECT_EQ(job["luminance_unit"], 1.0);
  // Two matt walls of luminance albedo 0.399 and 0.458 (0.2126 * 0.8 + 0.7152 * 0.3 + 0.0722 * 0.2 and so on)
  // in 3 lux: 0.43 * 3 / pi = 0.41 cd/m2 where they are seen; a part of the picture is black beside them.
  ASSERT_EQ(job["adaptation"].size(), 2u);  // frames 0 and 4
  const double seen = job["adaptation"][0][1].get<double>();
  EXPECT_GT(seen, 0.02);
  EXPECT_LT(seen, 0.6);
}

TEST_F(Tone, IsTheSameForEveryoneWhoLooksAtTheFrames) {
  expectDone(render("out", {"--tone", "tumblin-rushmeier", "--video", at("made.mkv")}));
  expectDone(run({"encode", at("out"), at("again.mkv"), "--tone", "tumblin-rushmeier"}));
  // The frames are halves, which may round a code value of 255 another way.
  EXPECT_LT(difference("made.mkv", "again.mkv"), 0.002);
  // An eye that is told that the light is 1000 times as bright sees something else.
  expectDone(run({"encode", at("out"), at("bright.mkv"), "--tone", "tumblin-rushmeier", "--unit", "1000"}));
  EXPECT_GT(difference("bright.mkv", "made.mkv"), 0.05);
}

TEST_F(Tone, OfEveryNameRendersAndCompares) {
  expectDone(render("out", {}));
  for (const ToneCurve curve : allToneCurves()) {
    expectDone(run({"encode", at("out"), at("v.mkv"), "--tone", nameOf(curve)}));
    const Outcome outcome =
        run({"compare", at("out"), at("out"), "--tone", nameOf(curve), "--fail-above", "0"});
    EXPECT_EQ(outcome.status, 0) << nameOf(curve) << outcome.err;
  }
}

TEST_F(Tone, AdaptsToBothSidesOfAComparison) {
  const auto writeGrey = [&](const std::string& file, double radiance) {
    writeExr(at(file), 64, 64,
             {{"R", constant(radiance)}, {"G", constant(radiance)}, {"B", constant(radiance)}});
  };
  writeGrey("a.exr", 1.0);
  writeGrey("b.exr", 4.0);
  for (const std::string tone : {"ward", "ferwerda", "larson", "chiu"}) {
    const auto compared = [&](const std::string& test, const std::string& reference) {
      const Outcome outcome =
          run({"compare", at(test), at(reference), "--tone", tone, "--metric", "rmse", "--json"});
      expectDone(outcome);
      return nlohmann::json::parse(outcome.out)["rmse_mean"].get<double>();
    };
    // Seen each with its own eye both would look alike; one that sees both sees that one is darker. (larson
    // spends nothing on the luminances between them.)
    EXPECT_GT(compared("a.exr", "b.exr"), 0.03) << tone;
    EXPECT_EQ(compared("a.exr", "b.exr"), compared("b.exr", "a.exr")) << tone;
  }
}

TEST_F(Tone, AndDisplayThatMakeNoSenseAreRefused) {
  expectRefused(render("out", {"--tone", "wart"}), "--tone: unknown value 'wart'; did you mean 'ward'?");
  expectRefused(render("out", {"--unit", "3"}), "--unit: only the tones of the eye ask for it, 'neutral'");
  writeText(at("d.json"), R"({"primaries": {"red": [0.6, 0.3]}})");
  expectRefused(render("out", {"--display", at("d.json")}), "d.json: primaries: there is no green");
}

TEST_F(Tone, PicturesForANativeDisplayAreItsOwn) {
  const std::string primaries =
      R"("primaries": {"red": [0.68, 0.32], "green": [0.265, 0.69], "blue": [0.15, 0.06], "white": [0.3127, 0.329]})";
  writeText(at("srgb.json"), "{" + primaries + "}");
  writeText(at("native.json"), R"({"signal": "native", )" + primaries + "}");
  expectDone(render("out", {"--display", at("native.json"), "--video", at("made.mkv")}));
  EXPECT_EQ(jobOf("out")["display_model"]["signal"], "native");
  expectDone(run({"encode", at("out"), at("again.mkv")}));
  EXPECT_LT(difference("made.mkv", "again.mkv"), 0.002);
  expectDone(run({"encode", at("out"), at("srgb.mkv"), "--display", at("srgb.json")}));
  EXPECT_GT(difference("srgb.mkv", "made.mkv"), 0.005);
}

}  // namespace
}  // namespace promenade::e2e
