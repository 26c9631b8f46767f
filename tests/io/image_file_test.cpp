#include "src/io/image_file.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "src/core/errors.h"
#include "src/io/png.h"
#include "tests/io/temp_folder.h"
#include "tests/shared_data.h"

namespace promenade::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::bytesOf;
using tests::messageOf;
using tests::noiseFrame;
using tests::TempFolder;
using tests::writeBytes;

void writeOiio(const std::filesystem::path& file, const OIIO::ImageSpec& spec,
               const std::vector<float>& values) {
  const auto out = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(out) << OIIO::geterror();
  ASSERT_TRUE(out->open(file.string(), spec)) << out->geterror();
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data())) << out->geterror();
  ASSERT_TRUE(out->close());
}

OIIO::ImageSpec exrSpec(int width, int height, std::vector<std::string> channels) {
  OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames = std::move(channels);
  return spec;
}

TEST(Png, ComesBackExactlyAlsoOfOneByOneAndOddSizes) {
  for (const Size size : {Size{1, 1}, Size{7, 3}, Size{256, 5}}) {
    const TempFolder folder;
    const EncodedMap image = noiseFrame(size, 0);
    write8bit(folder / "a.png", image);
    const ImageFile back = readImage(folder / "a.png");
    ASSERT_TRUE(std::holds_alternative<EncodedMap>(back.colour));
    ASSERT_EQ(back.size(), size);
    for (std::size_t i = 0; i < size.area(); ++i) {
      const Rgb difference = (std::get<EncodedMap>(back.colour).pixels()[i] - image.pixels()[i]) * 255.0f;
      ASSERT_NEAR(difference.r, 0.0f, 1e-4f);
      ASSERT_NEAR(difference.g, 0.0f, 1e-4f);
      ASSERT_NEAR(difference.b, 0.0f, 1e-4f);
    }
    EXPECT_THAT(folder.names(), ElementsAre("a.png"));
  }
}

TEST(Png, RoundsToTheNearestByteAndClamps) {
  const TempFolder folder;
  EncodedMap image(2, 1);
  // 0.499 * 255 = 127.245 -> 127; 0.5 * 255 = 127.5 -> 128.
  image(0, 0) = Rgb(0.499f, 0.5f, 2.0f);
  image(1, 0) = Rgb(-1.0f, std::numeric_limits<float>::quiet_NaN(), 1.0f);
  write8bit(folder / "a.png", image);
  const ImageFile file = readImage(folder / "a.png");
  const auto& back = std::get<EncodedMap>(file.colour);
  EXPECT_NEAR(back(0, 0).r * 255.0f, 127.0f, 1e-3f);
  EXPECT_NEAR(back(0, 0).g * 255.0f, 128.0f, 1e-3f);
  EXPECT_EQ(back(0, 0).b, 1.0f);
  EXPECT_EQ(back(1, 0), Rgb(0.0f, 0.0f, 1.0f));
}

TEST(Png, TwoWritesGiveTheSameBytes) {
  const TempFolder folder;
  write8bit(folder / "a.png", noiseFrame({33, 17}, 4));
  ::sleep(1);
  write8bit(folder / "b.png", noiseFrame({33, 17}, 4));
  EXPECT_EQ(bytesOf(folder / "a.png"), bytesOf(folder / "b.png"));
}

TEST(ReadImage, AGreyIntegerImageIsCodeValuesWithoutALuminance) {
  const TempFolder folder;
  writeOiio(folder / "a.png", OIIO::ImageSpec(2, 1, 1, OIIO::TypeDesc::UINT16), {0.25f, 1.0f});
  const ImageFile image = readImage(folder / "a.png");
  ASSERT_TRUE(std::holds_alternative<EncodedMap>(image.colour));
  EXPECT_NEAR(std::get<EncodedMap>(image.colour)(0, 0).g, 0.25f, 1e-5f);
  EXPECT_EQ(std::get<EncodedMap>(image.colour)(1, 0), Rgb(1.0f));
  EXPECT_TRUE(image.luminance.empty());
}

TEST(ReadImage, LuminanceOfAnExrIsReadBesideItsColour) {
  const TempFolder folder;
  writeOiio(folder / "both.exr", exrSpec(1, 1, {"R", "G", "B", "Y"}), {1.0f, 2.0f, 3.0f, 120.5f});
  const ImageFile both = readImage(folder / "both.exr");
  EXPECT_EQ(std::get<RadianceMap>(both.colour)(0, 0), Rgb(1.0f, 2.0f, 3.0f));
  ASSERT_FALSE(both.luminance.empty());
  EXPECT_EQ(both.luminance(0, 0), 120.5f);
  writeOiio(folder / "only.exr", exrSpec(1, 1, {"Y"}), {80.25f});
  const ImageFile only = readImage(folder / "only.exr");
  EXPECT_EQ(std::get<RadianceMap>(only.colour)(0, 0), Rgb(80.25f));
  EXPECT_EQ(only.luminance(0, 0), 80.25f);
}

TEST(ReadImage, FlowNeedsBothOfItsChannels) {
  const TempFolder folder;
  writeOiio(folder / "both.exr", exrSpec(1, 1, {"R", "G", "B", "Vector.X", "Vector.Y"}),
            {1.0f, 1.0f, 1.0f, -2.5f, 0.125f});
  const ImageFile both = readImage(folder / "both.exr");
  ASSERT_FALSE(both.flowToNext.empty());
  EXPECT_EQ(both.flowToNext(0, 0), glm::vec2(-2.5f, 0.125f));
  writeOiio(folder / "half.exr", exrSpec(1, 1, {"R", "G", "B", "Vector.X"}), {1.0f, 1.0f, 1.0f, 1.0f});
  EXPECT_TRUE(readImage(folder / "half.exr").flowToNext.empty());
}

