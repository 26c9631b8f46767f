#include "ibr/reconstruction.h"

#include <array>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <glm/common.hpp>

namespace promenade::ibr {
namespace {

using Weights = std::array<float, 4>;

Weights cubicWeights(float f) {
  const float g = 1.0f - f;
  return {-0.5f * f * g * g, 1.0f + f * f * (1.5f * f - 2.5f), 1.0f + g * g * (1.5f * g - 2.5f),
          -0.5f * g * f * f};
}

// Four samples in a row are 12 floats: three vectors of 4, worked on down the columns, and only then told
// apart. The compilers' vector types, since neither glm nor the auto-vectoriser gets there (twice as fast,
// measured).
using Four [[gnu::vector_size(16)]] = float;

Four smaller(Four a, Four b) {
  return a < b ? a : b;
}
Four larger(Four a, Four b) {
  return a > b ? a : b;
}
Rgb colour(Four a) {
  return {a[0], a[1], a[2]};
}

struct FourSamples {
  Four a, b, c;  // r0 g0 b0 r1, g1 b1 r2 g2, b2 r3 g3 b3

  static FourSamples load(const Rgb* first) {
    static_assert(sizeof(Rgb) == 3 * sizeof(float) && sizeof(FourSamples) == 4 * sizeof(Rgb));
    FourSamples samples;
    std::memcpy(&samples, first, sizeof(samples));
    return samples;
  }
  // The samples one by one; the last lane is of no meaning.
  [[nodiscard]] Four first() const { return a; }
  [[nodiscard]] Four second() const { return __builtin_shufflevector(a, b, 3, 4, 5, 5); }
  [[nodiscard]] Four third() const { return __builtin_shufflevector(b, c, 2, 3, 4, 4); }
  [[nodiscard]] Four fourth() const { return __builtin_shufflevector(c, c, 1, 2, 3, 3); }
};

Rgb catmullRom(const RadianceMap& map, const Between& at, const Weights& wx, const Weights& wy) {
  const FourSamples top = FourSamples::load(&map(at.x - 1, at.y - 1));
  FourSamples sum{top.a * wy[0], top.b * wy[0], top.c * wy[0]};
  FourSamples low = top;
  FourSamples high = top;
  for (int j = 1; j < 4; ++j) {
    const FourSamples row = FourSamples::load(&map(at.x - 1, at.y - 1 + j));
    const float weight = wy[static_cast<std::size_t>(j)];
    sum = {sum.a + row.a * weight, sum.b + row.b * weight, sum.c + row.c * weight};
    low = {smaller(low.a, row.a), smaller(low.b, row.b), smaller(low.c, row.c)};
    high = {larger(high.a, row.a), larger(high.b, row.b), larger(high.c, row.c)};
  }
  const Four result =
      (sum.first() * wx[0] + sum.second() * wx[1]) + (sum.third() * wx[2] + sum.fourth() * wx[3]);
  const Four least = smaller(smaller(low.first(), low.second()), smaller(low.third(), low.fourth()));
  const Four most = larger(larger(high.first(), high.second()), larger(high.third(), high.fourth()));
  return colour(smaller(larger(result, least), most));
}

using Block = std::array<std::array<Rgb, 4>, 4>;

bool isUsable(Neighbours usable, int i, int j) {
  return ((usable >> (4 * j + i)) & 1) != 0;
}

/// The end of a row of four, `near` being its neighbour: the parabola through the other three, or the line
/// through two where the far end is not known.
Rgb goOn(const Rgb& near, const Rgb& middle, const Rgb& far, bool farIsKnown) {
  return farIsKnown ? 3.0f * (near - middle) + far : 2.0f * near - middle;
}

/// Catmull-Rom where some of the outer samples are made up: continued from the inner ones, rows first.
Rgb catmullRomBesideEdge(const RadianceMap& map, const Between& at, Neighbours usable, const Weights& wx,
                         const Weights& wy) {
  Block block{};
  Rgb low = map(at.x, at.y);
  Rgb high = low;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      if (!isUsable(usable, i, j)) continue;
      const Rgb& value = map(at.x - 1 + i, at.y - 1 + j);
      block[j][i] = value;
      low = glm::min(low, value);
      high = glm::max(high, value);
    }
  }
  // Rows whose inner two samples are there become whole, the inner rows among them.
  std::array<bool, 4> isWhole{};
  for (int j = 0; j < 4; ++j) {
    isWhole[j] = isUsable(usable, 1, j) && isUsable(usable, 2, j);
    if (!isWhole[j]) continue;
    auto& row = block[j];
    const bool first = isUsable(usable, 0, j);
    const bool last = isUsable(usable, 3, j);
    if (!first) row[0] = goOn(row[1], row[2], row[3], last);
    if (!last) row[3] = goOn(row[2], row[1], row[0], first);
  }
  Rgb sum(0.0f);
  for (int i = 0; i < 4; ++i) {
    const bool first = isWhole[0] || isUsable(usable, i, 0);
    const bool last = isWhole[3] || isUsable(usable, i, 3);
    const Rgb top = first ? block[0][i] : goOn(block[1][i], block[2][i], block[3][i], last);
    const Rgb bottom = last ? block[3][i] : goOn(block[2][i], block[1][i], block[0][i], first);
    sum += wx[i] * (wy[0] * top + wy[1] * block[1][i] + wy[2] * block[2][i] + wy[3] * bottom);
  }
  return glm::clamp(sum, low, high);
}

