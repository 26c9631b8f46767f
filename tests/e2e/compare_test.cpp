// `promenade compare` and its metrics, from the outside.

#include <OpenImageIO/imageio.h>

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/e2e/exr_files.h"
#include "tests/e2e/tiny_scene.h"

namespace promenade::e2e {
namespace {

TEST_F(Compare, EveryMetricSaysNothingOfEqualFramesAndSomethingOfOthers) {
  writeGrating(0.05);
  writeLuminance(at("same.exr"), 128, 128, grating(0.05, 8.0));
  const std::vector<std::pair<std::string, std::string>> metrics = {{"aqm", "percent_visible_worst"},
                                                                    {"aqm2000", "percent_visible_worst"},
                                                                    {"revised", "percent_visible_worst"},
                                                                    {"vdp", "percent_visible_worst"},
                                                                    {"rmse", "rmse_worst"},
                                                                    {"model1", "distance_worst"},
                                                                    {"model2", "distance_worst"},
                                                                    {"model3", "distance_worst"}};
  for (const auto& [metric, key] : metrics) {
    SCOPED_TRACE(metric);
    const auto different = compared({"--metric", metric});
    EXPECT_EQ(different["metric"], metric);
    EXPECT_GT(different[key].get<double>(), 0.0);
    const Outcome same = run({"compare", at("test.exr"), at("same.exr"), "--absolute", "--ppd", "32",
                              "--metric", metric, "--json", "--quiet"});
    expectDone(same);
    EXPECT_EQ(nlohmann::json::parse(same.out, nullptr, false)[key], 0.0);
  }
  EXPECT_TRUE(compared({"--metric", "psnr"})["psnr_worst"].is_number());
}

TEST_F(Compare, MetricsDifferWhereTheirDefinitionsDo) {
  // A grating at threshold by each metric's own account: J without pooling is contrast times S times the
  // filter's gain, so that of aqm2000 and of vdp are neither equal nor aqm's.
  writeGrating(0.01);
  const auto largest = [&](const std::string& metric) {
    return compared({"--metric", metric})["frames"][0]["jnd_max"].get<double>();
  };
  const double aqm = largest("aqm");
  for (const char* metric : {"aqm2000", "revised", "vdp"}) {
    EXPECT_GT(std::abs(largest(metric) / aqm - 1.0), 0.02) << metric;
  }
}

TEST_F(Compare, TheEyeDecidesWhatMotionHides) {
  // Ten degrees a second across the bars of eight cycles per degree: an eye that follows leaves 1.65 degrees
  // a second on the retina, where S(8, 1.65) = 43; one that stays leaves 9.85, where S(8, 9.85) = 0.01.
  writeLuminance(at("reference.exr"), 128, 128, constant(50.0));
  writeLuminance(at("test.exr"), 128, 128, grating(0.2, 32.0));
  const auto visible = [&](const std::string& eye) {
    return compared({"--velocity", "10,0", "--eye", eye})["percent_visible_mean"].get<double>();
  };
  EXPECT_GT(visible("tracking"), 90.0);
  EXPECT_EQ(visible("fixating"), 0.0);
  // What rests on the retina fades: S(8, 0.15 / 16) / S(8, 0.15) = 0.54.
  const auto atRest = [&](const std::string& eye) {
    return compared({"--eye", eye})["frames"][0]["pooled_jnd_max"].get<double>();
  };
  EXPECT_NEAR(atRest("stabilised") / atRest("fixating"), 0.54, 0.01);
  EXPECT_EQ(atRest("tracking"), atRest("fixating"));
}

TEST_F(Compare, TheSignedMapOfVdpSaysWhetherTheTestIsBrighter) {
  // A bright spot and a dark one.
  const auto spots = [](int x, int y) {
    const auto spot = [&](double centre) {
      return std::exp(-((x - centre) * (x - centre) + (y - 32.0) * (y - 32.0)) / 50.0);
    };
    return 50.0 * (1.0 + 0.4 * spot(32.0) - 0.4 * spot(96.0));
  };
  writeLuminance(at("reference.exr"), 128, 64, constant(50.0));
  writeLuminance(at("test.exr"), 128, 64, spots);
  (void)compared({"--metric", "vdp", "--maps", at("maps")});
  const auto in = OIIO::ImageInput::open(at("maps/000000.exr"));
  ASSERT_TRUE(in);
  const auto& names = in->spec().channelnames;
  const auto found = std::find(names.begin(), names.end(), "SignedP");
  ASSERT_NE(found, names.end());
  const auto channel = static_cast<int>(found - names.begin());
  std::vector<float> map(128 * 64);
  ASSERT_TRUE(in->read_image(0, 0, channel, channel + 1, OIIO::TypeDesc::FLOAT, map.data()));
  EXPECT_GT(map[32 * 128 + 32], 0.5f);
  EXPECT_LT(map[32 * 128 + 96], -0.5f);
}

TEST_F(Compare, VectorChannelsAreTheVelocity) {
  // Two frames whose pixels all move 10 pixels to the right: at 25 frames a second and 32 pixels per degree
  // that is 7.8125 degrees per second. Where a pixel of the second frame comes from beyond its left edge, its
  // own flow is all there is, and it is the same.
  for (const char* frame : {"0.exr", "1.exr"}) {
    std::filesystem::create_directories(at("test"));
    std::filesystem::create_directories(at("reference"));
    writeExr(at("reference/") + frame, 96, 64,
             {{"Y", constant(50.0)}, {"Vector.X", constant(10.0)}, {"Vector.Y", constant(0.0)}});
    writeExr(at("test/") + frame, 96, 64,
             {{"Y", grating(0.03, 8.0)}, {"Vector.X", constant(10.0)}, {"Vector.Y", constant(0.0)}});
  }
  const auto compared2 = [&](std::vector<std::string> options) {
    std::vector<std::string> arguments = {"compare", at("test"), at("reference"), "--absolute", "--ppd", "32",
                                          "--fps",   "25",       "--json",        "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run(arguments);
    expectDone(outcome);
    return outcome.out;
  };
  EXPECT_EQ(compared2({}), compared2({"--velocity", "7.8125,0"}));
  EXPECT_NE(compared2({}), compared2({"--velocity", "0,0"}));
}

TEST_F(Compare, NamesWhatAMetricCannotDo) {
  writeGrating(0.01);
  const std::string a = at("test.exr");
  expectRefused(run({"compare", a, a, "--metric", "aqn"}), "did you mean 'aqm'?");
  expectRefused(run({"compare", a, a, "--metric", "vdq"}), "did you mean 'vdp'?");
  expectRefused(run({"compare", a, a, "--metric", "aqm200"}), "did you mean 'aqm2000'?");
  expectRefused(run({"compare", a, a, "--eye", "trackin"}), "did you mean 'tracking'?");
  expectRefused(run({"compare", a, a, "--metric", "vdp", "--eye", "fixating"}),
                "only aqm, aqm2000 and revised know of motion");
  expectRefused(run({"compare", a, a, "--metric", "vdp", "--velocity", "1,0"}),
                "only aqm, aqm2000 and revised know of motion");
  expectRefused(run({"compare", a, a, "--metric", "rmse", "--velocity", "1,0"}), "'rmse' was chosen");
  expectRefused(run({"compare", a, a, "--metric", "psnr", "--csf", "daly"}), "--csf: only aqm");
  expectRefused(run({"compare", a, a, "--metric", "rmse", "--fail-above", "3"}), "'rmse' was chosen");
  expectRefused(run({"compare", a, a, "--metric", "model2", "--heatmap", at("heat")}), "'model2' was chosen");
}

TEST_F(Compare, LuminanceThatIsNotFiniteIsRefusedWithItsFileAndPixel) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    writeLuminance(at("good.exr"), 5, 3, constant(50.0));
    writeLuminance(at("bad.exr"), 5, 3, [&](int x, int y) { return x == 4 && y == 1 ? bad : 50.0; });
    const Outcome outcome = run({"compare", at("good.exr"), at("bad.exr"), "--absolute"});
    expectRefused(outcome, "bad.exr: pixel (4, 1): expected a finite luminance");
  }
  // No light and less than none are the darkest there is.
  writeLuminance(at("black.exr"), 5, 3, constant(0.0));
  writeLuminance(at("negative.exr"), 5, 3, constant(-1.0));
  const Outcome dark = run({"compare", at("black.exr"), at("negative.exr"), "--absolute", "--json"});
  expectDone(dark);
  EXPECT_EQ(nlohmann::json::parse(dark.out, nullptr, false)["percent_visible_worst"], 0.0);
}

TEST_F(Compare, RadianceThatIsNoNumberIsBlackAndInfiniteRadianceWhite) {
  const auto write = [&](const char* name, double left, double right) {
    const Value value = [=](int x, int) { return x < 32 ? left : right; };
    writeExr(at(name), 64, 32, {{"R", value}, {"G", value}, {"B", value}});
  };
  write("reference.exr", 0.0, 1e6);
  write("same.exr", -3.0, std::numeric_limits<double>::infinity());
  write("nan.exr", std::numeric_limits<double>::quiet_NaN(), 1e6);
  write("other.exr", 0.3, 1e6);
  const auto worst = [&](const char* name) {
    const Outcome outcome = run({"compare", at(name), at("reference.exr"), "--exposure", "0", "--json"});
    expectDone(outcome);
    return nlohmann::json::parse(outcome.out, nullptr, false)["frames"][0]["jnd_max"].get<double>();
  };
  EXPECT_EQ(worst("same.exr"), 0.0);
  EXPECT_EQ(worst("nan.exr"), 0.0);
  EXPECT_GT(worst("other.exr"), 1.0);
}

TEST_F(Compare, CompareOfAbsoluteLuminanceGivesThePublishedNumbers) {
  // A grating of 1% contrast, two cycles per degree, at 50 cd/m2 and 32 pixels per degree against uniform
  // grey: at rest Jmax = 1.2523, mean J = 0.81675, 33.37% visible; moving at 8 degrees per second across its
  // bars Jmax = 2.1541, 100%.
  writeGrating(0.01);
  const auto still = compared({"--velocity", "0,0", "--exact"});
  EXPECT_EQ(still["ppd"], 32.0);
  EXPECT_NEAR(still["frames"][0]["jnd_max"].get<double>(), 1.2523, 1e-3 * 1.2523);
  EXPECT_NEAR(still["frames"][0]["jnd_mean"].get<double>(), 0.81675, 1e-3 * 0.81675);
  EXPECT_NEAR(still["frames"][0]["pooled_jnd_max"].get<double>(), 1.1142, 1e-3 * 1.1142);
  EXPECT_NEAR(still["percent_visible_mean"].get<double>(), 33.37, 0.1);
  const auto moving = compared({"--velocity", "8,0", "--exact"});
  EXPECT_NEAR(moving["frames"][0]["jnd_max"].get<double>(), 2.1541, 1e-3 * 2.1541);
  EXPECT_EQ(moving["percent_visible_mean"].get<double>(), 100.0);
  // Fast: the coarsest grids are interpolated. At threshold everywhere, that moves the border of what counts.
  const auto fast = compared({"--velocity", "0,0", "--fast"});
  EXPECT_NEAR(fast["frames"][0]["jnd_max"].get<double>(), 1.2523, 0.06 * 1.2523);
  EXPECT_NEAR(fast["frames"][0]["jnd_mean"].get<double>(), 0.81675, 0.06 * 0.81675);
  EXPECT_NEAR(fast["frames"][0]["pooled_jnd_max"].get<double>(), 1.1142, 0.025 * 1.1142);
  EXPECT_NEAR(fast["percent_visible_mean"].get<double>(), 33.37, 2.0);
}

// A picture of smooth colours, in the format that the name says.
void writePicture(const std::string& file, const OIIO::TypeDesc& type, int width = 64, int height = 48) {
  std::vector<float> pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      pixels.insert(pixels.end(), {static_cast<float>(x) / static_cast<float>(width), 0.5f,
                                   static_cast<float>(y) / static_cast<float>(height)});
    }
  }
  const auto out = OIIO::ImageOutput::create(file);
  ASSERT_TRUE(out && out->open(file, OIIO::ImageSpec(width, height, 3, type))) << file;
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
  ASSERT_TRUE(out->close());
}

