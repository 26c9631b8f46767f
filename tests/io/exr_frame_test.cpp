#include "src/io/exr_frame.h"

#include <Imath/ImathMatrix.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <limits>
#include <map>

#include "src/core/errors.h"
#include "src/io/exr_maps.h"
#include "src/io/image_file.h"
#include "tests/io/temp_folder.h"

namespace promenade::io {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;
using testing::UnorderedElementsAre;
using tests::bytesOf;
using tests::messageOf;
using tests::TempFolder;
using tests::writeBytes;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Pose tiltedPose() {
  // Columns (0.6, 0, -0.8), (0, 1, 0), (0.8, 0, 0.6): orthonormal, right-handed.
  Pose pose;
  pose.worldFromCamera = glm::dmat3(glm::dvec3(0.6, 0, -0.8), glm::dvec3(0, 1, 0), glm::dvec3(0.8, 0, 0.6));
  pose.eye = {1.25, 1.7, -3.1};
  return pose;
}

// Values that half and float hold exactly.
FrameFile sampleFrame(Size size) {
  FrameFile frame;
  frame.metadata = {.frame = 12,
                    .framesPerSecond = 25.0,
                    .camera = Camera(tiltedPose(), 0.9, size, {0.25, -0.125}),
                    .scene = "hall.glb",
                    .programVersion = "0.1.0",
                    .jobHash = "0123abcd"};
  frame.radiance = RadianceMap(size);
  frame.depth = DepthMap(size);
  frame.normal = NormalMap(size);
  frame.flowToNext = PixelFlow(size);
  frame.item = ItemBuffer(size);
  frame.source = SourceMap(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const auto i = static_cast<float>((y * size.width + x) % 1024);
      frame.radiance(x, y) = Rgb(i / 64.0f, 2.0f, 1024.0f - i);
      frame.depth(x, y) = x == y ? kInfinity : 0.1f + i;
      frame.normal(x, y) = glm::vec3(-0.5f, 0.75f, 0.25f);
      frame.flowToNext(x, y) = glm::vec2(0.1f * i, -3.3f);
      frame.item(x, y) = x == y ? kNoItem : 4000000000U + static_cast<ItemId>(x);
      frame.source(x, y) = static_cast<SampleSource>((x + y) % 6);
    }
  }
  return frame;
}

template <class Map>
void expectEqual(const Map& a, const Map& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.pixels().size(); ++i)
    ASSERT_EQ(a.pixels()[i], b.pixels()[i]) << "pixel " << i;
}

TEST(ExrFrame, ComesBackExactlyAlsoOfOneByOneAndOddSizes) {
  for (const Size size : {Size{1, 1}, Size{1, 7}, Size{13, 1}, Size{17, 19}, Size{64, 33}}) {
    const TempFolder folder;
    const FrameFile frame = sampleFrame(size);
    writeFrame(folder / "f.exr", frame);
    const FrameFile back = readFrame(folder / "f.exr");
    expectEqual(back.radiance, frame.radiance);
    expectEqual(back.depth, frame.depth);
    expectEqual(back.normal, frame.normal);
    expectEqual(back.flowToNext, frame.flowToNext);
    expectEqual(back.item, frame.item);
    expectEqual(back.source, frame.source);
  }
}

TEST(ExrFrame, MetadataComesBackExactly) {
  const TempFolder folder;
  const FrameFile frame = sampleFrame({16, 9});
  writeFrame(folder / "f.exr", frame);
  const FrameMetadata back = readFrameMetadata(folder / "f.exr");
  EXPECT_EQ(back.frame, 12);
  EXPECT_EQ(back.framesPerSecond, 25.0);
  EXPECT_EQ(back.scene, "hall.glb");
  EXPECT_EQ(back.programVersion, "0.1.0");
  EXPECT_EQ(back.jobHash, "0123abcd");
  EXPECT_EQ(back.camera.size(), (Size{16, 9}));
  EXPECT_EQ(back.camera.verticalFieldOfView(), 0.9);
  EXPECT_EQ(back.camera.pose().worldFromCamera, tiltedPose().worldFromCamera);
  EXPECT_EQ(back.camera.pose().eye, tiltedPose().eye);
  EXPECT_EQ(back.camera.subpixelOffset(), glm::dvec2(0.25, -0.125));
}

