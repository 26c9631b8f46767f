#include "src/io/web_picture.h"

#include <gmock/gmock.h>

namespace promenade::io {
namespace {

TEST(WebPicture, IsADataUriOfAWebpFile) {
  // "RIFF" is UklGR in base64 (its last letter shared with the next bytes).
  for (const Size size : {Size{1, 1}, Size{3, 5}, Size{64, 36}}) {
    const EncodedMap image(size, Rgb(0.5f, 0.25f, 1.0f));
    EXPECT_THAT(dataUri(image, PictureCoding::kPhoto), testing::StartsWith("data:image/webp;base64,UklGR"));
    EXPECT_EQ(dataUri(image, PictureCoding::kFlat), dataUri(image, PictureCoding::kFlat));
  }
}

TEST(WebPicture, ReducingTakesTheMeanOfThePixelsThatAreCovered) {
  EncodedMap image(4, 2, Rgb(0.0f));
  image(0, 0) = image(1, 0) = Rgb(1.0f);
  image(3, 1) = Rgb(0.4f);
  const EncodedMap half = reduced(image, {2, 1});
  EXPECT_NEAR(half(0, 0).r, 0.5f, 1e-5f);  // two of four
  EXPECT_NEAR(half(1, 0).g, 0.1f, 1e-5f);  // 0.4 / 4
  const EncodedMap same = reduced(image, {4, 2});
  EXPECT_EQ(same(3, 1), image(3, 1));
  EXPECT_EQ(reduced(image, {1, 1}).size(), (Size{1, 1}));
}

}  // namespace
}  // namespace promenade::io
