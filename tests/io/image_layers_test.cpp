// Which layer of an OpenEXR file is the picture: files as Blender, Nuke and others write them.

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/core/errors.h"
#include "src/io/image_file.h"
#include "src/io/sequence.h"
#include "tests/io/temp_folder.h"

namespace promenade::io {
namespace {

using testing::HasSubstr;
using tests::messageOf;
using tests::TempFolder;

struct Part {
  std::string name;
  std::vector<std::string> channels;  // their values are 1, 2, 3, ... at every pixel, in this order
};

void writeParts(const std::filesystem::path& file, const std::vector<Part>& parts) {
  std::vector<OIIO::ImageSpec> specs;
  for (const Part& part : parts) {
    OIIO::ImageSpec spec(2, 1, static_cast<int>(part.channels.size()), OIIO::TypeDesc::FLOAT);
    spec.channelnames = part.channels;
    if (!part.name.empty()) spec.attribute("oiio:subimagename", part.name);
    specs.push_back(spec);
  }
  const auto out = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(out->open(file.string(), static_cast<int>(specs.size()), specs.data())) << out->geterror();
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (i > 0) {
      ASSERT_TRUE(out->open(file.string(), specs[i], OIIO::ImageOutput::AppendSubimage)) << out->geterror();
    }
    std::vector<float> values;
    for (int pixel = 0; pixel < 2; ++pixel) {
      for (int c = 1; c <= specs[i].nchannels; ++c) values.push_back(static_cast<float>(c));
    }
    ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data())) << out->geterror();
  }
  ASSERT_TRUE(out->close());
}

Rgb colourIn(const std::filesystem::path& file, const std::string& layer = {}) {
  return std::get<RadianceMap>(readImage(file, layer).colour)(1, 0);
}

// A multi-layer file of Blender: one part, names of view layer, pass and component.
const Part kBlender{
    "",
    {"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B", "ViewLayer.Combined.A",
     "ViewLayer.Depth.Z", "ViewLayer.DiffCol.R", "ViewLayer.DiffCol.G", "ViewLayer.DiffCol.B",
     "ViewLayer.Normal.X", "ViewLayer.Normal.Y", "ViewLayer.Normal.Z", "ViewLayer.Vector.X",
     "ViewLayer.Vector.Y", "ViewLayer.Vector.Z", "ViewLayer.Vector.W"}};

TEST(ImageLayers, TheCombinedPassOfBlenderIsThePictureWhateverElseThereIs) {
  const TempFolder folder;
  writeParts(folder / "b.exr", {kBlender});
  EXPECT_EQ(colourIn(folder / "b.exr"), Rgb(1.0f, 2.0f, 3.0f));
  EXPECT_EQ(colourIn(folder / "b.exr", "ViewLayer.DiffCol"), Rgb(6.0f, 7.0f, 8.0f));
  EXPECT_EQ(colourIn(folder / "b.exr", "diffcol"), Rgb(6.0f, 7.0f, 8.0f));
  EXPECT_EQ(colourIn(folder / "b.exr", "Depth"), Rgb(5.0f));
}

// Its vector pass has where a point came from (X, Y) and, from the next frame back to this one, where it goes
// (Z, W); y is up: (14, 15) is 14 pixels to the left and 15 down.
TEST(ImageLayers, TheVectorPassOfBlenderBecomesFlowToTheNextFrame) {
  const TempFolder folder;
  writeParts(folder / "b.exr", {kBlender});
  const ImageFile image = readImage(folder / "b.exr");
  ASSERT_FALSE(image.flowToNext.empty());
  EXPECT_EQ(image.flowToNext(1, 0), glm::vec2(-14.0f, 15.0f));
}

TEST(ImageLayers, TheForwardLayerOfNukeBecomesFlowToTheNextFrame) {
  const TempFolder folder;
  writeParts(
      folder / "n.exr",
      {{"", {"R", "G", "B", "diffuse.red", "diffuse.green", "diffuse.blue", "forward.u", "forward.v"}}});
  EXPECT_EQ(colourIn(folder / "n.exr"), Rgb(1.0f, 2.0f, 3.0f));
  EXPECT_EQ(colourIn(folder / "n.exr", "diffuse"), Rgb(4.0f, 5.0f, 6.0f));
  EXPECT_EQ(readImage(folder / "n.exr").flowToNext(0, 0), glm::vec2(7.0f, -8.0f));
}

