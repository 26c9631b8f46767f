#include "src/io/sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/core/errors.h"
#include "src/io/png.h"
#include "src/io/video.h"
#include "tests/io/temp_folder.h"

namespace promenade::io {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using tests::messageOf;
using tests::noiseFrame;
using tests::TempFolder;
using tests::writeBytes;

std::vector<std::string> names(const Sequence& sequence) {
  std::vector<std::string> found;
  for (const fs::path& file : sequence.images) found.push_back(file.filename().string());
  return found;
}

void makeFiles(const fs::path& folder, const std::vector<std::string>& fileNames) {
  for (const std::string& name : fileNames) writeBytes(folder / name, "x");
}

std::string errorOf(const fs::path& argument) {
  return messageOf<InputError>([&] { (void)resolveSequence(argument.string()); });
}

TEST(Sequence, AnImageIsASequenceOfOne) {
  const TempFolder folder;
  makeFiles(folder.path(), {"a.png"});
  const Sequence sequence = resolveSequence((folder / "a.png").string());
  EXPECT_THAT(names(sequence), ElementsAre("a.png"));
  EXPECT_FALSE(sequence.isVideo());
}

TEST(Sequence, AFolderIsItsImagesInTheOrderOfTheirNames) {
  const TempFolder folder;
  makeFiles(folder.path(),
            {"b.exr", "a.exr", "c.EXR", "report.json", ".d.exr.12-0.promenade-tmp", ".hidden.exr"});
  EXPECT_THAT(names(resolveSequence(folder.path().string())), ElementsAre("a.exr", "b.exr", "c.EXR"));
}

TEST(Sequence, AFolderThatRenderWroteIsItsFrames) {
  const TempFolder folder;
  fs::create_directory(folder / "frames");
  makeFiles(folder.path(), {"report.json", "walkthrough.mp4"});
  makeFiles(folder / "frames", {"000000.exr", "000001.exr"});
  EXPECT_THAT(names(resolveSequence(folder.path().string())), ElementsAre("000000.exr", "000001.exr"));
}

TEST(Sequence, AFolderMayHoldAnyFormatOfOpenImageIO) {
  for (const char* name :
       {"a.sgi", "a.psd", "a.cin", "a.fits", "a.JPEG", "a.j2k", "a.tx", "a.pic", "a.rla"}) {
    const TempFolder folder;
    makeFiles(folder.path(), {name, "notes.txt", "walk.mp4", "walk.gif", "points.vdb"});
    EXPECT_THAT(names(resolveSequence(folder.path().string())), ElementsAre(name));
  }
}

TEST(Sequence, AFolderOfSeveralKindsIsAmbiguous) {
  const TempFolder folder;
  makeFiles(folder.path(), {"a.exr", "b.exr", "a.png"});
  EXPECT_THAT(errorOf(folder.path()), HasSubstr("found 2 .exr, 1 .png"));
}

TEST(Sequence, AFolderWithoutImagesSaysSo) {
  const TempFolder folder;
  makeFiles(folder.path(), {"a.txt", "b.txt"});
  EXPECT_THAT(errorOf(folder.path()), HasSubstr("found no image among its 2 files"));
}

TEST(Sequence, APrintfPatternTakesNumbersInTheirOrder) {
  const TempFolder folder;
  makeFiles(folder.path(), {"f_8.png", "f_9.png", "f_10.png", "f_11.png", "f_.png", "g_1.png", "f_1x.png"});
  EXPECT_THAT(names(resolveSequence((folder / "f_%d.png").string())),
              ElementsAre("f_8.png", "f_9.png", "f_10.png", "f_11.png"));
}

TEST(Sequence, APaddedPatternTakesOnlyPaddedNumbers) {
  const TempFolder folder;
  makeFiles(folder.path(), {"0003.exr", "0004.exr", "5.exr", "00005.exr"});
  EXPECT_THAT(names(resolveSequence((folder / "%04d.exr").string())), ElementsAre("0003.exr", "0004.exr"));
}

TEST(Sequence, APatternWithAGapNamesTheMissingFrame) {
  const TempFolder folder;
  makeFiles(folder.path(), {"000.exr", "001.exr", "003.exr"});
  EXPECT_THAT(errorOf(folder / "%03d.exr"), HasSubstr("frame 2 is missing; found 3 frames from 0 to 3"));
}

TEST(Sequence, APatternThatFitsNothingSaysWhatIsThere) {
  const TempFolder folder;
  makeFiles(folder.path(), {"000.exr", "001.exr"});
  EXPECT_THAT(errorOf(folder / "%06d.exr"), HasSubstr("holds 2 images (000.exr to 001.exr)"));
  EXPECT_THAT(errorOf(folder / "absent/%06d.exr"), HasSubstr("there is no folder"));
}

TEST(Sequence, AGlobTakesWhatItMatchesInTheOrderOfTheNames) {
  const TempFolder folder;
  makeFiles(folder.path(), {"b2.png", "b1.png", "a1.png"});
  EXPECT_THAT(names(resolveSequence((folder / "b*.png").string())), ElementsAre("b1.png", "b2.png"));
  EXPECT_THAT(names(resolveSequence((folder / "[ab]1.png").string())), ElementsAre("a1.png", "b1.png"));
  EXPECT_THAT(errorOf(folder / "c*.png"), HasSubstr("no file has such a name"));
}

TEST(Sequence, AFileThatBearsTheVeryNameComesBeforePatternAndGlob) {
  const TempFolder folder;
  makeFiles(folder.path(), {"a[1].png", "a1.png", "%d.png", "7.png"});
  EXPECT_THAT(names(resolveSequence((folder / "a[1].png").string())), ElementsAre("a[1].png"));
  EXPECT_THAT(names(resolveSequence((folder / "%d.png").string())), ElementsAre("%d.png"));
}

TEST(Sequence, NothingThereSaysWhatIs) {
  const TempFolder folder;
  makeFiles(folder.path(), {"a.png"});
  EXPECT_THAT(errorOf(folder / "b.png"), HasSubstr("no such file or folder"));
  EXPECT_THAT(errorOf(folder / "b.png"), HasSubstr("holds 1 image (a.png)"));
  EXPECT_THAT(errorOf(""), HasSubstr("no such file or folder"));
}

TEST(SequenceReader, ReadsImagesInOrder) {
  const TempFolder folder;
  for (int i = 0; i < 3; ++i)
    write8bit(folder / (std::to_string(i) + ".png"), EncodedMap(4, 3, Rgb(float(i) / 2.0f)));
  SequenceReader reader(resolveSequence((folder / "%d.png").string()));
  EXPECT_EQ(reader.frameCount(), 3);
  EXPECT_FALSE(reader.framesPerSecond().has_value());
  for (int i = 0; i < 3; ++i) {
    const auto image = reader.next();
    ASSERT_TRUE(image.has_value());
    EXPECT_NEAR(std::get<EncodedMap>(image->colour)(3, 2).r, static_cast<float>(i) / 2.0f, 0.003f);
    EXPECT_EQ(reader.file(i).filename().string(), std::to_string(i) + ".png");
  }
  EXPECT_FALSE(reader.next().has_value());
}

TEST(SequenceReader, ReadsAVideoTheSameWay) {
  const TempFolder folder;
  VideoWriter writer(folder / "v.mkv", {6, 4}, {30, 1});
  for (int i = 0; i < 4; ++i) writer.write(noiseFrame({6, 4}, i));
  writer.finish();
  SequenceReader reader(resolveSequence((folder / "v.mkv").string()));
  EXPECT_EQ(reader.frameCount(), 4);
  EXPECT_NEAR(reader.framesPerSecond().value(), 30.0, 1e-9);
  int count = 0;
  while (const auto image = reader.next()) {
    EXPECT_EQ(std::get<EncodedMap>(image->colour)(5, 3), noiseFrame({6, 4}, count)(5, 3));
    ++count;
  }
  EXPECT_EQ(count, 4);
}

TEST(SequenceReader, StatesBothSizesWhenTheyDiffer) {
  const TempFolder folder;
  write8bit(folder / "0.png", EncodedMap(4, 3));
  write8bit(folder / "1.png", EncodedMap(5, 3));
  SequenceReader reader(resolveSequence(folder.path().string()));
  ASSERT_TRUE(reader.next().has_value());
  EXPECT_THAT(messageOf<InputError>([&] { (void)reader.next(); }), HasSubstr("4x3, found 5x3"));
}

}  // namespace
}  // namespace promenade::io
