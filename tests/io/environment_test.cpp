#include "src/io/environment.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "src/core/errors.h"
#include "src/io/png.h"
#include "tests/io/temp_folder.h"

namespace promenade::io {
namespace {

using testing::HasSubstr;

TEST(Environment, IsRadianceWithoutValuesThatBreakSampling) {
  const tests::TempFolder folder;
  const std::string file = (folder / "sky.exr").string();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::vector<float> values{0.5f, 2.0f, 1e6f, kNan, -1.0f, kInfinity};
  const auto out = OIIO::ImageOutput::create(file);
  ASSERT_TRUE(out);
  ASSERT_TRUE(out->open(file, OIIO::ImageSpec(2, 1, 3, OIIO::TypeDesc::FLOAT)));
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
  ASSERT_TRUE(out->close());
  const RadianceMap sky = readEnvironment(file);
  ASSERT_EQ(sky.size(), (Size{2, 1}));
  EXPECT_EQ(sky(0, 0), Rgb(0.5f, 2.0f, 65504.0f));
  EXPECT_EQ(sky(1, 0), Rgb(0.0f, 0.0f, 65504.0f));
}

TEST(Environment, IsNotADisplayEncodedImage) {
  const tests::TempFolder folder;
  write8bit(folder / "sky.png", EncodedMap(2, 1, Rgb(0.5f)));
  EXPECT_THAT(tests::messageOf<InputError>([&] { (void)readEnvironment(folder / "sky.png"); }),
              HasSubstr("expected linear floating-point radiance"));
}

}  // namespace
}  // namespace promenade::io
