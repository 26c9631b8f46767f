#pragma once
// The responses of the channels to the two frames, in units of their own unmasked threshold: the cortex
// filters and the CSF, applied together.

#include <optional>
#include <vector>

#include "aqm/csf.h"
#include "aqm/filter_bank.h"
#include "aqm/fourier.h"
#include "aqm/layout.h"
#include "aqm/plane.h"
#include "aqm/spectrum.h"
#include "aqm/speed_field.h"

namespace promenade::aqm {

/// Bands 1 (finest) .. K with an orientation each, and band K+1, the baseband, with kUnoriented.
struct Channel {
  int band = 1;
  int orientation = 0;
};

/// Planes of the image's size; columns beyond its width are 0. 1 = a difference of this size is at threshold
/// if nothing masks it.
struct Responses {
  Plane<float> test;
  Plane<float> reference;
};

/// How responses get their unit.
struct ChannelModel {
  FilterBank filters;
  Csf csf = Csf::kKellyDaly;
  CsfPlacement placement = CsfPlacement::kWithinBands;
  Adaptation adaptation{};  ///< for Daly's
  double gain = 1.09;       ///< G
};

/// Kelly-Daly within the bands: Y(x) = G sum_j w_j(v(x)) S(rho_k, v(x)) / S(rho_k, u_j)
/// IFFT[ F H_kl S(rho, u_j) ](x). At band centres: G S(rho_k, v(x)) IFFT[ F H_kl ](x). A static CSF does not
/// depend on v.
class ChannelBank {
 public:
  ChannelBank(const Layout& layout, const FourierPlans& plans, const Spectrum& test,
              const Spectrum& reference, const ChannelModel& model);

  /// From now on the responses are divided by these, pixel by pixel: local contrast.
  void relateTo(Plane<float> testMeans, Plane<float> referenceMeans);

  /// `speeds` belongs to the orientation of `channel`. The result lives until the next call.
  const Responses& respond(const Channel& channel, const SpeedField& speeds);

 private:
  struct Columns {
    int begin = 0;
    int end = 0;
  };
  /// Fills passed_ and returns the columns of the spectrum that the channel passes at all.
  Columns passColumns(const Channel& channel);
  /// Whether the CSF's shape inside a band depends on the speed.
  [[nodiscard]] bool isByLevels() const;
  [[nodiscard]] double spectralSensitivity(double fx, double fy, const Channel& channel) const;
  void filterColumns(Columns columns, double decay, double lowestFrequency);
  /// Adds weights(y, to) times the filtered frames to the responses, in the rows that are `needed`.
  template <class Needed, class Weights>
  void addRows(Columns columns, const Needed& needed, const Weights& weights);
  void respondByLevels(Columns columns, const Channel& channel, const SpeedField& speeds);
  void respondAtCentre(Columns columns, const Channel& channel, const SpeedField& speeds);

  const Layout layout_;
  const FourierPlans& plans_;
  const Spectrum& testSpectrum_;
  const Spectrum& referenceSpectrum_;
  const ChannelModel model_;
  Plane<float> frequency_;  ///< cycles per degree, laid out like a Spectrum
  std::vector<Plane<float>>
      radial_;        ///< amplitudes of bands 1 .. K+1 (at index band - 1), as many columns as they pass
  Plane<float> fan_;  ///< amplitudes of orientation fanOrientation_
  std::optional<int> fanOrientation_;
  Plane<float> passed_;   ///< the channel's filter, but for the CSF's exponential
  Spectrum testColumns_;  ///< filtered, transformed along the columns
  Spectrum referenceColumns_;
  Responses responses_;
  Responses means_;  ///< of size 0 for global contrast
};

}  // namespace promenade::aqm
