#include "ibr/temporal_filter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <string>
#include <vector>

#include "ibr/coverage.h"
#include "ibr/pixel_sum.h"
#include "ibr/sample_projection.h"
#include "src/core/errors.h"

namespace promenade::ibr {
namespace {

/// What a frame weighs at each display pixel.
using TimeWeightMap = Map<struct TimeWeightTag, float>;

/// Frames that weigh less than this beside the filtered one are left out.
constexpr float kLeastWeight = 0.02f;

/// Sighting::hiding: all four.
constexpr std::uint8_t kAllAround = 0b1111;

TimeWeightMap timeWeights(const WindowMap& window, int framesAway) {
  TimeWeightMap weights(window.size());
  const auto away = static_cast<float>(framesAway);
  for (std::size_t i = 0; i < weights.pixels().size(); ++i) {
    const float deviations = away / window.pixels()[i];
    const float weight = std::exp(-0.5f * deviations * deviations);
    weights.pixels()[i] = weight >= kLeastWeight ? weight : 0.0f;
  }
  return weights;
}

/// What a sample adds to a display pixel.
struct Deposit {
  glm::ivec2 pixel{-1};   ///< outside of the image: nothing
  glm::vec2 place{0.0f};  ///< in the pixel, [0, 1)
  float area = 0.0f;      ///< display pixels
  Rgb radiance{0.0f};
};

/// Rows of pixels: [first, end).
struct Rows {
  int first = 0;
  int end = 0;
};

/// The samples of another frame, in the image of the filtered one, and the other way round.
class Transfer {
 public:
  Transfer(const Frame& frame, const Frame& other, const Coverage& coverage, int supersample,
           const TemporalFilterSettings& settings)
      : frame_(frame),
        other_(other),
        coverage_(coverage),
        supersample_(supersample),
        offset_(frame.visibility.camera.subpixelOffset()),
        there_(other.visibility, frame.visibility, settings.creaseDegrees),
        back_(frame.visibility, other.visibility, settings.creaseDegrees),
        footprintLimit_(static_cast<float>(settings.footprintLimit)),
        slideLimit_(static_cast<float>(settings.slideLimit)) {}

  /// Sample (x, y) of the other frame.
  [[nodiscard]] Deposit deposit(int x, int y) const {
    Deposit deposit;
    const ProjectedSample sample = there_(x, y);
    if (!isSeen(sample) || sample.area > footprintLimit_) return deposit;
    const glm::vec2 position = pixelPosition(sample.position);
    const glm::vec2 corner = glm::floor(position);
    deposit.pixel = glm::ivec2(corner);
    deposit.place = position - corner;
    deposit.area = sample.area / static_cast<float>(supersample_ * supersample_);
    deposit.radiance = other_.diffuse(x, y) + viewDependent(x, y, sample.sighting, deposit.pixel);
    return deposit;
  }

  /// Whether the other frame has something in front of what sample (x, y) of the filtered one shows, all
  /// around, or sees it from behind.
  [[nodiscard]] bool isBlindTo(int x, int y) const {
    const ProjectedSample sample = back_(x, y);
    if (!sample.sighting.isInside) return false;
    return sample.sighting.hiding == kAllAround || !(sample.area > 0.0f);
  }

  /// The rows of pixels that row `y` of the other frame's samples reaches, as far as they are in the image.
  [[nodiscard]] Rows reached(int y) const {
    const int height = frame_.diffuse.height() / supersample_;
    Rows rows{height, 0};
    for (int x = 0; x < other_.diffuse.width(); ++x) {
      const auto position = there_.position(x, y);
      if (!position) continue;
      const float row = std::floor(pixelPosition(*position).y);
      if (!(row >= 0.0f && row < static_cast<float>(height))) continue;
      rows.first = std::min(rows.first, static_cast<int>(row));
      rows.end = std::max(rows.end, static_cast<int>(row) + 1);
    }
    return rows;
  }

 private:
  /// From samples of the filtered frame to display pixels.
  [[nodiscard]] glm::vec2 pixelPosition(glm::vec2 sample) const {
    return (sample + offset_) / static_cast<float>(supersample_);
  }

