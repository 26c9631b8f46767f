#include "paths/plot.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "paths/statistics.h"
#include "paths/text.h"

namespace promenade::paths {
namespace {

struct Range {
  double low, high;
};

struct Box {
  double x, y, width, height;  // SVG units, y down
};

struct Axes {
  Box box;
  Range x, y;
  bool yDown;  // whether larger y values lie lower

  [[nodiscard]] double px(double value) const {
    return box.x + (value - x.low) / (x.high - x.low) * box.width;
  }
  [[nodiscard]] double py(double value) const {
    const double u = (value - y.low) / (y.high - y.low);
    return box.y + (yDown ? u : 1.0 - u) * box.height;
  }
};

std::string fixed(double value) {
  return number(std::round(value * 100.0) / 100.0);
}

// 1, 2 or 5 times a power of ten, so that about `wanted` steps fill the range.
double niceStep(Range range, int wanted) {
  const double raw = (range.high - range.low) / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10.0 * power;
}

std::string line(double x1, double y1, double x2, double y2, const char* style) {
  return "<line x1=\"" + fixed(x1) + "\" y1=\"" + fixed(y1) + "\" x2=\"" + fixed(x2) + "\" y2=\"" +
         fixed(y2) + "\" class=\"" + style + "\"/>\n";
}

std::string label(double x, double y, const std::string& text, const char* anchor, const char* style) {
  return "<text x=\"" + fixed(x) + "\" y=\"" + fixed(y) + "\" text-anchor=\"" + anchor + "\" class=\"" +
         style + "\">" + text + "</text>\n";
}

std::string frameOf(const Axes& a, const std::string& title, const std::string& xName,
                    const std::string& yName) {
  std::string svg = "<rect x=\"" + fixed(a.box.x) + "\" y=\"" + fixed(a.box.y) + "\" width=\"" +
                    fixed(a.box.width) + "\" height=\"" + fixed(a.box.height) + "\" class=\"frame\"/>\n";
  const double bottom = a.box.y + a.box.height;
  const double xStep = niceStep(a.x, std::max(2, static_cast<int>(a.box.width / 90.0)));
  for (double k = std::ceil(a.x.low / xStep); k * xStep <= a.x.high; k += 1.0) {
    svg += line(a.px(k * xStep), a.box.y, a.px(k * xStep), bottom, "grid");
    svg += label(a.px(k * xStep), bottom + 16, number(k * xStep), "middle", "tick");
  }
  const double yStep = niceStep(a.y, std::max(2, static_cast<int>(a.box.height / 40.0)));
  for (double k = std::ceil(a.y.low / yStep); k * yStep <= a.y.high; k += 1.0) {
    svg += line(a.box.x, a.py(k * yStep), a.box.x + a.box.width, a.py(k * yStep), "grid");
    svg += label(a.box.x - 6, a.py(k * yStep) + 4, number(k * yStep), "end", "tick");
  }
  svg += label(a.box.x, a.box.y - 8, title, "start", "title");
  svg += label(a.box.x + a.box.width / 2, bottom + 34, xName, "middle", "name");
  const std::string x = fixed(a.box.x - 52);
  const std::string y = fixed(a.box.y + a.box.height / 2);
  svg += "<text x=\"" + x + "\" y=\"" + y +
         "\" text-anchor=\"middle\" class=\"name\" transform=\"rotate(-90 " + x + " " + y + ")\">" + yName +
         "</text>\n";
  return svg;
}

// At most about 2000 points: more cannot be seen, and long walks would give files of many megabytes.
std::size_t strideOf(std::size_t count) {
  return std::max<std::size_t>(1, (count + 1999) / 2000);
}

std::string polyline(const Axes& a, const std::vector<glm::dvec2>& points) {
  std::string svg = "<polyline class=\"curve\" points=\"";
  const std::size_t stride = strideOf(points.size());
  for (std::size_t i = 0; i < points.size(); i += stride) {
    svg += fixed(a.px(points[i].x)) + "," + fixed(a.py(points[i].y)) + " ";
  }
  if (!points.empty()) svg += fixed(a.px(points.back().x)) + "," + fixed(a.py(points.back().y));
  return svg + "\"/>\n";
}

std::string planView(const CameraPath& path, Box box) {
  Range x{path.frames[0].pose.eye.x, path.frames[0].pose.eye.x};
  Range z{path.frames[0].pose.eye.z, path.frames[0].pose.eye.z};
  std::vector<glm::dvec2> points;
  for (const PathFrame& frame : path.frames) {
    const glm::dvec3& e = frame.pose.eye;
    x = {std::min(x.low, e.x), std::max(x.high, e.x)};
    z = {std::min(z.low, e.z), std::max(z.high, e.z)};
    points.emplace_back(e.x, e.z);
  }
  // Equal scales, a margin of a tenth, and never an empty range (a standing camera).
  const double metresPerUnit =
      std::max({(x.high - x.low) / box.width, (z.high - z.low) / box.height, 1.0 / box.width}) * 1.2;
  const auto around = [&](Range r, double units) {
    const double centre = 0.5 * (r.low + r.high);
    return Range{centre - 0.5 * metresPerUnit * units, centre + 0.5 * metresPerUnit * units};
  };
  const Axes axes{box, around(x, box.width), around(z, box.height), true};
  std::string svg = frameOf(axes, "Plan view (from above)", "x [m]", "z [m]") + polyline(axes, points);
  const std::size_t step = std::max<std::size_t>(1, path.frames.size() / 16);
  for (std::size_t i = 0; i < path.frames.size(); i += step) {
    const glm::dvec3 view = -path.frames[i].pose.worldFromCamera[2];
    const double px = axes.px(points[i].x);
    const double py = axes.py(points[i].y);
    svg += line(px, py, px + 28.0 * view.x, py + 28.0 * view.z, "view");
    svg += "<circle cx=\"" + fixed(px) + "\" cy=\"" + fixed(py) + "\" r=\"3\" class=\"" +
           (i == 0 ? "start" : "dot") + "\"/>\n";
  }
  return svg + label(axes.px(points[0].x) + 6, axes.py(points[0].y) - 6, "start", "start", "tick");
}

std::string graph(const CameraPath& path, const std::vector<double>& values, Box box,
                  const std::string& title, const std::string& name) {
  std::vector<glm::dvec2> points;
  double highest = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    points.emplace_back((static_cast<double>(i) + 0.5) / path.framesPerSecond, values[i]);
    highest = std::max(highest, values[i]);
  }
  const double duration = static_cast<double>(path.frames.size()) / path.framesPerSecond;
  const Axes axes{box, {0.0, duration}, {0.0, highest > 1e-9 ? 1.1 * highest : 1.0}, false};
  return frameOf(axes, title, "time [s]", name) + polyline(axes, points);
}

}  // namespace

