#include "src/scene/budget.h"

#include <algorithm>
#include <limits>

#include "src/core/errors.h"

namespace promenade::scene {
namespace {

constexpr std::uint64_t kAlwaysAllowedBytes = 256ull << 20;

std::uint64_t saturatedProduct(std::uint64_t a, std::uint64_t b) {
  if (a != 0 && b > std::numeric_limits<std::uint64_t>::max() / a) {
    return std::numeric_limits<std::uint64_t>::max();
  }
  return a * b;
}

/// Adds without wrapping: a refused charge leaves the counter as it was.
bool charge(std::atomic<std::uint64_t>& used, std::uint64_t amount, std::uint64_t limit) {
  std::uint64_t before = used.load();
  do {
    if (before > limit || amount > limit - before) {
      return false;
    }
  } while (!used.compare_exchange_weak(before, before + amount));
  return true;
}

std::string refusal(const std::string& what, std::uint64_t limit, const std::string& option) {
  return what + " exceed the limit of " + std::to_string(limit) + " (raise it with " + option + ")";
}

}  // namespace

void Budget::chargeFileBytes(std::uint64_t bytes) {
  if (!charge(fileBytes_, bytes, options_.maxFileBytes)) {
    throw InputError(source_,
                     refusal("the bytes of the scene's files", options_.maxFileBytes, "--max-file-bytes"));
  }
}

void Budget::chargeGeometry(std::uint64_t count, std::uint64_t bytes) {
  const std::uint64_t amount = saturatedProduct(count, bytes);
  if (!charge(geometryBytes_, amount, options_.maxGeometryBytes)) {
    throw InputError(source_, refusal("the bytes of the decoded geometry", options_.maxGeometryBytes,
                                      "--max-geometry-bytes"));
  }
  const std::uint64_t allowed =
      std::max(kAlwaysAllowedBytes, saturatedProduct(fileBytes_.load(), options_.maxExpansion));
  if (geometryBytes_.load() > allowed) {
    throw InputError(source_, "the decoded geometry needs more than " +
                                  std::to_string(options_.maxExpansion) + " times the " +
                                  std::to_string(fileBytes_.load()) +
                                  " bytes of the scene's files (raise it with --max-expansion)");
  }
}

void Budget::chargeTexture(std::uint64_t width, std::uint64_t height) {
  if (!charge(textureBytes_, saturatedProduct(saturatedProduct(width, height), 4),
              options_.maxTextureBytes)) {
    throw InputError(source_, refusal("the bytes of the decoded textures", options_.maxTextureBytes,
                                      "--max-texture-bytes"));
  }
}

void Budget::chargeTriangles(std::uint64_t count) {
  if (!charge(triangles_, count, options_.maxTriangles)) {
    throw InputError(source_, refusal("the triangles", options_.maxTriangles, "--max-triangles"));
  }
}

void Budget::chargeInstances(std::uint64_t count) {
  if (!charge(instances_, count, options_.maxInstances)) {
    throw InputError(source_, refusal("the instances", options_.maxInstances, "--max-instances"));
  }
}

}  // namespace promenade::scene
