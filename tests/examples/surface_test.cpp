// The pieces the hall is made of: closed ones enclose the volume they should (which also proves that their
// triangles face outward), open ones have the right area, and normals agree with the triangles.

#include "examples/hall/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace promenade::hall {
namespace {

constexpr double kPi = glm::pi<double>();

double area(const Surface& s) {
  double sum = 0.0;
  for (std::size_t i = 0; i < s.indices.size(); i += 3) {
    const glm::dvec3 a = s.positions[s.indices[i]];
    sum +=
        0.5 * glm::length(glm::cross(s.positions[s.indices[i + 1]] - a, s.positions[s.indices[i + 2]] - a));
  }
  return sum;
}

/// By the divergence theorem: a sixth of the sum of a . (b x c); positive when the triangles face outward.
double volume(const Surface& s) {
  double sum = 0.0;
  for (std::size_t i = 0; i < s.indices.size(); i += 3) {
    sum += glm::dot(s.positions[s.indices[i]],
                    glm::cross(s.positions[s.indices[i + 1]], s.positions[s.indices[i + 2]]));
  }
  return sum / 6.0;
}

void expectSoundNormals(const Surface& s) {
  ASSERT_EQ(s.positions.size(), s.normals.size());
  ASSERT_EQ(s.positions.size(), s.texCoords.size());
  for (const glm::dvec3& n : s.normals) EXPECT_NEAR(glm::length(n), 1.0, 1e-9);
  for (std::size_t i = 0; i < s.indices.size(); i += 3) {
    const glm::dvec3 a = s.positions[s.indices[i]];
    const glm::dvec3 face = glm::cross(s.positions[s.indices[i + 1]] - a, s.positions[s.indices[i + 2]] - a);
    if (glm::length(face) < 1e-12) continue;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_GT(glm::dot(face, s.normals[s.indices[i + k]]), 0.0);
  }
}

TEST(HallSurface, ABoxEnclosesItsVolume) {
  const Surface s = box({-1, 0, 2}, {1, 3, 2.5});
  EXPECT_NEAR(volume(s), 2.0 * 3.0 * 0.5, 1e-12);
  EXPECT_NEAR(area(s), 2.0 * (2.0 * 3.0 + 3.0 * 0.5 + 0.5 * 2.0), 1e-12);
  EXPECT_EQ(s.triangleCount(), 12U);
  expectSoundNormals(s);
}

TEST(HallSurface, AChamferedBoxLacksItsEdges) {
  // Cutting a chamfer c off a box with edges a, b, d removes a prism of section c^2/2 along every edge,
  // shortened by 2c, and at every corner c^3 less the tetrahedral cap that stays: of the corner cube of edge
  // c the corner keeps c^3/6.
  const double c = 0.1, a = 1.0, b = 2.0, d = 3.0;
  const double prisms = 4.0 * ((a - 2 * c) + (b - 2 * c) + (d - 2 * c)) * 0.5 * c * c;
  const double corners = 8.0 * (c * c * c - c * c * c / 6.0);
  const Surface s = box({0, 0, 0}, {a, b, d}, c);
  EXPECT_NEAR(volume(s), a * b * d - prisms - corners, 1e-12);
  expectSoundNormals(s);
}

TEST(HallSurface, ASphereComesCloseToItsVolume) {
  // An inscribed polyhedron with n segments and n/2 rings lacks a share of the order of (pi/n)^2.
  const Surface s = sphere(2.0, 64, 32);
  EXPECT_NEAR(volume(s), 4.0 / 3.0 * kPi * 8.0, 0.006 * 33.5);
  expectSoundNormals(s);
}

TEST(HallSurface, ARodIsAPrismWithAsManySides) {
  // A regular n-gon inscribed in a circle of radius r has the area n/2 r^2 sin(2 pi / n).
  const int n = 10;
  const Surface s = rod({1, 0, 0}, {1, 2, 2}, 0.5, n);
  EXPECT_NEAR(volume(s), 0.5 * n * 0.25 * std::sin(2.0 * kPi / n) * std::sqrt(8.0), 1e-12);
}

TEST(HallSurface, AClosedTubeIsATorus) {
  // Pappus: 2 pi^2 R r^2; the section is an n-gon and the ring an m-gon, both inscribed.
  const Surface s =
      tube([](double u) { return glm::dvec3(std::cos(2 * kPi * u), 0.0, std::sin(2 * kPi * u)); },
           [](double) { return 0.25; }, 128, 64, Ends::kClosed);
  EXPECT_NEAR(volume(s), 2.0 * kPi * kPi * 0.0625, 0.005);
  expectSoundNormals(s);
}

TEST(HallSurface, AClosedTubeHasNoSeamWhereItMeetsItself) {
  // A trefoil has torsion: without spreading the twist the last ring would be turned against the first.
  const Surface s = tube(
      [](double u) {
        const double a = 2 * kPi * u;
        return glm::dvec3(std::sin(a) + 2 * std::sin(2 * a), std::cos(a) - 2 * std::cos(2 * a),
                          -std::sin(3 * a));
      },
      [](double) { return 0.2; }, 200, 16, Ends::kClosed);
  const std::size_t last = s.positions.size() - 17;
  for (std::size_t k = 0; k < 17; ++k)
    EXPECT_NEAR(glm::distance(s.positions[k], s.positions[last + k]), 0.0, 1e-6);
}

TEST(HallSurface, ALatheTurnsAProfileIntoACone) {
  // Radius 1 at the foot, 0 at height 1: n/2 sin(2 pi/n) / 3, with its base.
  const int n = 24;
  const Surface s = lathe(Profile({0, 0}).lineTo({1, 0}).lineTo({0, 1}), n);
  EXPECT_NEAR(volume(s), 0.5 * n * std::sin(2.0 * kPi / n) / 3.0, 1e-12);
}

TEST(HallSurface, AQuarterBulgesTheWayItIsTold) {
  // A quarter disc of radius 1 has the area pi/4 beside its two legs; the hollow one leaves 1 - pi/4.
  const auto sectionArea = [](const Profile& p) {
    double sum = 0.0;
    for (const auto& piece : p.pieces()) {
      for (std::size_t i = 0; i + 1 < piece.size(); ++i)
        sum += 0.5 * (piece[i].x + piece[i + 1].x) * (piece[i + 1].y - piece[i].y);
    }
    return sum;
  };
  for (const double to : {1.0, -1.0}) {  // growing and shrinking upward
    const double start = to > 0.0 ? 0.0 : 1.0;
    EXPECT_NEAR(sectionArea(Profile({start, 0}).quarterTo({start + to, 1}, Profile::Bulge::kOutward, 64)),
                kPi / 4.0, 1e-3);
    EXPECT_NEAR(sectionArea(Profile({start, 0}).quarterTo({start + to, 1}, Profile::Bulge::kInward, 64)),
                1.0 - kPi / 4.0, 1e-3);
  }
}

TEST(HallSurface, AFlatFrameCoversTheRingAroundItsOpening) {
  const Surface s = frame(2.0, 1.0, {{0.0, 0.0}, {0.25, 0.0}});
  EXPECT_NEAR(area(s), 2.5 * 1.5 - 2.0 * 1.0, 1e-12);
  for (const glm::dvec3& n : s.normals) EXPECT_NEAR(n.z, 1.0, 1e-12);
}

TEST(HallSurface, AWallWithAnArchHasItsFaceAndItsReveal) {
  // Face: the rectangle less the opening, a rectangle under a 24-gon's half. Reveal: its outline times the
  // depth.
  const ArchOpening opening{.sill = 1.0, .springing = 3.0, .halfWidth = 0.5};
  const double step = kPi / 24.0;
  const double head = 0.5 * 0.25 * 24.0 * std::sin(step),
               outline = 24.0 * 2.0 * 0.5 * std::sin(0.5 * step) + 1.0 + 2.0 * 2.0;
  const Surface s = wallWithArch(3.0, 0.0, 5.0, opening, 0.4);
  EXPECT_NEAR(area(s), 15.0 - 2.0 - head + 0.4 * outline, 1e-9);
  // Its pane has fewer triangles around the head: every third corner.
  EXPECT_NEAR(area(archPane(opening)), 2.0 + 0.5 * 0.25 * 8.0 * std::sin(3.0 * step), 1e-9);
}

TEST(HallSurface, AnExtrusionFacesAwayFromItsWall) {
  const Surface s = extrude(Profile({0.5, 0.0}).lineTo({0.5, 2.0}), -1.0, 3.0);
  EXPECT_NEAR(area(s), 2.0 * 4.0, 1e-12);
  for (const glm::dvec3& n : s.normals) EXPECT_NEAR(n.x, 1.0, 1e-12);
  expectSoundNormals(s);
}

}  // namespace
}  // namespace promenade::hall
