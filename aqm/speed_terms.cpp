#include "aqm/speed_terms.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "aqm/csf.h"
#include "aqm/retina.h"

namespace promenade::aqm {
namespace {

/// Speeds at which the functions are compared, per octave. The coefficients are linear in between, as w_j
/// are.
constexpr int kNodes = 64;
static_assert(kSpeedSteps % kNodes == 0);
/// Samples on which the basis is chosen.
constexpr int kSamples = 96;
/// Sensitivities below this are not worth a term: a full contrast would hardly be seen.
constexpr double kIrrelevant = 2.0;

using Function = std::vector<double>;

double dot(const Function& a, const Function& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

void addTimes(Function& to, double factor, const Function& from) {
  for (std::size_t i = 0; i < to.size(); ++i) {
    to[i] += factor * from[i];
  }
}

double largest(const Function& f) {
  double result = 0.0;
  for (const double value : f) {
    result = std::max(result, std::abs(value));
  }
  return result;
}

/// g(rho; v) at `count` frequencies between the band's ends.
class BandFunctions {
 public:
  BandFunctions(const FilterBank& filters, int band, const Settings& settings, const Adaptation& adaptation,
                const SpeedLevels& levels, double lowest, double highest, int count)
      : levels_(levels),
        isAtCentre_(settings.csfPlacement == CsfPlacement::kBandCentres),
        centre_(settings.pixelsPerDegree * filters.centre(band)),
        onset_(onsetSpeed(settings.onsetHertz, centre_)) {
    for (int i = 0; i < count; ++i) {
      const double f = lowest + (highest - lowest) * i / (count - 1);
      frequencies_.push_back(f * settings.pixelsPerDegree);
      amplitudes_.push_back(settings.gain * filters.radial({f, 0.0}, band));
      if (settings.csf == Csf::kDalyMoving) {
        amplitudes_.back() *= stillFactor(isAtCentre_ ? centre_ : frequencies_.back(), adaptation);
      }
    }
  }

  /// At 2^position times the slowest speed of motion.
  [[nodiscard]] Function at(double position) const {
    const double moving = levels_.slowest * std::exp2(position);
    const double v = std::min(std::hypot(moving, onset_), levels_.speed(levels_.last));
    const double octave = onset_ > 0.0 ? std::log2(v / levels_.slowest) : position;
    Function result(frequencies_.size());
    if (isAtCentre_) {
      addTimes(result, sensitivity(centre_, v), amplitudes_);
      return result;
    }
    const int below = static_cast<int>(octave);
    const double weight = octave - below;
    addLevel(result, v, below, 1.0 - weight);
    addLevel(result, v, below + 1, weight);
    return result;
  }

 private:
  /// Adds weight S(rho_k, v) / S(rho_k, u) S(rho, u), the exponents summed first: none of the factors need
  /// fit into a number.
  void addLevel(Function& to, double v, int level, double weight) const {
    if (weight == 0.0) {
      return;
    }
    const double decay = frequencyDecay(levels_.speed(level));
    const double gain = weight * speedGain(v);
    const double common = -centre_ * (frequencyDecay(v) - decay);
    for (std::size_t i = 0; i < to.size(); ++i) {
      const double rho = frequencies_[i];
      to[i] += gain * amplitudes_[i] * rho * rho * std::exp(common - rho * decay);
    }
  }

  SpeedLevels levels_;
  bool isAtCentre_;
  double centre_;
  double onset_;
  Function frequencies_;
  Function amplitudes_;
};

}  // namespace

SpeedTerms speedTerms(const FilterBank& filters, int band, const Settings& settings,
                      const Adaptation& adaptation, const SpeedLevels& levels, int first, int last,
                      double tolerance) {
  SpeedTerms terms;
  terms.lowest = filters.lowest(band);
  terms.highest = filters.highest(band);
  const BandFunctions coarse(filters, band, settings, adaptation, levels, terms.lowest, terms.highest,
                             kSamples);
  const BandFunctions fine(filters, band, settings, adaptation, levels, terms.lowest, terms.highest,
                           kShapeSamples);

  // The functions at all speeds, each in units of what matters at its speed.
  std::vector<double> octaves;
  for (int node = first * kNodes; node <= last * kNodes; ++node) {
    octaves.push_back(static_cast<double>(node) / kNodes);
  }
  std::vector<Function> functions;
  std::vector<double> units;
  for (const double octave : octaves) {
    functions.push_back(coarse.at(octave));
    units.push_back(largest(functions.back()) + kIrrelevant * settings.gain);
  }

  // Gram-Schmidt, each time on the function that the basis so far does worst: until none is worse than
  // allowed.
  std::vector<Function> basis;
  std::vector<Function> shapes;
  std::vector<Function> rests = functions;
  std::vector<Function> coefficients;
  const auto error = [&](std::size_t i) { return largest(rests[i]) / units[i]; };
  for (;;) {
    std::size_t worst = 0;
    for (std::size_t i = 1; i < rests.size(); ++i) {
      worst = error(i) > error(worst) ? i : worst;
    }
    if (!basis.empty() && !(error(worst) > tolerance)) {
      break;
    }
    Function direction = rests[worst];
    Function shape = fine.at(octaves[worst]);
    for (std::size_t m = 0; m < basis.size(); ++m) {
      addTimes(shape, -coefficients[m][worst], shapes[m]);
    }
    const double length = std::sqrt(dot(direction, direction));
    if (!(length > 0.0)) {
      break;  // blind at every speed
    }
    for (double& value : direction) value /= length;
    for (double& value : shape) value /= length;
    Function& projections = coefficients.emplace_back();
    for (Function& rest : rests) {
      projections.push_back(dot(rest, direction));
      addTimes(rest, -projections.back(), direction);
    }
    basis.push_back(std::move(direction));
    shapes.push_back(std::move(shape));
  }

  constexpr int kStepsPerNode = kSpeedSteps / kNodes;
  for (std::size_t m = 0; m < basis.size(); ++m) {
    terms.shapes.emplace_back(shapes[m].begin(), shapes[m].end());
    std::vector<float>& table = terms.coefficients.emplace_back();
    table.resize(static_cast<std::size_t>(last * kSpeedSteps) + 1);
    for (int step = first * kSpeedSteps; step <= last * kSpeedSteps; ++step) {
      const int offset = step - first * kSpeedSteps;
      const auto node = static_cast<std::size_t>(offset / kStepsPerNode);
      const std::size_t next = std::min(node + 1, octaves.size() - 1);
      const double weight = static_cast<double>(offset % kStepsPerNode) / kStepsPerNode;
      const double value = (1.0 - weight) * coefficients[m][node] + weight * coefficients[m][next];
      table[static_cast<std::size_t>(step)] = static_cast<float>(value);
    }
  }
  return terms;
}

}  // namespace promenade::aqm
