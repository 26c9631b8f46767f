#include "src/walkthrough/preview.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "src/core/display.h"

namespace promenade::walkthrough {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
/// Work is expected to take so many times as long as it did before.
constexpr double kMargin = 1.1;
constexpr int kMostPaths = 1 << 20;
/// Errors of what is darker than this share of the mean are measured against it instead.
constexpr double kDarkness = 0.1;
/// Of the time that is left, what a further level of the light may take while the picture has noise of its
/// own. What the other half can do about that is at most a factor of two in time from the best.
constexpr double kShareOfLight = 0.5;

/// A picture by computed light, with the renderer that makes it.
struct LitPicture {
  LitPicture(std::unique_ptr<const Renderer> lit, const Camera& camera, const Settings& settings,
             const Clock& clock)
      : renderer(std::move(lit)), picture(*renderer, camera, settings, clock) {}

  std::unique_ptr<const Renderer> renderer;
  ProgressivePicture picture;
};

/// Mean squares of relative errors of luminance.
struct SquaredErrors {
  double computed = 0.0;   ///< of S, unbiased: it may be below 0
  double deviation = 0.0;  ///< its standard error
  double traced = 0.0;     ///< of P

  [[nodiscard]] bool computedIsLess() const { return computed < traced; }
  [[nodiscard]] double mostOfComputed() const { return std::sqrt(std::max(0.0, computed) + 2.0 * deviation); }
};

/// preview.h; P has two paths at least.
SquaredErrors errorsBeside(const ProgressivePicture& traced, const RadianceMap& computed) {
  const RadianceMap whole = traced.picture();
  const ProgressivePicture::Parts parts = traced.parts();
  const auto pixels = computed.pixels();
  double mean = 0.0;
  for (const Rgb& pixel : pixels) mean += luminance(pixel);
  const auto count = static_cast<double>(pixels.size());
  const double darkness = std::max(kDarkness * mean / count, 1e-30);
  double products = 0.0;
  double squaredProducts = 0.0;
  double distances = 0.0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const double s = luminance(pixels[i]);
    const double unit = std::max(s, darkness);
    const double product =
        (s - luminance(parts.earlier.pixels()[i])) * (s - luminance(parts.later.pixels()[i])) / (unit * unit);
    const double distance = (s - luminance(whole.pixels()[i])) / unit;
    products += product;
    squaredProducts += product * product;
    distances += distance * distance;
  }
  SquaredErrors errors;
  errors.computed = products / count;
  errors.deviation = std::sqrt(squaredProducts) / count;
  errors.traced = distances / count - errors.computed;
  return errors;
}

class Progression {
 public:
  Progression(const Renderer& paths, const MakeSteppedLight& makeLight, const Camera& camera,
              const Settings& settings, const PreviewRule& rule, const Clock& clock)
      : makeLight_(makeLight),
        camera_(camera),
        settings_(settings),
        rule_(rule),
        clock_(clock),
        traced_(paths, camera, settings, clock) {}

  Preview run() {
    trace(traced_, 1);
    traceFor(rule_.switchOver.leastSamplingSeconds);
    if (makeLight_ && left() > 0.0) switchOver();
    while (goOn()) {
    }
    return result();
  }

 private:
  [[nodiscard]] double left() const { return (rule_.budgetSeconds - clock_()) / kMargin; }
  [[nodiscard]] const ProgressivePicture& best() const { return lit_ ? lit_->picture : traced_; }
  [[nodiscard]] ProgressivePicture& best() { return lit_ ? lit_->picture : traced_; }

  /// A viewer would not see the noise; asked at every doubling once it can be so.
  [[nodiscard]] bool isDone(const ProgressivePicture& picture) const {
    const int paths = picture.paths();
    if (picture.isClean() || paths >= kMostPaths) return true;
    if (paths < StoppingRule{}.firstPaths || !std::has_single_bit(static_cast<unsigned>(paths))) return false;
    return picture.predictedPercent().value_or(100.0) <= rule_.tolerancePercent;
  }

  /// Until path tracing has had so many seconds, is done, or no pass fits.
  void traceFor(double seconds) {
    while (!isDone(traced_)) {
      const int count = traced_.affordable(std::min(seconds - traced_.seconds(), left()), kMostPaths);
      if (count == 0) return;
      trace(traced_, count);
    }
  }

  void trace(ProgressivePicture& picture, int count) const {
    picture.trace(count);
    if (!rule_.progress) return;
    const auto whole = [](double seconds) {
      return static_cast<std::uint64_t>(std::lround(std::max(0.0, seconds)));
    };
    const std::uint64_t total = whole(rule_.budgetSeconds);
    rule_.progress({"seconds of the preview", std::min(whole(clock_()), total), total});
  }

  // Stage 1 to its end, and the first level if it can be there in time.
  void switchOver() {
    light_ = makeLight_();
    const std::optional<std::uint64_t> paths = placed();
    if (!paths) return;
    // The paths that were traced are the pilots.
    const int samples = settings_.supersample * settings_.supersample;
    secondsOfPath_ = traced_.secondsFor(1) / (static_cast<double>(settings_.size.area()) * samples);
    const double firstPicture = secondsOfPath_ * static_cast<double>(*paths) + traced_.secondsFor(1);
    const double sampling = rule_.switchOver.samplingSeconds(firstPicture);
    traceFor(sampling);
    if (traced_.paths() < 2 && traced_.affordable(left(), 1) == 1) trace(traced_, 1);
    const std::optional<double> error = traced_.error();
    if (!error || isDone(traced_)) return;
    // Not so late that nothing comes of it.
    traceFor(std::min(rule_.switchOver.seconds(sampling, *error, firstPicture),
                      traced_.seconds() + left() - firstPicture));
    if (firstPicture > left()) return;
    switchedSeconds_ = clock_();
    computeLevel();
  }