TEST(ExrFrame, ChannelsHaveTheNamesAndTypesThatCompositorsRead) {
  const TempFolder folder;
  writeFrame(folder / "f.exr", sampleFrame({5, 3}));
  const auto in = OIIO::ImageInput::open((folder / "f.exr").string());
  ASSERT_TRUE(in) << OIIO::geterror();
  const OIIO::ImageSpec& spec = in->spec();
  std::map<std::string, std::string> types;
  for (int i = 0; i < spec.nchannels; ++i) {
    types[spec.channelnames[static_cast<std::size_t>(i)]] = spec.channelformat(i).c_str();
  }
  EXPECT_THAT(
      types, UnorderedElementsAre(Pair("R", "half"), Pair("G", "half"), Pair("B", "half"), Pair("Z", "float"),
                                  Pair("N.X", "half"), Pair("N.Y", "half"), Pair("N.Z", "half"),
                                  Pair("Vector.X", "float"), Pair("Vector.Y", "float"),
                                  Pair("Item.ID", "uint"), Pair("Source", "half")));
  EXPECT_EQ(spec.get_string_attribute("compression"), "zip");
  EXPECT_EQ(spec.get_string_attribute("promenade:scene"), "hall.glb");
  EXPECT_EQ(spec.get_int_attribute("promenade:frame"), 12);
  EXPECT_EQ(spec.get_string_attribute("Software"), "Promenade 0.1.0");
  EXPECT_EQ(spec.find_attribute("DateTime"), nullptr);
}

TEST(ExrFrame, StandardMatricesSayWhereAPointOfTheWorldIsSeen) {
  const TempFolder folder;
  const FrameFile frame = sampleFrame({40, 20});
  writeFrame(folder / "f.exr", frame);
  const Imf::InputFile in((folder / "f.exr").c_str(), 0);
  // 3 m ahead, through image position (30, 5).
  const Camera& camera = frame.metadata.camera;
  const glm::dvec3 point = camera.pointAt({30.0, 5.0}, 3.0);
  const Imath::V3f world(static_cast<float>(point.x), static_cast<float>(point.y),
                         static_cast<float>(point.z));
  Imath::V3f cameraSpace;
  Imf::worldToCamera(in.header()).multVecMatrix(world, cameraSpace);
  // Left-handed camera space: depth is +z; the point is right of and above the axis.
  EXPECT_NEAR(cameraSpace.z, 3.0f, 1e-5f);
  EXPECT_GT(cameraSpace.x, 0.0f);
  EXPECT_GT(cameraSpace.y, 0.0f);
  // NDC runs from 0 to 1, y down: 30/40 and 5/20.
  Imath::V3f ndc;
  Imf::worldToNDC(in.header()).multVecMatrix(world, ndc);
  EXPECT_NEAR(ndc.x, 0.75f, 1e-5f);
  EXPECT_NEAR(ndc.y, 0.25f, 1e-5f);
  EXPECT_EQ(Imf::framesPerSecond(in.header()).n, 25);
  EXPECT_EQ(Imf::framesPerSecond(in.header()).d, 1U);
}

TEST(ExrFrame, TwoWritesGiveTheSameBytes) {
  const TempFolder folder;
  writeFrame(folder / "a.exr", sampleFrame({37, 21}));
  ::sleep(1);  // long enough for a clock in the file to show
  writeFrame(folder / "b.exr", sampleFrame({37, 21}));
  EXPECT_FALSE(bytesOf(folder / "a.exr").empty());
  EXPECT_EQ(bytesOf(folder / "a.exr"), bytesOf(folder / "b.exr"));
}

TEST(ExrFrame, RadianceIsClampedToWhatHalfHoldsAndNeverNotANumber) {
  const TempFolder folder;
  FrameFile frame = sampleFrame({3, 1});
  frame.radiance(0, 0) = Rgb(kNan, kInfinity, -kInfinity);
  frame.radiance(1, 0) = Rgb(1e9f, 65504.0f, 65519.0f);
  frame.radiance(2, 0) = Rgb(-0.5f, 0.1f, 1e-9f);
  writeFrame(folder / "f.exr", frame);
  const FrameFile back = readFrame(folder / "f.exr");
  EXPECT_EQ(back.radiance(0, 0), Rgb(0.0f, 65504.0f, -65504.0f));
  EXPECT_EQ(back.radiance(1, 0), Rgb(65504.0f));
  // 0.1 in half: 1638 * 2^-14 = 0.0999755859375; 1e-9 is below the smallest half.
  EXPECT_EQ(back.radiance(2, 0), Rgb(-0.5f, 0.0999755859375f, 0.0f));
}

TEST(ExrFrame, FlowWithoutADestinationStaysNotANumber) {
  const TempFolder folder;
  FrameFile frame = sampleFrame({2, 1});
  frame.flowToNext(1, 0) = glm::vec2(kNan);
  writeFrame(folder / "f.exr", frame);
  const FrameFile back = readFrame(folder / "f.exr");
  EXPECT_TRUE(std::isnan(back.flowToNext(1, 0).x));
  EXPECT_FALSE(std::isnan(back.flowToNext(0, 0).x));
}

