#include "aqm/layout.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace promenade::aqm {
namespace {

bool isFiveSmooth(int number) {
  for (const int prime : {2, 3, 5}) {
    while (number % prime == 0) {
      number /= prime;
    }
  }
  return number == 1;
}

int paddedLength(int length, int margin, int unit) {
  int units = (length + 2 * margin + unit - 1) / unit;
  while (!isFiveSmooth(units)) {
    ++units;
  }
  return units * unit;
}

}  // namespace

int bandCount(double pixelsPerDegree) {
  // The small number keeps log2 of an exact power of two from being rounded up to the next band.
  return std::max(2, static_cast<int>(std::ceil(std::log2(pixelsPerDegree) - 1e-9)));
}

Layout layoutOf(Size image, double pixelsPerDegree) {
  return layoutOf(image, pixelsPerDegree, bandCount(pixelsPerDegree));
}

Layout layoutOf(Size image, double pixelsPerDegree, int bands) {
  Layout layout;
  layout.image = image;
  layout.pixelsPerDegree = pixelsPerDegree;
  layout.bands = bands;
  layout.margin = 1 << (layout.bands - 1);
  const int unit = 1 << (layout.bands - 2);
  layout.padded = {paddedLength(image.width, layout.margin, unit),
                   paddedLength(image.height, layout.margin, unit)};
  return layout;
}

int reflected(int index, int count) {
  assert(count >= 1);
  const int period = 2 * count;
  const int phase = ((index % period) + period) % period;
  return phase < count ? phase : period - 1 - phase;
}

}  // namespace promenade::aqm
