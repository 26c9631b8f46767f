#include "src/app/fingerprint.h"

#include <bit>
#include <cstring>
#include <fstream>
#include <vector>

#include "src/app/formatted.h"
#include "src/core/errors.h"

namespace promenade::app {
namespace {

// The finalising mix of MurmurHash3 (Appleby), applied a word at a time.
std::uint64_t mixed(std::uint64_t h) {
  h ^= h >> 33;
  h *= 0xff51afd7ed558ccdull;
  h ^= h >> 33;
  h *= 0xc4ceb9fe1a85ec53ull;
  return h ^ (h >> 33);
}

}  // namespace

void Fingerprint::add(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    std::uint64_t word = 0;
    const std::size_t count = std::min<std::size_t>(8, bytes.size());
    std::memcpy(&word, bytes.data(), count);
    state_ = mixed(state_ * 3 + word);
    bytes = bytes.subspan(count);
  }
}

void Fingerprint::add(const std::string& text) {
  add(static_cast<double>(text.size()));
  add(std::as_bytes(std::span(text)));
}

void Fingerprint::add(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  add(std::as_bytes(std::span(&bits, 1)));
}

std::string Fingerprint::text() const {
  return formatted("%016llx", static_cast<unsigned long long>(state_));
}

void addScene(Fingerprint& fingerprint, const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) {
    fingerprint.addArray(std::span<const glm::vec3>(mesh.positions));
    fingerprint.addArray(std::span<const glm::vec3>(mesh.normals));
    fingerprint.addArray(std::span<const glm::vec4>(mesh.tangents));
    fingerprint.addArray(std::span<const glm::vec2>(mesh.texCoords[0]));
    fingerprint.addArray(std::span<const glm::vec2>(mesh.texCoords[1]));
    fingerprint.addArray(std::span<const glm::vec4>(mesh.colors));
    fingerprint.addArray(std::span<const glm::uvec3>(mesh.triangles));
    fingerprint.add(mesh.material);
  }
  for (const Instance& instance : scene.instances) {
    fingerprint.add(instance.mesh);
    fingerprint.add(std::as_bytes(std::span(&instance.worldFromObject, 1)));
  }
  for (const TextureImage& image : scene.images) {
    fingerprint.addArray(image.source->bytes());
  }
  if (scene.environment) {
    fingerprint.add(scene.environment->radiance.width());
    fingerprint.addArray(scene.environment->radiance.pixels());
    fingerprint.add(scene.environment->rotationRadians);
  }
}

void addFile(Fingerprint& fingerprint, const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<char> block(std::size_t{1} << 20);
  while (in) {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    fingerprint.add(std::as_bytes(std::span(block).first(static_cast<std::size_t>(in.gcount()))));
  }
  if (in.bad()) throw InputError(file.string(), "cannot be read");
}

void addPath(Fingerprint& fingerprint, const paths::CameraPath& path) {
  fingerprint.add(path.framesPerSecond);
  for (const paths::PathFrame& frame : path.frames) {
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) fingerprint.add(frame.pose.worldFromCamera[c][r]);
      fingerprint.add(frame.pose.eye[c]);
    }
    fingerprint.add(frame.verticalFieldOfView);
  }
}

}  // namespace promenade::app
