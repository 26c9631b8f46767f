// Rays a second against a bare Embree loop over the same rays, and paths a second of the whole renderer.
// The scene: a hall of 240 facetted columns and balls, 1.1 million triangles, under a uniform sky.

#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <memory>
#include <random>
#include <vector>

#include "src/render/embree_scene.h"
#include "src/render/path_renderer.h"
#include "src/render/ray_offset.h"
#include "src/render/surfaces.h"
#include "tests/render/scenes.h"

namespace promenade::render {
namespace {

constexpr int kPacket = EmbreeScene::kPacket;
constexpr Size kSize{640, 360};

Scene hall() {
  Scene scene;
  scene.materials.push_back(tests::diffuseMaterial(Rgb(0.6f, 0.55f, 0.5f)));
  Material polished;
  polished.metallic = 0.0f;
  polished.roughness = 0.3f;
  polished.baseColor = {0.7f, 0.3f, 0.2f, 1.0f};
  scene.materials.push_back(polished);
  tests::place(scene, tests::quad({-40.0f, 0.0f, 40.0f}, {80.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -80.0f}, 0));
  for (int i = 0; i < 240; ++i) {
    const auto x = static_cast<float>(i % 16), z = static_cast<float>(i / 16);
    tests::place(scene,
                 tests::sphere({2.5f * x - 18.75f, 0.6f + 0.4f * static_cast<float>(i % 3), 2.5f * z - 17.5f},
                               0.7f, 64, 36, i % 2));
  }
  scene.environment = tests::uniformSky(Rgb(1.0f));
  return scene;
}

struct Fixture {
  Scene scene = hall();
  Surfaces surfaces{scene};
  EmbreeScene wrapped{surfaces, 0};
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene bare = rtcNewScene(device);
  Camera camera = tests::lookingAt({0.0, 2.5, 22.0}, {0.0, 0.8, 0.0}, kSize, 0.9);
  std::vector<Ray> primary;  // in blocks of 4x4 samples, as the renderer takes them
  std::vector<Ray> shadow;   // one from each hit toward a random direction above it

  Fixture() {
    for (std::size_t i = 0; i < surfaces.instanceCount(); ++i) {
      const Surfaces::Triangles t = surfaces.triangles(i);
      RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
      rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, t.positions, 0,
                                 sizeof(glm::vec3), t.vertexCount);
      rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, t.indices, 0,
                                 sizeof(glm::uvec3), t.triangleCount);
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(bare, geometry);
      rtcReleaseGeometry(geometry);
    }
    rtcSetSceneFlags(bare, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(bare, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(bare);

    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    for (int y = 0; y < kSize.height; y += 4) {
      for (int x = 0; x < kSize.width; x += 4) {
        for (int i = 0; i < kPacket; ++i) {
          Ray ray;
          ray.origin = glm::vec3(camera.pose().eye);
          ray.direction = glm::vec3(camera.direction({x + i % 4 + 0.5, y + i / 4 + 0.5}));
          primary.push_back(ray);
          const Hit hit = wrapped.intersect(ray);
          if (!hit.found()) continue;
          const glm::vec3 front = glm::normalize(surfaces.corners(hit.instance, hit.triangle).frontNormal);
          const glm::vec3 facing = glm::dot(front, ray.direction) > 0.0f ? -front : front;
          const glm::vec3 to = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
          Ray s;
          s.origin = offsetRayOrigin(ray.origin + hit.distance * ray.direction, facing);
          s.direction = glm::dot(to, facing) > 0.0f ? to : -to;
          shadow.push_back(s);
        }
      }
    }
    shadow.resize(shadow.size() / kPacket * kPacket);
  }
  ~Fixture() {
    rtcReleaseScene(bare);
    rtcReleaseDevice(device);
  }
  Fixture(const Fixture&) = delete;
  Fixture& operator=(const Fixture&) = delete;
};

Fixture& fixture() {
  static Fixture instance;
  return instance;
}

template <class Trace>
void overPackets(const std::vector<Ray>& rays, const Trace& trace) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size() / kPacket, 64), [&](const auto& range) {
    for (std::size_t p = range.begin(); p < range.end(); ++p) trace(&rays[p * kPacket]);
  });
}

void fill(RTCRay16& packet, const Ray* rays) {
  for (int i = 0; i < kPacket; ++i) {
    packet.org_x[i] = rays[i].origin.x;
    packet.org_y[i] = rays[i].origin.y;
    packet.org_z[i] = rays[i].origin.z;
    packet.dir_x[i] = rays[i].direction.x;
    packet.dir_y[i] = rays[i].direction.y;
    packet.dir_z[i] = rays[i].direction.z;
    packet.tnear[i] = 0.0f;
    packet.tfar[i] = rays[i].farthest;
    packet.time[i] = 0.0f;
    packet.mask[i] = 0xffffffffu;
    packet.flags[i] = 0;
  }
}

constexpr auto allLanes() {
  std::array<int, kPacket> valid{};
  valid.fill(-1);
  return valid;
}

