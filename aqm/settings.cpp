#include "aqm/settings.h"

namespace promenade::aqm {

Settings aqm(double pixelsPerDegree) {
  Settings settings;
  settings.pixelsPerDegree = pixelsPerDegree;
  return settings;
}

Settings revisedAqm(double pixelsPerDegree) {
  Settings settings = aqm(pixelsPerDegree);
  settings.csf = Csf::kDalyMoving;
  settings.onsetHertz = 0.9;
  settings.viewingDistanceMetres = 1.0;
  settings.gain = 1.15;
  settings.masking.strength = 1.24;
  return settings;
}

Settings aqm2000(double pixelsPerDegree) {
  Settings settings = aqm(pixelsPerDegree);
  settings.decomposition = Decomposition::kCortexAmplitude;
  settings.csfPlacement = CsfPlacement::kBandCentres;
  settings.pooling = Pooling::kNone;
  settings.gain = 1.0;
  return settings;
}

Settings vdp(double pixelsPerDegree, double viewingDistanceMetres) {
  Settings settings = aqm(pixelsPerDegree);
  settings.decomposition = Decomposition::kCortexAmplitude;
  settings.csf = Csf::kDaly;
  settings.viewingDistanceMetres = viewingDistanceMetres;
  settings.masking = {Elevation::kDaly, MaskExtent::kChannel, MaskSource::kMutual};
  settings.pooling = Pooling::kNone;
  settings.gain = 1.0;
  settings.signedMap = SignedMap::kYes;
  return settings;
}

}  // namespace promenade::aqm
