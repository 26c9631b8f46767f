#include "src/walkthrough/retrace_items.h"

#include <cmath>
#include <utility>

#include "ibr/view_layer.h"
#include "src/core/display.h"
#include "src/walkthrough/selected.h"

namespace promenade::walkthrough {
namespace {

/// Of the range of luminances that settings.largestRange allows: what the coarse lattice misses is twice as
/// large, where the eye needs half the contrast.
constexpr double kRangeOfCoarse = 0.5;

// Renderers may give samples that share a place in the pixel the same random numbers, whose error would not
// average out. So neighbours stand at different places in their pixels: of any 2 x 2 pixels, and of any 2 x 2
// squares of the coarse lattice, all four have different ones. And between neighbouring rows, and columns,
// lie no more samples than interpolation reaches: whatever lies between has some on both sides, and an edge
// there is found. (Not where the item or the picture ends.)

/// One sample of each pixel, in the middle of it or beside.
bool isOnePerPixel(int x, int y, int supersample) {
  const int column = x / supersample;
  const int row = y / supersample;
  const int middle = (supersample - 1) / 2;
  return x % supersample == middle + (column + row) % 2 && y % supersample == middle + row % 2;
}

/// One pixel of each square of 2 x 2.
bool isOnePerSquare(int column, int row) {
  return column % 2 == row / 2 % 2 && row % 2 == column / 2 % 2;
}

/// Samples that are traced so that others need not be.
struct Lattice {
  Mask samples;  ///< of those asked for
  ibr::ViewLayerSettings settings;
  /// What its samples would make of the warped layer, which is known everywhere.
  ibr::ViewLayer expected;
};

class Lattices {
 public:
  Lattices(const Frame& warped, const Mask& wanted, int supersample, const Renderer& renderer)
      : warped_(warped.viewDependent.clone()),
        coarse_{Mask(wanted.size()), {.reach = 2 * supersample}, {}},
        fine_{
            Mask(wanted.size()),
            {.reach = supersample, .noise = [&renderer](ItemId item) { return renderer.traits(item).noise; }},
            {}} {
    coarse_.settings.largestRange *= kRangeOfCoarse;
    for (int y = 0; y < wanted.height(); ++y) {
      for (int x = 0; x < wanted.width(); ++x) {
        if (wanted(x, y) == 0 || !isOnePerPixel(x, y, supersample)) continue;
        fine_.samples(x, y) = 1;
        coarse_.samples(x, y) = isOnePerSquare(x / supersample, y / supersample) ? 1 : 0;
      }
    }
    for (Lattice* lattice : {&coarse_, &fine_})
      lattice->expected = ibr::interpolateViewLayer(warped, lattice->samples, wanted, lattice->settings);
  }
  /// One sample in each square of 2 x 2 pixels; noise is not allowed for, which would look as coarse.
  [[nodiscard]] const Lattice& coarse() const { return coarse_; }
  /// One sample a pixel, those of the coarse one among them.
  [[nodiscard]] const Lattice& fine() const { return fine_; }

  /// Detail finer than the lattice shows in the warped layer: what its samples would make of that is not what
  /// it is.
  [[nodiscard]] bool misses(const Lattice& lattice, const Frame& frame, int x, int y) const {
    if (lattice.expected.found(x, y) == 0) return true;
    const auto& settings = lattice.settings;
    const float bright = luminance(warped_(x, y));
    const double noise = settings.noise ? settings.noise(frame.visibility.item(x, y)) : 0.0;
    const double largest = (settings.largestRange + 3.0 * noise) * (bright + luminance(frame.diffuse(x, y)));
    return std::abs(luminance(lattice.expected.viewDependent(x, y)) - bright) > largest;
  }

 private:
  RadianceMap warped_;
  Lattice coarse_;
  Lattice fine_;
};

bool isAnyAround(const Mask& mask, int x, int y, int reach) {
  for (int j = y - reach; j <= y + reach; ++j) {
    for (int i = x - reach; i <= x + reach; ++i) {
      if (mask.contains(i, j) && mask(i, j) != 0) return true;
    }
  }
  return false;
}

class Retracing {
 public:
  Retracing(Frame&& frame, Size size, int frameIndex, const Renderer& renderer)
      : retraced_{std::move(frame), Mask(size)}, frameIndex_(frameIndex), renderer_(renderer) {}