  /// What own samples around are in front of it hide it as far as their surfaces reach.
  [[nodiscard]] bool isSeen(const ProjectedSample& sample) const {
    const Sighting& sighting = sample.sighting;
    if (!sighting.isInside || !(sample.area > 0.0f)) return false;
    for (int k = 0; k < 4; ++k) {
      if (((sighting.hiding >> k) & 1) == 0) continue;
      if (coverage_.reaches(sighting.x + k % 2, sighting.y + k / 2, sample.position)) return false;
    }
    return true;
  }

  /// The view-dependent layer of a sample of the other frame, as the filtered frame would see it: its own
  /// while reflections hardly slide, else that of the filtered frame's samples on the same surface, those of
  /// the pixel before others: what lies outside of it would soften it. Where there are none, nothing better
  /// is known than its own.
  [[nodiscard]] Rgb viewDependent(int x, int y, const Sighting& sighting, glm::ivec2 pixel) const {
    const Rgb own = other_.viewDependent(x, y);
    if (sighting.agreeing == 0) return own;
    // Falls to 0 from half the limit on.
    const float share = std::clamp(2.0f - 2.0f * there_.slide(x, y) / slideLimit_, 0.0f, 1.0f);
    if (share == 1.0f) return own;
    Rgb inside(0.0f);
    Rgb around(0.0f);
    int insideCount = 0;
    int aroundCount = 0;
    for (int k = 0; k < 4; ++k) {
      if (((sighting.agreeing >> k) & 1) == 0) continue;
      const glm::ivec2 sample(sighting.x + k % 2, sighting.y + k / 2);
      const Rgb value = frame_.viewDependent(sample.x, sample.y);
      around += value;
      ++aroundCount;
      if (sample / supersample_ == pixel) {
        inside += value;
        ++insideCount;
      }
    }
    const Rgb here =
        insideCount > 0 ? inside / static_cast<float>(insideCount) : around / static_cast<float>(aroundCount);
    return glm::mix(here, own, share);
  }

  const Frame& frame_;
  const Frame& other_;
  const Coverage& coverage_;
  int supersample_;
  glm::vec2 offset_;
  SampleProjection there_;
  SampleProjection back_;
  float footprintLimit_;
  float slideLimit_;
};

/// Another frame, ready to be collected from.
class Source {
 public:
  Source(const Frame& frame, const NearbyFrame& other, const Coverage& coverage, int supersample,
         const WindowMap& window, const TemporalFilterSettings& settings)
      : transfer_(frame, *other.frame, coverage, supersample, settings),
        size_(other.frame->diffuse.size()),
        weights_(timeWeights(window, other.framesAway)),
        reached_(static_cast<std::size_t>(size_.height)) {
    tbb::parallel_for(0, size_.height,
                      [&](int y) { reached_[static_cast<std::size_t>(y)] = transfer_.reached(y); });
  }

  [[nodiscard]] float weight(int x, int y) const { return weights_(x, y); }
  [[nodiscard]] bool isBlindTo(int x, int y) const { return transfer_.isBlindTo(x, y); }

  /// Calls collect(const Deposit&) for what falls into these rows of pixels, in the order of samples.
  template <class Collect>
  void forEachIn(const Rows& wanted, const Collect& collect) const {
    for (int y = 0; y < size_.height; ++y) {
      const Rows& rows = reached_[static_cast<std::size_t>(y)];
      if (rows.end <= wanted.first || rows.first >= wanted.end) continue;
      for (int x = 0; x < size_.width; ++x) {
        const Deposit deposit = transfer_.deposit(x, y);
        if (deposit.pixel.y < wanted.first || deposit.pixel.y >= wanted.end) continue;
        if (deposit.pixel.x >= 0 && deposit.pixel.x < weights_.width()) collect(deposit);
      }
    }
  }

 private:
  Transfer transfer_;
  Size size_;
  TimeWeightMap weights_;
  std::vector<Rows> reached_;
};

/// Collects the samples of the pixels of a few rows.
class PixelBand {
 public:
  PixelBand(const Frame& frame, int supersample, Rows rows)
      : frame_(frame),
        supersample_(supersample),
        rows_(rows),
        pixels_(Size{frame.diffuse.width() / supersample, rows.end - rows.first}, PixelSum(2 * supersample)) {
    forEachPixel([&](int x, int y) { addOwn(x, y, 1.0f, [](int, int) { return true; }); });
  }

