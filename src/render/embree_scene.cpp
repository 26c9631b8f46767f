#include "src/render/embree_scene.h"

#include <embree3/rtcore.h>

#include <cstddef>
#include <glm/mat4x3.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "src/core/errors.h"
#include "src/render/surfaces.h"

namespace promenade::render {
namespace {

constexpr int kPacket = EmbreeScene::kPacket;

/// What the occlusion filters gather on their way. A primitive that stands in several leaves of the hierarchy
/// is offered to the filter more than once, so the surfaces already passed are remembered; past kRemembered
/// the light is taken as blocked, which no scene of panes reaches.
struct ShadowContext {
  static constexpr int kRemembered = 24;
  struct Passed {
    std::uint32_t geometry, instance, triangle;
  };
  RTCIntersectContext embree;  // first, so that Embree's pointer is ours
  std::array<Rgb, kPacket> transmittance;
  std::array<int, kPacket> passedCount;
  std::array<std::array<Passed, kRemembered>, kPacket> passed;
};
static_assert(std::is_standard_layout_v<ShadowContext> && offsetof(ShadowContext, embree) == 0);

const Surfaces::FilterTarget& target(const RTCFilterFunctionNArguments* arguments) {
  return *static_cast<const Surfaces::FilterTarget*>(arguments->geometryUserPtr);
}

void rejectTransparentHits(const RTCFilterFunctionNArguments* arguments) {
  const Surfaces::FilterTarget& surface = target(arguments);
  const unsigned int n = arguments->N;
  for (unsigned int i = 0; i < n; ++i) {
    if (arguments->valid[i] == 0) continue;
    const std::uint32_t triangle = RTCHitN_primID(arguments->hit, n, i);
    const glm::vec2 barycentric(RTCHitN_u(arguments->hit, n, i), RTCHitN_v(arguments->hit, n, i));
    if (!surface.owner->isPresent(surface.mesh, triangle, barycentric)) arguments->valid[i] = 0;
  }
}

void attenuateShadow(const RTCFilterFunctionNArguments* arguments) {
  const Surfaces::FilterTarget& surface = target(arguments);
  auto& context = *reinterpret_cast<ShadowContext*>(arguments->context);
  const unsigned int n = arguments->N;
  for (unsigned int i = 0; i < n; ++i) {
    if (arguments->valid[i] == 0) continue;
    const std::uint32_t triangle = RTCHitN_primID(arguments->hit, n, i);
    const std::uint32_t geometry = RTCHitN_geomID(arguments->hit, n, i);
    const std::uint32_t instance = RTCHitN_instID(arguments->hit, n, i, 0);
    // The id is the lane, because Embree may repack the rays of a packet.
    const std::size_t lane = RTCRayN_id(arguments->ray, n, i);
    bool seen = false;
    for (int k = 0; k < context.passedCount[lane] && !seen; ++k) {
      const ShadowContext::Passed& p = context.passed[lane][static_cast<std::size_t>(k)];
      seen = p.geometry == geometry && p.instance == instance && p.triangle == triangle;
    }
    if (seen) {
      arguments->valid[i] = 0;
      continue;
    }
    const glm::vec2 barycentric(RTCHitN_u(arguments->hit, n, i), RTCHitN_v(arguments->hit, n, i));
    // The cosine is the same in object and world space up to the instance's scale, for which normalising in
    // object space is exact if the instance is a similarity.
    const glm::vec3 normal(RTCHitN_Ng_x(arguments->hit, n, i), RTCHitN_Ng_y(arguments->hit, n, i),
                           RTCHitN_Ng_z(arguments->hit, n, i));
    const glm::vec3 direction(RTCRayN_dir_x(arguments->ray, n, i), RTCRayN_dir_y(arguments->ray, n, i),
                              RTCRayN_dir_z(arguments->ray, n, i));
    const Rgb through =
        surface.owner->shadowTransmittance(surface.mesh, triangle, barycentric, normal, direction);
    const Rgb total = context.transmittance[lane] * through;
    if (context.passedCount[lane] == ShadowContext::kRemembered ||
        (total.x <= 0.0f && total.y <= 0.0f && total.z <= 0.0f)) {
      continue;  // blocked: the hit stands
    }
    context.transmittance[lane] = total;
    context.passed[lane][static_cast<std::size_t>(context.passedCount[lane]++)] = {geometry, instance,
                                                                                   triangle};
    arguments->valid[i] = 0;
  }
}

void throwOnError(RTCDevice device, const char* doing) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw CannotContinue(std::string("out of memory while ") + doing);
  throw CannotContinue(std::string("Embree error ") + std::to_string(static_cast<int>(error)) + " while " +
                       doing);
}

/// Owns a handle until it is attached.
template <class T, void (*release)(T)>
class Owned {
 public:
  explicit Owned(T handle) : handle_(handle) {}
  Owned(Owned&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  Owned& operator=(Owned&&) = delete;
  ~Owned() {
    if (handle_ != nullptr) release(handle_);
  }
  [[nodiscard]] T get() const { return handle_; }

 private:
  T handle_;
};
using OwnedDevice = Owned<RTCDevice, rtcReleaseDevice>;
using OwnedScene = Owned<RTCScene, rtcReleaseScene>;
using OwnedGeometry = Owned<RTCGeometry, rtcReleaseGeometry>;

OwnedScene newScene(RTCDevice device) {
  OwnedScene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
  return scene;
}

OwnedGeometry newTriangles(RTCDevice device, const Surfaces::Triangles& triangles) {
  OwnedGeometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             triangles.positions, 0, sizeof(glm::vec3), triangles.vertexCount);
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.indices, 0,
                             sizeof(glm::uvec3), triangles.triangleCount);
  rtcSetGeometryUserData(geometry.get(), const_cast<Surfaces::FilterTarget*>(triangles.filter));
  if (triangles.filter->cutOut) {
    rtcSetGeometryIntersectFilterFunction(geometry.get(), rejectTransparentHits);
  }
  if (triangles.filter->attenuates) rtcSetGeometryOccludedFilterFunction(geometry.get(), attenuateShadow);
  rtcCommitGeometry(geometry.get());
  return geometry;
}

