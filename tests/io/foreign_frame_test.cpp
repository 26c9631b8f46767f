#include "src/io/foreign_frame.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "src/core/errors.h"
#include "src/io/exr_frame.h"
#include "tests/io/temp_folder.h"

namespace promenade::io {
namespace {

const Camera kCamera = [] {
  Pose pose;
  const double a = 0.6;  // turned about y, and moved
  pose.worldFromCamera = glm::dmat3(std::cos(a), 0, -std::sin(a), 0, 1, 0, std::sin(a), 0, std::cos(a));
  pose.eye = {3.0, 1.5, -2.0};
  return Camera(pose, 0.9, Size{6, 4});
}();

FrameFile ownFrame() {
  FrameFile frame;
  frame.metadata.camera = kCamera;
  frame.metadata.framesPerSecond = 24.0;
  frame.radiance = RadianceMap(6, 4, Rgb(0.5f, 0.25f, 2.0f));
  frame.depth = DepthMap(6, 4, 3.25f);
  frame.depth(0, 0) = std::numeric_limits<float>::infinity();
  frame.normal = NormalMap(6, 4, glm::vec3(0, 0, 1));
  frame.item = ItemBuffer(6, 4, 7);
  return frame;
}

// As another program would write it: a layer's channels, standard attributes, 1e10 where nothing is hit.
void writeForeign(const std::filesystem::path& file, const Imf::Header& cameraOf, Imf::PixelType depthType,
                  float depth) {
  Imf::Header header(6, 4);
  if (Imf::hasWorldToCamera(cameraOf)) {
    Imf::addWorldToCamera(header, Imf::worldToCamera(cameraOf));
    Imf::addWorldToNDC(header, Imf::worldToNDC(cameraOf));
  }
  std::vector<float> values(24, depth);
  values[5] = 1e10f;
  std::vector<Imath::half> halves(values.begin(), values.end());
  Imf::FrameBuffer buffer;
  for (const char* name : {"View.Combined.R", "View.Combined.G", "View.Combined.B"}) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    buffer.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 24));
  }
  header.channels().insert("View.Depth.Z", Imf::Channel(depthType));
  buffer.insert("View.Depth.Z", depthType == Imf::HALF
                                    ? Imf::Slice(Imf::HALF, reinterpret_cast<char*>(halves.data()), 2, 12)
                                    : Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 24));
  Imf::OutputFile out(file.c_str(), header);
  out.setFrameBuffer(buffer);
  out.writePixels(4);
}

Imf::Header headerOf(const std::filesystem::path& file) {
  return Imf::InputFile(file.c_str()).header();
}

TEST(ForeignFrame, OfPromenadeComesWithEverything) {
  const tests::TempFolder folder;
  writeFrame(folder / "own.exr", ownFrame());
  const ForeignFrame frame = readForeignFrame(folder / "own.exr");
  EXPECT_EQ(frame.radiance(1, 1), Rgb(0.5f, 0.25f, 2.0f));
  EXPECT_EQ(frame.depth(1, 1), 3.25f);
  EXPECT_EQ(frame.item(1, 1), 7u);
  const ForeignCamera camera = readForeignCamera(folder / "own.exr");
  ASSERT_TRUE(camera.camera);
  EXPECT_EQ(camera.camera->pose().eye, kCamera.pose().eye);
  EXPECT_EQ(camera.framesPerSecond, 24.0);
}

TEST(ForeignFrame, OfAnotherProgramIsFoundByItsLayersAndStandardAttributes) {
  const tests::TempFolder folder;
  writeFrame(folder / "own.exr", ownFrame());
  writeForeign(folder / "other.exr", headerOf(folder / "own.exr"), Imf::FLOAT, 4.5f);
  const ForeignFrame frame = readForeignFrame(folder / "other.exr");
  EXPECT_EQ(frame.radiance(0, 0), Rgb(4.5f));
  EXPECT_EQ(frame.depth(0, 0), 4.5f);
  EXPECT_EQ(frame.depth(5, 0), std::numeric_limits<float>::infinity());
  EXPECT_TRUE(frame.normal.empty());
  EXPECT_TRUE(frame.item.empty());
  const auto camera = readForeignCamera(folder / "other.exr").camera;
  ASSERT_TRUE(camera);
  // The standard matrices are single precision: 2^-24 of coordinates of a few metres.
  EXPECT_NEAR(camera->verticalFieldOfView(), 0.9, 1e-5);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(camera->pose().eye[i], kCamera.pose().eye[i], 1e-5);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(camera->pose().worldFromCamera[i][k], kCamera.pose().worldFromCamera[i][k], 1e-6);
    }
  }
}

TEST(ForeignFrame, WithoutACameraSaysSo) {
  const tests::TempFolder folder;
  writeForeign(folder / "other.exr", Imf::Header(6, 4), Imf::FLOAT, 4.5f);
  EXPECT_FALSE(readForeignCamera(folder / "other.exr").camera);
}

TEST(ForeignFrame, ThatCannotBeWarpedIsRefused) {
  const tests::TempFolder folder;
  writeForeign(folder / "half.exr", Imf::Header(6, 4), Imf::HALF, 4.5f);
  EXPECT_THROW((void)readForeignFrame(folder / "half.exr"), InputError);
  writeForeign(folder / "behind.exr", Imf::Header(6, 4), Imf::FLOAT, -1.0f);
  EXPECT_THROW((void)readForeignFrame(folder / "behind.exr"), InputError);
  FrameFile flat = ownFrame();
  flat.depth = {};
  writeFrame(folder / "flat.exr", flat);
  EXPECT_THROW((void)readForeignFrame(folder / "flat.exr"), InputError);
  EXPECT_THROW((void)readForeignFrame(folder / "missing.exr"), InputError);
}

}  // namespace
}  // namespace promenade::io
