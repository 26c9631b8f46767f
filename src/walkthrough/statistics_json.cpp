// Every struct is taken apart by a structured binding: a member that is added and forgotten here does not
// compile, because a record that leaves something out would make a resumed report differ.

#include "src/walkthrough/statistics_json.h"

#include <nlohmann/json.hpp>

namespace promenade::walkthrough {
namespace {

using OrderedJson = nlohmann::ordered_json;

RayCounts countsFrom(const nlohmann::json& value) {
  return {value.at("visibility"), value.at("primary"), value.at("scattered"), value.at("shadow")};
}

OrderedJson toJson(const RayCounts& rays) {
  const auto& [visibility, primary, scattered, shadow] = rays;
  return {{"visibility", visibility}, {"primary", primary}, {"scattered", scattered}, {"shadow", shadow}};
}

OrderedJson toJson(const PartSeconds& seconds) {
  const auto& [trace, visibility, warp, metric, filter, output] = seconds;
  return {{"trace", trace},   {"visibility", visibility}, {"warp", warp},
          {"metric", metric}, {"filter", filter},         {"output", output}};
}

PartSeconds secondsFrom(const nlohmann::json& value) {
  return {value.at("trace"),  value.at("visibility"), value.at("warp"),
          value.at("metric"), value.at("filter"),     value.at("output")};
}

std::optional<StoppingStatistics> stoppingFrom(const nlohmann::json& frame) {
  if (!frame.contains("paths")) return std::nullopt;
  return StoppingStatistics{.paths = frame.at("paths"),
                            .mostPaths = frame.at("paths_most"),
                            .predictedPercent = frame.at("predicted_percent"),
                            .openTiles = frame.at("tiles_open")};
}

FrameStatistics frameFrom(const nlohmann::json& value) {
  return {.index = value.at("index"),
          .kind = value.at("kind") == "keyframe" ? FrameKind::kKeyframe : FrameKind::kInbetween,
          .samples = value.at("samples"),
          .samplesTraced = value.at("samples_traced"),
          .holes = value.at("holes"),
          .itemSamples = value.at("items_traced"),
          .disputed = value.at("disputed"),
          .itemsTraced = value.at("items").get<std::vector<ItemId>>(),
          .warped = value.at("warped"),
          .layered = value.at("layered"),
          .reused = value.at("reused"),
          .unknown = value.at("unknown"),
          .stopping = stoppingFrom(value),
          .rays = countsFrom(value.at("rays")),
          .seconds = value.at("seconds")};
}

SegmentStatistics segmentFrom(const nlohmann::json& value) {
  return {.segment = {value.at("first"), value.at("last"), value.at("depth")},
          .decision = value.at("decision") == "split" ? Decision::kSplit : Decision::kAccept,
          .differencePercent = value.at("difference_percent"),
          .maskedPercent = value.at("masked_percent"),
          .unverifiedPercent = value.at("unverified_percent"),
          .probes = value.at("probes"),
          .probeDifferencePercent = value.at("probe_difference_percent"),
          .rays = countsFrom(value.at("rays"))};
}

OrderedJson toJson(const SegmentStatistics& statistics) {
  const auto& [segment, decision, differencePercent, maskedPercent, unverifiedPercent, probes,
               probeDifferencePercent, rays] = statistics;
  return {{"first", segment.first},
          {"last", segment.last},
          {"middle", segment.middle()},
          {"difference_percent", differencePercent},
          {"masked_percent", maskedPercent},
          {"unverified_percent", unverifiedPercent},
          {"probes", probes},
          {"probe_difference_percent", probeDifferencePercent},
          {"decision", decision == Decision::kSplit ? "split" : "accept"},
          {"depth", segment.depth},
          {"rays", toJson(rays)}};
}

}  // namespace

OrderedJson toJson(const FrameStatistics& frame) {
  const auto& [index, kind, samples, samplesTraced, holes, itemSamples, disputed, itemsTraced, warped,
               layered, reused, unknown, stopping, rays, seconds] = frame;
  OrderedJson json = {
      {"index", index},       {"kind", kind == FrameKind::kKeyframe ? "keyframe" : "inbetween"},
      {"samples", samples},   {"samples_traced", samplesTraced},
      {"holes", holes},       {"items_traced", itemSamples},
      {"disputed", disputed}, {"items", itemsTraced},
      {"warped", warped},     {"reused", reused},
      {"layered", layered},   {"unknown", unknown},
      {"rays", toJson(rays)}, {"seconds", seconds}};
  if (stopping) {
    const auto& [paths, mostPaths, predictedPercent, openTiles] = *stopping;
    json.update({{"paths", paths},
                 {"paths_most", mostPaths},
                 {"predicted_percent", predictedPercent},
                 {"tiles_open", openTiles}});
  }
  return json;
}

std::optional<FrameStatistics> frameStatisticsFrom(const nlohmann::json& value) {
  try {
    return frameFrom(value);
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

OrderedJson toJson(const Statistics& statistics) {
  const auto& [frames, segments, seconds] = statistics;
  OrderedJson segmentList = OrderedJson::array();
  for (const SegmentStatistics& segment : segments) segmentList.push_back(toJson(segment));
  OrderedJson frameList = OrderedJson::array();
  for (const FrameStatistics& frame : frames) frameList.push_back(toJson(frame));
  return {
      {"segments", std::move(segmentList)}, {"frames", std::move(frameList)}, {"seconds", toJson(seconds)}};
}

std::optional<Statistics> statisticsFrom(const nlohmann::json& value) {
  try {
    Statistics statistics;
    for (const nlohmann::json& frame : value.at("frames")) statistics.frames.push_back(frameFrom(frame));
    for (const nlohmann::json& segment : value.at("segments")) {
      statistics.segments.push_back(segmentFrom(segment));
    }
    statistics.seconds = secondsFrom(value.at("seconds"));
    return statistics;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

}  // namespace promenade::walkthrough
