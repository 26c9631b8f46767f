#include "src/render/path_renderer.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>

#include "src/core/errors.h"
#include "src/render/item_traits.h"
#include "src/render/material_textures.h"
#include "src/render/path_settings.h"
#include "src/render/path_tracer.h"

namespace promenade::render {
namespace {

constexpr int kTile = 16;  ///< samples along the edge of a task
constexpr int kBlock = 4;  ///< samples along the edge of a packet
static_assert(kBlock * kBlock == EmbreeScene::kPacket);

struct SamplePosition {
  int x = 0, y = 0;
};

struct PrimaryHit {
  const Ray& ray;
  const Hit& hit;
  const glm::vec3& tracedNormal;  ///< for Surfaces::facingNormal()
};

/// Samples of one tile in packets of neighbours.
class TileSamples {
 public:
  template <class Selected>
  TileSamples(Size size, int tileX, int tileY, const Selected& selected) {
    const int right = std::min(size.width, (tileX + 1) * kTile);
    const int bottom = std::min(size.height, (tileY + 1) * kTile);
    for (int blockY = tileY * kTile; blockY < bottom; blockY += kBlock) {
      for (int blockX = tileX * kTile; blockX < right; blockX += kBlock) {
        for (int y = blockY; y < std::min(bottom, blockY + kBlock); ++y) {
          for (int x = blockX; x < std::min(right, blockX + kBlock); ++x) {
            if (selected(x, y)) positions_[static_cast<std::size_t>(count_++)] = {x, y};
          }
        }
      }
    }
  }

  /// visit(position, primary hit) for each sample.
  template <class Visit>
  void castPrimaryRays(const EmbreeScene& embree, const Camera& camera, const Visit& visit) const {
    std::array<Ray, EmbreeScene::kPacket> rays;
    for (int first = 0; first < count_; first += EmbreeScene::kPacket) {
      const int count = std::min(count_ - first, EmbreeScene::kPacket);
      const SamplePosition* positions = &positions_[static_cast<std::size_t>(first)];
      for (int i = 0; i < count; ++i) {
        const glm::dvec2 centre(positions[i].x + 0.5, positions[i].y + 0.5);
        rays[static_cast<std::size_t>(i)].origin = glm::vec3(camera.pose().eye);
        rays[static_cast<std::size_t>(i)].direction = glm::vec3(camera.direction(centre));
      }
      const EmbreeScene::PacketHits found = embree.intersect(rays, count);
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        visit(positions[i], PrimaryHit{rays[i], found.hits[i], found.normals[i]});
      }
    }
  }

  [[nodiscard]] int count() const { return count_; }

 private:
  std::array<SamplePosition, kTile * kTile> positions_;
  int count_ = 0;
};

struct ShadedSample {
  SampleRadiance radiance;
  std::uint64_t paths = 0;  ///< traced for it
  bool isClean = true;      ///< more paths would change nothing that a viewer could see
};

/// A sample of a tile: its pilot's radiance first, then that of all its paths.
struct Traced {
  Ray ray;
  Hit hit;
  glm::vec3 normal;
  ShadedSample sample;
};

class PathRenderer final : public Renderer {
 public:
  PathRenderer(const Scene& scene, const PathSettings& settings)
      : settings_(settings),
        tracer_(scene, settings),
        traits_(itemTraits(scene)),
        arena_(settings.threads > 0 ? settings.threads : tbb::task_arena::automatic) {}

  [[nodiscard]] Visibility visibility(const Camera& camera) const override {
    Visibility result = emptyVisibility(camera);
    forEachTile(camera.size(), [&](int tileX, int tileY) {
      const TileSamples samples(camera.size(), tileX, tileY, [](int, int) { return true; });
      samples.castPrimaryRays(tracer_.embree(), camera, [&](SamplePosition p, const PrimaryHit& primary) {
        record(p, primary, result);
      });
      visibilityRays_ += static_cast<std::uint64_t>(samples.count());
    });
    return result;
  }

