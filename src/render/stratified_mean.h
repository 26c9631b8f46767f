#pragma once
// How well the mean of a stratified sequence is known. Not part of the folder's public face.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace promenade::render {

/// Values of samples of a sequence of which every aligned block is a stratified set (sampler.h). The error of
/// their mean is taken from the means of a few blocks: unlike the scatter of single values it knows what
/// stratification saves within a block (not what it saves among blocks, so it stays on the safe side).
class StratifiedMean {
 public:
  /// For up to `most` samples.
  explicit StratifiedMean(int most) : values_(static_cast<std::size_t>(most)) {}

  /// What belongs to one sample adds up. `sample` in [0, most).
  void add(int sample, float value) { values_[static_cast<std::size_t>(sample)] += value; }

  /// Of the mean of the first `count` samples, at least 2.
  [[nodiscard]] float standardError(int count) const {
    const int blocks = std::min(count, kBlocks);
    const int each = count / blocks;
    float sum = 0.0f, squares = 0.0f;
    for (int b = 0; b < blocks; ++b) {
      float block = 0.0f;
      for (int i = b * each; i < (b + 1) * each; ++i) block += values_[static_cast<std::size_t>(i)];
      block /= static_cast<float>(each);
      sum += block;
      squares += block * block;
    }
    const auto n = static_cast<float>(blocks);
    const float mean = sum / n;
    return std::sqrt(std::max(0.0f, squares / n - mean * mean) / (n - 1.0f));
  }

 private:
  static constexpr int kBlocks = 8;
  std::vector<float> values_;
};

}  // namespace promenade::render
