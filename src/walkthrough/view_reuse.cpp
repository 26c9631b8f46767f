#include "src/walkthrough/view_reuse.h"

#include <array>
#include <utility>

#include "ibr/blend.h"
#include "src/core/resolve.h"

namespace promenade::walkthrough {
namespace {

ibr::Warped warpFrom(const TracedViews& source, const Visibility& target, const Mask& wanted,
                     const ibr::WarpSettings& settings) {
  return source.known != nullptr ? ibr::gatherWarp(*source.frame, *source.known, target, wanted, settings)
                                 : ibr::gatherWarp(*source.frame, target, wanted, settings);
}

bool isValid(const ibr::Warped& warped, int x, int y) {
  return warped.validity(x, y) == ibr::Validity::kValid;
}

Rgb meanRadiance(const Draft& draft) {
  glm::dvec3 sum(0.0);
  double count = 0.0;
  for (std::size_t i = 0; i < draft.holes.pixels().size(); ++i) {
    if (draft.holes.pixels()[i] != 0) continue;
    sum += glm::dvec3(draft.frame.diffuse.pixels()[i] + draft.frame.viewDependent.pixels()[i]);
    count += 1.0;
  }
  return count > 0.0 ? Rgb(sum / count) : Rgb(0.0f);
}

/// The draft as it would look from either end. Only what both ends fill can differ.
ComparedPair comparedViews(const Draft& draft, const WarpedViews& views, const ItemSet& items,
                           const ItemSet& matt) {
  const Frame& frame = draft.frame;
  const Size size = draft.holes.size();
  const Rgb fill = meanRadiance(draft);
  ComparedPair pair{RadianceMap(size), RadianceMap(size), Mask(size), Mask(size)};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const ItemId item = frame.visibility.item(x, y);
      Rgb& a = pair.fromFirst(x, y);
      Rgb& b = pair.fromLast(x, y);
      a = b = draft.holes(x, y) != 0 ? fill : frame.diffuse(x, y) + frame.viewDependent(x, y);
      if (!isValid(views.fromFirst, x, y) || !isValid(views.fromLast, x, y) || !items.contains(item)) {
        pair.excluded(x, y) = 1;
        continue;
      }
      const bool isMatt = matt.contains(item);
      const auto seenFrom = [&](const ibr::Warped& end) {
        return (isMatt ? end.diffuse(x, y) : frame.diffuse(x, y)) + end.viewDependent(x, y);
      };
      a = seenFrom(views.fromFirst);
      b = seenFrom(views.fromLast);
    }
  }
  return pair;
}

}  // namespace

Mask samplesOf(const ItemSet& items, const Draft& draft) {
  Mask samples(draft.holes.size());
  for (std::size_t i = 0; i < samples.pixels().size(); ++i) {
    const bool selected =
        draft.holes.pixels()[i] == 0 && items.contains(draft.frame.visibility.item.pixels()[i]);
    samples.pixels()[i] = selected ? 1 : 0;
  }
  return samples;
}

WarpedViews warpViews(const ViewRange& range, const Draft& draft, const Mask& wanted,
                      const ibr::WarpSettings& settings) {
  const Visibility& target = draft.frame.visibility;
  return {range.first.frameIndex, range.last.frameIndex, warpFrom(range.first, target, wanted, settings),
          warpFrom(range.last, target, wanted, settings)};
}

ItemSet agreeingItems(const Draft& draft, const WarpedViews& views, const ItemSet& items, const ItemSet& matt,
                      int frameIndex, const VelocityMap& velocity, const Renderer& renderer,
                      const Settings& settings) {
  const ComparedPair pair = comparedViews(draft, views, items, matt);
  const int factor = settings.supersample;
  const ItemVerdict verdict = judgeItems(differenceSeen(pair, frameIndex, velocity, settings),
                                         resolveVisibility(draft.frame.visibility, factor).item,
                                         resolveMask(pair.excluded, factor),
                                         resolveMask(pair.unverified, factor), renderer,
                                         settings.tolerancePercent);
  std::vector<ItemId> agreeing;
  for (const ItemId item : verdict.proven.items()) {
    if (items.contains(item)) agreeing.push_back(item);
  }
  return ItemSet(std::move(agreeing));
}

void layOver(Draft& draft, const WarpedViews& views, const ItemSet& items, const ItemSet& matt,
             int frameIndex) {
  const std::array<ibr::BlendSource, 2> ends{
      {{&views.fromFirst, double(views.first)}, {&views.fromLast, double(views.last)}}};
  ibr::Blended look = ibr::blend(ends, std::move(draft.frame.visibility), double(frameIndex));
  Frame& frame = draft.frame;
  frame.visibility = std::move(look.frame.visibility);
  for (int y = 0; y < draft.holes.height(); ++y) {
    for (int x = 0; x < draft.holes.width(); ++x) {
      const bool byBoth = look.holes(x, y) == 0 && look.frame.source(x, y) == SampleSource::kBlended;
      if (!byBoth || draft.holes(x, y) != 0) continue;
      const ItemId item = frame.visibility.item(x, y);
      if (!items.contains(item)) continue;
      frame.viewDependent(x, y) = look.frame.viewDependent(x, y);
      if (matt.contains(item)) frame.diffuse(x, y) = look.frame.diffuse(x, y);
      draft.settled(x, y) = 1;
    }
  }
}

}  // namespace promenade::walkthrough