  void retrace(Frame& frame, const Mask& mask, SampleSource source, int frameIndex) const override {
    const Size size = frame.visibility.camera.size();
    assert(mask.size() == size && frame.diffuse.size() == size && frame.viewDependent.size() == size &&
           frame.source.size() == size);
    forEachTile(size, [&](int tileX, int tileY) {
      const TileSamples samples(size, tileX, tileY, [&](int x, int y) { return mask(x, y) != 0; });
      shadeTile(samples, frame.visibility.camera, allPaths(frameIndex),
                [&](SamplePosition p, const PrimaryHit&, const ShadedSample& sample) {
                  frame.diffuse(p.x, p.y) = sample.radiance.diffuse;
                  frame.viewDependent(p.x, p.y) = sample.radiance.viewDependent;
                  frame.source(p.x, p.y) = source;
                });
    });
  }

  [[nodiscard]] Refined refine(Frame& frame, const Mask& mask, PathRange paths,
                               int frameIndex) const override {
    const Size size = frame.visibility.camera.size();
    assert(mask.size() == size && frame.diffuse.size() == size && frame.viewDependent.size() == size &&
           frame.source.size() == size);
    assert(paths.count >= 1 && paths.before % paths.count == 0);
    const float share = static_cast<float>(paths.count) / static_cast<float>(paths.before + paths.count);
    Refined refined{Mask(size), 0};
    std::atomic<std::uint64_t> traced{0};
    forEachTile(size, [&](int tileX, int tileY) {
      const TileSamples samples(size, tileX, tileY, [&](int x, int y) { return mask(x, y) != 0; });
      std::uint64_t count = 0;
      shadeTile(samples, frame.visibility.camera, {frameIndex, paths, Effort::kExactly},
                [&](SamplePosition p, const PrimaryHit&, const ShadedSample& sample) {
                  Rgb& diffuse = frame.diffuse(p.x, p.y);
                  Rgb& viewDependent = frame.viewDependent(p.x, p.y);
                  if (paths.before == 0) {
                    diffuse = sample.radiance.diffuse;
                    viewDependent = sample.radiance.viewDependent;
                  } else if (sample.paths > 0) {
                    diffuse = glm::mix(diffuse, sample.radiance.diffuse, share);
                    viewDependent = glm::mix(viewDependent, sample.radiance.viewDependent, share);
                  }
                  frame.source(p.x, p.y) = SampleSource::kTraced;
                  refined.open(p.x, p.y) = sample.isClean ? 0 : 1;
                  count += sample.paths;
                });
      traced += count;
    });
    refined.paths = traced;
    return refined;
  }

  [[nodiscard]] Frame render(const Camera& camera, int frameIndex) const override {
    const Size size = camera.size();
    Frame frame;
    frame.visibility = emptyVisibility(camera);
    frame.diffuse = RadianceMap(size);
    frame.viewDependent = RadianceMap(size);
    frame.source = SourceMap(size, SampleSource::kTraced);
    forEachTile(size, [&](int tileX, int tileY) {
      const TileSamples samples(size, tileX, tileY, [](int, int) { return true; });
      shadeTile(samples, camera, allPaths(frameIndex),
                [&](SamplePosition p, const PrimaryHit& primary, const ShadedSample& sample) {
                  record(p, primary, frame.visibility);
                  frame.diffuse(p.x, p.y) = sample.radiance.diffuse;
                  frame.viewDependent(p.x, p.y) = sample.radiance.viewDependent;
                });
    });
    return frame;
  }

  [[nodiscard]] ItemTraits traits(ItemId item) const override {
    if (item == kNoItem || item > traits_.size()) return {};
    return traits_[item - 1];
  }

  [[nodiscard]] RayCounts rayCounts() const override {
    return {visibilityRays_.load(), primaryRays_.load(), scatteredRays_.load(), shadowRays_.load()};
  }

  [[nodiscard]] TextureUse textureUse() const override { return tracer_.surfaces().textures().use(); }

 private:
  static Visibility emptyVisibility(const Camera& camera) {
    Visibility v;
    v.camera = camera;
    v.depth = DepthMap(camera.size(), std::numeric_limits<float>::infinity());
    v.normal = NormalMap(camera.size(), glm::vec3(0.0f));
    v.item = ItemBuffer(camera.size(), kNoItem);
    return v;
  }

  /// The primary direction has component 1 along the view axis, so distances along the ray are depths.
  void record(SamplePosition p, const PrimaryHit& primary, Visibility& visibility) const {
    const Hit& hit = primary.hit;
    if (!hit.found()) return;
    visibility.depth(p.x, p.y) = hit.distance;
    visibility.normal(p.x, p.y) =
        tracer_.surfaces().facingNormal(hit.instance, primary.tracedNormal, primary.ray.direction);
    visibility.item(p.x, p.y) = hit.instance + 1;
  }

