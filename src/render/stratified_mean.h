#pragma once
// How well the mean of a stratified sequence is known. Not part of the folder's public face.

#include <algorithm>
#include <array>
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

/// The same for a sequence that is doubled until its mean is known well enough. Keeps the sums of its blocks
/// alone.
class DoubledMean {
 public:
  static constexpr int kBlocks = 8;

  /// For the first `count` samples: a multiple of kBlocks, above 0.
  explicit DoubledMean(int count) : count_(count) {}

  [[nodiscard]] int count() const { return count_; }
  /// As many samples again. All of those before must have been added.
  void grow() {
    count_ *= 2;
    for (std::size_t b = 0; b < kBlocks / 2; ++b) blocks_[b] = blocks_[2 * b] + blocks_[2 * b + 1];
    for (std::size_t b = kBlocks / 2; b < kBlocks; ++b) blocks_[b] = 0.0;
  }
  /// What belongs to one sample adds up. `sample` in [0, count()).
  void add(int sample, float value) {
    blocks_[static_cast<std::size_t>(sample / (count_ / kBlocks))] += value;
  }
  /// Square of the standard error of the mean of all samples.
  [[nodiscard]] double squaredError() const {
    double sum = 0.0, squares = 0.0;
    for (const double block : blocks_) {
      sum += block;
      squares += block * block;
    }
    const double each = static_cast<double>(count_) / kBlocks;
    return std::max(0.0, squares - sum * sum / kBlocks) / (kBlocks * (kBlocks - 1.0) * each * each);
  }

 private:
  int count_;
  std::array<double, kBlocks> blocks_{};
};

}  // namespace promenade::render
