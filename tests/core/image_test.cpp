#include "src/core/image.h"

#include <gtest/gtest.h>

#include <type_traits>
#include <utility>

namespace promenade {
namespace {

static_assert(!std::is_copy_constructible_v<Image<float>> && !std::is_copy_assignable_v<Image<float>>);
static_assert(!std::is_copy_constructible_v<DepthMap> && !std::is_copy_assignable_v<DepthMap>);
static_assert(std::is_nothrow_move_constructible_v<DepthMap> && std::is_nothrow_move_assignable_v<DepthMap>);
static_assert(!std::is_convertible_v<DepthMap, LuminanceMap>, "a depth is not a luminance");
static_assert(!std::is_constructible_v<LuminanceMap, DepthMap> &&
              !std::is_assignable_v<LuminanceMap&, DepthMap>);

TEST(Image, IsRowMajorWithTheOriginAtTheTopLeft) {
  Image<int> image(3, 2);
  image(1, 0) = 10;
  image(0, 1) = 20;
  image(2, 1) = 30;
  // Index y * width + x: (1,0) -> 1, (0,1) -> 3, (2,1) -> 5.
  EXPECT_EQ(image.pixels()[1], 10);
  EXPECT_EQ(image.pixels()[3], 20);
  EXPECT_EQ(image.pixels()[5], 30);
  EXPECT_EQ(image.row(1).size(), 3U);
  EXPECT_EQ(image.row(1)[2], 30);
}

TEST(Image, IsFilledWithTheGivenValueDownToOnePixel) {
  const Image<int> one(1, 1, 7);
  EXPECT_EQ(one(0, 0), 7);
  EXPECT_EQ(one.row(0).size(), 1U);
  EXPECT_FALSE(one.empty());
  EXPECT_TRUE(Image<int>().empty());
}

TEST(Image, ContainsItsPixelsAndNoOthers) {
  const Image<int> image(5, 3);
  EXPECT_TRUE(image.contains(0, 0));
  EXPECT_TRUE(image.contains(4, 2));
  EXPECT_FALSE(image.contains(5, 2));
  EXPECT_FALSE(image.contains(4, 3));
  EXPECT_FALSE(image.contains(-1, 0));
  EXPECT_FALSE(image.contains(0, -1));
}

TEST(Image, CloneSharesNothing) {
  DepthMap original(2, 2, 1.0f);
  DepthMap copy = original.clone();
  copy(0, 0) = 5.0f;
  EXPECT_EQ(original(0, 0), 1.0f);
  EXPECT_EQ(copy.size(), original.size());
}

TEST(Image, IsEmptyOnceMovedFrom) {
  RadianceMap original(4, 3, Rgb(1.0f));
  const RadianceMap taken = std::move(original);
  EXPECT_EQ(taken.size(), (Size{4, 3}));
  // NOLINTNEXTLINE(bugprone-use-after-move): this is what is tested.
  EXPECT_TRUE(original.empty());
  EXPECT_EQ(original.size(), (Size{0, 0}));
}

TEST(Size, AreaDoesNotOverflowAnInt) {
  EXPECT_EQ((Size{100000, 100000}).area(), 10000000000ULL);
}

}  // namespace
}  // namespace promenade
