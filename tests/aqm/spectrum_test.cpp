#include "aqm/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace promenade::aqm {
namespace {

ContrastMap randomContrast(Size size) {
  std::mt19937 random(5);
  ContrastMap map(size);
  for (float& value : map.pixels()) {
    value = static_cast<float>(random()) / 4294967296.0f - 0.5f;
  }
  return map;
}

TEST(Spectrum, IsTheFourierSumOfTheReflectedImage) {
  for (const Size size : {Size{1, 1}, Size{1, 5}, Size{6, 1}, Size{7, 5}, Size{8, 12}}) {
    const Layout layout = layoutOf(size, 6.0);
    const ContrastMap map = randomContrast(size);
    const FourierPlans plans(layout.padded);
    const Spectrum spectrum = spectrumOf(map, layout, plans);
    for (int ix = 0; ix < layout.spectrumColumns(); ++ix) {
      for (int iy = 0; iy < layout.padded.height; ++iy) {
        std::complex<double> sum = 0.0;
        for (int y = 0; y < layout.padded.height; ++y) {
          for (int x = 0; x < layout.padded.width; ++x) {
            const double turns = static_cast<double>(ix * x) / layout.padded.width +
                                 static_cast<double>(iy * y) / layout.padded.height;
            sum += static_cast<double>(map(reflected(x - layout.margin, size.width),
                                           reflected(y - layout.margin, size.height))) *
                   std::polar(1.0, -2.0 * std::numbers::pi * turns);
          }
        }
        ASSERT_NEAR(spectrum.row(ix)[iy].real(), sum.real(), 1e-4) << ix << ", " << iy;
        ASSERT_NEAR(spectrum.row(ix)[iy].imag(), sum.imag(), 1e-4) << ix << ", " << iy;
      }
    }
  }
}

TEST(FourierPlans, ComeBackToWhereTheyStartedTimesTheLength) {
  const Size size{15, 12};
  const FourierPlans plans(size);
  Plane<float> row(size.width, 2);
  Plane<std::complex<float>> halfRow(size.width / 2 + 1, 1);
  Plane<std::complex<float>> column(size.height, 3);
  for (int i = 0; i < size.width; ++i) {
    row.row(0)[i] = static_cast<float>(i * i % 7);
  }
  for (int i = 0; i < size.height; ++i) {
    column.row(0)[i] = {static_cast<float>(i % 5), static_cast<float>(i % 3)};
  }
  plans.forwardRow(row.row(0), halfRow.row(0));
  plans.inverseRow(halfRow.row(0), row.row(1));
  plans.forwardColumn(column.row(0), column.row(1));
  plans.inverseColumn(column.row(1), column.row(2));
  for (int i = 0; i < size.width; ++i) {
    EXPECT_NEAR(row.row(1)[i], 15.0f * row.row(0)[i], 1e-4);
  }
  for (int i = 0; i < size.height; ++i) {
    EXPECT_NEAR(std::abs(column.row(2)[i] - 12.0f * column.row(0)[i]), 0.0, 1e-4);
  }
}

TEST(Plane, HasAlignedRowsAndZeroesBetweenThem) {
  const Plane<float> plane(33, 3);
  EXPECT_EQ(plane.stride(), 64);
  for (int y = 0; y < 3; ++y) {
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(plane.row(y)) % 64, 0u);
    for (int x = 0; x < plane.stride(); ++x) {
      EXPECT_EQ(plane.row(y)[x], 0.0f);
    }
  }
}

}  // namespace
}  // namespace promenade::aqm
