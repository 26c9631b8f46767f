#include "tests/aqm/frame_pairs.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "ibr/flow.h"
#include "ibr/warp.h"
#include "paths/from_animation.h"
#include "src/core/resolve.h"
#include "src/render/path_renderer.h"
#include "src/walkthrough/judge.h"

namespace promenade::tests {
namespace {

double exposureFor(const Frame& frame) {
  const RadianceMap radiance = combinedRadiance(frame);
  std::vector<double> luminances;
  for (const Rgb& pixel : radiance.pixels()) luminances.push_back(luminance(pixel));
  return walkthrough::exposureOf(std::move(luminances));
}

}  // namespace

FramePair warpedPair(const Scene& scene, const paths::CameraPath& walk, int first, int last,
                     const Rendering& rendering) {
  render::PathSettings settings;
  settings.pathsPerSample = rendering.paths;
  const auto renderer = render::makePathRenderer(scene, settings);
  const auto samples = [&](int frame) {
    return walk.camera(frame, rendering.size).supersampled(rendering.supersample);
  };
  const int middle = (first + last) / 2;
  const Frame firstFrame = renderer->render(samples(first), first);
  const Frame lastFrame = renderer->render(samples(last), last);
  const auto target = [&] { return renderer->visibility(samples(middle)); };
  walkthrough::WarpedPair warped{target(), ibr::gatherWarp(firstFrame, target(), ibr::WarpSettings{}),
                                 ibr::gatherWarp(lastFrame, target(), ibr::WarpSettings{}), Mask()};
  const walkthrough::ComparedPair compared =
      walkthrough::comparedPair(warped, walkthrough::ItemSet(), Mask(warped.target.item.size()));

  const ToneMapping mapping{.curve = ToneCurve::kNeutral, .exposureEv = exposureFor(firstFrame)};
  const FrameTone tone = mapping.at(middle, rendering.display);
  const auto seen = [&](const RadianceMap& radiance) {
    return displayLuminance(encodeForDisplay(resolveRadiance(radiance, rendering.supersample), tone),
                            rendering.display);
  };
  const Visibility pixels = renderer->visibility(walk.camera(middle, rendering.size));
  const auto flowTo = [&](int frame) { return ibr::pixelFlow(pixels, walk.camera(frame, rendering.size)); };
  return {seen(compared.fromFirst), seen(compared.fromLast),
          ibr::imageVelocity(flowTo(middle - 1), flowTo(middle + 1), walk.framesPerSecond,
                             rendering.display.pixelsPerDegree())};
}

paths::CameraPath walkOf(const Scene& scene) {
  const auto moving =
      std::ranges::find_if(scene.cameras, [](const CameraAnimation& camera) { return !camera.name.empty(); });
  if (moving == scene.cameras.end()) throw std::runtime_error("the scene has no camera animation");
  return paths::pathFromAnimation(*moving, std::nullopt, "the scene's walk");
}

}  // namespace promenade::tests