TEST_F(Compare, ReadsWhateverOpenImageIOReads) {
  // Rounding to 8 bits is below 1 / 510; JPEG and WebP lose more, but not of what is so smooth.
  writePicture(at("reference.png"), OIIO::TypeDesc::UINT16);
  for (const char* name :
       {"8.png", "8.tif", "8.bmp", "8.tga", "8.ppm", "8.jpg", "8.webp", "8.sgi", "8.jp2"}) {
    SCOPED_TRACE(name);
    writePicture(at(name), OIIO::TypeDesc::UINT8);
    const Outcome outcome = run({"compare", at(name), at("reference.png"), "--metric", "rmse", "--json"});
    expectDone(outcome);
    EXPECT_LT(nlohmann::json::parse(outcome.out, nullptr, false)["rmse_worst"].get<double>(), 0.01);
  }
  // Floating-point pixels are radiance, so that these are compared with each other.
  writePicture(at("f.exr"), OIIO::TypeDesc::HALF);
  for (const char* name : {"f.tif", "f.hdr"}) {
    SCOPED_TRACE(name);
    writePicture(at(name), OIIO::TypeDesc::FLOAT);
    const Outcome outcome = run({"compare", at(name), at("f.exr"), "--metric", "rmse", "--json"});
    expectDone(outcome);
    EXPECT_LT(nlohmann::json::parse(outcome.out, nullptr, false)["rmse_worst"].get<double>(), 0.01);
  }
}

