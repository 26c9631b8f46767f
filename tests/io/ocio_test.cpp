// Views of OpenColorIO configs that can be worked out by hand.

#include "src/io/ocio.h"

#include <gmock/gmock.h>

#include "src/core/errors.h"
#include "tests/io/ocio_config.h"
#include "tests/io/temp_folder.h"

namespace promenade::io {
namespace {

using testing::HasSubstr;
using tests::messageOf;
using tests::TempFolder;
using tests::writeOcioConfig;

void expectNear(const Rgb& found, const Rgb& expected, float tolerance) {
  EXPECT_NEAR(found.r, expected.r, tolerance);
  EXPECT_NEAR(found.g, expected.g, tolerance);
  EXPECT_NEAR(found.b, expected.b, tolerance);
}

TEST(Ocio, TheDefaultViewIsItsMatrixThenItsTable) {
  const TempFolder folder;
  const ColourView view = openColourView({.config = writeOcioConfig(folder.path())});
  EXPECT_EQ(view.display, "Screen");
  EXPECT_EQ(view.view, "Swapped");
  EXPECT_EQ(view.input, "scene_linear");
  // (0.25, 0.5, 1) is (0.5, 0.25, 0.5) after the matrix; the table makes 0.8 of 0.5 and 0.4 of 0.25.
  expectNear(view.codes(Rgb(0.25f, 0.5f, 1.0f)), Rgb(0.8f, 0.4f, 0.8f), 1e-6f);
  expectNear(view.codes(Rgb(1e6f)), Rgb(1.0f), 1e-6f);
}

TEST(Ocio, DisplayViewAndColourSpaceCanBeChosen) {
  const TempFolder folder;
  const std::string config = writeOcioConfig(folder.path());
  const Rgb colour(0.25f, 0.5f, 1.0f);
  expectNear(openColourView({.config = config, .view = "Plain"}).codes(colour), colour, 1e-6f);
  const ColourView wall = openColourView({.config = config, .display = "Wall", .input = "halves"});
  EXPECT_EQ(wall.view, "Plain");
  expectNear(wall.codes(colour), colour * 0.5f, 1e-6f);
}

TEST(Ocio, ThroughAcesRadianceIsRec709) {
  const TempFolder folder;
  const auto config = folder / "aces.ocio";
  tests::writeBytes(config, R"(ocio_profile_version: 2
roles: {default: aces, aces_interchange: aces, scene_linear: else}
displays:
  Screen:
    - !<View> {name: Aces, colorspace: aces}
colorspaces:
  - !<ColorSpace> {name: aces}
  - !<ColorSpace> {name: else}
)");
  const ColourView view = openColourView({.config = config});
  EXPECT_EQ(view.input, "aces_interchange");
  expectNear(view.codes(Rgb(1.0f)), Rgb(1.0f), 1e-4f);
  // Red of Rec.709 in ACES2065-1 (Academy TB-2014-004 for its primaries; from D65 to its white by Bradford).
  expectNear(view.codes(Rgb(1.0f, 0.0f, 0.0f)), Rgb(0.43963f, 0.08978f, 0.01754f), 1e-4f);
}

TEST(Ocio, AUsualNameOfRec709IsPreferredToRoles) {
  const TempFolder folder;
  const auto config = folder / "named.ocio";
  tests::writeBytes(config, R"(ocio_profile_version: 2
roles: {default: wide, scene_linear: wide}
displays:
  Screen:
    - !<View> {name: Wide, colorspace: wide}
colorspaces:
  - !<ColorSpace> {name: wide}
  - !<ColorSpace>
    name: Utility - Linear - sRGB
    to_scene_reference: !<MatrixTransform> {matrix: [2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1]}
)");
  expectNear(openColourView({.config = config}).codes(Rgb(0.1f)), Rgb(0.2f, 0.3f, 0.4f), 1e-6f);
}

TEST(Ocio, EqualTransformsHaveEqualFingerprintsWhereverTheyAre) {
  const TempFolder one;
  const TempFolder other;
  const std::string config = writeOcioConfig(one.path());
  const std::string fingerprint = openColourView({.config = config}).fingerprint;
  EXPECT_EQ(openColourView({.config = writeOcioConfig(other.path())}).fingerprint, fingerprint);
  EXPECT_NE(openColourView({.config = config, .view = "Plain"}).fingerprint, fingerprint);
  // The table decides, too. (In another folder: a process reads each file once.)
  const TempFolder changed;
  const std::string brighter = writeOcioConfig(changed.path());
  tests::writeBytes(changed / "rise.spi1d",
                    "Version 1\nFrom 0.0 1.0\nLength 3\nComponents 1\n{\n 0.0\n 0.9\n 1.0\n}\n");
  EXPECT_NE(openColourView({.config = brighter}).fingerprint, fingerprint);
}

TEST(Ocio, WhatIsNotThereIsNamedWithWhatIs) {
  const TempFolder folder;
  const std::string config = writeOcioConfig(folder.path());
  const auto refused = [&](const ColourViewRequest& request) {
    return messageOf<InputError>([&] { (void)openColourView(request); });
  };
  EXPECT_EQ(refused({.config = config, .display = "Screem"}),
            config + ": there is no display 'Screem'; expected one of 'Screen', 'Wall'");
  EXPECT_EQ(refused({.config = config, .view = "Film"}),
            config + ": the display 'Screen' has no view 'Film'; expected one of 'Swapped', 'Plain'");
  EXPECT_EQ(refused({.config = config, .input = "film"}),
            config + ": there is no colour space 'film'; expected one of 'radiance', 'halves', 'swapped'");
  EXPECT_THAT(refused({.config = folder / "none.ocio"}), HasSubstr("none.ocio"));
}

TEST(Ocio, DamagedConfigsAreRefused) {
  const TempFolder folder;
  const auto refused = [&](const std::string& text) {
    tests::writeBytes(folder / "bad.ocio", text);
    return messageOf<InputError>([&] { (void)openColourView({.config = folder / "bad.ocio"}); });
  };
  EXPECT_THAT(refused("not a config"), HasSubstr("bad.ocio: OpenColorIO: "));
  EXPECT_THAT(
      refused("ocio_profile_version: 2\nroles: {default: a}\ncolorspaces:\n  - !<ColorSpace> {name: a}\n"),
      HasSubstr("bad.ocio: the config has no displays"));
  const std::string config = writeOcioConfig(folder.path());
  std::filesystem::remove(folder / "rise.spi1d");
  EXPECT_THAT(messageOf<InputError>([&] { (void)openColourView({.config = config}); }),
              HasSubstr("rise.spi1d"));
}

}  // namespace
}  // namespace promenade::io
