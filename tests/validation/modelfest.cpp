// ModelFest: thresholds of 43 small patterns, mean of 16 observers (Carney et al. 1999, 2000; Watson, Ahumada
// 2005).

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "tests/validation/chapters.h"
#include "tests/validation/stimuli.h"
#include "tests/validation/tables.h"
#include "tests/validation/threshold.h"

namespace promenade::validation {
namespace {

constexpr double kModelfestLuminance = 30.0;
/// Where the spatiovelocity CSF itself is known to be wrong: 22.6 and 30 cycles per degree, blobs of 0.5 and
/// 0.14 degrees.
const std::set<int> kKnownWrong{9, 10, 26, 27};

struct Fit {
  double bias = 0.0;    ///< mean of 20 log10(predicted / measured)
  double raw = 0.0;     ///< rms of it
  double fitted = 0.0;  ///< rms around the mean: with the best gain
};

Fit fitOf(const std::vector<double>& errors) {
  return {mean(errors), rms(errors), deviation(errors)};
}

}  // namespace

void reportModelfest(Report& report, const std::filesystem::path& data) {
  report.heading("ModelFest: thresholds of small patterns");
  report.text(
      "256 x 256 pixels at 120 pixels per degree, 30 cd/m2, still. Predicted threshold: the contrast at "
      "which the largest "
      "Jp is 1. Errors are 20 log10(predicted / measured), decibels: positive where observers see more than "
      "the metric. "
      "The standard deviation between observers is 2 to 5 dB.");
  std::vector<Named> settings = metrics(kModelfestPpd);
  aqm::Settings steady = aqm::revisedAqm(kModelfestPpd);
  steady.onsetHertz = 0.0;
  settings.push_back({"revised without onset", steady});
  const std::vector<Row> rows = readTable(data / "modelfest_thresholds.csv");
  std::vector<std::vector<double>> errors(settings.size());
  std::vector<int> stimuli;
  const LuminanceMap flat(kModelfestSize, static_cast<float>(kModelfestLuminance));
  for (const Row& row : rows) {
    const int stimulus = static_cast<int>(numberIn(row, "stim"));
    const double measured = std::pow(10.0, -numberIn(row, "mean_neglog10_thr"));
    const Raster pattern = modelfest(stimulus, data);
    const auto frame = [&](double contrast) {
      Raster scaled = pattern;
      for (double& value : scaled) value *= contrast;
      return frameOf(kModelfestSize, kModelfestLuminance, scaled);
    };
    stimuli.push_back(stimulus);
    for (std::size_t i = 0; i < settings.size(); ++i) {
      const double predicted = threshold(frame, flat, {}, settings[i].settings);
      errors[i].push_back(decibels(predicted / measured));
    }
  }
  std::vector<std::vector<std::string>> table{{"set"}};
  for (const Named& one : settings) {
    table[0].push_back(one.name + " bias");
    table[0].push_back("rms");
    table[0].push_back("rms, best gain");
  }
  const auto addRow = [&](const std::string& name, const auto& isIn) {
    table.push_back({name});
    for (const std::vector<double>& all : errors) {
      std::vector<double> chosen;
      for (std::size_t k = 0; k < stimuli.size(); ++k) {
        if (isIn(stimuli[k])) chosen.push_back(all[k]);
      }
      const Fit fit = fitOf(chosen);
      for (const double value : {fit.bias, fit.raw, fit.fitted}) table.back().push_back(fixed(value, 1));
    }
  };
  std::string found;
  for (std::size_t i = 0; i < 2; ++i) {
    found += settings[i].name + " " + fixed(deviation(errors[i]), 1) + " dB rms with its best gain, bias " +
             fixed(mean(errors[i]), 1) + (i == 0 ? "; " : "");
  }
  report.verdict("ModelFest, " + std::to_string(stimuli.size()) + " thresholds", found,
                 "observers differ by 2 to 5 dB: revised fits; aqm misses fine gratings and large blobs");
  addRow("all " + std::to_string(stimuli.size()), [](int) { return true; });
  addRow("without 9, 10, 26, 27", [](int s) { return !kKnownWrong.contains(s); });
  addRow("Gabors 1 to 14", [](int s) { return s <= 14; });
  addRow("Gabors 1 to 14 without 9, 10", [](int s) { return s <= 14 && !kKnownWrong.contains(s); });
  report.table(table);

  std::vector<std::vector<std::string>> single{{"stimulus"}};
  std::vector<Series> series;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    single[0].push_back(settings[i].name);
    Series one{settings[i].name, {}, errors[i], Mark::kPoints};
    for (const int stimulus : stimuli) one.x.push_back(stimulus);
    series.push_back(one);
  }
  for (std::size_t k = 0; k < stimuli.size(); ++k) {
    single.push_back({std::to_string(stimuli[k])});
    for (const std::vector<double>& all : errors) single.back().push_back(fixed(all[k], 1));
  }
  report.plot("modelfest", "ModelFest: predicted over measured threshold", {"stimulus"}, {"dB"}, series);
  report.table(single);
  report.text(
      "Why aqm misses 9, 10 (22.6 and 30 cycles per degree) and 26, 27 (blobs): Kelly's formula falls as "
      "exp(-0.41 "
      "rho) where the eye falls as exp(-0.14 rho) or so, which is 12 dB at 22.6 and 23 dB at 30 cycles per "
      "degree, and "
      "as rho^2 below 1 cycle per degree. Neither filters nor pooling are at fault. With Daly's static CSF "
      "in the same "
      "pipeline (revised without onset) the fine Gabors fall into line without any parameter of their own; "
      "the blob (27, "
      "standard deviation 0.14 degrees) and the coarse Gabor (1) do not, because Daly's CSF, too, is that of "
      "a pattern "
      "that stands there. But these patterns came and went, in a Gaussian window of standard deviation 0.125 "
      "s: the root "
      "mean square of its temporal frequencies is 0.9 Hz, and to Kelly's formula a grating that flickers at "
      "w Hz is one that "
      "moves at w / rho degrees per second, several times the eye's drift below 2 cycles per degree. With "
      "this onset, "
      "which is the stimulus' own and not fitted, revised misses neither. What is left are the line and the "
      "smallest spot "
      "(29, 31; seen better than predicted) and the noise (35; less well).");
}

}  // namespace promenade::validation
