#include "src/io/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace promenade::io {
namespace {

constexpr double kWidth = 640.0;
constexpr double kHeight = 400.0;
constexpr double kLeft = 70.0;
constexpr double kTop = 34.0;
constexpr double kRight = 170.0;
constexpr double kBottom = 50.0;
constexpr std::array<const char*, 6> kColours{"#1b6ca8", "#c8442d", "#3a8f4d",
                                              "#8a5bb0", "#b07d12", "#444444"};

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

std::string coordinate(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", value);
  return text.data();
}

/// From data to a fraction of the axis.
class Mapping {
 public:
  Mapping(Scale scale, const std::vector<Series>& series, std::vector<double> Series::*values)
      : scale_(scale) {
    least_ = 1e300;
    most_ = -1e300;
    for (const Series& one : series) {
      for (const double value : one.*values) {
        if (isGood(value)) {
          least_ = std::min(least_, transformed(value));
          most_ = std::max(most_, transformed(value));
        }
      }
    }
    if (!(least_ < most_)) {
      least_ = std::isfinite(least_) && least_ < 1e299 ? least_ - 1.0 : 0.0;
      most_ = least_ + 2.0;
    }
    const double room = 0.05 * (most_ - least_);
    least_ -= room;
    most_ += room;
  }
  [[nodiscard]] bool isGood(double value) const {
    return std::isfinite(value) && (scale_ == Scale::kLinear || value > 0.0);
  }
  [[nodiscard]] double at(double value) const { return (transformed(value) - least_) / (most_ - least_); }
  [[nodiscard]] std::vector<double> ticks() const {
    std::vector<double> result;
    if (scale_ == Scale::kLogarithmic) {
      const bool few = most_ - least_ > 3.0;
      for (int decade = static_cast<int>(std::floor(least_)); decade <= most_; ++decade) {
        for (const double digit : {1.0, 2.0, 5.0}) {
          const double value = digit * std::pow(10.0, decade);
          if ((digit == 1.0 || !few) && at(value) >= 0.0 && at(value) <= 1.0) result.push_back(value);
        }
      }
      return result;
    }
    const double raw = (most_ - least_) / 6.0;
    const double decade = std::pow(10.0, std::floor(std::log10(raw)));
    const double step = decade * (raw / decade < 1.5   ? 1.0
                                  : raw / decade < 3.5 ? 2.0
                                  : raw / decade < 7.5 ? 5.0
                                                       : 10.0);
    for (double value = std::ceil(least_ / step) * step; value <= most_; value += step) {
      result.push_back(std::abs(value) < 1e-9 * step ? 0.0 : value);
    }
    return result;
  }

 private:
  [[nodiscard]] double transformed(double value) const {
    return scale_ == Scale::kLogarithmic ? std::log10(value) : value;
  }
  Scale scale_;
  double least_;
  double most_;
};

}  // namespace

std::string plotted(const std::string& title, const Axis& x, const Axis& y,
                    const std::vector<Series>& series) {
  const Mapping across(x.scale, series, &Series::x);
  const Mapping up(y.scale, series, &Series::y);
  const double width = kWidth - kLeft - kRight;
  const double height = kHeight - kTop - kBottom;
  const auto px = [&](double value) { return kLeft + width * across.at(value); };
  const auto py = [&](double value) { return kTop + height * (1.0 - up.at(value)); };
  const auto text = [](double atX, double atY, const std::string& anchor, const std::string& what) {
    return "<text x=\"" + coordinate(atX) + "\" y=\"" + coordinate(atY) + "\" text-anchor=\"" + anchor +
           "\">" + what + "</text>\n";
  };
  const auto line = [](double x1, double y1, double x2, double y2) {
    return "<line x1=\"" + coordinate(x1) + "\" y1=\"" + coordinate(y1) + "\" x2=\"" + coordinate(x2) +
           "\" y2=\"" + coordinate(y2) + "\" stroke=\"#dddddd\"/>\n";
  };
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"640\" height=\"400\" font-family=\"sans-serif\" "
      "font-size=\"12\">\n<rect width=\"640\" height=\"400\" fill=\"white\"/>\n";
  svg += text(kLeft, 20.0, "start", "<tspan font-weight=\"bold\">" + title + "</tspan>");
  for (const double tick : across.ticks()) {
    svg += line(px(tick), kTop, px(tick), kTop + height) +
           text(px(tick), kTop + height + 16.0, "middle", number(tick));
  }
  for (const double tick : up.ticks()) {
    svg += line(kLeft, py(tick), kLeft + width, py(tick)) +
           text(kLeft - 6.0, py(tick) + 4.0, "end", number(tick));
  }
  svg += text(kLeft + width / 2.0, kHeight - 10.0, "middle", x.label);
  svg += "<text transform=\"translate(16 " + coordinate(kTop + height / 2.0) +
         ") rotate(-90)\" text-anchor=\"middle\">" + y.label + "</text>\n";
  for (std::size_t i = 0; i < series.size(); ++i) {
    const std::string colour = kColours[i % kColours.size()];
    std::string points;
    for (std::size_t k = 0; k < series[i].x.size(); ++k) {
      if (!across.isGood(series[i].x[k]) || !up.isGood(series[i].y[k])) continue;
      const std::string cx = coordinate(px(series[i].x[k]));
      const std::string cy = coordinate(py(series[i].y[k]));
      points += cx + "," + cy + " ";
      if (series[i].mark == Mark::kPoints) {
        svg += "<circle cx=\"" + cx + "\" cy=\"" + cy + "\" r=\"3.5\" fill=\"" + colour + "\"/>\n";
      }
    }
    if (series[i].mark == Mark::kLine) {
      svg += "<polyline points=\"" + points + "\" fill=\"none\" stroke=\"" + colour +
             "\" stroke-width=\"1.8\"/>\n";
    }
    const double legend = kTop + 14.0 + 18.0 * static_cast<double>(i);
    svg += "<rect x=\"" + coordinate(kWidth - kRight + 12.0) + "\" y=\"" + coordinate(legend - 8.0) +
           "\" width=\"10\" height=\"10\" fill=\"" + colour + "\"/>\n" +
           text(kWidth - kRight + 28.0, legend + 1.0, "start", series[i].name);
  }
  return svg + "</svg>\n";
}

}  // namespace promenade::io
