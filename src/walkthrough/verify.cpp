#include "src/walkthrough/verify.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "ibr/blend.h"
#include "ibr/source_surface.h"
#include "src/core/resolve.h"
#include "src/walkthrough/contrast_error.h"
#include "src/walkthrough/inbetween.h"
#include "src/walkthrough/moved_gloss.h"
#include "src/walkthrough/seen.h"

namespace promenade::walkthrough {
namespace {

constexpr float kLessSure = 4.0f;
constexpr float kStretched = 1.5f;
constexpr float kGrazingCosine = 0.2f;

Visibility clone(const Visibility& v) {
  return {v.camera, v.depth.clone(), v.normal.clone(), v.item.clone()};
}

Mask either(const Mask& a, const Mask& b) {
  Mask both = a.clone();
  for (std::size_t i = 0; i < both.pixels().size(); ++i) both.pixels()[i] |= b.pixels()[i];
  return both;
}

/// The middle without anything traced in it; what will be traced has the mean radiance of the rest.
struct WarpedMiddle {
  Frame frame;
  Mask traced;
};

WarpedMiddle warpedMiddle(const Middle& middle, const ItemVerdict& items, const Renderer& renderer) {
  ibr::Blended blended =
      ibr::blend(middle.warped.fromFirst, middle.warped.fromLast, clone(middle.warped.target), middle.t);
  const ItemTrust trust = trustIn(blended.frame.visibility.item, items, renderer);
  blended.holes = holesAndChangedGloss(blended, middle.warped, trust.looksTheSame);
  const Retrace retrace = selectRetrace(blended.holes, blended.frame.source, middle.warped.disputed, trust);
  return {std::move(blended.frame), either(retrace.holes, retrace.items)};
}

LuminanceMap seen(const WarpedMiddle& middle, int frameIndex, const Settings& settings) {
  RadianceMap radiance = combinedRadiance(middle.frame);
  glm::dvec3 sum(0.0);
  double count = 0.0;
  for (std::size_t i = 0; i < radiance.pixels().size(); ++i) {
    if (middle.traced.pixels()[i] != 0) continue;
    sum += glm::dvec3(radiance.pixels()[i]);
    count += 1.0;
  }
  const Rgb mean = count > 0.0 ? Rgb(sum / count) : Rgb(0.0f);
  for (std::size_t i = 0; i < radiance.pixels().size(); ++i) {
    if (middle.traced.pixels()[i] != 0) radiance.pixels()[i] = mean;
  }
  return seenOnDisplay(resolveRadiance(radiance, settings.supersample), frameIndex, settings);
}

/// What the display makes of single samples, cd/m2.
LuminanceMap luminanceAt(const Frame& frame, const std::vector<Probe>& probes, int frameIndex,
                         const Surroundings& surroundings, const Settings& settings) {
  RadianceMap radiance(static_cast<int>(probes.size()), 1);
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const auto [x, y, area] = probes[i];
    const glm::vec2 pixel = (glm::vec2(x, y) + 0.5f) / static_cast<float>(settings.supersample);
    radiance.pixels()[i] = surroundings.scaleAt(pixel) * (frame.diffuse(x, y) + frame.viewDependent(x, y));
  }
  return displayLuminance(encodePoints(radiance, settings.tone.at(frameIndex, settings.display)),
                          settings.display);
}

std::vector<ProbeError> traceProbes(Frame& warped, const std::vector<Probe>& probes, int frameIndex,
                                    const Renderer& renderer, const Settings& settings) {
  const Surroundings surroundings = surroundingsOf(warped, frameIndex, settings);
  const LuminanceMap before = luminanceAt(warped, probes, frameIndex, surroundings, settings);
  const Size size = warped.diffuse.size();
  Mask mask(size);
  for (const Probe& probe : probes) mask(probe.x, probe.y) = 1;
  Frame traced{std::move(warped.visibility), RadianceMap(size), RadianceMap(size), SourceMap(size)};
  renderer.retrace(traced, mask, SampleSource::kTraced, frameIndex);
  const LuminanceMap truth = luminanceAt(traced, probes, frameIndex, surroundings, settings);
  warped.visibility = std::move(traced.visibility);

  std::vector<ProbeError> errors;
  const auto factor = static_cast<float>(settings.supersample);
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const auto [x, y, area] = probes[i];
    errors.push_back(
        {(glm::vec2(x, y) + 0.5f) / factor, std::log(truth.pixels()[i] / before.pixels()[i]), area});
  }
  return errors;
}

