#include "src/walkthrough/probes.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace promenade::walkthrough {
namespace {

/// In [0, 1). The finaliser of SplitMix64 (Steele, Lea, Flood 2014).
double randomNumber(std::uint64_t seed, int tileX, int tileY) {
  const auto place = (static_cast<std::uint64_t>(tileY) << 32) | static_cast<std::uint32_t>(tileX);
  std::uint64_t z = seed + (place + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-53;
}

}  // namespace

std::vector<Probe> chooseProbes(const ProbeWeights& weights, double share, std::uint64_t seed) {
  assert(share > 0.0 && share <= 1.0);
  double sum = 0.0;
  std::size_t eligible = 0;
  for (const float weight : weights.pixels()) {
    sum += weight;
    eligible += weight > 0.0f ? 1 : 0;
  }
  std::vector<Probe> probes;
  if (eligible == 0) return probes;
  const double scale = share * static_cast<double>(eligible) / sum;

  const int tile = std::max(1, static_cast<int>(std::lround(1.0 / std::sqrt(share))));
  for (int top = 0; top < weights.height(); top += tile) {
    for (int left = 0; left < weights.width(); left += tile) {
      // Systematic sampling with a random start: every sample is chosen with its own probability, and a
      // tile's count is its expected one, rounded up or down.
      double next = randomNumber(seed, left / tile, top / tile);
      double before = 0.0;
      for (int y = top; y < std::min(top + tile, weights.height()); ++y) {
        for (int x = left; x < std::min(left + tile, weights.width()); ++x) {
          const double probability = std::min(1.0, scale * weights(x, y));
          if (next < before + probability) {
            probes.push_back({x, y, static_cast<float>(1.0 / probability)});
            next += 1.0;
          }
          before += probability;
        }
      }
    }
  }
  return probes;
}

}  // namespace promenade::walkthrough
