#pragma once
// The best picture of one frame that a time budget allows: the composite progression of McNamara, Chalmers,
// Troscianko (eds.) 2000, section 4.3.2. At first everything is stochastic (path tracing); then light on matt
// surfaces is computed (a light solution, coarse to fine) and replaces what paths found of it; then what is
// still indirect is continued: finer records, and paths of reflections, until a viewer would not see more.
//
// When to go on is decided by the published heuristic (switch_over.h). What comes is taken only if it is
// nearer to the converged picture I_C than what is there. I_C is not known, but the path-traced picture P is
// unbiased, and its first and later paths, A and B, are independent of each other and of a picture S by
// computed light. So on average (S - A)(S - B) = (S - I_C)^2, whether what is wrong with S is noise or bias,
// and (S - P)^2 = (S - I_C)^2 + (P - I_C)^2. Means over the pixels, of luminance relative to S. (On the
// display such means would not be true of very noisy pictures, of which it shows the brightest dots cut off.)

#include <cstdint>
#include <memory>
#include <optional>

#include "src/walkthrough/progressive_picture.h"
#include "src/walkthrough/switch_over.h"

namespace promenade::walkthrough {

/// Thrown by the checkpoint of work that would go on for too long.
struct OutOfTime {};

/// Light that is computed level by level.
class SteppedLight {
 public:
  /// Called now and then from any thread; may throw OutOfTime.
  using Checkpoint = std::function<void()>;
  /// May so many paths be traced besides those that were announced?
  using MayTrace = std::function<bool(std::uint64_t paths)>;

  SteppedLight() = default;
  SteppedLight(const SteppedLight&) = delete;
  SteppedLight& operator=(const SteppedLight&) = delete;
  virtual ~SteppedLight() = default;

  /// At least 1 at first.
  [[nodiscard]] virtual int levelsLeft() const = 0;
  /// Prepares the next level. Returns how many paths computing it will take at least.
  virtual std::uint64_t place(const Checkpoint& checkpoint) = 0;
  /// Computes the next level, as well as the paths it may trace allow. If the checkpoint throws, what was
  /// there before stays.
  virtual void gather(const Checkpoint& checkpoint, const MayTrace& mayTrace) = 0;
  /// Shades with what is known.
  [[nodiscard]] virtual std::unique_ptr<const Renderer> renderer() const = 0;
};

/// Called once, when the light is first asked for; what it takes counts. Empty: there is none, and all is
/// stochastic.
using MakeSteppedLight = std::function<std::unique_ptr<SteppedLight>()>;

struct PreviewRule {
  double budgetSeconds = 10.0;    ///< on the clock, whose zero is the start
  double tolerancePercent = 1.0;  ///< of pixels that may be predicted to differ visibly: then it is done
  SwitchOver switchOver;
  ProgressCallback progress;  ///< seconds of the budget; may be empty, may throw Interrupted
};

enum class PreviewStage {
  kStochastic = 1,  ///< direct and indirect light by chance
  kComputed = 2,    ///< by the first level of the light solution
  kContinued = 3,   ///< by finer ones
};

struct Preview {
  Frame frame;  ///< samples of settings.frames.first
  PreviewStage stage = PreviewStage::kStochastic;
  int paths = 0;       ///< of each sample that needs any
  int levelsLeft = 0;  ///< of the light solution that the picture is made of
  /// RMS. Stage 1: about so much, as ProgressivePicture::error(). Later: hardly more than this, two standard
  /// errors above what path tracing can tell. Nothing if it is not known (a single path; light that was
  /// known).
  std::optional<double> error;
  /// Per cent of the pixels that would differ visibly between two pictures with as much noise.
  std::optional<double> predictedPercent;
  std::optional<double> switchedSeconds;  ///< on the clock, when the first level was begun
  double stochasticSeconds = 0.0;         ///< that path tracing took
  double seconds = 0.0;                   ///< on the clock, at the end
};

/// Renders `camera` (at display resolution), frame settings.frames.first, until the budget is spent or the
/// picture done. `paths` is unbiased; the light has random numbers of its own. Ends with the budget: a pass
/// or a level is begun only if it is expected to end in time, and a level is broken off. The first path of
/// every sample is traced whatever the budget.
[[nodiscard]] Preview preview(const Renderer& paths, const MakeSteppedLight& makeLight, const Camera& camera,
                              const Settings& settings, const PreviewRule& rule, const Clock& clock);

/// The same where the light is known from the beginning, of the quality of a walk: `lit` shades with it, and
/// all that is left to do are paths of reflections.
[[nodiscard]] Preview previewByKnownLight(const Renderer& lit, const Camera& camera, const Settings& settings,
                                          const PreviewRule& rule, const Clock& clock);

}  // namespace promenade::walkthrough
