#pragma once
// The surfaces that a frame's samples lie on, as triangles in the image of another camera.
//
// Four neighbours that lie on one surface are joined to two triangles. Where they do not, each keeps a
// quarter of its own cell in its own tangent plane, half a sample wide: nothing spans a depth edge, and a
// rail one sample wide stays one sample wide. Edges between two samples of one surface are shared, so that no
// cracks open along them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "ibr/reprojection.h"
#include "ibr/source_surface.h"
#include "src/core/frame.h"

namespace promenade::ibr {

/// A vertex in the target's image. 1/depth, unlike depth, is linear across the image of a plane; 0 is
/// infinitely far.
struct Corner {
  glm::vec2 pixel;
  float inverseDepth;  ///< < 0: behind the eye
};

struct Patch {
  std::array<Corner, 3> corners;
  glm::vec3 normal;  ///< world axes; 0 for background
  ItemId item;
};

class SurfacePatches {
 public:
  SurfacePatches(const Frame& source, const Camera& target, double creaseDegrees);

  /// Rows of cells between samples: the cells of row y have samples of rows y and y + 1 for corners, as far
  /// as there are such.
  [[nodiscard]] int firstRow() const { return -1; }
  [[nodiscard]] int endRow() const { return visibility_.camera.size().height; }

  /// Calls draw(const Patch&) for the patches of a row, in a fixed order. A patch with a corner behind the
  /// eye of the target is left out.
  template <class Draw>
  void forEachInRow(int row, const Draw& draw) const {
    for (int x = -1; x < visibility_.camera.size().width; ++x) {
      const Patches patches = cell(x, row);
      for (std::size_t i = 0; i < patches.count; ++i) draw(patches.patch[i]);
    }
  }

 private:
  struct Patches {
    std::array<Patch, 8> patch;  // left as it is up to `count`: clearing it would cost more than filling it
    std::size_t count = 0;
    /// Unless a corner is behind the eye.
    void add(const Patch& more) {
      for (const Corner& corner : more.corners) {
        if (corner.inverseDepth < 0.0f) return;
      }
      patch[count++] = more;
    }
  };
  /// A position in the source's image with the inverse depth of a surface there.
  struct SourcePoint {
    glm::vec2 pixel;
    float inverseDepth;
  };

  [[nodiscard]] Patches cell(int x, int y) const;
  void addQuarter(Patches& patches, glm::ivec2 sample, glm::ivec2 toward) const;
  [[nodiscard]] SourcePoint centre(glm::ivec2 sample) const;
  [[nodiscard]] SourcePoint onTangentPlane(glm::ivec2 sample, glm::vec2 offset) const;
  [[nodiscard]] Corner project(const SourcePoint& point) const;
  /// Whether two neighbours, `other` being right of or below `sample`, lie on one surface.
  [[nodiscard]] bool joined(glm::ivec2 sample, glm::ivec2 other) const;

  const Visibility& visibility_;
  SourceSurface surface_;
  RayBasis rays_;
  Reprojection reproject_;
  Image<Corner> centres_;
  Image<std::uint8_t> links_;  ///< bit 0: joined with the sample to the right, bit 1: with the one below
};

}  // namespace promenade::ibr