/// Drops what lies on samples that are traced anyway.
std::vector<ProbeError> remaining(const std::vector<ProbeError>& errors, const std::vector<Probe>& probes,
                                  const Mask& traced) {
  std::vector<ProbeError> rest;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (traced(probes[i].x, probes[i].y) == 0) rest.push_back(errors[i]);
  }
  return rest;
}

aqm::Result compare(const LuminanceMap& warped, const ContrastErrorMap& errors, const Mask& excluded,
                    const VelocityMap& velocity, const Settings& settings) {
  LuminanceMap corrected = warped.clone();
  for (std::size_t i = 0; i < corrected.pixels().size(); ++i) {
    if (excluded.pixels()[i] == 0) corrected.pixels()[i] *= std::exp(errors.pixels()[i]);
  }
  return aqm::compare(corrected, warped, velocity, aqm::Settings{settings.display.pixelsPerDegree()});
}

ItemVerdict fail(const ItemVerdict& verdict, const ItemSet& caught) {
  const auto without = [&](std::vector<ItemId> items) {
    std::erase_if(items, [&](ItemId item) { return caught.contains(item); });
    return ItemSet(std::move(items));
  };
  // Which layer was wrong is not known.
  return {verdict.failing.with(caught), without(verdict.proven.items()), without(verdict.steady.items()),
          verdict.matt.with(caught), verdict.disputes};
}

}  // namespace

ProbeWeights probeWeights(const WarpedPair& warped, const Mask& traced) {
  const Visibility& target = warped.target;
  const ibr::RayBasis rays(target.camera);
  ProbeWeights weights(target.depth.size());
  std::size_t i = 0;
  for (int y = 0; y < weights.height(); ++y) {
    for (int x = 0; x < weights.width(); ++x, ++i) {
      if (traced(x, y) != 0) continue;
      const bool both = warped.bothFill(i);
      const bool stretched =
          std::min(warped.fromFirst.footprint(x, y), warped.fromLast.footprint(x, y)) > kStretched;
      const bool grazing =
          target.item(x, y) != kNoItem &&
          std::abs(glm::dot(target.normal(x, y), glm::normalize(rays.through(x, y)))) < kGrazingCosine;
      weights(x, y) = !both || stretched || grazing ? kLessSure : 1.0f;
    }
  }
  return weights;
}

Verification verifyMiddle(const Middle& middle, const Renderer& renderer, const Settings& settings,
                          PartSeconds& seconds) {
  Verification verification{middle.items, 0, 0.0, Decision::kAccept};
  const Size size = settings.size;
  WarpedMiddle warped;
  std::vector<Probe> probes;
  {
    const Stopwatch watch(seconds.warp);
    warped = warpedMiddle(middle, middle.items, renderer);
    // Of frames a different set each, so that no place is overlooked for good.
    const auto seed = settings.seed + static_cast<std::uint64_t>(middle.frameIndex);
    probes = chooseProbes(probeWeights(middle.warped, warped.traced), settings.probeShare, seed);
  }
  if (probes.empty()) return verification;
  verification.probes = probes.size();
  std::vector<ProbeError> errors;
  {
    const Stopwatch watch(seconds.trace);
    errors = traceProbes(warped.frame, probes, middle.frameIndex, renderer, settings);
  }
  const Stopwatch watch(seconds.metric);
  const double spacing = 1.0 / (std::sqrt(settings.probeShare) * settings.supersample);
  Mask excluded;
  const auto look = [&] {
    excluded = resolveMask(warped.traced, settings.supersample);
    return compare(seen(warped, middle.frameIndex, settings),
                   contrastErrors(size, remaining(errors, probes, warped.traced), spacing), excluded,
                   middle.velocity, settings);
  };
  aqm::Result result = look();
  const ItemBuffer item = resolveVisibility(warped.frame.visibility, settings.supersample).item;
  const ItemVerdict caught =
      judgeItems(result.probability, item, excluded, Mask(size), renderer, settings.tolerancePercent);
  if (!caught.failing.empty()) {
    verification.items = fail(middle.items, caught.failing);
    warped = warpedMiddle(middle, verification.items, renderer);
    result = look();
  }
  verification.differencePercent = aqm::percentVisible(result.probability, excluded);
  if (verification.differencePercent > settings.tolerancePercent) verification.decision = Decision::kSplit;
  return verification;
}

}  // namespace promenade::walkthrough