Hit hitOf(float distance, std::uint32_t geometry, std::uint32_t instance, std::uint32_t triangle, float u,
          float v) {
  Hit hit;
  if (geometry == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.instance = instance != RTC_INVALID_GEOMETRY_ID ? instance : geometry;
  hit.triangle = triangle;
  hit.barycentric = {u, v};
  hit.distance = distance;
  return hit;
}

RTCRay rayOf(const Ray& ray) {
  RTCRay out;
  out.org_x = ray.origin.x;
  out.org_y = ray.origin.y;
  out.org_z = ray.origin.z;
  out.tnear = ray.nearest;
  out.dir_x = ray.direction.x;
  out.dir_y = ray.direction.y;
  out.dir_z = ray.direction.z;
  out.time = 0.0f;
  out.tfar = ray.farthest;
  out.mask = 0xffffffffu;
  out.id = 0;
  out.flags = 0;
  return out;
}

void fill(RTCRay16& packet, const std::array<Ray, kPacket>& rays, int count) {
  for (int i = 0; i < kPacket; ++i) {
    const Ray& ray = rays[static_cast<std::size_t>(i < count ? i : 0)];
    packet.org_x[i] = ray.origin.x;
    packet.org_y[i] = ray.origin.y;
    packet.org_z[i] = ray.origin.z;
    packet.tnear[i] = ray.nearest;
    packet.dir_x[i] = ray.direction.x;
    packet.dir_y[i] = ray.direction.y;
    packet.dir_z[i] = ray.direction.z;
    packet.time[i] = 0.0f;
    packet.tfar[i] = ray.farthest;
    packet.mask[i] = 0xffffffffu;
    packet.id[i] = static_cast<unsigned int>(i);
    packet.flags[i] = 0;
  }
}

std::array<int, kPacket> firstLanes(int count) {
  std::array<int, kPacket> valid{};
  for (int i = 0; i < count; ++i) valid[static_cast<std::size_t>(i)] = -1;
  return valid;
}

}  // namespace

struct EmbreeScene::Handles {
  OwnedDevice device;
  std::vector<OwnedScene> meshScenes;
  OwnedScene top;
};

