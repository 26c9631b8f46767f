#pragma once
// Shadow rays in packets. Not part of the folder's public face.

#include <array>
#include <cstddef>
#include <utility>

#include "src/render/embree_scene.h"

namespace promenade::render {

/// Shadow rays that travel in packets, because they share their origin or nearly so. Calls
/// arrive(payload, transmittance) for each.
template <class Payload, class Arrive>
class ShadowBatch {
 public:
  ShadowBatch(const EmbreeScene& embree, Arrive arrive) : embree_(embree), arrive_(std::move(arrive)) {}

  void add(const Ray& ray, const Payload& payload) {
    const auto i = static_cast<std::size_t>(count_++);
    rays_[i] = ray;
    payloads_[i] = payload;
    if (count_ == EmbreeScene::kPacket) flush();
  }
  void flush() {
    if (count_ == 0) return;
    const auto transmittance = embree_.transmittance(rays_, count_);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i)
      arrive_(payloads_[i], transmittance[i]);
    count_ = 0;
  }

 private:
  const EmbreeScene& embree_;
  Arrive arrive_;
  int count_ = 0;
  std::array<Ray, EmbreeScene::kPacket> rays_;
  std::array<Payload, EmbreeScene::kPacket> payloads_;
};

template <class Payload, class Arrive>
ShadowBatch<Payload, Arrive> shadowBatch(const EmbreeScene& embree, Arrive arrive) {
  return ShadowBatch<Payload, Arrive>(embree, std::move(arrive));
}

}  // namespace promenade::render