TEST(ExrFrame, EmptyMapsHaveNoChannels) {
  const TempFolder folder;
  FrameFile frame;
  frame.metadata.camera = Camera(Pose{}, 1.0, Size{2, 2});
  frame.radiance = RadianceMap(2, 2, Rgb(1.0f));
  writeFrame(folder / "f.exr", frame);
  const auto in = OIIO::ImageInput::open((folder / "f.exr").string());
  ASSERT_TRUE(in);
  EXPECT_EQ(in->spec().nchannels, 3);
  const FrameFile back = readFrame(folder / "f.exr");
  EXPECT_TRUE(back.depth.empty() && back.normal.empty() && back.flowToNext.empty() && back.item.empty() &&
              back.source.empty());
  EXPECT_EQ(back.metadata.framesPerSecond, 0.0);
}

TEST(ExrFrame, IsReadableAsAnyOtherImageToo) {
  const TempFolder folder;
  const FrameFile frame = sampleFrame({11, 6});
  writeFrame(folder / "f.exr", frame);
  const ImageFile image = readImage(folder / "f.exr");
  ASSERT_TRUE(std::holds_alternative<RadianceMap>(image.colour));
  expectEqual(std::get<RadianceMap>(image.colour), frame.radiance);
  expectEqual(image.flowToNext, frame.flowToNext);
  EXPECT_TRUE(image.luminance.empty());
}

TEST(ExrFrame, ATruncatedFileIsRefusedWhereverItIsCut) {
  const TempFolder folder;
  writeFrame(folder / "f.exr", sampleFrame({64, 64}));
  const std::string whole = bytesOf(folder / "f.exr");
  for (const double part : {0.0, 0.01, 0.2, 0.5, 0.9, 0.999}) {
    writeBytes(folder / "cut.exr",
               whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
    EXPECT_THROW((void)readFrame(folder / "cut.exr"), InputError) << "cut at " << part;
    EXPECT_THROW((void)readImage(folder / "cut.exr"), InputError) << "cut at " << part;
  }
}

TEST(ExrFrame, OtherFilesAreRefusedByTheReason) {
  const TempFolder folder;
  EXPECT_THAT(messageOf<InputError>([&] { (void)readFrame(folder / "absent.exr"); }),
              HasSubstr("no such file"));
  writeBytes(folder / "text.exr", "this is not an image at all, but it is long enough to be one");
  EXPECT_THAT(messageOf<InputError>([&] { (void)readFrame(folder / "text.exr"); }),
              HasSubstr("text.exr: cannot read"));
  // An OpenEXR file, but not one of ours.
  const JndMap jnd(2, 2, 1.0f);
  writeMaps(folder / "maps.exr", {jnd, jnd, ProbabilityMap(2, 2, 0.5f)});
  EXPECT_THAT(messageOf<InputError>([&] { (void)readFrame(folder / "maps.exr"); }), HasSubstr("not a frame"));
}

TEST(ExrFrame, NothingIsWrittenIntoAFolderThatIsNotThere) {
  const TempFolder folder;
  EXPECT_THROW(writeFrame(folder / "absent/f.exr", sampleFrame({2, 2})), InputError);
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(ExrFrame, NamesAreSixDigitsAndSortAsNumbers) {
  EXPECT_EQ(frameFileName(0), "000000.exr");
  EXPECT_EQ(frameFileName(1234), "001234.exr");
}

TEST(ExrMaps, HoldJJpAndPAsFloat) {
  const TempFolder folder;
  JndMap jnd(3, 1, 2.1f);
  const JndMap pooled(3, 1, 1.0978f);
  const ProbabilityMap probability(3, 1, 0.75000006f);  // one step above the threshold
  jnd(2, 0) = 0.0f;
  writeMaps(folder / "m.exr", {jnd, pooled, probability});
  const auto in = OIIO::ImageInput::open((folder / "m.exr").string());
  ASSERT_TRUE(in);
  EXPECT_EQ(in->spec().channelnames, (std::vector<std::string>{"J", "Jp", "P"}));
  EXPECT_TRUE(in->spec().channelformats.empty());
  EXPECT_EQ(in->spec().format, OIIO::TypeDesc::FLOAT);
  std::vector<float> values(9);
  ASSERT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, values.data()));
  EXPECT_EQ(values[6], 0.0f);
  EXPECT_EQ(values[7], 1.0978f);
  EXPECT_EQ(values[8], 0.75000006f);
}

}  // namespace
}  // namespace promenade::io
