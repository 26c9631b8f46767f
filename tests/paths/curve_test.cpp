#include "paths/curve.h"

#include <cmath>
#include <numbers>

#include "tests/paths/near.h"

namespace promenade::paths {
namespace {

using Points = std::vector<glm::dvec3>;

TEST(Curve, ThroughTwoPointsIsTheStraightLine) {
  const Curve curve(Points{{0, 0, 0}, {3, 4, 0}}, CurveKind::kCatmullRom);
  EXPECT_NEAR(curve.length(), 5.0, 1e-12);
  expectNear(curve.at(2.5), {1.5, 2.0, 0.0});
}

TEST(Curve, PassesThroughEveryPointAtItsLength) {
  const Points points{{0, 0, 0}, {1, 0, 0}, {1, 0, 5}, {-3, 2, 5}, {-3, 2.5, 5}};
  for (const CurveKind kind : {CurveKind::kCatmullRom, CurveKind::kLinear}) {
    const Curve curve(points, kind);
    for (std::size_t i = 0; i < points.size(); ++i)
      expectNear(curve.at(curve.lengthAtPoints()[i]), points[i]);
  }
}

TEST(Curve, MatchesAPointOfCentripetalCatmullRomDerivedByHand) {
  // Points (0,0) (1,0) (1,1) (0,1): knots are all 1 apart, so the tangents at the middle points are
  // (P2 - P0) / 2 = (1/2, 1/2) and (P3 - P1) / 2 = (-1/2, 1/2), and the middle of the middle segment is
  // (P1 + P2) / 2 + (T1 - T2) / 8 = (1, 1/2) + (1, 0) / 8. By symmetry it is also the middle of the length.
  const Curve curve(Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, CurveKind::kCatmullRom);
  expectNear(curve.at(curve.length() / 2.0), {1.125, 0.5, 0.0});
}

TEST(Curve, UsesCentripetalKnotsWherePointsAreUneven) {
  // Points 0, 1, 5 on a line, knot intervals sqrt(1) = 1 and sqrt(4) = 2: dC/dknot at 1 is
  // 1/1 - 5/3 + 4/2 = 4/3. The second segment's c1 is 2 * 4/3 = 8/3; its far tangent, with the mirrored point
  // 9 (interval 2), is 2 * (4/2 - 8/4 + 4/2) = 4. At u = 1/2: (1 + 5)/2 + (8/3 - 4)/8 = 17/6. On a line the
  // length from 1 to 17/6 is 11/6, the whole second segment 4 and the first 1.
  const Curve curve(Points{{0, 0, 0}, {1, 0, 0}, {5, 0, 0}}, CurveKind::kCatmullRom);
  EXPECT_NEAR(curve.length(), 5.0, 1e-9);
  expectNear(curve.at(1.0 + 11.0 / 6.0), {17.0 / 6.0, 0.0, 0.0});
}

TEST(Curve, IsWalkedAtUnitSpeed) {
  const Curve curve(Points{{0, 0, 0}, {4, 0, 1}, {4, 3, 0}, {-2, 3, 8}}, CurveKind::kCatmullRom);
  const int steps = 2000;
  const double step = curve.length() / steps;
  for (int i = 0; i < steps; ++i) {
    const double chord = glm::distance(curve.at(i * step), curve.at((i + 1) * step));
    EXPECT_NEAR(chord / step, 1.0, 1e-3) << "at step " << i;
  }
}

TEST(Curve, ApproximatesAQuarterCircle) {
  Points points;
  for (int i = -1; i <= 9; ++i) {
    const double a = i * std::numbers::pi / 16.0;
    points.emplace_back(std::cos(a), 0.0, std::sin(a));
  }
  const Curve curve(points, CurveKind::kCatmullRom);
  const auto lengths = curve.lengthAtPoints();
  EXPECT_NEAR(lengths[9] - lengths[1], std::numbers::pi / 2.0, 2e-3);
}

TEST(Curve, StandsStillAtRepeatedPointsAndMayHaveNoLengthAtAll) {
  const Curve still(Points{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, CurveKind::kCatmullRom);
  EXPECT_EQ(still.length(), 0.0);
  expectNear(still.at(0.0), {1, 2, 3});
  const Curve pause(Points{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}}, CurveKind::kCatmullRom);
  EXPECT_NEAR(pause.length(), 2.0, 1e-9);
  expectNear(pause.at(1.5), {1.5, 0, 0});
}

TEST(MonotoneCubic, IsExactOnALineAndPassesItsPoints) {
  const std::vector<double> times{0, 1, 4};
  const MonotoneCubic line(times, std::vector<double>{1, 3, 9});
  EXPECT_NEAR(line.at(0.3), 1.6, 1e-12);
  EXPECT_NEAR(line.at(2.7), 6.4, 1e-12);
  EXPECT_EQ(line.at(-1.0), 1.0);
  EXPECT_EQ(line.at(9.0), 9.0);
}

TEST(MonotoneCubic, NeverGoesBackAndHoldsWhereValuesAreEqual) {
  const std::vector<double> times{0, 1, 2, 3, 10};
  const std::vector<double> values{0, 5, 5, 5.1, 50};
  const MonotoneCubic cubic(times, values);
  double before = cubic.at(0.0);
  for (int i = 1; i <= 1000; ++i) {
    const double now = cubic.at(i * 0.01);
    EXPECT_GE(now, before - 1e-12) << "at " << i * 0.01;
    before = now;
  }
  EXPECT_EQ(cubic.at(1.5), 5.0);
}

TEST(Locate, ClampsOutside) {
  const std::vector<double> times{1, 2, 4};
  EXPECT_EQ(locate(times, 0.0).segment, 0u);
  EXPECT_EQ(locate(times, 0.0).u, 0.0);
  EXPECT_EQ(locate(times, 3.0).segment, 1u);
  EXPECT_EQ(locate(times, 3.0).u, 0.5);
  EXPECT_EQ(locate(times, 9.0).u, 1.0);
}

}  // namespace
}  // namespace promenade::paths
