// aqm and ibr are for other programs too: this one links nothing else of the project, and must need none of
// the libraries of its other folders.

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "aqm/metric.h"
#include "ibr/blend.h"
#include "ibr/flow.h"
#include "ibr/warp.h"

namespace promenade {
namespace {

// A wall that fills the view, 2 m away and facing the eye.
Frame wall(Size size, float radiance) {
  Frame frame{{Camera(Pose{}, 1.0, size), DepthMap(size, 2.0f), NormalMap(size, glm::vec3(0.0f, 0.0f, 1.0f)),
               ItemBuffer(size, ItemId{1})},
              RadianceMap(size, Rgb(radiance)),
              RadianceMap(size),
              SourceMap(size, SampleSource::kTraced)};
  return frame;
}

}  // namespace

TEST(TheLibrariesAlone, NeedNeitherRayTracerNorSceneReaderNorImageFiles) {
  std::ifstream maps("/proc/self/maps");
  ASSERT_TRUE(maps.is_open());
  int libraries = 0;
  for (std::string line; std::getline(maps, line);) {
    if (line.find(".so") != std::string::npos) ++libraries;
    for (const char* name : {"libembree", "libtinygltf", "libOpenImageIO", "libOpenEXR", "libavcodec"}) {
      EXPECT_EQ(line.find(name), std::string::npos) << line;
    }
  }
  EXPECT_GT(libraries, 0);
}

TEST(TheMetricAlone, SeesTwiceTheLightAndNotTheSame) {
  const Size size{64, 48};
  LuminanceMap grating(size, 50.0f);
  LuminanceMap field(size, 50.0f);
  // 2 cycles/degree at full contrast: far above threshold.
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) grating(x, y) = x / 8 % 2 == 0 ? 5.0f : 95.0f;
  }
  const aqm::Settings viewing{.pixelsPerDegree = 32.0};
  const auto different = aqm::compare(grating, field, VelocityMap(), viewing);
  const auto same = aqm::compare(grating, grating, VelocityMap(), viewing);
  EXPECT_GT(aqm::percentVisible(different.probability, Mask()), 50.0);
  EXPECT_EQ(aqm::percentVisible(same.probability, Mask()), 0.0);
}

TEST(WarpingAlone, BlendsTwoKeyframesOfOneWall) {
  const Size size{16, 9};
  const Frame first = wall(size, 1.0f);
  const Frame last = wall(size, 3.0f);
  const auto target = [&] { return wall(size, 0.0f).visibility; };
  const auto fromFirst = ibr::gatherWarp(first, target(), ibr::WarpSettings{});
  const auto fromLast = ibr::gatherWarp(last, target(), ibr::WarpSettings{});
  const ibr::Blended middle = ibr::blend(fromFirst, fromLast, target(), 0.5);
  // Equal cameras, equal footprints: the mean of 1 and 3.
  for (const Rgb& value : middle.frame.diffuse.pixels()) EXPECT_FLOAT_EQ(value.r, 2.0f);
  const PixelFlow flow = ibr::pixelFlow(target(), first.visibility.camera);
  EXPECT_EQ(flow(3, 4), glm::vec2(0.0f));
}

}  // namespace promenade