/// Samples and the weights with which they make the fitted value.
struct Taps {
  std::array<int, 16> x;
  std::array<int, 16> y;
  std::array<float, 16> weight;
  std::size_t count = 0;
};

/// Minimises sum w_k (c + g.d_k - v_k)^2 + ridge |g|^2 for the value c at the position (d_k from it to sample
/// k). c is linear in the samples: c = sum w_k (q . (1, d_k)) v_k, with M q = (1, 0, 0), M the matrix of
/// moments.
Taps fit(const Between& at, Neighbours usable) {
  Taps taps;
  std::array<glm::vec2, 16> offset;
  float s = 0.0f;
  glm::vec2 s1(0.0f);
  float sxx = 0.0f;
  float sxy = 0.0f;
  float syy = 0.0f;
  for (int k = 0; k < 16; ++k) {
    if (((usable >> k) & 1) == 0) continue;
    const glm::ivec2 cell(k % 4 - 1, k / 4 - 1);
    const glm::vec2 d = glm::vec2(cell) - at.fraction;
    // Falls steeply, so that the fit goes nearly through a sample that the position comes close to.
    const float distance = d.x * d.x + d.y * d.y + 0.001f;
    const float w = 1.0f / (distance * distance);
    s += w;
    s1 += w * d;
    sxx += w * d.x * d.x;
    sxy += w * d.x * d.y;
    syy += w * d.y * d.y;
    offset[taps.count] = d;
    taps.x[taps.count] = at.x + cell.x;
    taps.y[taps.count] = at.y + cell.y;
    taps.weight[taps.count] = w;
    ++taps.count;
  }
  assert(taps.count > 0);
  // The ridge makes the gradient 0 along directions in which the samples do not differ.
  const float ridge = 0.001f * s;
  sxx += ridge;
  syy += ridge;
  // q by Cramer's rule; the determinant is positive, since M is positive definite.
  const float q0 = sxx * syy - sxy * sxy;
  const glm::vec2 q(sxy * s1.y - s1.x * syy, sxy * s1.x - s1.y * sxx);
  const float determinant = s * q0 + s1.x * q.x + s1.y * q.y;
  for (std::size_t k = 0; k < taps.count; ++k) {
    taps.weight[k] *= (q0 + q.x * offset[k].x + q.y * offset[k].y) / determinant;
  }
  return taps;
}

Rgb apply(const RadianceMap& map, const Taps& taps) {
  Rgb sum(0.0f);
  Rgb low = map(taps.x[0], taps.y[0]);
  Rgb high = low;
  for (std::size_t k = 0; k < taps.count; ++k) {
    const Rgb& value = map(taps.x[k], taps.y[k]);
    sum += taps.weight[k] * value;
    low = glm::min(low, value);
    high = glm::max(high, value);
  }
  return glm::clamp(sum, low, high);
}

}  // namespace

LayeredRadiance catmullRom(const Frame& source, const Between& at) {
  const Weights wx = cubicWeights(at.fraction.x);
  const Weights wy = cubicWeights(at.fraction.y);
  return {catmullRom(source.diffuse, at, wx, wy), catmullRom(source.viewDependent, at, wx, wy)};
}

LayeredRadiance catmullRomBesideEdge(const Frame& source, const Between& at, Neighbours usable) {
  assert((usable & kInnerNeighbours) == kInnerNeighbours);
  const Weights wx = cubicWeights(at.fraction.x);
  const Weights wy = cubicWeights(at.fraction.y);
  return {catmullRomBesideEdge(source.diffuse, at, usable, wx, wy),
          catmullRomBesideEdge(source.viewDependent, at, usable, wx, wy)};
}

LayeredRadiance linearFit(const Frame& source, const Between& at, Neighbours usable) {
  const Taps taps = fit(at, usable);
  return {apply(source.diffuse, taps), apply(source.viewDependent, taps)};
}

}  // namespace promenade::ibr
