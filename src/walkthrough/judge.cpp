#include "src/walkthrough/judge.h"

#include <algorithm>
#include <cmath>

#include "src/core/resolve.h"
#include "src/walkthrough/item_table.h"
#include "src/walkthrough/selected.h"
#include "src/walkthrough/steady_items.h"

namespace promenade::walkthrough {
namespace {

Rgb radianceOf(const ibr::Warped& warped, int x, int y) {
  return warped.diffuse(x, y) + warped.viewDependent(x, y);
}

bool isValid(const ibr::Warped& warped, int x, int y) {
  return warped.validity(x, y) == ibr::Validity::kValid;
}

/// Mean radiance of the valid samples: what holes are filled with, so that they add no contrast of their own.
Rgb meanRadiance(const WarpedPair& warped) {
  glm::dvec3 sum(0.0);
  double count = 0.0;
  for (int y = 0; y < warped.target.depth.height(); ++y) {
    for (int x = 0; x < warped.target.depth.width(); ++x) {
      for (const ibr::Warped* source : {&warped.fromFirst, &warped.fromLast}) {
        if (!isValid(*source, x, y)) continue;
        sum += glm::dvec3(radianceOf(*source, x, y));
        count += 1.0;
      }
    }
  }
  return count > 0.0 ? Rgb(sum / count) : Rgb(0.0f);
}

/// Display pixels. Of an item with fewer that are compared nothing is proven: a glint on it may be in other
/// frames than the middle, and in neither keyframe.
constexpr std::size_t kFewestOfProof = 25;

struct Look {
  EncodedMap fromFirst;
  EncodedMap fromLast;
  aqm::Result metric;
};

Look compareAsSeen(const ComparedPair& pair, int frame, const VelocityMap& velocity,
                   const Settings& settings) {
  // Both are what is seen at the same instant, by an eye adapted alike.
  const FrameTone tone = settings.tone.at(frame, settings.display);
  const RadianceMap fromFirst = resolveRadiance(pair.fromFirst, settings.supersample);
  const RadianceMap fromLast = resolveRadiance(pair.fromLast, settings.supersample);
  const Surroundings surroundings = tone.around({&fromFirst, &fromLast});
  Look look;
  look.fromFirst = encodeForDisplay(fromFirst, tone, surroundings);
  look.fromLast = encodeForDisplay(fromLast, tone, surroundings);
  look.metric = aqm::compare(displayLuminance(look.fromFirst, settings.display),
                             displayLuminance(look.fromLast, settings.display), velocity,
                             aqm::Settings{settings.display.pixelsPerDegree()});
  return look;
}

}  // namespace

ComparedPair comparedPair(const WarpedPair& warped, const ItemSet& traced, const Mask& disputed) {
  const Size size = warped.target.depth.size();
  const Rgb fill = meanRadiance(warped);
  ComparedPair pair{RadianceMap(size), RadianceMap(size), Mask(size), Mask(size)};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const bool first = isValid(warped.fromFirst, x, y);
      const bool last = isValid(warped.fromLast, x, y);
      Rgb a = first ? radianceOf(warped.fromFirst, x, y) : last ? radianceOf(warped.fromLast, x, y) : fill;
      Rgb b = last ? radianceOf(warped.fromLast, x, y) : a;
      if ((!first && !last) || disputed(x, y) != 0 || traced.contains(warped.target.item(x, y))) {
        pair.excluded(x, y) = 1;
        b = a;
      } else if (first != last) {
        pair.unverified(x, y) = 1;
      }
      pair.fromFirst(x, y) = a;
      pair.fromLast(x, y) = b;
    }
  }
  return pair;
}

ComparedPair diffuseCompared(ComparedPair pair, const WarpedPair& warped, const ItemSet& items) {
  for (int y = 0; y < pair.excluded.height(); ++y) {
    for (int x = 0; x < pair.excluded.width(); ++x) {
      if (pair.excluded(x, y) != 0 || pair.unverified(x, y) != 0) continue;
      if (!items.contains(warped.target.item(x, y))) continue;
      pair.fromLast(x, y) = warped.fromLast.diffuse(x, y) + warped.fromFirst.viewDependent(x, y);
    }
  }
  return pair;
}

Mask resolveMask(const Mask& samples, int factor) {
  Mask pixels(samples.width() / factor, samples.height() / factor);
  for (int y = 0; y < pixels.height(); ++y) {
    for (int x = 0; x < pixels.width(); ++x) {
      int selected = 0;
      for (int j = 0; j < factor; ++j) {
        for (int i = 0; i < factor; ++i) selected += samples(x * factor + i, y * factor + j) != 0 ? 1 : 0;
      }
      pixels(x, y) = 2 * selected > factor * factor ? 1 : 0;
    }
  }
  return pixels;
}

