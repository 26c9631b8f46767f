#pragma once
// Where the records of a light solution are: on what cameras see, and on what sends light there
// (irradiance_solution.h). Where they are does not depend on the seed: that is the error of their light
// alone. Not part of the folder's public face.

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "src/core/camera.h"
#include "src/render/irradiance_records.h"
#include "src/render/irradiance_solution.h"
#include "src/render/path_tracer.h"

namespace promenade::render {

/// A place on a matt surface that the walk looks at.
struct RecordCandidate {
  glm::vec3 position{0.0f};
  glm::vec3 normal{0.0f};
  glm::vec3 towardViewer{0.0f};  ///< unit
  float pixelWidth = 0.0f;       ///< of a display pixel there
};

/// Places the records of one spacing. All that it is given must outlive it.
class RecordPlacer {
 public:
  RecordPlacer(const PathTracer& tracer, const SolutionSettings& settings, const RecordSpacing& spacing,
               IrradianceRecords& records)
      : tracer_(tracer), settings_(settings), spacing_(spacing), records_(records) {}

  /// What a camera sees on a grid of that many display pixels. Nothing is placed where a record is that has
  /// no light yet, so that doing it again changes nothing.
  void placeSeen(const Camera& camera, int stride);
  /// What sends light to the records from `first` to `last`.
  void placeBounces(std::size_t first, std::size_t last);

 private:
  struct Open {
    RecordCandidate place;
    float mostReach;
    std::vector<RecordWall> walls;
  };

  /// Farthest that a new record at a place may reach; nothing if what is known there is good enough.
  [[nodiscard]] std::optional<float> wanted(const RecordCandidate& c) const;
  /// `find(i, candidates)` adds the i-th of `count` groups of candidates.
  using Find = std::function<void(std::size_t i, std::vector<RecordCandidate>& candidates)>;
  void place(std::size_t count, const Find& find);
  [[nodiscard]] float meanLuminance() const;

  const PathTracer& tracer_;
  const SolutionSettings& settings_;
  const RecordSpacing& spacing_;
  IrradianceRecords& records_;
  float darkness_ = 0.0f;
};

}  // namespace promenade::render