  /// What a tile's samples get.
  struct Work {
    int frameIndex;
    PathRange paths;
    Effort effort;
  };
  [[nodiscard]] Work allPaths(int frameIndex) const {
    return {frameIndex, {0, settings_.pathsPerSample}, Effort::kPilot};
  }

  template <class Store>
  void shadeTile(const TileSamples& samples, const Camera& camera, const Work& work,
                 const Store& store) const {
    if (samples.count() == 0) return;
    PathRays rays;
    const float pixelWidth = settings_.sampleWidth / static_cast<float>(camera.focalPixels());
    const auto shade = [&](const Traced& t, Effort effort, PilotedSample& piloted) {
      Sampler::Stream stream;
      stream.pixel = piloted.position;
      stream.frame = static_cast<std::uint32_t>(work.frameIndex);
      stream.seed = seedOf(settings_);
      stream.pathsPerPixel = static_cast<std::uint32_t>(work.paths.count);
      stream.block = static_cast<std::uint32_t>(work.paths.before / work.paths.count);
      const PathRays before = rays;
      ShadedSample sample;
      sample.radiance = tracer_.shade(t.hit, t.ray, pixelWidth, stream, effort, piloted.pilots, rays);
      sample.paths = rays.paths - before.paths;
      sample.isClean = rays.noisyLines == before.noisyLines;
      return sample;
    };
    std::vector<Traced> traced;
    std::vector<PilotedSample> piloted;
    traced.reserve(static_cast<std::size_t>(samples.count()));
    piloted.reserve(static_cast<std::size_t>(samples.count()));
    samples.castPrimaryRays(tracer_.embree(), camera, [&](SamplePosition p, const PrimaryHit& primary) {
      Traced& t = traced.emplace_back(Traced{primary.ray, primary.hit, primary.tracedNormal, {}});
      PilotedSample& pilots = piloted.emplace_back(PilotedSample{{p.x, p.y}, t.hit.instance, {}});
      if (t.hit.found()) {
        t.sample = shade(t, work.effort, pilots);
      } else {
        t.sample.radiance.diffuse = tracer_.background(glm::normalize(t.ray.direction));
      }
    });
    choosePaths(piloted);
    for (std::size_t i = 0; i < traced.size(); ++i) {
      Traced& t = traced[i];
      const std::vector<Pilot>& lines = piloted[i].pilots.lines;
      if (std::any_of(lines.begin(), lines.end(), [](const Pilot& p) { return p.wanted > p.paths; })) {
        t.sample = shade(t, Effort::kGoOn, piloted[i]);
      }
      store(SamplePosition{piloted[i].position.x, piloted[i].position.y}, PrimaryHit{t.ray, t.hit, t.normal},
            t.sample);
    }
    primaryRays_ += static_cast<std::uint64_t>(samples.count());
    scatteredRays_ += rays.scattered;
    shadowRays_ += rays.shadow;
  }

  template <class Work>
  void forEachTile(Size size, const Work& work) const {
    const int columns = (size.width + kTile - 1) / kTile;
    const int rows = (size.height + kTile - 1) / kTile;
    arena_.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range2d<int>(0, rows, 1, 0, columns, 1),
          [&](const tbb::blocked_range2d<int>& range) {
            for (int y = range.rows().begin(); y < range.rows().end(); ++y) {
              for (int x = range.cols().begin(); x < range.cols().end(); ++x) {
                if (settings_.checkpoint) settings_.checkpoint();
                work(x, y);
              }
            }
          },
          tbb::simple_partitioner());
    });
  }

  PathSettings settings_;
  PathTracer tracer_;
  std::vector<ItemTraits> traits_;
  mutable tbb::task_arena arena_;
  mutable std::atomic<std::uint64_t> visibilityRays_{0}, primaryRays_{0}, scatteredRays_{0}, shadowRays_{0};
};

}  // namespace

std::unique_ptr<Renderer> makePathRenderer(const Scene& scene, const PathSettings& settings) {
  requireGood(settings);
  return std::make_unique<PathRenderer>(scene, settings);
}

}  // namespace promenade::render
