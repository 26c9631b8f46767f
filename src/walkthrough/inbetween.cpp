#include "src/walkthrough/inbetween.h"

#include <algorithm>

#include "ibr/blend.h"
#include "src/walkthrough/moved_gloss.h"
#include "src/walkthrough/retrace_items.h"
#include "src/walkthrough/selected.h"

namespace promenade::walkthrough {
namespace {

/// 78 degrees. What another inbetween traced is often one sample wide, beside an edge. A keyframe has the
/// neighbours, and there are two of them.
constexpr double kGrazingOfShared = 0.2;

/// `target` becomes part of the result.
ibr::Blended blendInTheOrderOfTime(const WarpedPair& keyframes, const std::vector<const Inbetween*>& others,
                                   Visibility&& target, const Segment& segment, int frameIndex,
                                   const Mask& shared, const ibr::WarpSettings& settings) {
  std::vector<ibr::BlendSource> ordered{{&keyframes.fromFirst, double(segment.first)},
                                        {&keyframes.fromLast, double(segment.last)}};
  std::vector<ibr::SampleGather> gathers;
  gathers.reserve(others.size());
  ibr::WarpSettings ofShared = settings;
  ofShared.grazingCosine = kGrazingOfShared;
  for (const Inbetween* other : others) {
    gathers.emplace_back(other->frame, target, shared, ofShared);
    ordered.push_back({&gathers.back(), double(other->statistics.index)});
  }
  std::sort(ordered.begin(), ordered.end(),
            [](const ibr::BlendSource& a, const ibr::BlendSource& b) { return a.time < b.time; });
  return ibr::blend(ordered, std::move(target), double(frameIndex));
}

/// Samples that no keyframe fills, but another inbetween did.
std::uint64_t countReused(const WarpedPair& keyframes, const Mask& holes) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < holes.pixels().size(); ++i) {
    if (!keyframes.firstFills(i) && !keyframes.lastFills(i) && holes.pixels()[i] == 0) ++count;
  }
  return count;
}

/// Traced samples of items that are not traced as a whole.
std::uint64_t countDisputed(const Mask& disputed, const RetracedItems& items, const ItemSet& whole) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < disputed.pixels().size(); ++i) {
    if (disputed.pixels()[i] == 0 || items.traced.pixels()[i] == 0) continue;
    if (!whole.contains(items.frame.visibility.item.pixels()[i])) ++count;
  }
  return count;
}

}  // namespace

Retrace selectRetrace(const Mask& holes, const SourceMap& source, const Mask& disputed,
                      const ItemTrust& trust) {
  Retrace retrace{holes.clone(), Mask(holes.size())};
  for (std::size_t i = 0; i < holes.pixels().size(); ++i) {
    const bool isContradicted = disputed.pixels()[i] != 0 && trust.disputesCount.pixels()[i] != 0;
    const bool isUnproven =
        trust.looksTheSame.pixels()[i] == 0 && source.pixels()[i] != SampleSource::kBlended;
    const bool isTraced = trust.untrusted.pixels()[i] != 0 || isContradicted || isUnproven;
    if (isTraced && holes.pixels()[i] == 0) retrace.items.pixels()[i] = 1;
  }
  return retrace;
}

Inbetween synthesise(InbetweenSources&& sources, const Segment& segment, int frameIndex,
                     const ItemVerdict& verdict, const Renderer& renderer, const Settings& settings,
                     PartSeconds& seconds) {
  ibr::Blended blended;
  Retrace retrace;
  Mask disputed;
  ItemTrust trust;
  std::uint64_t reused = 0;
  {
    const Stopwatch watch(seconds.warp);
    InbetweenSources used = std::move(sources);  // given back before anything is traced
    trust = trustIn(used.keyframes.target.item, verdict, renderer);
    blended = blendInTheOrderOfTime(used.keyframes, used.others, std::move(used.keyframes.target), segment,
                                    frameIndex, trust.looksTheSame, settings.warp);
    blended.holes = holesAndChangedGloss(blended, used.keyframes, trust.looksTheSame);
    disputed = std::move(used.keyframes.disputed);
    retrace = selectRetrace(blended.holes, blended.frame.source, disputed, trust);
    reused = countReused(used.keyframes, blended.holes);
  }
  RetracedItems items;
  {
    const Stopwatch watch(seconds.trace);
    renderer.retrace(blended.frame, retrace.holes, SampleSource::kTracedHole, frameIndex);
    items = retraceItems(std::move(blended.frame), retrace.items, verdict.matt, settings.supersample,
                         frameIndex, renderer);
  }
  const std::uint64_t disputedTraced = countDisputed(disputed, items, trust.tracedWhole);
  Inbetween inbetween{std::move(items.frame), {}};
  FrameStatistics& statistics = inbetween.statistics;
  statistics.index = frameIndex;
  statistics.kind = FrameKind::kInbetween;
  statistics.samples = inbetween.frame.diffuse.size().area();
  statistics.holes = countSelected(retrace.holes);
  statistics.itemSamples = countSelected(items.traced);
  statistics.disputed = disputedTraced;
  statistics.layered = countSelected(retrace.items) - statistics.itemSamples;
  const auto from = inbetween.frame.source.pixels();
  const auto samplesFrom = [&](SampleSource source) {
    return static_cast<std::uint64_t>(std::count(from.begin(), from.end(), source));
  };
  statistics.unknown = samplesFrom(SampleSource::kUnknown);
  statistics.samplesTraced = samplesFrom(SampleSource::kTracedHole) + statistics.itemSamples;
  if (samplesFrom(SampleSource::kTraced) == statistics.samples) {  // the renderer had to make a whole frame
    statistics.kind = FrameKind::kKeyframe;
    statistics.samplesTraced = statistics.samples;
  }
  statistics.warped = statistics.samples - statistics.samplesTraced - statistics.unknown;
  statistics.reused = reused;
  statistics.itemsTraced = trust.tracedWhole.items();
  return inbetween;
}

}  // namespace promenade::walkthrough