  void add(const Source& source) {
    source.forEachIn(rows_, [&](const Deposit& deposit) {
      const float weight = source.weight(deposit.pixel.x, deposit.pixel.y) * deposit.area;
      if (weight > 0.0f) pixel(deposit.pixel.x, deposit.pixel.y).add(deposit.place, deposit.radiance, weight);
    });
    // What the other frame is blind to stands for itself, or else the rest of its pixel would grow over it.
    forEachPixel([&](int x, int y) {
      addOwn(x, y, source.weight(x, y), [&](int i, int j) { return source.isBlindTo(i, j); });
    });
  }

  void writeTo(RadianceMap& pixels) const {
    forEachPixel([&](int x, int y) { pixels(x, y) = pixels_(x, y - rows_.first).mean(); });
  }

 private:
  template <class Work>
  void forEachPixel(const Work& work) const {
    for (int y = rows_.first; y < rows_.end; ++y) {
      for (int x = 0; x < pixels_.width(); ++x) work(x, y);
    }
  }

  [[nodiscard]] PixelSum& pixel(int x, int y) { return pixels_(x, y - rows_.first); }

  /// The frame's own samples of a pixel that `isWanted`.
  template <class IsWanted>
  void addOwn(int x, int y, float weight, const IsWanted& isWanted) {
    if (weight == 0.0f) return;
    PixelSum& sum = pixel(x, y);
    sum.addWhole(weight);
    const auto edge = static_cast<float>(supersample_);
    const glm::vec2 offset(frame_.visibility.camera.subpixelOffset());
    for (int k = 0; k < supersample_ * supersample_; ++k) {
      const glm::ivec2 cell(k % supersample_, k / supersample_);
      const glm::ivec2 sample = glm::ivec2(x, y) * supersample_ + cell;
      if (!isWanted(sample.x, sample.y)) continue;
      sum.add((glm::vec2(cell) + 0.5f + offset) / edge,
              frame_.diffuse(sample.x, sample.y) + frame_.viewDependent(sample.x, sample.y),
              weight / (edge * edge));
    }
  }

  const Frame& frame_;
  int supersample_;
  Rows rows_;
  Image<PixelSum> pixels_;
};

void requireForFilter(bool good, const std::string& expected) {
  if (!good) throw InputError("temporal filter", "expected " + expected);
}

bool isWhole(const Frame& frame) {
  const Visibility& v = frame.visibility;
  const Size size = v.camera.size();
  return v.depth.size() == size && v.normal.size() == size && v.item.size() == size &&
         frame.diffuse.size() == size && frame.viewDependent.size() == size;
}

}  // namespace

RadianceMap temporalFilter(const Frame& frame, int supersample, std::span<const NearbyFrame> others,
                           const WindowMap& window, const TemporalFilterSettings& settings) {
  const Size size = frame.visibility.camera.size();
  requireForFilter(isWhole(frame), "maps of the size of the frame's camera");
  requireForFilter(supersample >= 1 && size.width % supersample == 0 && size.height % supersample == 0,
                   "a whole number of samples a pixel");
  requireForFilter(window.size() == Size{size.width / supersample, size.height / supersample},
                   "a window for every display pixel");
  requireForFilter(settings.footprintLimit > 0.0 && settings.creaseDegrees > 0.0 && settings.slideLimit > 0.0,
                   "limits above 0");
  for (const float deviation : window.pixels()) requireForFilter(deviation > 0.0f, "windows above 0 frames");

  std::vector<const Visibility*> visibilities;
  for (const NearbyFrame& other : others) {
    requireForFilter(isWhole(*other.frame), "maps of the size of the other frame's camera");
    requireForFilter(other.framesAway != 0, "other frames than the filtered one");
    visibilities.push_back(&other.frame->visibility);
  }
  const Coverage coverage(frame.visibility, visibilities, settings.creaseDegrees);
  std::vector<Source> sources;
  sources.reserve(others.size());
  for (const NearbyFrame& other : others) {
    sources.emplace_back(frame, other, coverage, supersample, window, settings);
  }
  RadianceMap pixels(window.size());
  constexpr int kBand = 8;
  tbb::parallel_for(0, (pixels.height() + kBand - 1) / kBand, [&](int i) {
    PixelBand band(frame, supersample, {i * kBand, std::min((i + 1) * kBand, pixels.height())});
    for (const Source& source : sources) band.add(source);
    band.writeTo(pixels);
  });
  return pixels;
}

}  // namespace promenade::ibr