EmbreeScene::EmbreeScene(const Surfaces& surfaces, int threads) {
  const std::string config = threads > 0 ? "threads=" + std::to_string(threads) : std::string();
  OwnedDevice device(rtcNewDevice(config.empty() ? nullptr : config.c_str()));
  if (device.get() == nullptr) throw CannotContinue("Embree cannot be started on this machine");
  RTCDevice d = device.get();
  OwnedScene top = newScene(d);
  std::vector<OwnedScene> meshScenes;
  std::vector<RTCScene> sceneOfMesh(surfaces.meshCount(), nullptr);
  for (std::size_t i = 0; i < surfaces.instanceCount(); ++i) {
    const Surfaces::Placement& placement = surfaces.placement(i);
    if (placement.flattened) {
      const OwnedGeometry geometry = newTriangles(d, surfaces.triangles(i));
      rtcAttachGeometryByID(top.get(), geometry.get(), static_cast<unsigned int>(i));
      continue;
    }
    RTCScene& meshScene = sceneOfMesh[placement.mesh];
    if (meshScene == nullptr) {
      meshScenes.push_back(newScene(d));
      meshScene = meshScenes.back().get();
      const OwnedGeometry geometry = newTriangles(d, surfaces.triangles(i));
      rtcAttachGeometry(meshScene, geometry.get());
      rtcCommitScene(meshScene);
    }
    const OwnedGeometry instance(rtcNewGeometry(d, RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(instance.get(), meshScene);
    rtcSetGeometryTransform(instance.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                            &placement.worldFromObject[0][0]);
    rtcCommitGeometry(instance.get());
    rtcAttachGeometryByID(top.get(), instance.get(), static_cast<unsigned int>(i));
  }
  throwOnError(d, "preparing the scene for ray tracing");
  rtcCommitScene(top.get());
  throwOnError(d, "building the hierarchy for ray tracing");
  handles_ = std::make_unique<Handles>(Handles{std::move(device), std::move(meshScenes), std::move(top)});
}

EmbreeScene::~EmbreeScene() = default;

Hit EmbreeScene::intersect(const Ray& ray) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query;
  query.ray = rayOf(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(handles_->top.get(), &context, &query);
  const RTCHit& hit = query.hit;
  return hitOf(query.ray.tfar, hit.geomID, hit.instID[0], hit.primID, hit.u, hit.v);
}

EmbreeScene::PacketHits EmbreeScene::intersect(const std::array<Ray, kPacket>& rays, int count) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  // Embree 3.13.5 never returns from coherent traversal of some packets in scenes with instances.
  if (handles_->meshScenes.empty()) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCRayHit16 query;
  fill(query.ray, rays, count);
  for (int i = 0; i < kPacket; ++i) {
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  alignas(64) const std::array<int, kPacket> valid = firstLanes(count);
  rtcIntersect16(valid.data(), handles_->top.get(), &context, &query);
  PacketHits packet;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    packet.hits[i] = hitOf(query.ray.tfar[i], query.hit.geomID[i], query.hit.instID[0][i],
                           query.hit.primID[i], query.hit.u[i], query.hit.v[i]);
    packet.normals[i] = {query.hit.Ng_x[i], query.hit.Ng_y[i], query.hit.Ng_z[i]};
  }
  return packet;
}

Rgb EmbreeScene::transmittance(const Ray& ray) const {
  ShadowContext context;
  rtcInitIntersectContext(&context.embree);
  context.transmittance[0] = Rgb(1.0f);
  context.passedCount[0] = 0;
  RTCRay query = rayOf(ray);
  rtcOccluded1(handles_->top.get(), &context.embree, &query);
  return query.tfar < 0.0f ? Rgb(0.0f) : context.transmittance[0];
}

std::array<Rgb, kPacket> EmbreeScene::transmittance(const std::array<Ray, kPacket>& rays, int count) const {
  ShadowContext context;
  rtcInitIntersectContext(&context.embree);
  context.transmittance.fill(Rgb(1.0f));
  context.passedCount.fill(0);
  RTCRay16 query;
  fill(query, rays, count);
  alignas(64) const std::array<int, kPacket> valid = firstLanes(count);
  rtcOccluded16(valid.data(), handles_->top.get(), &context.embree, &query);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    if (query.tfar[i] < 0.0f) context.transmittance[i] = Rgb(0.0f);
  }
  return context.transmittance;
}

EmbreeScene::Bounds EmbreeScene::bounds() const {
  RTCBounds b;
  rtcGetSceneBounds(handles_->top.get(), &b);
  if (!(b.lower_x <= b.upper_x)) return {};
  return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

}  // namespace promenade::render