ItemVerdict judgeItems(const ProbabilityMap& probability, const ItemBuffer& item, const Mask& excluded,
                       const Mask& unverified, const Renderer& renderer, double tolerancePercent) {
  struct Count {
    bool viewDependent = false;
    std::size_t compared = 0;
    std::size_t visible = 0;
  };
  ItemTable<Count> counts;
  for (int y = 0; y < item.height(); ++y) {
    for (int x = 0; x < item.width(); ++x) {
      const ItemId id = item(x, y);
      if (id == kNoItem || excluded(x, y) != 0 || unverified(x, y) != 0) continue;
      Count& count = counts.of(id, [&](ItemId) { return Count{renderer.traits(id).viewDependent}; });
      if (!count.viewDependent) continue;
      ++count.compared;
      if (probability(x, y) > aqm::kVisibleProbability) ++count.visible;
    }
  }
  std::vector<ItemId> failing;
  std::vector<ItemId> proven;
  for (const auto& [id, count] : counts) {
    if (!count.viewDependent) continue;
    const double percent = 100.0 * static_cast<double>(count.visible) / static_cast<double>(count.compared);
    if (percent > tolerancePercent) {
      failing.push_back(id);
    } else if (count.compared >= kFewestOfProof) {
      proven.push_back(id);
    }
  }
  return {ItemSet(std::move(failing)), ItemSet(std::move(proven))};
}

namespace {

ItemSet mattAmong(const ItemSet& items, const Renderer& renderer) {
  std::vector<ItemId> matt = items.items();
  std::erase_if(matt, [&](ItemId item) { return renderer.traits(item).viewDependent; });
  return ItemSet(std::move(matt));
}

/// What is disputed is one half of a pattern finer than the samples. The other half both keyframes miss
/// alike, or have alike, and it cannot be told where: a line that is in neither. If more of the middle than
/// this differs visibly by what is disputed, the other half would be seen too. Per cent of the picture;
/// measured in a city, docs/results.md.
constexpr double kMostPatterned = 50.0;

struct Judged {
  Judgement judgement;
  double percentTraced = 0.0;  ///< of the samples of an inbetween, going by the middle
};

Judged judgeWithout(Disputes disputes, const Segment& segment, const WarpedPair& warped,
                    const VelocityMap& velocity, const Renderer& renderer, const Settings& settings) {
  const int factor = settings.supersample;
  const Mask allDisputed = disputedOf(warped, disputes, renderer);
  const ItemSet widely = widelyDisputed(allDisputed, warped);
  const Mask disputed = disputedHereAndThere(allDisputed, widely, warped);
  const ItemSet patterned = mattAmong(widely, renderer);
  ComparedPair pair = comparedPair(warped, patterned, disputed);
  Look look = compareAsSeen(pair, segment.middle(), velocity, settings);

  const ItemBuffer item = resolveVisibility(warped.target, factor).item;
  const auto judged = [&] {
    return judgeItems(look.metric.probability, item, resolveMask(pair.excluded, factor),
                      resolveMask(pair.unverified, factor), renderer, settings.tolerancePercent);
  };
  Judged result;
  Judgement& judgement = result.judgement;
  judgement.items = judged();
  if (!judgement.items.failing.empty()) {
    pair = diffuseCompared(std::move(pair), warped, judgement.items.failing);
    look = compareAsSeen(pair, segment.middle(), velocity, settings);
    judgement.items.matt = judged().failing;
    // A mask laid over the finished map would let the failing items speak through filters and pooling.
    pair = comparedPair(warped, judgement.items.failing.with(patterned), disputed);
    look = compareAsSeen(pair, segment.middle(), velocity, settings);
  }
  Mask excluded = resolveMask(pair.excluded, factor);

  SegmentStatistics& statistics = judgement.statistics;
  statistics.segment = segment;
  statistics.differencePercent = aqm::percentVisible(look.metric.probability, excluded);
  statistics.maskedPercent = percentSelected(excluded);
  statistics.unverifiedPercent = percentSelected(resolveMask(pair.unverified, factor));
  // Holes that stay are differences, too.
  const double holesPercent = settings.holes == Holes::kStay ? statistics.maskedPercent : 0.0;
  statistics.decision =
      std::min(statistics.differencePercent + holesPercent, 100.0) > settings.tolerancePercent
          ? Decision::kSplit
          : Decision::kAccept;
  judgement.middle = {segment,
                      statistics.decision,
                      std::move(look.fromFirst),
                      std::move(look.fromLast),
                      std::move(excluded),
                      std::move(look.metric)};
  judgement.items.steady = steadyAmong(judgement.items.proven, warped);
  judgement.items.disputes = disputes;
  judgement.items.failing = judgement.items.failing.with(patterned);
  result.percentTraced = percentSelected(pair.excluded);
  return result;
}

}  // namespace

Judgement judgeMiddle(const Segment& segment, const WarpedPair& warped, const VelocityMap& velocity,
                      const Renderer& renderer, const Settings& settings) {
  const auto without = [&](Disputes disputes) {
    return judgeWithout(disputes, segment, warped, velocity, renderer, settings);
  };
  Judged first = without(Disputes::kOfViewDependentItems);
  const SegmentStatistics& seen = first.judgement.statistics;
  const bool isDoubtful = seen.decision == Decision::kSplit && seen.differencePercent <= kMostPatterned;
  // What nobody can trace may not be taken out.
  if (!isDoubtful || settings.holes == Holes::kStay) return std::move(first.judgement);
  Judged again = without(Disputes::kOfAllItems);
  const double frames =
      0.01 * (again.percentTraced - first.percentTraced) * (segment.last - segment.first - 1);
  const bool isCheaper = again.judgement.statistics.decision == Decision::kAccept && frames < 1.0;
  return std::move(isCheaper ? again.judgement : first.judgement);
}

}  // namespace promenade::walkthrough
