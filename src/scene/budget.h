#pragma once
// Counts what a scene takes before it is taken, so that kilobytes of input never become gigabytes of memory.

#include <atomic>
#include <cstdint>
#include <string>

#include "src/scene/load.h"

namespace promenade::scene {

/// Every charge throws InputError when its limit is passed; the message names the option to raise.
/// Thread-safe.
class Budget {
 public:
  Budget(std::string source, const LoadOptions& options) : source_(std::move(source)), options_(options) {}

  void chargeFileBytes(std::uint64_t bytes);
  /// For memory of `bytes` each for `count` items: overflow-safe.
  void chargeGeometry(std::uint64_t count, std::uint64_t bytes);
  void chargeTexture(std::uint64_t width, std::uint64_t height);
  void chargeTriangles(std::uint64_t count);
  void chargeInstances(std::uint64_t count);

 private:
  std::string source_;
  LoadOptions options_;
  std::atomic<std::uint64_t> fileBytes_{0};
  std::atomic<std::uint64_t> geometryBytes_{0};
  std::atomic<std::uint64_t> textureBytes_{0};
  std::atomic<std::uint64_t> triangles_{0};
  std::atomic<std::uint64_t> instances_{0};
};

}  // namespace promenade::scene
