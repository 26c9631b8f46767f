#pragma once
// Reads a glTF 2.0 scene (.gltf with its files, or .glb) into a validated Scene. docs/formats.md lists what
// is supported.

#include <cstdint>
#include <filesystem>

#include "src/scene/scene.h"

namespace promenade {

/// Which files a scene may pull in by its URIs.
enum class FileAccess {
  kSceneFolder,  ///< only files in the folder of the scene or below it, symbolic links resolved
  kAnywhere,
};

/// Limits that keep a small or hostile file from taking the machine. The message of a refusal names the
/// option to raise as the command line spells it.
struct LoadOptions {
  FileAccess fileAccess = FileAccess::kSceneFolder;  ///< --allow-outside-folder
  std::uint64_t maxFileBytes = 4ull << 30;           ///< --max-file-bytes: all files of the scene together
  std::uint64_t maxJsonBytes = 256ull << 20;         ///< --max-json-bytes: the JSON text of the scene
  std::uint64_t maxTextureBytes = 2ull << 30;  ///< --max-texture-bytes: decoded RGBA texels, without mip-maps
  int textureMegabytes = 1024;                 ///< --texture-memory: Scene::textureMegabytes
  std::uint64_t maxGeometryBytes = 8ull
                                   << 30;  ///< --max-geometry-bytes: decoded attributes, triangles, instances
  std::uint64_t maxTriangles = 200'000'000;  ///< --max-triangles: stored ones; instances do not count
  std::uint64_t maxInstances = 5'000'000;    ///< --max-instances
  /// --max-expansion: decoded geometry may be this many times the bytes that were read (but 256 MiB are
  /// always allowed).
  std::uint64_t maxExpansion = 100;
};

/// Reads and validates `file`. The scene's default scene is taken (else scene 0, else every root node), at
/// rest. The front of a triangle is where its vertices run counter-clockwise in object space; for instances
/// that mirror (negative determinant) this stays so, as glTF asks: transform geometric normals by the inverse
/// transpose. Throws InputError with one line that says where in the file, what was expected and what was
/// found.
[[nodiscard]] Scene loadScene(const std::filesystem::path& file, const LoadOptions& options = {});

/// Whether anything in the scene emits light: an emissive material in use, a punctual light or an
/// environment.
[[nodiscard]] bool hasLight(const Scene& scene);

/// The scene itself where it has light; else with a uniform white sky of radiance 1 and a notice among the
/// warnings.
[[nodiscard]] Scene ensureLight(Scene scene);

}  // namespace promenade
