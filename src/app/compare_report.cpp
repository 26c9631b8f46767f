#include "src/app/compare_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace promenade::app {
namespace {

using Json = nlohmann::ordered_json;

double badness(const FrameDifference& f, Metric metric) {
  return metric == Metric::kAqm ? f.percentVisible : f.rmse;
}

template <class Value>
double meanOf(const SequenceDifference& d, Value&& value) {
  double sum = 0.0;
  for (const FrameDifference& f : d.frames) sum += value(f);
  return sum / static_cast<double>(d.frames.size());
}

template <class Value>
double maxOf(const SequenceDifference& d, Value&& value) {
  double largest = 0.0;
  for (const FrameDifference& f : d.frames) largest = std::max(largest, value(f));
  return largest;
}

const char* nameOf(Metric metric) {
  switch (metric) {
    case Metric::kAqm:
      return "aqm";
    case Metric::kRmse:
      return "rmse";
    case Metric::kPsnr:
      return "psnr";
  }
  return "";
}

Json finite(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

std::string formatted(const char* format, auto... values) {
  char buffer[512];
  const int length = std::snprintf(buffer, sizeof(buffer), format, values...);
  return std::string(buffer, static_cast<std::size_t>(std::clamp(length, 0, 511)));
}

}  // namespace

std::size_t worstFrame(const SequenceDifference& d) {
  const auto worst = std::max_element(d.frames.begin(), d.frames.end(),
                                      [&](const FrameDifference& a, const FrameDifference& b) {
                                        return badness(a, d.metric) < badness(b, d.metric);
                                      });
  return static_cast<std::size_t>(worst - d.frames.begin());
}

std::string differenceJson(const SequenceDifference& d) {
  Json frames = Json::array();
  for (const FrameDifference& f : d.frames) {
    if (d.metric == Metric::kAqm) {
      frames.push_back({{"index", f.index},
                        {"percent_visible", f.percentVisible},
                        {"jnd_mean", f.jndMean},
                        {"jnd_max", f.jndMax},
                        {"pooled_jnd_max", f.pooledJndMax},
                        {"probability_mean", f.probabilityMean}});
    } else {
      frames.push_back({{"index", f.index}, {"rmse", f.rmse}, {"psnr", finite(f.psnr)}});
    }
  }
  Json root = {{"metric", nameOf(d.metric)}, {"ppd", d.pixelsPerDegree}, {"fps", d.framesPerSecond}};
  root["frames"] = std::move(frames);
  const FrameDifference& worst = d.frames[worstFrame(d)];
  if (d.metric == Metric::kAqm) {
    root["percent_visible_mean"] = meanOf(d, [](const FrameDifference& f) { return f.percentVisible; });
    root["percent_visible_worst"] = worst.percentVisible;
  } else {
    root["rmse_mean"] = meanOf(d, [](const FrameDifference& f) { return f.rmse; });
    root["rmse_worst"] = worst.rmse;
    root["psnr_worst"] = finite(worst.psnr);
  }
  root["worst_frame"] = worst.index;
  return root.dump(2) + "\n";
}

std::string differenceCsv(const SequenceDifference& d) {
  const bool aqm = d.metric == Metric::kAqm;
  std::string csv =
      aqm ? "index,percent_visible,jnd_mean,jnd_max,pooled_jnd_max,probability_mean\n" : "index,rmse,psnr\n";
  for (const FrameDifference& f : d.frames) {
    csv += aqm ? formatted("%d,%.9g,%.9g,%.9g,%.9g,%.9g\n", f.index, f.percentVisible, f.jndMean, f.jndMax,
                           f.pooledJndMax, f.probabilityMean)
               : formatted("%d,%.9g,%.9g\n", f.index, f.rmse, f.psnr);
  }
  return csv;
}

std::string differenceSummary(const SequenceDifference& d) {
  const FrameDifference& worst = d.frames[worstFrame(d)];
  const std::string count = std::to_string(d.frames.size()) + (d.frames.size() == 1 ? " frame" : " frames");
  const std::string head = d.test + " against " + d.reference + ", " + count + ": ";
  if (d.metric == Metric::kAqm) {
    return head +
           formatted("%.3f%% of pixels visibly different (worst frame %d: %.3f%%), JND mean %.4f, max %.3f\n",
                     meanOf(d, [](const FrameDifference& f) { return f.percentVisible; }), worst.index,
                     worst.percentVisible, meanOf(d, [](const FrameDifference& f) { return f.jndMean; }),
                     maxOf(d, [](const FrameDifference& f) { return f.jndMax; }));
  }
  if (d.metric == Metric::kPsnr) {
    return head + formatted("PSNR of the worst frame (%d) %.2f dB\n", worst.index, worst.psnr);
  }
  return head + formatted("RMSE mean %.6f, worst frame %d: %.6f\n",
                          meanOf(d, [](const FrameDifference& f) { return f.rmse; }), worst.index,
                          worst.rmse);
}

}  // namespace promenade::app
