#include "src/app/division.h"

#include <nlohmann/json.hpp>

#include "src/app/job_record.h"
#include "src/walkthrough/statistics.h"

namespace promenade::app {
namespace {

constexpr const char* kFileName = "division.json";

}  // namespace

std::optional<Division> divisionIn(const OutputFolder& folder, const std::string& jobHash) {
  return fromRecord(folder.file(kFileName), jobHash, [](const nlohmann::json& root) {
    Division division{{}, root.at("seconds")};
    for (const nlohmann::json& part : root.at("parts")) {
      division.parts.push_back({part.at(0), part.at(1), 0});
    }
    return division;
  });
}

Division divide(const LoadedJob& job, const Renderer& renderer, const OutputFolder& folder,
                Console& console) {
  Division division;
  {
    const walkthrough::Stopwatch watch(division.seconds);
    division.parts = walkthrough::partsOf(job.path, renderer, job.settings, console.progress());
    console.endProgress();
  }
  nlohmann::ordered_json parts = nlohmann::ordered_json::array();
  for (const walkthrough::Segment& part : division.parts) parts.push_back({part.first, part.last});
  io::writeJson(
      folder.file(kFileName),
      nlohmann::ordered_json{{"job", job.hash}, {"seconds", division.seconds}, {"parts", std::move(parts)}});
  return division;
}

}  // namespace promenade::app
