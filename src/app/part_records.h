#pragma once
// What was done of a job: DIR/parts/000000.json, one a part (division.h), written when the part's
// frames are whole. From these a job is resumed, and the report of all of it is made.

#include <optional>
#include <string>

#include "src/app/output_folder.h"
#include "src/walkthrough/walkthrough.h"

namespace promenade::app {

struct PartRecord {
  walkthrough::Statistics statistics;
  double wallSeconds = 0.0;  ///< that the part took
};

class PartRecords {
 public:
  /// `folder` must outlive this. `walk`: the frames of the job.
  PartRecords(const OutputFolder& folder, std::string jobHash, walkthrough::FrameRange walk);

  /// Nothing unless the part is done: its record is whole and of this job, and all of its frames are there.
  /// Throws InputError for a file that cannot be read.
  [[nodiscard]] std::optional<PartRecord> find(const walkthrough::Segment& part) const;
  /// Call when the part's frames are written.
  void write(const walkthrough::Segment& part, const PartRecord& record) const;

 private:
  [[nodiscard]] std::filesystem::path fileOf(const walkthrough::Segment& part) const;

  const OutputFolder& folder_;
  std::string jobHash_;
  walkthrough::FrameRange walk_;
};

}  // namespace promenade::app
