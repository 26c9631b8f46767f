#include "src/walkthrough/view.h"

#include "ibr/flow.h"
#include "ibr/subpixel_offsets.h"

namespace promenade::walkthrough {

Camera displayCamera(const paths::CameraPath& path, const Settings& settings, int frame) {
  return path.camera(frame, settings.size);
}

Camera sampleCamera(const paths::CameraPath& path, const Settings& settings, int frame) {
  const Camera samples = displayCamera(path, settings, frame).supersampled(settings.supersample);
  if (!settings.antialiasing) return samples;
  return samples.withSubpixelOffset(ibr::subpixelOffset(frame, settings.antialiasing->frames()));
}

PixelFlow flowTo(const paths::CameraPath& path, const Settings& settings, const Visibility& pixels, int to) {
  if (to < 0 || to >= path.frameCount()) return {};
  // What moves is the scene, not the place of the samples.
  const Camera other = displayCamera(path, settings, to);
  return ibr::pixelFlow(pixels, other.withSubpixelOffset(pixels.camera.subpixelOffset()));
}

VelocityMap velocityOf(const paths::CameraPath& path, const Settings& settings, const Visibility& pixels,
                       int frame) {
  return ibr::imageVelocity(flowTo(path, settings, pixels, frame - 1),
                            flowTo(path, settings, pixels, frame + 1), path.framesPerSecond,
                            settings.display.pixelsPerDegree());
}

}  // namespace promenade::walkthrough
