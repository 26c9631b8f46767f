#include "ibr/subpixel_offsets.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <numeric>

namespace promenade::ibr {
namespace {

/// The least squared distance, times n^2, of two points of the lattice (i, a i) / n on a torus.
int leastDistance(int n, int a) {
  int least = std::numeric_limits<int>::max();
  for (int i = 1; i < n; ++i) {
    const int x = std::min(i, n - i);
    const int j = i * a % n;
    const int y = std::min(j, n - j);
    least = std::min(least, x * x + y * y);
  }
  return least;
}

/// The a whose points are farthest apart (the smallest of them).
int generator(int n) {
  int best = 1;
  for (int a = 2; a < n; ++a) {
    if (std::gcd(a, n) == 1 && leastDistance(n, a) > leastDistance(n, best)) best = a;
  }
  return best;
}

/// In base 2, times 2^31: the digits of k mirrored at the point (van der Corput 1935).
std::uint32_t radicalInverse(std::uint32_t k) {
  std::uint32_t mirrored = 0;
  for (int bit = 0; bit < 31; ++bit) mirrored |= ((k >> bit) & 1U) << (30 - bit);
  return mirrored;
}

/// Place k of an order of 0 to n - 1: that of their radical inverses. With steps of one size the samples of
/// all frames would fall on the same places of a surface that moves by just that much the other way.
int placeInOrder(int n, int k) {
  int place = 0;
  const std::uint32_t own = radicalInverse(static_cast<std::uint32_t>(k));
  for (int i = 0; i < n; ++i) place += radicalInverse(static_cast<std::uint32_t>(i)) < own ? 1 : 0;
  return place;
}

}  // namespace

glm::dvec2 subpixelOffset(int frame, int period) {
  assert(period >= 1 && period % 2 == 1);
  const int i = placeInOrder(period, (frame % period + period) % period);
  const int j = i * generator(period) % period;
  // Symmetric about 0: the lattice has its middle point at the middle of the cell.
  const auto centred = [period](int k) {
    const int half = (period - 1) / 2;
    return static_cast<double>((k + half) % period - half) / period;
  };
  return {centred(i), centred(j)};
}

}  // namespace promenade::ibr
