#include "src/app/part_records.h"

#include <nlohmann/json.hpp>

#include "src/app/formatted.h"
#include "src/io/json.h"
#include "src/walkthrough/statistics_json.h"

namespace promenade::app {

namespace fs = std::filesystem;

PartRecords::PartRecords(const OutputFolder& folder, std::string jobHash, walkthrough::FrameRange walk)
    : folder_(folder), jobHash_(std::move(jobHash)), walk_(walk) {}

fs::path PartRecords::fileOf(const walkthrough::Segment& part) const {
  return folder_.file("parts") / formatted("%06d.json", part.first);
}

std::optional<PartRecord> PartRecords::find(const walkthrough::Segment& part) const {
  const walkthrough::FrameRange frames = framesOf(part, walk_);
  for (int frame = frames.first; frame <= frames.last; ++frame) {
    if (!fs::is_regular_file(folder_.frame(frame))) return std::nullopt;
  }
  if (!fs::is_regular_file(fileOf(part))) return std::nullopt;
  try {
    const nlohmann::json root = nlohmann::json::parse(io::readTextFile(fileOf(part)));
    if (root.at("job") != jobHash_ || root.at("first") != part.first || root.at("last") != part.last) {
      return std::nullopt;
    }
    auto statistics = walkthrough::statisticsFrom(root);
    if (!statistics || static_cast<int>(statistics->frames.size()) != frames.count()) return std::nullopt;
    return PartRecord{std::move(*statistics), root.at("seconds_wall")};
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;  // another program's: the part is rendered again
  }
}

void PartRecords::write(const walkthrough::Segment& part, const PartRecord& record) const {
  nlohmann::ordered_json root = {
      {"job", jobHash_}, {"first", part.first}, {"last", part.last}, {"seconds_wall", record.wallSeconds}};
  root.update(walkthrough::toJson(record.statistics));
  io::writeJson(fileOf(part), root);
}

}  // namespace promenade::app