  /// One more thing for the picture; false: there is nothing that fits.
  [[nodiscard]] bool goOn() {
    const bool done = isDone(best());
    // The picture is made anew by the new light.
    const double most = done ? left() - kMargin * best().seconds() : kShareOfLight * left();
    if (switchedSeconds_ && secondsOfLevel() <= most) {
      computeLevel();
      return true;
    }
    const int count = done ? 0 : best().affordable(left(), kMostPaths);
    if (count > 0) trace(best(), count);
    return count > 0;
  }

  /// Paths of the next level; nothing if there is none, or none in time.
  [[nodiscard]] std::optional<std::uint64_t> placed() {
    if (!placed_ && !isLightOver_) {
      inTime([&](const SteppedLight::Checkpoint& checkpoint) { placed_ = light_->place(checkpoint); });
    }
    return placed_;
  }

  [[nodiscard]] double secondsOfLevel() {
    if (light_->levelsLeft() == 0) return kForever;
    const std::optional<std::uint64_t> paths = placed();
    return paths ? secondsOfGatheredPath_ * static_cast<double>(*paths) : kForever;
  }

  // The next level, if it ends in time, and a picture by it.
  void computeLevel() {
    const double start = clock_();
    std::uint64_t paths = placed_.value_or(0);
    const auto mayTrace = [&](std::uint64_t more) {
      if (secondsOfPath_ * static_cast<double>(more) > kShareOfLight * left()) return false;
      paths += more;
      return true;
    };
    inTime([&](const SteppedLight::Checkpoint& checkpoint) { light_->gather(checkpoint, mayTrace); });
    if (isLightOver_) return;
    ++levels_;
    secondsOfGatheredPath_ = (clock_() - start) / static_cast<double>(std::max<std::uint64_t>(paths, 1));
    placed_.reset();
    renew();
  }

  /// Light that is late is given up.
  template <class Work>
  void inTime(const Work& work) {
    // Leaves time for a picture.
    const double end =
        rule_.budgetSeconds - kMargin * (lit_ ? lit_->picture.seconds() : traced_.secondsFor(1));
    try {
      work([this, end] {
        if (clock_() > end) throw OutOfTime();
      });
    } catch (const OutOfTime&) {
      isLightOver_ = true;
      placed_.reset();
    }
  }

  // A picture by the light that is known now, with as many paths as the one before, if it is better.
  void renew() {
    auto next = std::make_unique<LitPicture>(light_->renderer(), camera_, settings_, clock_);
    ProgressivePicture& picture = next->picture;
    trace(picture, 1);
    const int wanted = lit_ ? lit_->picture.paths() : 1;
    while (picture.paths() < wanted && !picture.isClean()) {
      const int count = picture.affordable(left(), wanted - picture.paths());
      if (count == 0) break;
      trace(picture, count);
    }
    // A finer level is better by as many paths; the first has to be better than paths alone.
    const bool isBetter = lit_ ? picture.paths() >= wanted || picture.isClean()
                               : errorsBeside(traced_, picture.picture()).computedIsLess();
    if (!isBetter) return;
    lit_ = std::move(next);
    litStage_ = levels_ == 1 ? PreviewStage::kComputed : PreviewStage::kContinued;
    levelsLeft_ = light_->levelsLeft();
  }

  [[nodiscard]] std::optional<double> errorOfBest() const {
    const std::optional<double> noise = best().error();
    if (!lit_) return noise;
    return std::max(noise.value_or(0.0), errorsBeside(traced_, lit_->picture.picture()).mostOfComputed());
  }

  [[nodiscard]] Preview result() {
    Preview made;
    made.stage = lit_ ? litStage_ : PreviewStage::kStochastic;
    made.paths = best().paths();
    made.levelsLeft = levelsLeft_;
    made.error = errorOfBest();
    made.predictedPercent = best().isClean() ? 0.0 : best().predictedPercent();
    made.switchedSeconds = switchedSeconds_;
    made.stochasticSeconds = traced_.seconds();
    made.seconds = clock_();
    made.frame = best().take();
    return made;
  }

  const MakeSteppedLight& makeLight_;
  std::unique_ptr<SteppedLight> light_;  ///< null: it was not asked for yet
  const Camera& camera_;
  const Settings& settings_;
  const PreviewRule& rule_;
  const Clock& clock_;
  ProgressivePicture traced_;
  std::unique_ptr<LitPicture> lit_;  ///< null: the traced one is the best
  PreviewStage litStage_ = PreviewStage::kComputed;
  int levels_ = 0;      ///< that were computed
  int levelsLeft_ = 0;  ///< when the best picture was begun
  bool isLightOver_ = false;
  std::optional<std::uint64_t> placed_;  ///< paths of the next level
  double secondsOfPath_ = 0.0;           ///< that was traced
  double secondsOfGatheredPath_ = 0.0;   ///< of the last level
  std::optional<double> switchedSeconds_;
};

}  // namespace

Preview preview(const Renderer& paths, const MakeSteppedLight& makeLight, const Camera& camera,
                const Settings& settings, const PreviewRule& rule, const Clock& clock) {
  return Progression(paths, makeLight, camera, settings, rule, clock).run();
}

Preview previewByKnownLight(const Renderer& lit, const Camera& camera, const Settings& settings,
                            const PreviewRule& rule, const Clock& clock) {
  Preview made = preview(lit, {}, camera, settings, rule, clock);
  made.stage = PreviewStage::kContinued;
  made.stochasticSeconds = 0.0;
  made.error.reset();  // its noise can be told, its light's cannot
  return made;
}

}  // namespace promenade::walkthrough
