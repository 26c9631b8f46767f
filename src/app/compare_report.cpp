#include "src/app/compare_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "src/app/formatted.h"

namespace promenade::app {
namespace {

using OrderedJson = nlohmann::ordered_json;

double badness(const FrameDifference& f, Metric metric) {
  switch (findingOf(metric)) {
    case Finding::kVisibility:
      return f.percentVisible;
    case Finding::kSquaredError:
      return f.rmse;
    case Finding::kDistance:
      return f.distance;
  }
  return 0.0;
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

OrderedJson finite(double value) {
  return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr);
}

}  // namespace

const char* nameOf(Metric metric) {
  switch (metric) {
    case Metric::kAqm:
      return "aqm";
    case Metric::kAqm2000:
      return "aqm2000";
    case Metric::kRevised:
      return "revised";
    case Metric::kVdp:
      return "vdp";
    case Metric::kRmse:
      return "rmse";
    case Metric::kPsnr:
      return "psnr";
    case Metric::kModel1:
      return "model1";
    case Metric::kModel2:
      return "model2";
    case Metric::kModel3:
      return "model3";
  }
  return "";
}

Finding findingOf(Metric metric) {
  switch (metric) {
    case Metric::kAqm:
    case Metric::kAqm2000:
    case Metric::kRevised:
    case Metric::kVdp:
      return Finding::kVisibility;
    case Metric::kRmse:
    case Metric::kPsnr:
      return Finding::kSquaredError;
    case Metric::kModel1:
    case Metric::kModel2:
    case Metric::kModel3:
      return Finding::kDistance;
  }
  return Finding::kVisibility;
}

std::size_t worstFrame(const SequenceDifference& d) {
  const auto worst = std::max_element(d.frames.begin(), d.frames.end(),
                                      [&](const FrameDifference& a, const FrameDifference& b) {
                                        return badness(a, d.metric) < badness(b, d.metric);
                                      });
  return static_cast<std::size_t>(worst - d.frames.begin());
}

std::string differenceJson(const SequenceDifference& d) {
  const Finding finding = findingOf(d.metric);
  OrderedJson frames = OrderedJson::array();
  for (const FrameDifference& f : d.frames) {
    OrderedJson frame = {{"index", f.index}};
    if (finding == Finding::kVisibility) {
      frame["percent_visible"] = f.percentVisible;
      frame["jnd_mean"] = f.jndMean;
      frame["jnd_max"] = f.jndMax;
      frame["pooled_jnd_max"] = f.pooledJndMax;
      frame["probability_mean"] = f.probabilityMean;
    } else if (finding == Finding::kSquaredError) {
      frame["rmse"] = f.rmse;
      frame["psnr"] = finite(f.psnr);
    } else {
      frame["distance"] = f.distance;
    }
    frames.push_back(std::move(frame));
  }
  OrderedJson root = {{"metric", nameOf(d.metric)}, {"ppd", d.pixelsPerDegree}, {"fps", d.framesPerSecond}};
  for (const auto& [name, value] : d.settings) root["settings"][name] = value;
  root["frames"] = std::move(frames);
  const FrameDifference& worst = d.frames[worstFrame(d)];
  if (finding == Finding::kVisibility) {
    root["percent_visible_mean"] = meanOf(d, [](const FrameDifference& f) { return f.percentVisible; });
    root["percent_visible_worst"] = worst.percentVisible;
  } else if (finding == Finding::kSquaredError) {
    root["rmse_mean"] = meanOf(d, [](const FrameDifference& f) { return f.rmse; });
    root["rmse_worst"] = worst.rmse;
    root["psnr_worst"] = finite(worst.psnr);
  } else {
    root["distance_mean"] = meanOf(d, [](const FrameDifference& f) { return f.distance; });
    root["distance_worst"] = worst.distance;
  }
  root["worst_frame"] = worst.index;
  return root.dump(2) + "\n";
}

std::string differenceCsv(const SequenceDifference& d) {
  const Finding finding = findingOf(d.metric);
  std::string csv = finding == Finding::kVisibility
                        ? "index,percent_visible,jnd_mean,jnd_max,pooled_jnd_max,probability_mean\n"
                    : finding == Finding::kSquaredError ? "index,rmse,psnr\n"
                                                        : "index,distance\n";
  for (const FrameDifference& f : d.frames) {
    csv += finding == Finding::kVisibility
               ? formatted("%d,%.9g,%.9g,%.9g,%.9g,%.9g\n", f.index, f.percentVisible, f.jndMean, f.jndMax,
                           f.pooledJndMax, f.probabilityMean)
           : finding == Finding::kSquaredError ? formatted("%d,%.9g,%.9g\n", f.index, f.rmse, f.psnr)
                                               : formatted("%d,%.9g\n", f.index, f.distance);
  }
  return csv;
}

std::string differenceSummary(const SequenceDifference& d) {
  const FrameDifference& worst = d.frames[worstFrame(d)];
  const std::string count = std::to_string(d.frames.size()) + (d.frames.size() == 1 ? " frame" : " frames");
  const std::string head = d.test + " against " + d.reference + ", " + count + ": ";
  if (findingOf(d.metric) == Finding::kVisibility) {
    return head +
           formatted("%.3f%% of pixels visibly different (worst frame %d: %.3f%%), JND mean %.4f, max %.3f\n",
                     meanOf(d, [](const FrameDifference& f) { return f.percentVisible; }), worst.index,
                     worst.percentVisible, meanOf(d, [](const FrameDifference& f) { return f.jndMean; }),
                     maxOf(d, [](const FrameDifference& f) { return f.jndMax; }));
  }
  if (findingOf(d.metric) == Finding::kDistance) {
    return head + formatted("%s distance mean %.6g, worst frame %d: %.6g\n", nameOf(d.metric),
                            meanOf(d, [](const FrameDifference& f) { return f.distance; }), worst.index,
                            worst.distance);
  }
  if (d.metric == Metric::kPsnr) {
    return head + formatted("PSNR of the worst frame (%d) %.2f dB\n", worst.index, worst.psnr);
  }
  return head + formatted("RMSE mean %.6f, worst frame %d: %.6f\n",
                          meanOf(d, [](const FrameDifference& f) { return f.rmse; }), worst.index,
                          worst.rmse);
}

}  // namespace promenade::app
