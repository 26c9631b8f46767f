// `--tone` and `--display` from the outside.

#include <gmock/gmock.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "src/core/tone_mapping.h"
#include "src/io/sequence.h"
#include "tests/e2e/exr_files.h"
#include "tests/io/ocio_config.h"

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
    if (curve == ToneCurve::kOcio) continue;  // asks for a config: below
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

TEST_F(Tone, OfAConfigIsItsView) {
  const std::string config = tests::writeOcioConfig(folder_).string();
  writeExr(at("a.exr"), 32, 16, {{"R", constant(0.25)}, {"G", constant(0.5)}, {"B", constant(1.0)}});
  const auto shown = [&](const Arguments& choice) {
    Arguments all = {"encode", at("a.exr"), at("a.mkv"), "--exposure", "0"};
    all.insert(all.end(), choice.begin(), choice.end());
    expectDone(run(all));
    return std::get<EncodedMap>(io::SequenceReader(io::resolveSequence(at("a.mkv"))).next()->colour)(16, 8);
  };
  // FFV1 holds 8 bits of RGB or 10 of Y'CbCr: within two steps of 8 bits.
  const auto expectShown = [&](const Arguments& choice, const Rgb& expected) {
    const Rgb code = shown(choice);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(code[i], expected[i], 2.0 / 255.0) << testing::PrintToString(choice);
  };
  // As tests/io/ocio_config.h has it: (0.5, 0.25, 0.5), then the table.
  expectShown({"--ocio", config}, Rgb(0.8f, 0.4f, 0.8f));
  expectShown({"--tone", "ocio", "--ocio", config, "--ocio-view", "Plain"}, Rgb(0.25f, 0.5f, 1.0f));
  expectShown({"--ocio", config, "--ocio-display", "Wall", "--ocio-input", "halves"},
              Rgb(0.125f, 0.25f, 0.5f));
  ::setenv("OCIO", config.c_str(), 1);
  expectShown({"--tone", "ocio"}, Rgb(0.8f, 0.4f, 0.8f));
  // Who does not ask for it does not get it.
  expectShown({"--tone", "linear"}, Rgb(encodeSrgb(0.25f), encodeSrgb(0.5f), 1.0f));
  ::unsetenv("OCIO");
}

TEST_F(Tone, OfAConfigIsOfTheJob) {
  const std::string config = tests::writeOcioConfig(folder_).string();
  expectDone(render("out", {"--ocio", config, "--video", at("made.mkv")}));
  const nlohmann::json job = jobOf("out");
  EXPECT_EQ(job["tone"], "ocio");
  EXPECT_EQ(job["ocio"]["view"], "Swapped");
  expectDone(run({"encode", at("out"), at("again.mkv"), "--ocio", config}));
  EXPECT_LT(difference("made.mkv", "again.mkv"), 0.002);
  expectDone(run({"report", at("out")}));
  expectDone(run({"compare", at("out"), at("out"), "--ocio", config, "--fail-above", "0"}));
  // The same view, asked for by its name, is the same job; another one is not.
  expectDone(render("out", {"--ocio", config, "--ocio-view", "Swapped", "--video", at("made.mkv")}));
  expectRefused(render("out", {"--ocio", config, "--ocio-view", "Plain", "--video", at("made.mkv")}),
                "--overwrite");
}

TEST_F(Tone, OfAConfigThatMakesNoSenseIsRefused) {
  ::unsetenv("OCIO");
  const std::string config = tests::writeOcioConfig(folder_).string();
  expectRefused(render("out", {"--tone", "ocio", "--ocio-view", "Plain"}),
                "there is no config; expected --ocio FILE");
  expectRefused(render("out", {"--ocio", config, "--tone", "agx"}), "--ocio: is the tone of a config");
  expectRefused(render("out", {"--ocio", config, "--ocio-display", "Cinema"}), "'Screen', 'Wall'");
  expectRefused(render("out", {"--ocio", at("none.ocio")}), "none.ocio");
  writeText(at("bad.ocio"), "colorspaces: [");
  expectRefused(render("out", {"--ocio", at("bad.ocio")}), "bad.ocio: OpenColorIO:");
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