  [[nodiscard]] const Frame& frame() const { return retraced_.frame; }
  [[nodiscard]] RetracedItems result() && { return std::move(retraced_); }

  /// Those of the `samples` that are not traced yet.
  void trace(const Mask& samples) {
    Mask now = samples.clone();
    for (std::size_t i = 0; i < now.pixels().size(); ++i) {
      std::uint8_t& traced = retraced_.traced.pixels()[i];
      if (traced != 0) now.pixels()[i] = 0;
      traced |= now.pixels()[i];
    }
    renderer_.retrace(retraced_.frame, now, SampleSource::kTracedItem, frameIndex_);
  }

  /// Puts between the samples of the lattice, which are traced, what they tell, and returns those of the
  /// `wanted` that they tell nothing of.
  [[nodiscard]] Mask interpolate(const Lattice& lattice, const Lattices& all, const Mask& wanted) {
    Frame& frame = retraced_.frame;
    const ibr::ViewLayer layer = ibr::interpolateViewLayer(frame, known(), wanted, lattice.settings);
    Mask open(wanted.size());
    for (int y = 0; y < wanted.height(); ++y) {
      for (int x = 0; x < wanted.width(); ++x) {
        if (wanted(x, y) == 0 || retraced_.traced(x, y) != 0) continue;
        if (layer.found(x, y) != 0 && !all.misses(lattice, frame, x, y)) {
          frame.viewDependent(x, y) = layer.viewDependent(x, y);
        } else {
          open(x, y) = 1;
        }
      }
    }
    return open;
  }

 private:
  [[nodiscard]] Mask known() const {
    Mask known = retraced_.traced.clone();
    for (std::size_t i = 0; i < known.pixels().size(); ++i) {
      if (retraced_.frame.source.pixels()[i] == SampleSource::kTracedHole) known.pixels()[i] = 1;
    }
    return known;
  }

  RetracedItems retraced_;
  int frameIndex_;
  const Renderer& renderer_;
};

}  // namespace

RetracedItems retraceItems(Frame frame, const Mask& items, const ItemSet& matt, int supersample,
                           int frameIndex, const Renderer& renderer) {
  Retracing retracing(std::move(frame), items.size(), frameIndex, renderer);
  if (!isAnySelected(items)) return std::move(retracing).result();
  if (supersample == 1) {
    retracing.trace(items);
    return std::move(retracing).result();
  }
  // Of what has no view-dependent layer to speak of it is the diffuse one that is wrong; a mirror image may
  // be as fine as a sample.
  const ItemBuffer& item = retracing.frame().visibility.item;
  Mask whole(items.size());
  Mask layered(items.size());
  for (std::size_t i = 0; i < items.pixels().size(); ++i) {
    if (items.pixels()[i] == 0) continue;
    const ItemId id = item.pixels()[i];
    const ItemTraits traits = renderer.traits(id);
    const bool isLayered = traits.viewDependent && traits.noise > 0.0f && !matt.contains(id);
    (isLayered ? layered : whole).pixels()[i] = 1;
  }
  const Lattices lattices(retracing.frame(), layered, supersample, renderer);
  retracing.trace(whole);
  retracing.trace(lattices.coarse().samples);
  Mask open = retracing.interpolate(lattices.coarse(), lattices, layered);
  Mask around = lattices.fine().samples.clone();
  for (int y = 0; y < around.height(); ++y) {
    for (int x = 0; x < around.width(); ++x) {
      if (around(x, y) != 0 && !isAnyAround(open, x, y, supersample)) around(x, y) = 0;
    }
  }
  retracing.trace(around);
  open = retracing.interpolate(lattices.fine(), lattices, open);
  retracing.trace(open);
  return std::move(retracing).result();
}

}  // namespace promenade::walkthrough
