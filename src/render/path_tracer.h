#pragma once
// The light that reaches the eye along one primary ray. Not part of the folder's public face.

#include <cstdint>
#include <optional>

#include "src/render/bright_surfaces.h"
#include "src/render/embree_scene.h"
#include "src/render/environment.h"
#include "src/render/irradiance_records.h"
#include "src/render/lights.h"
#include "src/render/path_renderer.h"
#include "src/render/pilot.h"
#include "src/render/sampler.h"
#include "src/render/sky_guide.h"
#include "src/render/surfaces.h"

namespace promenade::render {

class ScatteringSurface;

/// How many paths a line of sight gets where it needs any.
enum class Effort {
  kExactly,  ///< Stream::pathsPerPixel, or fewer where they are found to be clean
  /// Stream::pathsPerPixel; with a light solution only the first few of a reflection, which tell how many it
  /// takes until it is clean.
  kPilot,
  kGoOn,  ///< after kPilot, by the same call: what is missing of those that somebody decided on
};

/// Counted by whoever calls; one a thread.
struct PathRays {
  std::uint64_t scattered = 0;
  std::uint64_t shadow = 0;
  std::uint64_t paths = 0;       ///< that began at the ends of lines of sight
  std::uint64_t noisyLines = 0;  ///< lines of sight that more paths would still change
};

/// How much work goes into the light of a record. Its parts (paths; points on the sky, on lamps, on bright
/// surfaces) begin with fixed shares. Then whichever takes the most error away for its time is doubled, until
/// the standard error of the light's luminance is at most `relativeError` of it, or all of them together have
/// cost as much as `most` paths.
struct GatherEffort {
  int paths = 256;    ///< to begin with; powers of two are stratified best
  int points = 1024;  ///< ... on the sky and on lamps each, and a quarter as many on bright surfaces
  int most = 0;       ///< 0: no more than that
  float relativeError = 0.0f;
};

struct Gathered {
  SurfaceLight light;
  LightField field;  ///< the same by direction, in units of the light's luminance; z along Basis(normal)
};

class PathTracer {
 public:
  PathTracer(const Scene& scene, const PathSettings& settings);

  [[nodiscard]] const EmbreeScene& embree() const { return embree_; }
  [[nodiscard]] const Surfaces& surfaces() const { return surfaces_; }

  /// Light on matt surfaces from now on; null: paths alone. Not while others use the tracer.
  void setSolution(std::shared_ptr<const LightSolution> solution);
  /// Surfaces that gathering paths know of from now on, as lights; null: none. They must be of this tracer,
  /// and may be of another solution than the one it has now. Not while others use the tracer.
  void setBright(std::shared_ptr<const BrightSurfaces> bright);
  /// Those that the present solution shows.
  [[nodiscard]] std::shared_ptr<const BrightSurfaces> findBright() const;

  /// What a primary ray that hits nothing sees.
  [[nodiscard]] Rgb background(const glm::vec3& unitDirection) const;
  /// Mean of the paths from a primary hit. `pilots`: written by Effort::kPilot, read by kGoOn. `pixelWidth`:
  /// of a sample at distance 1 along the view axis, of which `direction` has component 1.
  [[nodiscard]] SampleRadiance shade(const Hit& hit, const Ray& primary, float pixelWidth,
                                     const Sampler::Stream& stream, Effort effort, Pilots& pilots,
                                     PathRays& rays) const;

  /// Light on a surface element: everything but what point, spot and directional lights send there directly,
  /// which every sample asks for itself. `numbers`: its pixel, frame and seed tell elements apart.
  [[nodiscard]] Gathered gather(const glm::vec3& position, const glm::vec3& normal,
                                const Sampler::Stream& numbers, const GatherEffort& effort,
                                PathRays& rays) const;

 private:
  struct Vertex;
  /// The rays that one path stands for, where they meet a surface.
  struct Pencil {
    float width = 0.0f;
    bool blurred = false;  ///< some scattering before was not a mirror's
  };
  struct Carried;
  struct Shares;
  struct Sight;
  class Gatherer;
  enum class DeltaLights { kIncluded, kExcluded };