void bareIntersectPackets(const Fixture& f, const std::vector<Ray>& rays) {
  overPackets(rays, [&](const Ray* packet) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    RTCRayHit16 query;
    fill(query.ray, packet);
    for (int i = 0; i < kPacket; ++i) {
      query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    alignas(64) constexpr auto kValid = allLanes();
    rtcIntersect16(kValid.data(), f.bare, &context, &query);
    benchmark::DoNotOptimize(query);
  });
}

void bareOccludePackets(const Fixture& f, const std::vector<Ray>& rays) {
  overPackets(rays, [&](const Ray* packet) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay16 query;
    fill(query, packet);
    alignas(64) constexpr auto kValid = allLanes();
    rtcOccluded16(kValid.data(), f.bare, &context, &query);
    benchmark::DoNotOptimize(query);
  });
}

void bareOcclude(const Fixture& f, const std::vector<Ray>& rays) {
  overPackets(rays, [&](const Ray* packet) {
    for (int i = 0; i < kPacket; ++i) {
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      RTCRay ray{packet[i].origin.x,
                 packet[i].origin.y,
                 packet[i].origin.z,
                 0.0f,
                 packet[i].direction.x,
                 packet[i].direction.y,
                 packet[i].direction.z,
                 0.0f,
                 packet[i].farthest,
                 0xffffffffu,
                 0,
                 0};
      rtcOccluded1(f.bare, &context, &ray);
      benchmark::DoNotOptimize(ray);
    }
  });
}

/// Of all threads: says the same on a busy machine, where the clock on the wall does not.
double processorSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Both in turn over the same rays, so that they meet the same machine. "of bare" is asked to be 0.7 or more;
/// rays are counted by the second of one processor.
template <class Ours, class Bare>
void compareWithBare(benchmark::State& state, std::size_t rays, const Ours& ours, const Bare& bare) {
  double oursSeconds = 0.0, bareSeconds = 0.0;
  bare();
  ours();  // both touch their memory once before the clock runs
  for (auto _ : state) {
    const double start = processorSeconds();
    bare();
    const double middle = processorSeconds();
    ours();
    bareSeconds += middle - start;
    oursSeconds += processorSeconds() - middle;
  }
  const double all = static_cast<double>(rays) * static_cast<double>(state.iterations());
  state.counters["rays/s"] = all / oursSeconds;
  state.counters["bare rays/s"] = all / bareSeconds;
  state.counters["of bare"] = bareSeconds / oursSeconds;
}

void PrimaryRays(benchmark::State& state) {
  const Fixture& f = fixture();
  compareWithBare(
      state, f.primary.size(),
      [&] {
        overPackets(f.primary, [&](const Ray* rays) {
          std::array<Ray, kPacket> packet;
          std::copy(rays, rays + kPacket, packet.begin());
          benchmark::DoNotOptimize(f.wrapped.intersect(packet, kPacket));
        });
      },
      [&] { bareIntersectPackets(f, f.primary); });
}

// The same rays as the renderer makes them, with maps of depth, normals and items written.
void Visibility(benchmark::State& state) {
  const Fixture& f = fixture();
  const auto renderer = makePathRenderer(f.scene, {});
  compareWithBare(
      state, f.primary.size(), [&] { benchmark::DoNotOptimize(renderer->visibility(f.camera)); },
      [&] { bareIntersectPackets(f, f.primary); });
}

void ShadowRays(benchmark::State& state) {
  const Fixture& f = fixture();
  compareWithBare(
      state, f.shadow.size(),
      [&] {
        overPackets(f.shadow, [&](const Ray* rays) {
          for (int i = 0; i < kPacket; ++i) benchmark::DoNotOptimize(f.wrapped.transmittance(rays[i]));
        });
      },
      [&] { bareOcclude(f, f.shadow); });
}

void ShadowPackets(benchmark::State& state) {
  const Fixture& f = fixture();
  compareWithBare(
      state, f.shadow.size(),
      [&] {
        overPackets(f.shadow, [&](const Ray* rays) {
          std::array<Ray, kPacket> packet;
          std::copy(rays, rays + kPacket, packet.begin());
          benchmark::DoNotOptimize(f.wrapped.transmittance(packet, kPacket));
        });
      },
      [&] { bareOccludePackets(f, f.shadow); });
}

void RenderPaths(benchmark::State& state) {
  Fixture& f = fixture();
  PathSettings settings;
  settings.pathsPerSample = 16;
  const auto renderer = makePathRenderer(f.scene, settings);
  const Camera camera(f.camera.pose(), f.camera.verticalFieldOfView(), Size{160, 90});
  static_cast<void>(
      renderer->render(camera, 0));  // fills the sky guide, which is done once for a walkthrough
  const RayCounts before = renderer->rayCounts();
  for (auto _ : state) benchmark::DoNotOptimize(renderer->render(camera, 0));
  const RayCounts after = renderer->rayCounts();
  const auto rays = static_cast<double>(after.scattered + after.shadow + after.primary - before.scattered -
                                        before.shadow - before.primary);
  state.counters["rays/s"] = benchmark::Counter(rays, benchmark::Counter::kIsRate);
  state.counters["paths/s"] =
      benchmark::Counter(160.0 * 90.0 * settings.pathsPerSample * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate);
}

BENCHMARK(PrimaryRays)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(Visibility)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(ShadowRays)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(ShadowPackets)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(RenderPaths)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace promenade::render
