// A real interior beside the picture another renderer made of it (Mitsuba, with the scene's own materials).
//
// What the glTF file lacks is put in by hand, once: the sky of the reference (radiance read off its window
// panes, black below the horizon), the sun's direction in the reference's axes and its strength relative to
// that sky, and an albedo for the walls, whose texture is absent. Materials are approximations, so this is a
// test of plausibility: means of blocks agree within a factor, not to a per cent.

#include <gtest/gtest.h>

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/render/path_renderer.h"
#include "src/scene/load.h"
#include "tests/render/scenes.h"
#include "tests/shared_data.h"

namespace promenade::render {
namespace {

constexpr Size kReference{700, 400};
constexpr Size kRendered{140, 80};
constexpr Size kBlocks{14, 8};

std::vector<float> readReference(const std::string& file) {
  const auto input = OIIO::ImageInput::open(file);
  if (!input) return {};
  std::vector<float> pixels(kReference.area() * 3);
  if (input->spec().width != kReference.width || input->spec().height != kReference.height ||
      !input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, pixels.data())) {
    return {};
  }
  return pixels;
}

/// Mean of the three channels over each block.
template <class ValueAt>
std::vector<double> blockMeans(Size size, const ValueAt& valueAt) {
  std::vector<double> means;
  const int width = size.width / kBlocks.width, height = size.height / kBlocks.height;
  for (int by = 0; by < kBlocks.height; ++by) {
    for (int bx = 0; bx < kBlocks.width; ++bx) {
      double sum = 0.0;
      for (int y = by * height; y < (by + 1) * height; ++y) {
        for (int x = bx * width; x < (bx + 1) * width; ++x) sum += valueAt(x, y);
      }
      means.push_back(sum / (width * height));
    }
  }
  return means;
}

TEST(Picture, OfTheCountryKitchenResemblesMitsubas) {
  PROMENADE_NEEDS_SHARED("scenes/country-kitchen/kitchen.gltf");
  PROMENADE_NEEDS_SHARED("scenes/country-kitchen/mitsuba_ref.exr");
  Scene scene = loadScene(tests::sharedPath("scenes/country-kitchen/kitchen.gltf"));
  Environment sky;
  sky.radiance = RadianceMap(Size{4, 512});
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 4; ++x) sky.radiance(x, y) = Rgb(10.5f, 12.7f, 15.2f);
  }
  scene.environment = std::move(sky);
  ASSERT_EQ(scene.lights.size(), 1u);
  scene.lights[0].direction.z *= -1.0f;
  scene.lights[0].intensity *= 8.0f;
  for (Material& material : scene.materials) {
    if (material.name == "Walls") material.baseColor = {0.65f, 0.65f, 0.65f, 1.0f};
  }

  // The reference's field of view is 60 degrees across its width of 700 pixels.
  const double fieldOfView = 2.0 * std::atan(std::tan(glm::radians(30.0)) * 400.0 / 700.0);
  // From the file's camera matrix.
  const glm::dvec3 right(0.89874, 0.0, -0.438481), up(-0.0182716, 0.999131, -0.0374507),
      back(0.4381, 0.0416703, 0.89796);
  const Camera camera(Pose{glm::dmat3(right, up, back), {1.211, 1.80475, 3.85239}}, fieldOfView, kRendered);
  PathSettings settings;
  settings.pathsPerSample = 64;
  settings.maxBounces = 16;
  const Frame frame = makePathRenderer(scene, settings)->render(camera, 0);

  const std::vector<float> reference =
      readReference(tests::sharedPath("scenes/country-kitchen/mitsuba_ref.exr").string());
  ASSERT_FALSE(reference.empty());
  const RadianceMap rendered = combinedRadiance(frame);
  const auto ours = blockMeans(kRendered, [&](int x, int y) {
    const Rgb& p = rendered(x, y);
    return (p.x + p.y + p.z) / 3.0;
  });
  const auto theirs = blockMeans(kReference, [&](int x, int y) {
    const float* p =
        &reference[3 * (static_cast<std::size_t>(y) * kReference.width + static_cast<std::size_t>(x))];
    return (p[0] + p[1] + p[2]) / 3.0;
  });

  double ourSum = 0.0, theirSum = 0.0;
  std::vector<double> stops;
  int alike = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    ourSum += ours[i];
    theirSum += theirs[i];
    stops.push_back(std::log2(ours[i] / theirs[i]));
    alike += std::abs(stops.back()) < 1.0 ? 1 : 0;
  }
  std::nth_element(stops.begin(), stops.begin() + static_cast<long>(stops.size() / 2), stops.end());
  const double median = stops[stops.size() / 2];
  const double share = alike / static_cast<double>(ours.size());
  RecordProperty("median_stops", std::to_string(median));
  RecordProperty("blocks_within_a_factor_of_two", std::to_string(share));
  EXPECT_NEAR(ourSum / theirSum, 1.0, 0.25);
  EXPECT_NEAR(median, 0.0, 0.5);
  EXPECT_GT(share, 0.8);
}

}  // namespace
}  // namespace promenade::render
