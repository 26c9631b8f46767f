#include "src/scene/load.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "src/scene/accessors.h"
#include "src/scene/glb.h"
#include "src/scene/gltf.h"
#include "src/scene/images.h"
#include "src/scene/materials.h"
#include "src/scene/meshes.h"
#include "src/scene/nodes.h"
#include "src/scene/placement.h"

namespace promenade {
namespace scene {
namespace {

// tinygltf is given neither files nor images; should it ask all the same, it gets nothing.
bool noFile(const std::string&, void*) {
  return false;
}
std::string samePath(const std::string& path, void*) {
  return path;
}
bool noRead(std::vector<unsigned char>*, std::string*, const std::string&, void*) {
  return false;
}
bool noWrite(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}
bool noImage(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return false;
}

/// tinygltf separates its messages by line breaks; the first says what is wrong.
std::string firstLine(const std::string& text) {
  return printable(text.substr(0, text.find('\n')));
}

tinygltf::Model parseModel(const std::string& text, const std::string& source) {
  tinygltf::TinyGLTF parser;
  parser.SetFsCallbacks({noFile, samePath, noRead, noWrite, nullptr});
  parser.SetImageLoader(noImage, nullptr);
  tinygltf::Model model;
  std::string error;
  std::string warning;
  bool good = false;
  try {
    good = parser.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                      static_cast<unsigned int>(text.size()), "", tinygltf::NO_REQUIRE);
  } catch (const std::exception& exception) {
    throw InputError(source, "is not valid glTF: " + firstLine(exception.what()));
  }
  // It reports some errors and goes on without the part that has them.
  if (!good || !error.empty()) {
    throw InputError(source, "is not valid glTF: " + firstLine(error));
  }
  return model;
}

void readBuffers(Gltf& gltf, SceneFiles& files, const std::shared_ptr<const Bytes>& glbBinary,
                 bool isBinary) {
  for (std::size_t i = 0; i < gltf.bufferSources.size(); ++i) {
    const BufferSource& source = gltf.bufferSources[i];
    const std::string place = at("buffers", i);
    std::shared_ptr<const Bytes> bytes;
    if (source.uri) {
      bytes = files.read(*source.uri, gltf.source + ": " + place + ".uri");
    } else if (isBinary && i == 0 && glbBinary) {
      bytes = glbBinary;
    }
    if (bytes && bytes->size() < source.byteLength) {
      gltf.fail(place + ".byteLength", "expected at most the " + std::to_string(bytes->size()) +
                                           " bytes there are, found " + std::to_string(source.byteLength));
    }
    gltf.buffers.push_back(std::move(bytes));
  }
}

Gltf readFiles(const std::filesystem::path& file, const LoadOptions& options, Budget& budget,
               SceneFiles& files, Warnings& warnings) {
  Gltf gltf;
  gltf.source = printable(file.string());
  constexpr std::uint64_t kMagicBytes = 4;
  const bool binary = isGlb(readRegularFile(file, budget, kMagicBytes));
  // One byte more than the limit shows that the limit is passed.
  const Bytes bytes = readRegularFile(file, budget, binary ? UINT64_MAX : options.maxJsonBytes + 1);
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::shared_ptr<const Bytes> glbBinary;
  if (binary) {
    const GlbChunks chunks = splitGlb(bytes, gltf.source);
    text = chunks.json;
    if (chunks.binary) {
      glbBinary = std::make_shared<const Bytes>(chunks.binary->begin(), chunks.binary->end());
    }
  }
  Document document = prepareDocument(text, gltf.source, options, warnings);
  gltf.model = parseModel(document.model, gltf.source);
  gltf.bufferSources = std::move(document.buffers);
  gltf.images = std::move(document.images);
  gltf.skins = std::move(document.skins);
  readBuffers(gltf, files, glbBinary, binary);
  return gltf;
}

void warnOfMotion(const Gltf& gltf, const std::vector<CameraAnimation>& cameras, Warnings& warnings) {
  const bool hasMovingCamera = std::any_of(
      cameras.begin(), cameras.end(), [](const CameraAnimation& camera) { return !camera.name.empty(); });
  if (!gltf.model.animations.empty() && !hasMovingCamera) {
    warnings.add("animations that move no camera are left out: the scene is shown at rest");
  }
}

/// The default material is kept only where something uses it or there is no other.
void dropUnusedDefault(Scene& scene) {
  const int defaultMaterial = static_cast<int>(scene.materials.size()) - 1;
  const bool used = std::any_of(scene.meshes.begin(), scene.meshes.end(),
                                [&](const Mesh& mesh) { return mesh.material == defaultMaterial; });
  if (!used && scene.materials.size() > 1) {
    scene.materials.pop_back();
  }
}

}  // namespace
}  // namespace scene

Scene loadScene(const std::filesystem::path& file, const LoadOptions& options) {
  using namespace scene;
  Budget budget(printable(file.string()), options);
  Warnings warnings;
  SceneFiles files(file, options.fileAccess, budget);
  const Gltf gltf = readFiles(file, options, budget, files, warnings);
  const Accessors accessors(gltf, budget);
  const std::vector<PlacedNode> nodes = placeNodes(gltf);

  Scene result;
  result.source = file.string();
  ImageStore images(gltf, accessors, files);
  result.materials = readMaterials(gltf, images, warnings);
  MeshStore meshes(gltf, accessors, result.materials, budget, warnings);
  result.instances = placeMeshes(gltf, nodes, accessors, meshes, budget, warnings);
  result.meshes = meshes.take();
  dropUnusedDefault(result);
  result.lights = placeLights(gltf, nodes, warnings);
  result.cameras = placeCameras(gltf, nodes, accessors, budget, warnings);
  result.images = images.decode(budget, warnings);
  result.textureMegabytes = options.textureMegabytes;
  warnOfMotion(gltf, result.cameras, warnings);
  if (result.instances.empty()) {
    warnings.add("the scene has no meshes to show");
  }
  result.warnings = warnings.take();
  return result;
}

}  // namespace promenade
