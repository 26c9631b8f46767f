// Do full frames flicker? Of each two neighbours the later one is warped to the earlier, along the exact
// motion of every pixel, and both are compared by the metric: what differs then is no motion, but noise, or
// light that changes with the view.
//
//     promenade render SCENE --method full --supersample 1 --size 1280x720 --frames 40-44 --out walk
//     flicker walk/frames 2 [EXPOSURE [all] [without ITEM...]]
//
// Without `all` only ray-traced samples are compared. With it warped ones are, too: do frames made of
// keyframes and warps jump where a segment ends? Pairs with a keyframe are marked and stand against the
// others. Items that are left out count as not compared, and their differences do not spread to others when
// the metric pools: what a mirror shows moves otherwise than the mirror, and is no flicker.
//
// With --supersample 1 the file's pixels are samples, none of which mixes two surfaces; 2x2 of them make a
// display pixel here. Left out are samples that the later frame does not see, or not closely enough. Asked:
// pooled difference below 1 JND on 99.5% of the rest. Beside FRAMES/000040.exr the picture
// FRAMES/000040-flicker.png is written, bright where it is not, and FRAMES/000040-difference.png: what became
// brighter or darker, 10 per cent being white or black. After each pair, the items that have most of the
// squared differences.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "aqm/metric.h"
#include "ibr/flow.h"
#include "ibr/warp.h"
#include "src/core/display.h"
#include "src/core/errors.h"
#include "src/core/resolve.h"
#include "src/core/tone_mapping.h"
#include "src/io/exr_frame.h"
#include "src/io/png.h"

