#include <algorithm>
#include <charconv>
#include <utility>

#include "src/walkthrough/report.h"

namespace promenade::walkthrough {
namespace {

/// With so many digits after the point, independent of the locale.
std::string fixed(double value, int digits) {
  char buffer[64];
  const auto result = std::to_chars(buffer, buffer + sizeof(buffer), value, std::chars_format::fixed, digits);
  return result.ec == std::errc() ? std::string(buffer, result.ptr) : std::string("?");
}

std::string percent(double value) {
  return fixed(value, 2) + "%";
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
  const auto text = [](auto value) { return std::to_string(value); };
  const std::string perEdge = text(r.settings.supersample);
  std::string html = "<table>\n";
  html += row("scene", escaped(r.job.scene)) + row("path", escaped(r.job.path));
  html += row("frames", text(s.frames.size()) + " of " + text(r.settings.size.width) + " x " +
                            text(r.settings.size.height) + " pixels, " + perEdge + " x " + perEdge +
                            " samples a pixel, " + fixed(r.job.framesPerSecond, 3) + " frames/s");
  html += row("method", r.settings.method == Method::kFull ? "full: every frame ray traced" : "ibr");
  html += row("keyframes", text(s.keyframes()));
  html += row("samples ray traced", percent(100.0 * s.tracedFraction()));
  html += row("paths a sample",
              text(r.job.pathsPerSample) + (r.job.pathsChosenAutomatically ? " (chosen automatically)" : ""));
  html += row("wall time", fixed(r.wallSeconds, 1) + " s");
  const std::pair<const char*, double> parts[] = {
      {"load", r.seconds.load},     {"prepare", r.seconds.prepare},
      {"trace", s.seconds.trace},   {"visibility", s.seconds.visibility},
      {"warp", s.seconds.warp},     {"metric", s.seconds.metric},
      {"filter", s.seconds.filter}, {"encode", r.seconds.encode},
      {"write", r.seconds.write}};
  std::string list;
  for (const auto& [name, seconds] : parts) {
    if (!list.empty()) list += ", ";
    list.append(name).append(" ").append(fixed(seconds, 1)).append(" s");
  }
  html += row("of which", list);
  html += row("peak memory", fixed(r.peakResidentBytes / 1e6, 0) + " MB");
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
    svg += "<rect x=\"" + fixed(60.0 + width * static_cast<double>(i), 2) + "\" y=\"" +
           fixed(200.0 - height, 2) + "\" width=\"" + fixed(width * 0.9, 2) + "\" height=\"" +
           fixed(height, 2) + "\" fill=\"" + (f.kind == FrameKind::kKeyframe ? "#1f3f70" : "#c06020") +
           "\"><title>frame " + std::to_string(f.index) + ": " + percent(100.0 * share) + "</title></rect>\n";
  }
  if (!frames.empty()) {
    svg += "<text x=\"60\" y=\"218\">" + std::to_string(frames.front().index) +
           "</text><text x=\"940\" y=\"218\" text-anchor=\"end\">" + std::to_string(frames.back().index) +
           "</text>\n";
  }
  return svg + "</svg>\n";
}

std::string segmentsTable(const Report& r) {
  std::string html =
      "<table>\n<tr><th>segment</th><th>middle</th><th>visibly "
      "different</th><th>masked</th><th>unverified</th>"
      "<th>decision</th></tr>\n";
  for (const SegmentStatistics& s : r.statistics.segments) {
    const auto cell = [&html](const std::string& text) { html.append("<td>").append(text).append("</td>"); };
    html += "<tr>";
    cell(std::to_string(s.segment.first) + "-" + std::to_string(s.segment.last));
    cell(std::to_string(s.segment.middle()));
    cell(percent(s.differencePercent));
    cell(percent(s.maskedPercent));
    cell(percent(s.unverifiedPercent));
    cell(s.decision == Decision::kSplit ? "split" : "accept");
    html += "</tr>\n";
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
