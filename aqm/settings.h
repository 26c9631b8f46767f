#pragma once
// One pipeline, many metrics: every choice that the published metrics make differently is a setting here, and
// each published metric is a set of choices. docs/method.md says what each of them is and where it comes
// from.

namespace promenade::aqm {

/// What a contrast is relative to.
enum class ContrastKind {
  kGlobal,  ///< the mean of both frames
  kLocal    ///< the frame's own baseband at the pixel (Daly 1993; Peli 1990)
};

/// How an image is split into bands and orientations.
enum class Decomposition {
  kCortexEnergy,     ///< cortex transform whose squared filters sum to 1
  kCortexAmplitude,  ///< Daly 1993: filters sum to 1, the baseband is a Gaussian
  kLaplacianPyramid  ///< Burt, Adelson 1983: differences of low-passed images, times fans of orientation
};

/// Whose contrast sensitivity function.
enum class Csf {
  kKellyDaly,      ///< Kelly 1979 with Daly's constants (1998): knows of motion
  kDalyMoving,     ///< kDaly's at rest, without its oblique effect, changed by motion as kKellyDaly changes
  kDaly,           ///< Daly 1993: light adaptation, image area, viewing distance, oblique effect
  kMannosSakrison  ///< Mannos, Sakrison 1974, scaled to a peak of 250
};

enum class CsfPlacement {
  kWithinBands,  ///< shapes the spectrum inside each band; for a static CSF the same as filtering before
  kBandCentres   ///< scales each band by its value at the centre frequency
};

/// What the eye does while the image moves.
enum class Eye {
  kTracking,   ///< follows at min(0.82 v + 0.15, 80) degrees per second, drifts at 0.15 (Daly 1998)
  kFixating,   ///< untracked: stares at one point and drifts at 0.15
  kStabilised  ///< as in Kelly's experiments: not even drift; what rests on the retina fades
};

/// The elevation of a channel's threshold by its response m, in units of that threshold.
enum class Elevation {
  kNone,      ///< 1
  kUnitKnee,  ///< (1 + m^4)^(1/4)
  kDaly       ///< Daly 1993: (1 + (k1 (k2 m)^s)^4)^(1/4), s = 0.7 baseband, 0.8 lowest band, 1 elsewhere
};

/// Over what an elevation extends.
enum class MaskExtent {
  kChannel,  ///< a Gaussian as wide as the channel's filter
  kPoint     ///< the pixel
};

/// Which frame masks the difference.
enum class MaskSource {
  kMutual,  ///< the one that masks less
  kTest,
  kReference
};

struct Masking {
  Elevation elevation = Elevation::kUnitKnee;
  MaskExtent extent = MaskExtent::kChannel;
  MaskSource source = MaskSource::kMutual;
  double strength = 1.0;  ///< responses are multiplied by this before they elevate a threshold; > 0
  friend bool operator==(const Masking&, const Masking&) = default;
};

enum class Pooling {
  kHalfDegree,  ///< summed under a Gaussian window of standard deviation half a degree
  kNone         ///< each pixel by itself
};

enum class SignedMap { kNo, kYes };

/// How, not what: both give the same maps within the bounds that docs/method.md states.
enum class Execution {
  kFast,  ///< transforms of reduced size, few of them; settings that it does not cover are executed plainly
  kPlain  ///< the formulas one by one, at full size: the yardstick of the other
};

/// Far finer than the eye resolves (60 cycles per degree); finer still would only cost memory.
inline constexpr double kMostPixelsPerDegree = 2000.0;
inline constexpr double kMostOnsetHertz = 60.0;
inline constexpr int kFewestRadialBands = 2;
inline constexpr int kMostRadialBands = 12;
inline constexpr int kMostOrientations = 24;

/// The defaults are those of aqm().
struct Settings {
  double pixelsPerDegree = 40.0;  ///< of the display, > 0, <= kMostPixelsPerDegree
  ContrastKind contrast = ContrastKind::kGlobal;
  Decomposition decomposition = Decomposition::kCortexEnergy;
  int radialBands = 0;   ///< besides the baseband, 2 .. 12; 0: as many as make the baseband end at 1 cycle
                         ///< per degree
  int orientations = 6;  ///< 1 .. 24
  Csf csf = Csf::kKellyDaly;
  CsfPlacement csfPlacement = CsfPlacement::kWithinBands;
  double viewingDistanceMetres = 0.5;  ///< > 0; only Daly's static CSF asks for it (accommodation)
  Eye eye = Eye::kTracking;
  /// Temporal frequency of the coming and going of the whole picture on the retina, 0 .. 60 Hz, in quadrature
  /// with that of its motion; 0: it stands there for long. Only a CSF that knows of motion asks for it.
  double onsetHertz = 0.0;
  Masking masking{};
  Pooling pooling = Pooling::kHalfDegree;
  /// What responses are multiplied by. 1.09 fits thresholds of Gabor patches (ModelFest) after pooling;
  /// without pooling 1 puts a grating of contrast 1 / S at a band's centre frequency at threshold.
  double gain = 1.09;
  SignedMap signedMap = SignedMap::kNo;
  Execution execution = Execution::kFast;
};

/// The animation quality metric of this project.
[[nodiscard]] Settings aqm(double pixelsPerDegree);

/// aqm() with Daly's CSF at rest, moved as Kelly's (Csf::kDalyMoving), for an eye that looks here and there,
/// and the gain that fits Gabor patches then; adapts to the frames' luminance. A glance of a third of a
/// second has about the spectrum of a Gaussian window of standard deviation 0.125 s (in which ModelFest's
/// patterns were shown): the root mean square of its temporal frequencies is 1 / (2 pi sqrt(2) 0.125 s) = 0.9
/// Hz. Large patterns are then better seen than if they stood still. Masks count by a quarter more, which
/// fits edges in noise. Fits thresholds of still patterns, edges in noise and slow flicker better than aqm(),
/// flicker above 16 Hz worse (docs/validation.md). Not the default: the project's other numbers are aqm()'s.
[[nodiscard]] Settings revisedAqm(double pixelsPerDegree);

/// The animation quality metric as published (Myszkowski, Rokita, Tawara 2000): Daly's filters, the CSF taken
/// at their centre frequencies, no spatial pooling.
[[nodiscard]] Settings aqm2000(double pixelsPerDegree);

/// Daly's visible differences predictor (1993) for still images, with its signed map. The elevation extends
/// over a channel's filter (his phase uncertainty): at the pixel alone, thresholds would be those of the
/// mask's zeros. Masking is mutual, his choice where either frame may hold the artefact: an error in the test
/// frame must not hide itself, and swapping the frames changes nothing but the signs.
[[nodiscard]] Settings vdp(double pixelsPerDegree, double viewingDistanceMetres);

}  // namespace promenade::aqm