namespace promenade {
namespace {

/// Samples as seen from the earlier camera.
struct Pair {
  RadianceMap earlier, later;  ///< equal where nothing can be compared
  Mask excluded;
};

/// Which samples of the later frame are compared.
enum class Samples { kTraced, kAll };

/// What the display shows, and how it is judged.
struct Viewing {
  int supersample;
  ToneMapping tone;
  DisplayModel display = {};
  Samples samples = Samples::kTraced;
  std::set<ItemId> without = {};
};

/// Of one item in one frame.
struct OfItem {
  ItemId item = kNoItem;
  int pixels = 0;
  double squares = 0.0;  ///< sum of the squared relative differences
};

struct Flicker {
  aqm::Result seen;
  Mask excluded;
  Image<float> difference;    ///< later - earlier over their mean, on the display
  std::vector<OfItem> items;  ///< those with the largest differences first
};

bool isKeyframe(const SourceMap& source) {
  return std::all_of(source.pixels().begin(), source.pixels().end(),
                     [](SampleSource s) { return s == SampleSource::kTraced; });
}

Frame samplesOf(io::FrameFile&& file, Samples compared) {
  const Size size = file.radiance.size();
  if (compared == Samples::kAll) file.source = SourceMap(size, SampleSource::kTraced);
  return {{file.metadata.camera, std::move(file.depth), std::move(file.normal), std::move(file.item)},
          std::move(file.radiance),
          RadianceMap(size),
          std::move(file.source)};
}

Pair aligned(const Frame& earlier, const Frame& later, const std::set<ItemId>& without) {
  const ibr::Warped warped = ibr::gatherWarp(later, earlier.visibility, {});
  Pair pair{earlier.diffuse.clone(), earlier.diffuse.clone(), Mask(earlier.diffuse.size(), 1)};
  for (std::size_t i = 0; i < pair.excluded.pixels().size(); ++i) {
    if (warped.validity.pixels()[i] != ibr::Validity::kValid) continue;
    if (without.contains(earlier.visibility.item.pixels()[i])) continue;
    pair.later.pixels()[i] = warped.diffuse.pixels()[i];
    pair.excluded.pixels()[i] = 0;
  }
  return pair;
}

/// A display pixel is left out if any of its samples is.
Mask resolved(const Mask& samples, int factor) {
  Mask pixels(samples.width() / factor, samples.height() / factor);
  for (int y = 0; y < pixels.height() * factor; ++y) {
    for (int x = 0; x < pixels.width() * factor; ++x) {
      if (samples(x, y) != 0) pixels(x / factor, y / factor) = 1;
    }
  }
  return pixels;
}

Image<float> relativeDifference(const LuminanceMap& earlier, const LuminanceMap& later) {
  Image<float> difference(earlier.size());
  for (std::size_t i = 0; i < difference.pixels().size(); ++i) {
    const float a = earlier.pixels()[i], b = later.pixels()[i];
    if (a + b > 0.0f) difference.pixels()[i] = 2.0f * (b - a) / (a + b);
  }
  return difference;
}

std::vector<OfItem> byItem(const Image<float>& difference, const Mask& excluded, const ItemBuffer& items) {
  std::map<ItemId, OfItem> sums;
  for (std::size_t i = 0; i < difference.pixels().size(); ++i) {
    if (excluded.pixels()[i] != 0) continue;
    const ItemId item = items.pixels()[i];
    OfItem& sum = sums[item];
    sum.item = item;
    ++sum.pixels;
    sum.squares += std::pow(static_cast<double>(difference.pixels()[i]), 2.0);
  }
  std::vector<OfItem> sorted;
  for (const auto& [item, sum] : sums) sorted.push_back(sum);
  std::sort(sorted.begin(), sorted.end(),
            [](const OfItem& a, const OfItem& b) { return a.squares > b.squares; });
  return sorted;
}

Flicker flickerBetween(const Frame& earlier, const Frame& later, double framesPerSecond,
                       const Viewing& viewing) {
  const Pair pair = aligned(earlier, later, viewing.without);
  const auto onDisplay = [&](const RadianceMap& samples) {
    return displayLuminance(
        encodeForDisplay(resolveRadiance(samples, viewing.supersample), viewing.tone.at(0, viewing.display)),
        viewing.display);
  };
  const Visibility seen = resolveVisibility(earlier.visibility, viewing.supersample);
  const Camera& after = later.visibility.camera;
  const double pixelsPerDegree = viewing.display.pixelsPerDegree();
  const VelocityMap velocity = ibr::imageVelocity(
      PixelFlow(),
      ibr::pixelFlow(seen, Camera(after.pose(), after.verticalFieldOfView(), seen.camera.size())),
      framesPerSecond, pixelsPerDegree);
  const LuminanceMap before = onDisplay(pair.earlier), now = onDisplay(pair.later);
  Mask excluded = resolved(pair.excluded, viewing.supersample);
  Image<float> difference = relativeDifference(before, now);
  std::vector<OfItem> items = byItem(difference, excluded, seen.item);
  return {aqm::compare(before, now, velocity, aqm::Settings{pixelsPerDegree}), std::move(excluded),
          std::move(difference), std::move(items)};
}

struct Shares {
  double compared = 0.0, steady = 0.0;  ///< per cent: of all pixels; of those compared, below 1 JND
  float largest = 0.0f;                 ///< JND
  double mean = 0.0;                    ///< JND, of those compared
};

/// Of pairs of frames.
struct Mean {
  double sum = 0.0;
  int count = 0;
  void add(double value) {
    sum += value;
    ++count;
  }
  [[nodiscard]] double value() const { return count > 0 ? sum / count : 0.0; }
};

Shares sharesOf(const Flicker& flicker) {
  std::size_t compared = 0, steady = 0;
  Shares shares;
  for (std::size_t i = 0; i < flicker.excluded.pixels().size(); ++i) {
    if (flicker.excluded.pixels()[i] != 0) continue;
    const float jnd = flicker.seen.pooledJnd.pixels()[i];
    ++compared;
    steady += jnd < 1.0f ? 1 : 0;
    shares.largest = std::max(shares.largest, jnd);
    shares.mean += static_cast<double>(jnd);
  }
  if (compared > 0) shares.mean /= static_cast<double>(compared);
  shares.compared =
      100.0 * static_cast<double>(compared) / static_cast<double>(flicker.excluded.size().area());
  shares.steady = compared > 0 ? 100.0 * static_cast<double>(steady) / static_cast<double>(compared) : 100.0;
  return shares;
}

/// White at 2 JND; excluded pixels blue.
EncodedMap pictureOf(const Flicker& flicker) {
  EncodedMap picture(flicker.excluded.size());
  for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
    const float grey = std::min(1.0f, 0.5f * flicker.seen.pooledJnd.pixels()[i]);
    picture.pixels()[i] = flicker.excluded.pixels()[i] != 0 ? Rgb(0.0f, 0.0f, 0.4f) : Rgb(grey);
  }
  return picture;
}

/// Grey where nothing changed, white and black at 10 per cent; excluded pixels blue.
EncodedMap pictureOfDifference(const Flicker& flicker) {
  EncodedMap picture(flicker.excluded.size());
  for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
    const float grey = std::clamp(0.5f + 5.0f * flicker.difference.pixels()[i], 0.0f, 1.0f);
    picture.pixels()[i] = flicker.excluded.pixels()[i] != 0 ? Rgb(0.0f, 0.0f, 0.4f) : Rgb(grey);
  }
  return picture;
}