std::string plotSvg(const CameraPath& path) {
  const Statistics s = statisticsOf(path);
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"900\" height=\"1060\" viewBox=\"0 0 900 1060\">\n"
      "<style>text{font-family:sans-serif;fill:#222}.title{font-size:15px;font-weight:bold}.name{font-size:"
      "13px}"
      ".tick{font-size:12px}.grid{stroke:#ddd}.frame{fill:none;stroke:#444}"
      ".curve{fill:none;stroke:#1f5fa8;stroke-width:2}.view{stroke:#c05020;stroke-width:1.5}"
      ".dot{fill:#1f5fa8}.start{fill:#208040}</style>\n"
      "<rect width=\"900\" height=\"1060\" fill=\"white\"/>\n";
  svg += label(80, 28,
               number(s.frames) + " frames, " + fixed(s.durationSeconds) + " s at " +
                   number(s.framesPerSecond) + " frames/s; " + fixed(s.lengthMetres) + " m",
               "start", "name");
  svg += planView(path, {80, 64, 780, 400});
  svg += graph(path, speeds(path), {80, 556, 780, 180}, "Speed", "speed [m/s]");
  svg += graph(path, turnRates(path), {80, 824, 780, 180}, "Turn rate", "turn rate [deg/s]");
  return svg + "</svg>\n";
}

}  // namespace promenade::paths