  [[nodiscard]] Vertex vertexAt(const Hit& hit, const glm::vec3& unitDirection, const Pencil& pencil) const;
  /// Before next event estimation at the vertex.
  void lookAtSky(Vertex& vertex) const;
  [[nodiscard]] Shares firstShares(const Vertex& vertex) const;
  [[nodiscard]] Shares laterShares(const Vertex& vertex) const;
  template <class Scattering, class Add>
  void sampleLights(const Vertex& vertex, const Scattering& scattering, const Shares& shares, float times,
                    Sampler& sampler, DeltaLights deltaLights, const Add& add) const;
  struct TowardBright;
  /// A point on a bright surface, chosen `share` times. What it sends back is worth asking (sentBy()) only if
  /// its shadow ray arrives: most do not.
  template <class Scattering>
  [[nodiscard]] std::optional<TowardBright> chooseBright(const Vertex& vertex, const Scattering& scattering,
                                                         float share, Sampler& sampler) const;
  [[nodiscard]] Rgb sentBy(const TowardBright& bright, PathRays& rays) const;
  /// What a vertex sends on of the light that the solution says falls on it, and of the point, spot and
  /// directional lights.
  struct SentBack {
    Rgb radiance{0.0f};
    bool isAll = false;  ///< it sends nothing else on, but what it emits
  };
  [[nodiscard]] SentBack sentBack(const Vertex& vertex, const ScatteringSurface& scattering,
                                  const SurfaceLight& known, bool blurred, PathRays& rays) const;
  /// The same for a point that a blurred path comes to over that distance.
  [[nodiscard]] Rgb sentBackAt(const Hit& hit, const glm::vec3& direction, float width, float distance,
                               PathRays& rays) const;
  /// What a vertex sends on of the point, spot and directional lights that it sees: all of them, exactly.
  [[nodiscard]] SampleRadiance fromDeltaLights(const Vertex& vertex, const ScatteringSurface& scattering,
                                               PathRays& rays) const;
  /// `blurredOver`: distance to the last scattering, where some scattering blurs what lies there; nothing
  /// where it is seen sharply.
  [[nodiscard]] std::optional<SurfaceLight> lightFromSolution(const Vertex& vertex,
                                                              std::optional<float> blurredOver) const;
  // What arrives along a line of sight that ends at `hit`; what its end sends there; and by way of it, of
  // which it gets `share`.
  [[nodiscard]] SampleRadiance see(Sight sight, const Hit& hit, const Sampler::Stream& stream,
                                   PathRays& rays) const;
  [[nodiscard]] SampleRadiance seeSurface(const Sight& sight, const Vertex& vertex,
                                          const Sampler::Stream& stream, PathRays& rays) const;
  [[nodiscard]] Rgb seeBeyond(Sight sight, Rgb share, const Sampler::Stream& stream, PathRays& rays) const;
  [[nodiscard]] static Sight straightOn(Sight sight, const Vertex& vertex);
  [[nodiscard]] std::optional<Sight> turned(Sight sight, const Vertex& vertex,
                                            const glm::vec3& localDirection) const;
  // What `scattering` at the end of a line of sight sends along it.
  [[nodiscard]] SampleRadiance shadeByPaths(const Sight& sight, Vertex vertex,
                                            const ScatteringSurface& scattering,
                                            const Sampler::Stream& stream, PathRays& rays) const;
  [[nodiscard]] SampleRadiance shadeFromSolution(const Sight& sight, Vertex vertex,
                                                 ScatteringSurface scattering, const Sampler::Stream& stream,
                                                 PathRays& rays) const;
  /// The path that leaves a vertex at the end of a line of sight; nothing if it would leak through the
  /// surface.
  [[nodiscard]] std::optional<Carried> leave(const Sight& sight, const Vertex& vertex,
                                             const BsdfSample& sample, const Shares& shares) const;
  void scatter(const Vertex& vertex, const BsdfSample& sample, const glm::vec3& direction,
               const Shares& shares, Carried& path) const;
  [[nodiscard]] Rgb follow(Carried carried, Sampler& sampler, PathRays& rays) const;

  PathSettings settings_;
  Surfaces surfaces_;
  EmbreeScene embree_;
  std::optional<EnvironmentLight> environment_;
  std::optional<SkyGuide> sky_;
  Lights lights_;
  std::shared_ptr<const BrightSurfaces> bright_;
};

}  // namespace promenade::render