void printItems(const std::vector<OfItem>& items) {
  constexpr std::size_t kMost = 8;
  double all = 0.0;
  for (const OfItem& of : items) all += of.squares;
  if (!(all > 0.0)) return;
  std::printf("  ");
  for (std::size_t i = 0; i < std::min(kMost, items.size()); ++i) {
    const OfItem& of = items[i];
    std::printf(" item %u: %.0f%% on %d pixels, rms %.1f%%;", static_cast<unsigned>(of.item),
                100.0 * of.squares / all, of.pixels, 100.0 * std::sqrt(of.squares / of.pixels));
  }
  std::printf("\n");
}

void measure(const std::filesystem::path& folder, const Viewing& viewing) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".exr") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  if (files.size() < 2) throw InputError(folder.string(), "expected at least two frames");
  std::printf(
      "| frames | %% compared | %% of them below 1 JND | mean, JND | largest, JND "
      "|\n|---|---|---|---|---|\n");
  Mean besideKeyframes, between;
  for (std::size_t i = 0; i + 1 < files.size(); ++i) {
    io::FrameFile first = io::readFrame(files[i]), second = io::readFrame(files[i + 1]);
    const Size size = first.radiance.size();
    if (size.width % viewing.supersample != 0 || size.height % viewing.supersample != 0) {
      throw InputError(files[i].string(), "expected whole display pixels of samples");
    }
    const double rate = first.metadata.framesPerSecond;
    const int number = first.metadata.frame;
    const bool hasKeyframe = isKeyframe(first.source) || isKeyframe(second.source);
    const Flicker flicker = flickerBetween(samplesOf(std::move(first), viewing.samples),
                                           samplesOf(std::move(second), viewing.samples), rate, viewing);
    const Shares shares = sharesOf(flicker);
    (hasKeyframe ? besideKeyframes : between).add(shares.mean);
    std::printf("| %d, %d%s | %.2f | %.3f | %.3f | %.2f |\n", number, number + 1,
                hasKeyframe ? " (keyframe)" : "", shares.compared, shares.steady, shares.mean,
                static_cast<double>(shares.largest));
    printItems(flicker.items);
    const auto beside = [&](const char* what) {
      return std::filesystem::path(files[i]).replace_filename(files[i].stem().string() + what);
    };
    io::write8bit(beside("-flicker.png"), pictureOf(flicker));
    io::write8bit(beside("-difference.png"), pictureOfDifference(flicker));
  }
  std::printf("mean, JND: %.3f in %d pairs with a keyframe, %.3f in the %d others\n", besideKeyframes.value(),
              besideKeyframes.count, between.value(), between.count);
}

}  // namespace
}  // namespace promenade

namespace {

/// The whole text as a number.
template <class Number>
Number numberFrom(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw promenade::InputError("flicker", "expected a number, found '" + std::string(text) + "'");
  }
  return number;
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string_view> words(arguments + 1, arguments + count);
  if (words.size() < 2) {
    std::fputs("flicker FRAMES SUPERSAMPLE [EXPOSURE [all] [without ITEM...]]\n", stderr);
    return 2;
  }
  try {
    promenade::Viewing viewing{.supersample = numberFrom<int>(words[1]), .tone = {}};
    if (viewing.supersample < 1) throw promenade::InputError("flicker", "expected at least one sample");
    if (words.size() > 2) viewing.tone.exposureEv = numberFrom<double>(words[2]);
    std::size_t next = 3;
    if (next < words.size() && words[next] == "all") {
      viewing.samples = promenade::Samples::kAll;
      ++next;
    }
    if (next < words.size()) {
      if (words[next] != "without") {
        throw promenade::InputError("flicker",
                                    "expected 'all' or 'without', found '" + std::string(words[next]) + "'");
      }
      for (++next; next < words.size(); ++next) {
        viewing.without.insert(numberFrom<promenade::ItemId>(words[next]));
      }
    }
    promenade::measure(std::string(words[0]), viewing);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "flicker: %s\n", error.what());
    return 2;
  }
}
