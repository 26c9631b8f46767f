#pragma once
// Where in the sky light comes from, seen from each part of the scene: next event estimation of the
// environment that knows about windows. Indoors, choosing directions by the environment's radiance alone
// finds a wall nearly every time.
//
// The scene's box is cut into cells; each cell has, for each of the six axis directions that a surface in it
// may face, a histogram over directions of visible radiance times cosine, filled by rays from random points
// of the cell when it is first asked for. (The portals of Bitterli et al., Portal-Masked Environment Map
// Sampling (EGSR 2015), without placing portals; the histograms are those of Jensen, Importance driven path
// tracing using the photon map (1995).) A cell looks only where a coarse cell around it has seen sky, which
// indoors is a small part of the directions.
//
// Directions are drawn from a mixture of the histogram and the environment's own density, so nothing is
// biased where the histogram is wrong. A histogram depends on nothing but its cell: images stay the same for
// any number of threads. Not part of the folder's public face.

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "src/render/cell_views.h"
#include "src/render/embree_scene.h"
#include "src/render/environment.h"

namespace promenade::render {

class SkyGuide {
 public:
  /// Bins of equal solid angle: the sphere of directions folded on a square of kEdge x kEdge (Clarberg, Fast
  /// Equal-Area Mapping of the (Hemi)Sphere using SIMD, 2008).
  static constexpr int kEdge = 32;
  static constexpr int kBins = kEdge * kEdge;

  /// What one cell sees on one side.
  struct View {
    std::array<float, kEdge>
        rowEnds;  ///< cumulative at the last bin of each row: a search stays in few cache lines
    std::array<float, kBins> cumulative;  ///< the last is 1 (unless nothing of the sky is seen)
    float light = 0.0f;  ///< that the histogram counts: radiance times cosine, summed over the bins
    float share = 0.0f;  ///< of samples drawn from the histogram; the rest from the environment
  };

  /// Both must outlive this.
  SkyGuide(const EmbreeScene& embree, const EnvironmentLight& environment);

  /// For a surface at `position` that faces `normal`. Any number of threads may ask.
  [[nodiscard]] const View& viewFrom(const glm::vec3& position, const glm::vec3& normal) const;

  [[nodiscard]] EnvironmentSample sample(const View& view, float choose, glm::vec2 u) const;
  /// As if sample() had chosen the unit vector `direction`.
  [[nodiscard]] EnvironmentSample toward(const View& view, const glm::vec3& direction) const;

 private:
  /// The sky in a bin.
  struct Bin {
    float radiance = 0.0f;  ///< mean over the bin and the colours
    int raysByLight = 0;    ///< that look at it besides those of every bin: none but where a sun stands
  };

  void fillBins();
  /// Density per solid angle with which sample() chooses the unit vector `direction`, which the environment
  /// by itself does with `environmentPdf`.
  [[nodiscard]] static float mixedPdf(const View& view, const glm::vec3& direction, float environmentPdf);
  /// `around`: what is seen from a larger cell; null: nothing is known.
  [[nodiscard]] std::unique_ptr<View> look(const CellSide& from, const View* around) const;

  const EmbreeScene& embree_;
  const EnvironmentLight& environment_;
  std::array<Bin, kBins> bins_{};
  /// What the sky would send to a surface on each side of a cell if nothing stood before it, as bins_ count
  /// it.
  std::array<float, CellSide::kSides> unobstructed_{};
  CellViews<View> coarse_, fine_;
};

}  // namespace promenade::render
