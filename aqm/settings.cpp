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
  settings.viewingDistanceMetres = 1.0;
  settings.gain = 1.42;
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
  settings.masking = {Elevation::kDaly, MaskExtent::kChannel, MaskSource::kReference};
  settings.pooling = Pooling::kNone;
  settings.gain = 1.0;
  settings.signedMap = SignedMap::kYes;
  return settings;
}

}  // namespace promenade::aqm
