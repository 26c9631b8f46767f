#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <string>

#include "src/core/errors.h"

namespace promenade::paths {

inline constexpr double kDegree = std::numbers::pi / 180.0;

inline void expectNear(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance = 1e-9) {
  EXPECT_LE(glm::distance(actual, expected), tolerance)
      << "actual (" << actual.x << ", " << actual.y << ", " << actual.z << ") expected (" << expected.x
      << ", " << expected.y << ", " << expected.z << ")";
}

inline void expectRotation(const glm::dmat3& m, double tolerance = 1e-9) {
  EXPECT_NEAR(glm::determinant(m), 1.0, tolerance);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(glm::length(m[i]), 1.0, tolerance);
  EXPECT_NEAR(glm::dot(m[0], m[1]), 0.0, tolerance);
  EXPECT_NEAR(glm::dot(m[1], m[2]), 0.0, tolerance);
}

/// The work is refused with an InputError of one line that contains `part`.
inline void expectRefused(const std::function<void()>& work, const std::string& part) {
  try {
    work();
    FAIL() << "expected an InputError with: " << part;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(part));
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

}  // namespace promenade::paths