TEST(ImageLayers, OfSeveralPartsTheOneThatIsThePictureIsTaken) {
  const TempFolder folder;
  writeParts(folder / "first.exr",
             {{"main", {"R", "G", "B"}}, {"albedo", {"B", "G", "R"}}, {"Vector", {"X", "Y"}}});
  EXPECT_EQ(colourIn(folder / "first.exr"), Rgb(1.0f, 2.0f, 3.0f));
  EXPECT_EQ(colourIn(folder / "first.exr", "albedo"), Rgb(3.0f, 2.0f, 1.0f));
  EXPECT_EQ(readImage(folder / "first.exr").flowToNext(1, 0), glm::vec2(1.0f, 2.0f));
  writeParts(folder / "beauty.exr", {{"albedo", {"B", "G", "R"}}, {"beauty", {"R", "G", "B"}}});
  EXPECT_EQ(colourIn(folder / "beauty.exr"), Rgb(1.0f, 2.0f, 3.0f));
  writeParts(folder / "prefixed.exr", {{"depth", {"Z"}}, {"beauty", {"beauty.R", "beauty.G", "beauty.B"}}});
  EXPECT_EQ(colourIn(folder / "prefixed.exr"), Rgb(1.0f, 2.0f, 3.0f));
}

TEST(ImageLayers, TheOnlyLayerWithColourNeedsNoName) {
  const TempFolder folder;
  writeParts(folder / "one.exr", {{"", {"pass.R", "pass.G", "pass.B", "N.X", "N.Y", "N.Z"}}});
  EXPECT_EQ(colourIn(folder / "one.exr"), Rgb(1.0f, 2.0f, 3.0f));
}

TEST(ImageLayers, ALuminanceIsThatOfTheChosenLayer) {
  const TempFolder folder;
  writeParts(folder / "y.exr", {{"", {"R", "G", "B", "Y", "light.Y"}}});
  EXPECT_EQ(readImage(folder / "y.exr").luminance(0, 0), 4.0f);
  EXPECT_EQ(readImage(folder / "y.exr", "light").luminance(0, 0), 5.0f);
}

TEST(ImageLayers, WhatIsAmbiguousOrAbsentIsRefusedWithTheNamesOfTheLayers) {
  const TempFolder folder;
  writeParts(folder / "two.exr",
             {{"", {"diffuse.R", "diffuse.G", "diffuse.B", "gloss.R", "gloss.G", "gloss.B"}}});
  const auto refusal = [&](const std::string& file, const std::string& layer) {
    return messageOf<InputError>([&] { (void)readImage(folder / file, layer); });
  };
  EXPECT_THAT(refusal("two.exr", ""),
              HasSubstr("two.exr: several layers have colour (diffuse, gloss): choose one with --layer"));
  EXPECT_THAT(refusal("two.exr", "glos"),
              HasSubstr("expected one of the layers diffuse, gloss, found 'glos'"));
  writeParts(
      folder / "views.exr",
      {{"",
        {"A.Combined.R", "A.Combined.G", "A.Combined.B", "B.Combined.R", "B.Combined.G", "B.Combined.B"}}});
  EXPECT_THAT(refusal("views.exr", ""), HasSubstr("A.Combined, B.Combined"));
  EXPECT_THAT(refusal("views.exr", "Combined"), HasSubstr("several layers end in 'Combined'"));
  EXPECT_EQ(colourIn(folder / "views.exr", "B.Combined"), Rgb(4.0f, 5.0f, 6.0f));
  const auto png = OIIO::ImageOutput::create((folder / "a.png").string());
  const float value = 0.5f;
  ASSERT_TRUE(png->open((folder / "a.png").string(), OIIO::ImageSpec(1, 1, 1, OIIO::TypeDesc::UINT8)));
  ASSERT_TRUE(png->write_image(OIIO::TypeDesc::FLOAT, &value));
  ASSERT_TRUE(png->close());
  EXPECT_THAT(refusal("a.png", "beauty"), HasSubstr("only OpenEXR files have layers"));
}

TEST(ImageLayers, OfASequenceAreReadFromEachOfItsFiles) {
  const TempFolder folder;
  for (const char* name : {"0.exr", "1.exr"}) writeParts(folder / name, {kBlender});
  Sequence sequence = resolveSequence((folder / "%d.exr").string());
  sequence.layer = "DiffCol";
  SequenceReader reader(sequence);
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(std::get<RadianceMap>(reader.next()->colour)(0, 0), Rgb(6.0f, 7.0f, 8.0f));
}

}  // namespace
}  // namespace promenade::io
