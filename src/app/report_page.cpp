#include "src/app/report_page.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "src/app/formatted.h"
#include "src/app/heatmap.h"
#include "src/app/page_parts.h"
#include "src/io/bytes.h"
#include "src/io/text_file.h"

namespace promenade::app {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string cssColour(const Rgb& colour) {
  return formatted("#%02x%02x%02x", io::toByte(colour.r), io::toByte(colour.g), io::toByte(colour.b));
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

// JSON inside of a script element: "</script>" or "<!--" in a name must not end or hide it. A "<" is always
// within a string, where it may be written so.
std::string forScriptElement(const std::string& json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      out += "\\u003c";
    } else {
      out += c;
    }
  }
  return out;
}

OrderedJson picturesJson(const ReportContents& contents) {
  OrderedJson frames = OrderedJson::array();
  for (const FramePictures& f : contents.frames) {
    OrderedJson frame = {{"index", f.index}};
    const auto add = [&](const char* kind, const std::string& uri) {
      if (!uri.empty()) frame[kind] = uri;
    };
    add("result", f.result);
    add("source", f.source);
    add("metric", f.metric);
    add("reference", f.reference);
    if (f.percentVisible) frame["percent_visible"] = *f.percentVisible;
    frames.push_back(std::move(frame));
  }
  return {{"size", {contents.pictureSize.width, contents.pictureSize.height}}, {"frames", std::move(frames)}};
}

OrderedJson sourcesJson() {
  OrderedJson sources = OrderedJson::array();
  for (const SourceLook& look : sourceLooks()) {
    sources.push_back({{"key", look.key}, {"name", look.name}, {"colour", cssColour(look.colour)}});
  }
  return sources;
}

OrderedJson visibilityJson() {
  return {
      {{"name", "grey: no difference is seen"}, {"colour", cssColour(visibilityColour(0.0f, 0.35f))}},
      {{"name", "seen by half the viewers"}, {"colour", cssColour(visibilityColour(0.5f, 0.35f))}},
      {{"name", "visible: by more than three of four"}, {"colour", cssColour(visibilityColour(0.8f, 0.35f))}},
      {{"name", "seen by all"}, {"colour", cssColour(visibilityColour(1.0f, 0.35f))}}};
}

// Of the frames that were compared with a reference; null if none was.
OrderedJson comparisonJson(const std::vector<FramePictures>& frames) {
  double sum = 0.0;
  int count = 0;
  const FramePictures* worst = nullptr;
  for (const FramePictures& frame : frames) {
    if (!frame.percentVisible) continue;
    sum += *frame.percentVisible;
    ++count;
    if (worst == nullptr || *frame.percentVisible > *worst->percentVisible) worst = &frame;
  }
  if (worst == nullptr) return nullptr;
  return {{"percent_visible_mean", sum / count},
          {"percent_visible_worst", *worst->percentVisible},
          {"worst_frame", worst->index}};
}

std::string dataJson(const RenderedJob& job, const ReportContents& contents) {
  OrderedJson rest = {
      {"pictures", picturesJson(contents)}, {"sources", sourcesJson()}, {"visibility", visibilityJson()}};
  if (const OrderedJson comparison = comparisonJson(contents.frames); !comparison.is_null())
    rest["comparison"] = comparison;
  if (contents.speedup) {
    const Speedup& speedup = *contents.speedup;
    rest["speedup"] = {{"value", speedup.value},
                       {"kind", speedup.measured ? "measured" : "estimated"},
                       {"how", speedup.how}};
  }
  // report.json goes in as it stands: its numbers are not even formatted again.
  return "{\"report\":" + job.report + "," +
         rest.dump(-1, ' ', false, OrderedJson::error_handler_t::replace).substr(1);
}

bool isSameJobTracedWhole(const RenderedJob& job, const RenderedJob& reference) {
  return reference.everyFrameTraced && !job.everyFrameTraced && reference.wallSeconds > 0.0 &&
         reference.size == job.size && reference.supersample == job.supersample &&
         reference.frames.first == job.frames.first && reference.frames.last == job.frames.last &&
         reference.integrator == job.integrator && reference.pathsPerSample == job.pathsPerSample &&
         reference.threads == job.threads;
}

std::string secondsText(double seconds) {
  return formatted("%.1f s", seconds);
}

}  // namespace

std::optional<Speedup> speedupOf(const RenderedJob& job, const RenderedJob* reference) {
  if (!(job.wallSeconds > 0.0) || job.everyFrameTraced) return std::nullopt;
  if (reference != nullptr && isSameJobTracedWhole(job, *reference)) {
    return Speedup{reference->wallSeconds / job.wallSeconds, true,
                   "Speedup is measured: wall time of " + reference->folder.string() +
                       ", the same job with every frame ray traced (" + secondsText(reference->wallSeconds) +
                       "), over the wall time of this one (" + secondsText(job.wallSeconds) + ")."};
  }
  if (!(job.speedupEstimated > 0.0)) return std::nullopt;
  return Speedup{
      job.speedupEstimated, false,
      "Speedup is estimated, not measured: what the keyframes took for each sample, times all samples, "
      "with the same time for loading, light and output, over the wall time. `promenade report "
      "--reference` measures it against the same job rendered with --method full."};
}

std::string reportPage(const RenderedJob& job, const ReportContents& contents) {
  std::string page;
  // The template is walked through once, so that nothing inside of a part is taken for a mark.
  std::string_view rest = pageTemplate();
  for (std::size_t open = rest.find("{{"); open != std::string_view::npos; open = rest.find("{{")) {
    const std::size_t close = rest.find("}}", open);
    const std::string_view mark = rest.substr(open + 2, close - open - 2);
    page += rest.substr(0, open);
    if (mark == "title")
      page += escaped("Walkthrough of " + std::filesystem::path(job.scene).filename().string());
    if (mark == "style") page += pageStyle();
    if (mark == "charts") page += chartLibrary();
    if (mark == "script") page += pageScript();
    if (mark == "data") page += forScriptElement(dataJson(job, contents));
    rest.remove_prefix(close + 2);
  }
  return page.append(rest);
}

void writeReportPage(const std::filesystem::path& folder,
                     const std::optional<std::filesystem::path>& reference, const std::filesystem::path& file,
                     const ProgressCallback& progress) {
  const RenderedJob job = readRenderedJob(folder);
  std::optional<RenderedJob> traced;
  if (reference) traced = readRenderedJob(*reference);
  ReportContents contents;
  contents.pictureSize = pictureSize(job, traced ? 4 : 2);
  contents.frames = framePictures(job, contents.pictureSize, progress);
  if (traced) addReference(contents.frames, job, *traced, contents.pictureSize, progress);
  contents.speedup = speedupOf(job, traced ? &*traced : nullptr);
  io::writeTextFile(file, reportPage(job, contents));
}

}  // namespace promenade::app
