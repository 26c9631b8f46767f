#pragma once
// Small plots as SVG.

#include <string>
#include <vector>

namespace promenade::io {

enum class Mark { kLine, kPoints };
enum class Scale { kLinear, kLogarithmic };

struct Series {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  Mark mark = Mark::kLine;
};

struct Axis {
  std::string label;
  Scale scale = Scale::kLinear;
};

/// Values that are not finite (or not positive on a logarithmic axis) are left out.
[[nodiscard]] std::string plotted(const std::string& title, const Axis& x, const Axis& y,
                                  const std::vector<Series>& series);

}  // namespace promenade::io
