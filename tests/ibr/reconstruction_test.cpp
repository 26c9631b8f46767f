#include "ibr/reconstruction.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace promenade::ibr::tests {
namespace {

constexpr Neighbours kAll = 0xffff;

/// 4x4 samples at x, y = 0..3, so that Between{1, 1} reaches all of them.
Frame samples(const std::function<float(float, float)>& value) {
  const Size size{4, 4};
  Frame frame{{}, RadianceMap(size), RadianceMap(size), SourceMap(size)};
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      const float v = value(static_cast<float>(x), static_cast<float>(y));
      frame.diffuse(x, y) = Rgb(v, 2.0f * v, 0.5f);
      frame.viewDependent(x, y) = Rgb(0.0f, 3.0f * v, v);
    }
  }
  return frame;
}

float quadratic(float x, float y) {
  return 5.0f + x - 0.5f * y + 0.25f * x * x + 0.125f * x * y - 0.25f * y * y;
}

TEST(Reconstruction, CatmullRomReproducesQuadraticsInBothLayers) {
  const Frame frame = samples(quadratic);
  for (const float u : {0.0f, 0.25f, 0.5f, 0.9f, 1.0f}) {
    for (const float v : {0.0f, 0.4f, 1.0f}) {
      const LayeredRadiance r = catmullRom(frame, {1, 1, {u, v}});
      const float expected = quadratic(1.0f + u, 1.0f + v);
      EXPECT_NEAR(r.diffuse.r, expected, 1e-5f);
      EXPECT_NEAR(r.diffuse.g, 2.0f * expected, 1e-5f);
      EXPECT_NEAR(r.diffuse.b, 0.5f, 1e-6f);
      EXPECT_EQ(r.viewDependent.r, 0.0f);
      EXPECT_NEAR(r.viewDependent.g, 3.0f * expected, 2e-5f);
      EXPECT_NEAR(r.viewDependent.b, expected, 1e-5f);
    }
  }
}

TEST(Reconstruction, CatmullRomStaysWithinItsSamples) {
  // A step from 0 to 1: unclamped, the cubic goes to -0.07 before it and 1.07 after it.
  const Frame frame = samples([](float x, float) { return x < 1.5f ? 0.0f : 1.0f; });
  for (int i = 0; i <= 20; ++i) {
    const float v = catmullRom(frame, {1, 1, {0.05f * static_cast<float>(i), 0.3f}}).diffuse.r;
    EXPECT_GE(v, 0.0f);
    EXPECT_LE(v, 1.0f);
  }
}

TEST(Reconstruction, BesideAnEdgeTheCubicDoesNotReadBeyondIt) {
  // Everything outside the usable samples is poison. A row or column that lacks one end is continued by a
  // parabola, so that quadratics still come back; one that lacks both by lines.
  for (const Neighbours usable :
       {Neighbours{0x7777}, Neighbours{0xeeee}, Neighbours{0x0fff}, Neighbours{0xfff0}, kAll}) {
    Frame frame = samples(quadratic);
    for (int k = 0; k < 16; ++k) {
      if (((usable >> k) & 1) == 0)
        frame.diffuse(k % 4, k / 4) = Rgb(std::numeric_limits<float>::quiet_NaN());
    }
    const LayeredRadiance r = catmullRomBesideEdge(frame, {1, 1, {0.3f, 0.6f}}, usable);
    EXPECT_NEAR(r.diffuse.r, quadratic(1.3f, 1.6f), 1e-5f) << usable;
  }
  const auto plane = [](float x, float y) { return 2.0f + 0.5f * x - 0.25f * y; };
  Frame frame = samples(plane);
  for (int k = 0; k < 16; ++k) {
    if (((kInnerNeighbours >> k) & 1) == 0) frame.diffuse(k % 4, k / 4) = Rgb(1e9f);
  }
  EXPECT_NEAR(catmullRomBesideEdge(frame, {1, 1, {0.3f, 0.6f}}, kInnerNeighbours).diffuse.r,
              plane(1.3f, 1.6f), 1e-5f);
}

TEST(Reconstruction, TheLinearFitReproducesPlanesFromWhatIsLeft) {
  const auto plane = [](float x, float y) { return 2.0f + 0.5f * x - 0.25f * y; };
  // The left two columns; an L of three; three quarters of the block.
  for (const unsigned usable : {0x3333U, 0x0230U, 0x0377U}) {
    Frame frame = samples(plane);
    for (int k = 0; k < 16; ++k) {
      if (((usable >> k) & 1U) == 0) frame.diffuse(k % 4, k / 4) = Rgb(1e9f);
    }
    const LayeredRadiance r = linearFit(frame, {1, 1, {-0.0f, 0.4f}}, static_cast<Neighbours>(usable));
    EXPECT_NEAR(r.diffuse.r, plane(1.0f, 1.4f), 0.01f) << usable;
  }
}

TEST(Reconstruction, TheLinearFitOfOneSampleIsThatSample) {
  const Frame frame = samples(quadratic);
  for (int k = 0; k < 16; ++k) {
    const LayeredRadiance r = linearFit(frame, {1, 1, {0.7f, 0.2f}}, static_cast<Neighbours>(1U << k));
    EXPECT_FLOAT_EQ(r.diffuse.r, quadratic(static_cast<float>(k % 4), static_cast<float>(k / 4)));
  }
}

TEST(Reconstruction, TheLinearFitStaysWithinItsSamples) {
  const Frame frame = samples([](float x, float) { return x; });
  // From the two left columns (0 and 1) toward the right: not beyond 1.
  const LayeredRadiance r = linearFit(frame, {1, 1, {0.45f, 0.5f}}, Neighbours{0x3333});
  EXPECT_LE(r.diffuse.r, 1.0f);
  EXPECT_GT(r.diffuse.r, 0.95f);
}

}  // namespace
}  // namespace promenade::ibr::tests
