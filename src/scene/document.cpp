#include "src/scene/document.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "src/core/errors.h"
#include "src/scene/json_types.h"
#include "src/scene/references.h"

namespace promenade::scene {
namespace {

using nlohmann::json;

// glTF itself nests about ten deep; the rest is room for extensions.
constexpr int kDeepestNesting = 64;

constexpr std::array<std::string_view, 15> kSupported = {
    "EXT_mesh_gpu_instancing", "EXT_texture_webp", "KHR_lights_punctual", "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_specular",
    "KHR_materials_transmission", "KHR_materials_unlit", "KHR_materials_volume", "KHR_mesh_quantization",
    "KHR_texture_transform",
    // Nothing to do for a still picture of the default look:
    "KHR_xmp", "KHR_xmp_json_ld", "KHR_materials_variants"};

bool isSupported(std::string_view extension) {
  return std::find(kSupported.begin(), kSupported.end(), extension) != kSupported.end();
}

/// Of these, only the name matters: see checkCompression().
constexpr std::string_view kDraco = "KHR_draco_mesh_compression";
constexpr std::string_view kMeshopt = "EXT_meshopt_compression";

/// Refuses deep nesting before any parser meets it.
void checkNesting(std::string_view text, const std::string& source) {
  int depth = 0;
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') {
        ++i;
      } else if (c == '"') {
        inString = false;
      }
    } else if (c == '"') {
      inString = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepestNesting) {
        throw InputError(source, "the JSON is nested more than " + std::to_string(kDeepestNesting) + " deep");
      }
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

json parse(std::string_view text, const std::string& source) {
  try {
    json document = json::parse(text);
    if (!document.is_object()) {
      throw InputError(source, "is not glTF: expected a JSON object");
    }
    return document;
  } catch (const json::exception& error) {
    throw InputError(source, "is not glTF: " + printable(error.what()));
  }
}

void checkVersion(const json& document, const std::string& source) {
  const auto asset = document.find("asset");
  if (asset == document.end() || !asset->is_object() || !asset->contains("version")) {
    throw InputError(source, "is not glTF: asset.version is missing");
  }
  for (const char* key : {"version", "minVersion"}) {
    if (!asset->contains(key)) {
      continue;
    }
    const json& version = (*asset)[key];
    const bool good = version.is_string() &&
                      (version == "2.0" ||
                       (std::string_view(key) == "version" && version.get<std::string>().starts_with("2.")));
    if (!good) {
      throw InputError(
          source, std::string("asset.") + key + ": expected \"2.0\", found " + printable(version.dump()));
    }
  }
}

void checkExtensions(const json& document, const std::string& source, Warnings& warnings) {
  std::vector<std::string> required;
  if (document.contains("extensionsRequired")) {
    required = document["extensionsRequired"].get<std::vector<std::string>>();
  }
  for (const std::string& name : required) {
    if (!isSupported(name)) {
      throw InputError(source, "requires the extension " + inQuotes(name) + ", which is not supported");
    }
  }
  if (document.contains("extensionsUsed")) {
    for (const std::string& name : document["extensionsUsed"].get<std::vector<std::string>>()) {
      if (!isSupported(name)) {
        warnings.add("the extension " + inQuotes(name) + " is not supported and is left out");
      }
    }
  }
}

/// The member of that name, or an empty value.
const json& member(const json& object, const char* key) {
  static const json empty;
  const auto found = object.find(key);
  return found == object.end() ? empty : *found;
}

/// Draco and meshopt may be used without being required, where the file has plain data to fall back on. Where
/// it has none, the extension is what is missing, not the data.
void checkCompression(const json& document, const std::string& source) {
  const auto refuse = [&](std::string_view extension) {
    throw InputError(source, "its data are compressed by the extension " + inQuotes(extension) +
                                 ", which is not supported");
  };
  for (const json& buffer : member(document, "buffers")) {
    if (!buffer.contains("uri") && member(buffer, "extensions").contains(kMeshopt)) {
      refuse(kMeshopt);
    }
  }
  const auto accessors = document.find("accessors");
  const auto hasData = [&](const json& accessor) {
    const std::size_t index = accessor.is_number_unsigned() ? accessor.get<std::size_t>() : SIZE_MAX;
    return accessors == document.end() || index >= accessors->size() ||
           (*accessors)[index].contains("bufferView");
  };
  for (const json& mesh : member(document, "meshes")) {
    for (const json& primitive : member(mesh, "primitives")) {
      if (member(primitive, "extensions").contains(kDraco) && primitive.contains("attributes") &&
          primitive["attributes"].contains("POSITION") && !hasData(primitive["attributes"]["POSITION"])) {
        refuse(kDraco);
      }
    }
  }
}

/// Removes what tinygltf need not see.
void strip(json& value) {
  if (value.is_object()) {
    value.erase("extras");
    const auto extensions = value.find("extensions");
    if (extensions != value.end() && extensions->is_object()) {
      for (auto it = extensions->begin(); it != extensions->end();) {
        const bool keep = isSupported(it.key()) || it.key() == kDraco || it.key() == kMeshopt;
        it = keep ? std::next(it) : extensions->erase(it);
      }
    }
  }
  if (value.is_structured()) {
    for (json& member : value) {
      if (member.is_structured()) {
        strip(member);
      }
    }
  }
}

/// Channels without a node are for extensions to define (glTF 2.0, 3.11); tinygltf takes them for errors.
void dropChannelsWithoutNode(json& document) {
  if (!document.contains("animations")) {
    return;
  }
  for (json& animation : document["animations"]) {
    if (!animation.contains("channels")) {
      continue;
    }
    json kept = json::array();
    for (json& channel : animation["channels"]) {
      if (!channel.contains("target") || !channel["target"].is_object() ||
          channel["target"].contains("node")) {
        kept.push_back(std::move(channel));
      }
    }
    animation["channels"] = std::move(kept);
  }
}

std::vector<BufferSource> takeBuffers(json& document, const std::string& source) {
  std::vector<BufferSource> buffers;
  if (!document.contains("buffers")) {
    return buffers;
  }
  for (const json& buffer : document["buffers"]) {
    if (!buffer.contains("byteLength")) {
      throw InputError(source, "buffers[" + std::to_string(buffers.size()) + "].byteLength: is missing");
    }
    BufferSource& entry = buffers.emplace_back();
    entry.byteLength = buffer["byteLength"].get<std::uint64_t>();
    if (buffer.contains("uri")) {
      entry.uri = buffer["uri"].get<std::string>();
    }
  }
  document.erase("buffers");
  return buffers;
}

std::vector<ImageSource> takeImages(json& document, const std::string& source) {
  std::vector<ImageSource> images;
  if (!document.contains("images")) {
    return images;
  }
  for (const json& image : document["images"]) {
    if (image.contains("uri") == image.contains("bufferView")) {
      throw InputError(source,
                       "images[" + std::to_string(images.size()) + "]: expected either uri or bufferView");
    }
    ImageSource& entry = images.emplace_back();
    entry.name = image.value("name", "");
    entry.uri = image.value("uri", "");
    entry.bufferView = image.value("bufferView", -1);
  }
  document.erase("images");
  return images;
}

std::vector<SkinSource> takeSkins(json& document, const std::string& source) {
  std::vector<SkinSource> skins;
  if (!document.contains("skins")) {
    return skins;
  }
  for (const json& skin : document["skins"]) {
    if (!skin.contains("joints")) {
      throw InputError(source, "skins[" + std::to_string(skins.size()) + "].joints: is missing");
    }
    skins.push_back({skin["joints"].get<std::vector<int>>(), skin.value("inverseBindMatrices", -1)});
  }
  document.erase("skins");
  return skins;
}

}  // namespace

Document prepareDocument(std::string_view text, const std::string& source, const LoadOptions& options,
                         Warnings& warnings) {
  if (text.size() > options.maxJsonBytes) {
    throw InputError(source, "its JSON exceeds the limit of " + std::to_string(options.maxJsonBytes) +
                                 " bytes (raise it with --max-json-bytes)");
  }
  checkNesting(text, source);
  json document = parse(text, source);
  checkVersion(document, source);
  strip(document);
  checkPropertyTypes(document, source);
  checkExtensions(document, source, warnings);
  checkCompression(document, source);
  checkReferences(document, source);
  dropChannelsWithoutNode(document);
  Document result;
  result.buffers = takeBuffers(document, source);
  result.images = takeImages(document, source);
  result.skins = takeSkins(document, source);
  result.model = document.dump();
  return result;
}

}  // namespace promenade::scene
