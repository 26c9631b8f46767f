// Do full frames flicker? Of each two neighbours the later one is warped to the earlier, along the exact
// motion of every pixel, and both are compared by the metric: what differs then is no motion, but noise, or
// light that changes with the view.
//
//     promenade render SCENE --method full --supersample 1 --size 1280x720 --frames 40-44 --out walk
//     flicker walk/frames 2 [EXPOSURE [all]]
//
// Without `all` only ray-traced samples are compared. With it warped ones are, too: do frames made of
// keyframes and warps jump where a segment ends? Pairs with a keyframe are marked and stand against the
// others.
//
// With --supersample 1 the file's pixels are samples, none of which mixes two surfaces; 2x2 of them make a
// display pixel here. Left out are samples that the later frame does not see, or not closely enough. Asked:
// pooled difference below 1 JND on 99.5% of the rest. Beside FRAMES/000040.exr the picture
// FRAMES/000040-flicker.png is written: bright where it is not.

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
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
};

struct Flicker {
  aqm::Result seen;
  Mask excluded;
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

Pair aligned(const Frame& earlier, const Frame& later) {
  const ibr::Warped warped = ibr::gatherWarp(later, earlier.visibility, {});
  Pair pair{earlier.diffuse.clone(), earlier.diffuse.clone(), Mask(earlier.diffuse.size(), 1)};
  for (std::size_t i = 0; i < pair.excluded.pixels().size(); ++i) {
    if (warped.validity.pixels()[i] != ibr::Validity::kValid) continue;
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

Flicker flickerBetween(const Frame& earlier, const Frame& later, double framesPerSecond,
                       const Viewing& viewing) {
  const Pair pair = aligned(earlier, later);
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
  return {
      aqm::compare(onDisplay(pair.earlier), onDisplay(pair.later), velocity, aqm::Settings{pixelsPerDegree}),
      resolved(pair.excluded, viewing.supersample)};
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
  Mean beside, between;
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
    (hasKeyframe ? beside : between).add(shares.mean);
    std::printf("| %d, %d%s | %.2f | %.3f | %.3f | %.2f |\n", number, number + 1,
                hasKeyframe ? " (keyframe)" : "", shares.compared, shares.steady, shares.mean,
                static_cast<double>(shares.largest));
    io::write8bit(std::filesystem::path(files[i]).replace_filename(files[i].stem().string() + "-flicker.png"),
                  pictureOf(flicker));
  }
  std::printf("mean, JND: %.3f in %d pairs with a keyframe, %.3f in the %d others\n", beside.value(),
              beside.count, between.value(), between.count);
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
  if (count < 3 || count > 5 || (count == 5 && std::string_view(arguments[4]) != "all")) {
    std::fputs("flicker FRAMES SUPERSAMPLE [EXPOSURE [all]]\n", stderr);
    return 2;
  }
  try {
    promenade::Viewing viewing{.supersample = numberFrom<int>(arguments[2]), .tone = {}};
    if (viewing.supersample < 1) throw promenade::InputError("flicker", "expected at least one sample");
    if (count == 5) viewing.samples = promenade::Samples::kAll;
    if (count >= 4) viewing.tone.exposureEv = numberFrom<double>(arguments[3]);
    promenade::measure(arguments[1], viewing);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "flicker: %s\n", error.what());
    return 2;
  }
}
