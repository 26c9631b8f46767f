// Blur of an edge, and a step in a line.

#include <algorithm>
#include <cmath>

#include "tests/validation/chapters.h"
#include "tests/validation/stimuli.h"
#include "tests/validation/threshold.h"

namespace promenade::validation {
namespace {

constexpr double kEdgePpd = 120.0;
constexpr Size kEdgeSize{192, 192};
constexpr double kEdgeLuminance = 50.0;

/// The size at which Jp reaches 1; `frame`(size) grows less like `frame`(0) with it.
double sizeAtThreshold(const std::function<LuminanceMap(double)>& frame, double least, double most,
                       const aqm::Settings& settings) {
  const LuminanceMap reference = frame(0.0);
  for (int i = 0; i < 12; ++i) {
    const double middle = std::sqrt(least * most);
    const aqm::Result result = aqm::compare(frame(middle), reference, {}, settings);
    (*std::ranges::max_element(result.pooledJnd.pixels()) > 1.0f ? most : least) = middle;
  }
  return std::sqrt(least * most);
}

}  // namespace

void reportBlur(Report& report) {
  report.heading("Blur detection against contrast");
  report.text(
      "A vertical edge of Michelson contrast c, blurred by a Gaussian, against a sharp one; 120 pixels per "
      "degree, 50 cd/m2. "
      "Literature (review of Watson, Ahumada 2011): 0.4 to 1 minute of arc at high contrast, rising as the "
      "contrast falls, about "
      "twofold at 10 %.");
  std::vector<std::vector<std::string>> table{{"contrast"}};
  for (const Named& kind : metrics(kEdgePpd)) table[0].push_back(kind.name + ", arc minutes");
  for (const double contrast : {0.05, 0.1, 0.2, 0.4, 0.8}) {
    table.push_back({fixed(contrast, 2)});
    for (const Named& kind : metrics(kEdgePpd)) {
      const auto frame = [&](double sigma) {
        // Averaged over each pixel's own width, of deviation 1 / sqrt(12).
        const double width = std::hypot(sigma / 60.0, 1.0 / (kEdgePpd * std::sqrt(12.0)));
        return frameOf(kEdgeSize, kEdgePpd, kEdgeLuminance, contrast, [=](double x, double) {
          return std::erf((x + 0.5 / kEdgePpd) / (width * std::sqrt(2.0)));
        });
      };
      table.back().push_back(fixed(sizeAtThreshold(frame, 0.02, 10.0, kind.settings), 2));
    }
  }
  report.verdict("Blur",
                 "aqm " + table[2][1] + " arc minutes at 10 %, " + table[5][1] + " at 80 %; revised " +
                     table[2][2] + " and " + table[5][2],
                 "fits: 0.4 to 1 at high contrast, twice that at 10 %; vdp masks itself out of it");
  report.table(table);
}

void reportVernier(Report& report) {
  report.heading("Vernier offset");
  report.text(
      "Two abutting vertical lines, one minute of arc wide, against the same without offset; 120 pixels per "
      "degree, rendered with exact "
      "coverage, 50 cd/m2, contrast 0.8. Literature: 5 to 10 seconds of arc (Westheimer 1975), rising as the "
      "contrast falls.");
  std::vector<Named> kinds = metrics(kEdgePpd);
  const auto variant = [&](const std::string& name, const auto& change) {
    kinds.push_back({name, aqm::aqm(kEdgePpd)});
    change(kinds.back().settings);
  };
  variant("aqm without masking", [](aqm::Settings& s) { s.masking.elevation = aqm::Elevation::kNone; });
  variant("aqm, masking at the point", [](aqm::Settings& s) { s.masking.extent = aqm::MaskExtent::kPoint; });
  variant("aqm, not pooled", [](aqm::Settings& s) { s.pooling = aqm::Pooling::kNone; });
  std::vector<std::vector<std::string>> table{{"contrast"}};
  for (const Named& kind : kinds) table[0].push_back(kind.name + ", arc seconds");
  for (const double contrast : {0.2, 0.8}) {
    table.push_back({fixed(contrast, 1)});
    for (const Named& kind : kinds) {
      const auto frame = [&](double seconds) {
        return frameOf(kEdgeSize, kEdgePpd, kEdgeLuminance, contrast, [=](double x, double y) {
          const double centre = (y < 0.0 ? 0.0 : seconds / 3600.0);
          const double half = 0.5 / 60.0;
          const double from = std::max(x - 0.5 / kEdgePpd, centre - half);
          const double to = std::min(x + 0.5 / kEdgePpd, centre + half);
          return std::max(0.0, to - from) * kEdgePpd;
        });
      };
      table.back().push_back(fixed(sizeAtThreshold(frame, 0.3, 300.0, kind.settings), 1));
    }
  }
  report.verdict("Vernier offset at 80 %",
                 "aqm " + table[2][1] + ", revised " + table[2][2] + ", vdp " + table[2][4] + " arc seconds",
                 "observers: 5 to 10: does not fit, least of all where pooled");
  report.table(table);
  report.text(
      "Masking and pooling each suffice to spoil it: at 80 % the threshold is " + table[2][1] +
      " arc seconds, without masking " + table[2][5] + ", without pooling " + table[2][7] +
      ". The contrast that a displacement adds is large enough, but it lies in the channels that see the "
      "line "
      "itself, and their elevation spreads over the channel; observers are thought to use channels beside "
      "the "
      "line, which hardly see it (Wilson 1986). And Jp sums over half a degree what is seen within a few "
      "minutes of arc.");
}

}  // namespace promenade::validation