TEST_F(Compare, AmbientLightWashesDifferencesOut) {
  // 20000 lux on a screen that reflects 1 % add 64 cd/m2 to both frames: darks of 2 cd/m2 lose their
  // contrast.
  writePicture(at("reference.png"), OIIO::TypeDesc::UINT8);
  writePicture(at("test.jpg"), OIIO::TypeDesc::UINT8);
  const auto jnd = [&](const char* lux) {
    const Outcome outcome =
        run({"compare", at("test.jpg"), at("reference.png"), "--ambient", lux, "--json", "--quiet"});
    expectDone(outcome);
    return nlohmann::json::parse(outcome.out, nullptr, false)["frames"][0]["jnd_mean"].get<double>();
  };
  EXPECT_LT(jnd("20000"), 0.8 * jnd("0"));
  expectRefused(run({"compare", at("test.jpg"), at("test.jpg"), "--ambient", "dim"}), "--ambient");
}

TEST_F(Compare, VideosAreComparedFrameByFrameWithProgress) {
  std::filesystem::create_directories(at("frames"));
  for (const char* frame : {"0.png", "1.png", "2.png"}) {
    writePicture(at("frames/") + frame, OIIO::TypeDesc::UINT8);
  }
  expectDone(run({"encode", at("frames"), at("lossless.mkv"), "--fps", "30", "--quiet"}));
  expectDone(run({"encode", at("frames"), at("lossy.mp4"), "--fps", "30", "--quiet"}));
  const Outcome outcome =
      run({"compare", at("lossy.mp4"), at("lossless.mkv"), "--json", "--heatmap", at("heat")});
  expectDone(outcome);
  const auto root = nlohmann::json::parse(outcome.out, nullptr, false);
  EXPECT_EQ(root["fps"], 30.0);
  EXPECT_EQ(root["frames"].size(), 3u);
  EXPECT_THAT(outcome.err, testing::HasSubstr("3/3"));
  EXPECT_TRUE(std::filesystem::exists(at("heat/000002.png")));
  // A video and the frames that it was made of differ in the last bit of n / 255 at most.
  const Outcome same = run({"compare", at("lossless.mkv"), at("frames"), "--json", "--quiet"});
  expectDone(same);
  EXPECT_LT(nlohmann::json::parse(same.out, nullptr, false)["frames"][1]["jnd_max"].get<double>(), 1e-3);
  std::filesystem::resize_file(at("lossless.mkv"), std::filesystem::file_size(at("lossless.mkv")) / 2);
  expectRefused(run({"compare", at("lossy.mp4"), at("lossless.mkv")}), "lossless.mkv");
}

TEST_F(Compare, FramesOfOnePixelRowsColumnsAndUnknownFlowHaveAnAnswer) {
  const auto nan = constant(std::numeric_limits<double>::quiet_NaN());
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(1, 37), std::pair(53, 1), std::pair(7, 5)}) {
    SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
    // No flow is known, or it leads far beyond the image.
    for (const auto& flow : {nan, constant(1e30)}) {
      writeExr(at("reference.exr"), width, height,
               {{"Y", constant(50.0)}, {"Vector.X", flow}, {"Vector.Y", flow}});
      writeExr(at("test.exr"), width, height,
               {{"Y", constant(60.0)}, {"Vector.X", flow}, {"Vector.Y", flow}});
      const auto root = compared({"--heatmap", at("heat"), "--maps", at("maps")});
      // A uniform change of a uniform frame is no pattern.
      EXPECT_NEAR(root["frames"][0]["jnd_max"].get<double>(), 0.0, 1e-3);
    }
  }
}

}  // namespace
}  // namespace promenade::e2e