TEST(ReadImage, CoversTheDisplayWindowWhateverTheDataWindow) {
  const TempFolder folder;
  // A picture of 4x3 of which the file holds the 3x2 that begin at (-1, 2), two of them inside: (0,2) and
  // (1,2).
  OIIO::ImageSpec spec = exrSpec(3, 2, {"R", "G", "B"});
  spec.x = -1;
  spec.y = 2;
  spec.full_width = 4;
  spec.full_height = 3;
  std::vector<float> values;
  for (int i = 0; i < 6; ++i) values.insert(values.end(), 3, static_cast<float>(10 + i));
  writeOiio(folder / "a.exr", spec, values);
  const ImageFile image = readImage(folder / "a.exr");
  const auto& map = std::get<RadianceMap>(image.colour);
  ASSERT_EQ(map.size(), (Size{4, 3}));
  EXPECT_EQ(map(0, 2), Rgb(11.0f));
  EXPECT_EQ(map(1, 2), Rgb(12.0f));
  EXPECT_EQ(map(2, 2), Rgb(0.0f));
  EXPECT_EQ(map(0, 0), Rgb(0.0f));
}

TEST(ReadImage, ReadsRadianceHdr) {
  const TempFolder folder;
  writeOiio(folder / "a.hdr", OIIO::ImageSpec(1, 1, 3, OIIO::TypeDesc::FLOAT), {4.0f, 2.0f, 1.0f});
  const ImageFile image = readImage(folder / "a.hdr");
  // RGBE: powers of two within a shared exponent survive.
  EXPECT_NEAR(std::get<RadianceMap>(image.colour)(0, 0).r, 4.0f, 0.05f);
  EXPECT_NEAR(std::get<RadianceMap>(image.colour)(0, 0).b, 1.0f, 0.05f);
}

TEST(ReadImage, SaysWhatIsWrong) {
  const TempFolder folder;
  EXPECT_THAT(messageOf<InputError>([&] { (void)readImage(folder / "absent.png"); }),
              HasSubstr("no such file"));
  EXPECT_THAT(messageOf<InputError>([&] { (void)readImage(folder.path()); }), HasSubstr("found a folder"));
  writeBytes(folder / "text.png", "not an image");
  EXPECT_THAT(messageOf<InputError>([&] { (void)readImage(folder / "text.png"); }),
              HasSubstr("text.png: cannot read"));
  writeBytes(folder / "empty.png", "");
  EXPECT_THROW((void)readImage(folder / "empty.png"), InputError);
  writeBytes(folder / "unknown.xyz", "neither");
  EXPECT_THROW((void)readImage(folder / "unknown.xyz"), InputError);
  writeOiio(folder / "odd.exr", exrSpec(1, 1, {"U", "V"}), {1.0f, 2.0f});
  EXPECT_THAT(messageOf<InputError>([&] { (void)readImage(folder / "odd.exr"); }), HasSubstr("found U, V"));
}

TEST(ReadImage, ATruncatedPngIsRefused) {
  const TempFolder folder;
  write8bit(folder / "a.png", noiseFrame({64, 64}, 0));
  const std::string whole = bytesOf(folder / "a.png");
  for (const std::size_t length : {whole.size() / 2, whole.size() - 1, std::size_t{8}, std::size_t{12}}) {
    writeBytes(folder / "cut.png", whole.substr(0, length));
    EXPECT_THAT(messageOf<InputError>([&] { (void)readImage(folder / "cut.png"); }), HasSubstr("cut short"));
  }
  writeBytes(folder / "more.png", whole + "what other programs append");
  EXPECT_EQ(readImage(folder / "more.png").size(), (Size{64, 64}));
}

TEST(ReadImage, AHeaderThatClaimsBillionsOfPixelsTakesNoMemory) {
  const TempFolder folder;
  // A netpbm header is its size in words.
  writeBytes(folder / "huge.ppm", "P6\n60000 60000\n255\nxyz");
  EXPECT_THAT(messageOf<InputError>([&] { (void)readImage(folder / "huge.ppm"); }), HasSubstr("60000x60000"));
  writeBytes(folder / "large.ppm", "P6\n10000 10000\n255\nxyz");
  EXPECT_THAT(messageOf<InputError>([&] { (void)readImage(folder / "large.ppm"); }), HasSubstr("damaged"));
}

TEST(ReadImage, ReadsAnotherRenderersPicture) {
  PROMENADE_NEEDS_SHARED("scenes/country-kitchen/mitsuba_ref.exr");
  const ImageFile image = readImage(tests::sharedPath("scenes/country-kitchen/mitsuba_ref.exr"));
  ASSERT_TRUE(std::holds_alternative<RadianceMap>(image.colour));
  double sum = 0.0;
  for (const Rgb& pixel : std::get<RadianceMap>(image.colour).pixels()) sum += static_cast<double>(pixel.g);
  EXPECT_GT(sum / static_cast<double>(image.size().area()), 0.01);
}

}  // namespace
}  // namespace promenade::io
