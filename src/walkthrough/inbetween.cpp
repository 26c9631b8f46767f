#include "src/walkthrough/inbetween.h"

#include <algorithm>
#include <unordered_map>

#include "ibr/blend.h"

namespace promenade::walkthrough {
namespace {

std::uint64_t countSelected(const Mask& mask) {
  return static_cast<std::uint64_t>(
      std::count_if(mask.pixels().begin(), mask.pixels().end(), [](std::uint8_t v) { return v != 0; }));
}

}  // namespace

Retrace selectRetrace(const ItemBuffer& item, const Mask& holes, const SourceMap& source,
                      const ItemVerdict& verdict, const Renderer& renderer) {
  Retrace retrace{holes.clone(), Mask(item.size()), {}};
  enum class Trust { kWhole, kWhereBothAgree, kNone };
  std::unordered_map<ItemId, Trust> trusted;
  const auto items = item.pixels();
  const auto sources = source.pixels();
  const auto hole = retrace.holes.pixels();
  const auto selected = retrace.items.pixels();
  for (std::size_t i = 0; i < items.size(); ++i) {
    const ItemId id = items[i];
    if (id == kNoItem) continue;
    const auto [entry, isNew] = trusted.try_emplace(id);
    if (isNew) {
      entry->second = !renderer.traits(id).viewDependent ? Trust::kWhole
                      : verdict.proven.contains(id)      ? Trust::kWhereBothAgree
                                                         : Trust::kNone;
    }
    const bool isTraced = entry->second == Trust::kNone ||
                          (entry->second == Trust::kWhereBothAgree && sources[i] != SampleSource::kBlended);
    if (isTraced && hole[i] == 0) selected[i] = 1;
  }
  std::vector<ItemId> list;
  for (const auto& [id, trust] : trusted) {
    if (trust == Trust::kNone) list.push_back(id);
  }
  retrace.traced = ItemSet(std::move(list));
  return retrace;
}

Inbetween synthesise(WarpedPair&& warped, double t, int frameIndex, const ItemVerdict& verdict,
                     const Renderer& renderer, PartSeconds& seconds) {
  ibr::Blended blended;
  Retrace retrace;
  {
    const Stopwatch watch(seconds.warp);
    blended = ibr::blend(warped.fromFirst, warped.fromLast, std::move(warped.target), t);
    retrace =
        selectRetrace(blended.frame.visibility.item, blended.holes, blended.frame.source, verdict, renderer);
  }
  {
    const Stopwatch watch(seconds.trace);
    renderer.retrace(blended.frame, retrace.holes, SampleSource::kTracedHole, frameIndex);
    renderer.retrace(blended.frame, retrace.items, SampleSource::kTracedItem, frameIndex);
  }
  Inbetween inbetween{std::move(blended.frame), {}};
  FrameStatistics& statistics = inbetween.statistics;
  statistics.index = frameIndex;
  statistics.kind = FrameKind::kInbetween;
  statistics.samples = inbetween.frame.diffuse.size().area();
  statistics.holes = countSelected(retrace.holes);
  statistics.itemSamples = countSelected(retrace.items);
  statistics.samplesTraced = statistics.holes + statistics.itemSamples;
  statistics.warped = statistics.samples - statistics.samplesTraced;
  statistics.itemsTraced = retrace.traced.items();
  return inbetween;
}

}  // namespace promenade::walkthrough
