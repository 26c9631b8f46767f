#include <algorithm>
#include <cstdio>

#include "src/walkthrough/report.h"

namespace promenade::walkthrough {
namespace {

std::string formatted(const char* format, auto... values) {
  char buffer[512];
  const int length = std::snprintf(buffer, sizeof(buffer), format, values...);
  return std::string(buffer, static_cast<std::size_t>(std::clamp(length, 0, 511)));
}

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string row(const std::string& name, const std::string& value) {
  return "<tr><th>" + name + "</th><td>" + value + "</td></tr>\n";
}

std::string totalsTable(const Report& r) {
  const Statistics& s = r.statistics;
  std::string html = "<table>\n";
  html += row("scene", escaped(r.job.scene)) + row("path", escaped(r.job.path));
  html += row("frames", formatted("%zu of %dx%d, %d x %d samples a pixel, %g frames/s", s.frames.size(),
                                  r.settings.size.width, r.settings.size.height, r.settings.supersample,
                                  r.settings.supersample, r.job.framesPerSecond));
  html += row("method", r.settings.method == Method::kFull ? "full: every frame ray traced" : "ibr");
  html += row("keyframes", formatted("%d", s.keyframes()));
  html += row("samples ray traced", formatted("%.2f%%", 100.0 * s.tracedFraction()));
  html += row("paths a sample", formatted("%d%s", r.job.pathsPerSample,
                                          r.job.pathsChosenAutomatically ? " (chosen automatically)" : ""));
  html += row("wall time", formatted("%.1f s", r.wallSeconds));
  html +=
      row("of which",
          formatted("load %.1f, prepare %.1f, trace %.1f, visibility %.1f, warp %.1f, metric %.1f, "
                    "filter %.1f, encode %.1f, write %.1f s",
                    r.seconds.load, r.seconds.prepare, s.seconds.trace, s.seconds.visibility, s.seconds.warp,
                    s.seconds.metric, s.seconds.filter, r.seconds.encode, r.seconds.write));
  html += row("peak memory", formatted("%.0f MB", r.peakResidentBytes / 1e6));
  return html + "</table>\n";
}

/// A bar a frame: how much of it was ray traced.
std::string tracedChart(const Report& r) {
  const auto& frames = r.statistics.frames;
  const double width = 880.0 / static_cast<double>(std::max<std::size_t>(1, frames.size()));
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 960 240\" width=\"960\" height=\"240\">\n"
      "<line x1=\"60\" y1=\"200\" x2=\"940\" y2=\"200\" stroke=\"#444\"/>\n"
      "<line x1=\"60\" y1=\"20\" x2=\"940\" y2=\"20\" stroke=\"#ddd\"/>\n"
      "<text x=\"54\" y=\"24\" text-anchor=\"end\">100%</text><text x=\"54\" y=\"204\" "
      "text-anchor=\"end\">0%</text>\n"
      "<text x=\"500\" y=\"232\" text-anchor=\"middle\">frame (dark: keyframe)</text>\n";
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameStatistics& f = frames[i];
    const double share =
        f.samples > 0 ? static_cast<double>(f.samplesTraced) / static_cast<double>(f.samples) : 0.0;
    const double height = 180.0 * std::min(share, 1.0);
    svg += formatted(
        "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"%s\"><title>frame %d: "
        "%.2f%%</title></rect>\n",
        60.0 + width * static_cast<double>(i), 200.0 - height, width * 0.9, height,
        f.kind == FrameKind::kKeyframe ? "#1f3f70" : "#c06020", f.index, 100.0 * share);
  }
  if (!frames.empty()) {
    svg += formatted(
        "<text x=\"60\" y=\"218\">%d</text><text x=\"940\" y=\"218\" text-anchor=\"end\">%d</text>\n",
        frames.front().index, frames.back().index);
  }
  return svg + "</svg>\n";
}

std::string segmentsTable(const Report& r) {
  std::string html =
      "<table>\n<tr><th>segment</th><th>middle</th><th>visibly "
      "different</th><th>masked</th><th>unverified</th>"
      "<th>decision</th></tr>\n";
  for (const SegmentStatistics& s : r.statistics.segments) {
    html += formatted(
        "<tr><td>%d-%d</td><td>%d</td><td>%.2f%%</td><td>%.2f%%</td><td>%.2f%%</td><td>%s</td></tr>\n",
        s.segment.first, s.segment.last, s.segment.middle(), s.differencePercent, s.maskedPercent,
        s.unverifiedPercent, s.decision == Decision::kSplit ? "split" : "accept");
  }
  return html + "</table>\n";
}

}  // namespace

std::string reportHtml(const Report& report) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Promenade report</title>\n"
         "<style>body{font-family:sans-serif;margin:2em;color:#222}th{text-align:left;padding-right:1.5em}"
         "td{padding-right:1.5em}text{font-size:12px}</style></head><body>\n<h1>Promenade " +
         escaped(report.version) + "</h1>\n" + totalsTable(report) +
         "<h2>Ray traced share of each frame</h2>\n" + tracedChart(report) + "<h2>Segments</h2>\n" +
         segmentsTable(report) + "</body></html>\n";
}

}  // namespace promenade::walkthrough
