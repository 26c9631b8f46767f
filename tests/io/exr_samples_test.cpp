#include "src/io/exr_samples.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <limits>

#include "src/core/errors.h"
#include "tests/io/temp_folder.h"

namespace promenade::io {
namespace {

template <class T>
bool sameBits(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

const SamplesNote kNote{"job", R"({"a": 1})"};

Frame someSamples(const Camera& camera) {
  const Size size = camera.size();
  Frame s{{camera, DepthMap(size), NormalMap(size), ItemBuffer(size)},
          RadianceMap(size),
          RadianceMap(size),
          SourceMap(size)};
  float value = 1.0f / 3.0f;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      s.diffuse(x, y) = Rgb(value, -value, 1e-42f);  // a subnormal, too
      s.viewDependent(x, y) = Rgb(70000.0f * value, 0.0f, -0.0f);
      s.visibility.depth(x, y) = (x + y) % 3 == 0 ? std::numeric_limits<float>::infinity() : value;
      s.visibility.normal(x, y) = {value, 0.1f, -0.7f};
      s.visibility.item(x, y) = 0xfffffff0u + static_cast<ItemId>(x);
      s.source(x, y) = static_cast<SampleSource>((x + y) % 6);
      value *= 1.37f;
    }
  }
  return s;
}

TEST(ExrSamples, ComeBackBitForBit) {
  const tests::TempFolder folder;
  for (const Size size : {Size{1, 1}, Size{7, 5}, Size{33, 18}}) {
    const Camera camera(Pose{}, 1.0, size);
    const Frame a = someSamples(camera);
    writeSamples(folder / "s.exr", a, kNote);
    const auto read = readSamples(folder / "s.exr", camera, "job");
    ASSERT_TRUE(read);
    const Frame& b = read->frame;
    EXPECT_TRUE(sameBits(a.diffuse.pixels(), b.diffuse.pixels()));
    EXPECT_TRUE(sameBits(a.viewDependent.pixels(), b.viewDependent.pixels()));
    EXPECT_TRUE(sameBits(a.visibility.depth.pixels(), b.visibility.depth.pixels()));
    EXPECT_TRUE(sameBits(a.visibility.normal.pixels(), b.visibility.normal.pixels()));
    EXPECT_TRUE(sameBits(a.visibility.item.pixels(), b.visibility.item.pixels()));
    EXPECT_TRUE(sameBits(a.source.pixels(), b.source.pixels()));
    EXPECT_EQ(read->note.statistics, kNote.statistics);
  }
}

TEST(ExrSamples, OfAnotherJobOrMissingAreNone) {
  const tests::TempFolder folder;
  const Camera camera(Pose{}, 1.0, Size{4, 3});
  EXPECT_FALSE(readSamples(folder / "s.exr", camera, "job"));
  writeSamples(folder / "s.exr", someSamples(camera), kNote);
  EXPECT_FALSE(readSamples(folder / "s.exr", camera, "another"));
}

TEST(ExrSamples, ThatDoNotFitAreRefused) {
  const tests::TempFolder folder;
  const Camera camera(Pose{}, 1.0, Size{4, 3});
  writeSamples(folder / "s.exr", someSamples(camera), kNote);
  EXPECT_THROW((void)readSamples(folder / "s.exr", Camera(Pose{}, 1.0, Size{4, 4}), "job"), InputError);
  std::ofstream(folder / "s.exr") << "no OpenEXR file";
  EXPECT_THROW((void)readSamples(folder / "s.exr", camera, "job"), InputError);
}

}  // namespace
}  // namespace promenade::io
