#include "src/scene/json_types.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <unordered_map>

#include "src/core/errors.h"
#include "src/scene/text.h"

namespace promenade::scene {
namespace {

using nlohmann::json;

// A property may have more than one type, because some names have two meanings (`target` of a buffer view and
// of a channel).
enum Kind : unsigned {
  kIndex = 1u << 0,  // 0 .. 2^31 - 1
  kSize = 1u << 1,   // 0 .. 2^53 - 1
  kNumber = 1u << 2,
  kString = 1u << 3,
  kBoolean = 1u << 4,
  kNumbers = 1u << 5,  // array of numbers
  kIndices = 1u << 6,  // array of indices
  kObject = 1u << 7,
  kObjects = 1u << 8,   // array of objects
  kIndexMap = 1u << 9,  // object whose values are indices
  kIndexMaps = 1u << 10,
  kStrings = 1u << 11,
};

const std::unordered_map<std::string_view, unsigned>& kinds() {
  static const std::unordered_map<std::string_view, unsigned> table = {{"accessors", kObjects},
                                                                       {"animations", kObjects},
                                                                       {"buffers", kObjects},
                                                                       {"bufferViews", kObjects},
                                                                       {"cameras", kObjects},
                                                                       {"images", kObjects},
                                                                       {"materials", kObjects},
                                                                       {"meshes", kObjects},
                                                                       {"nodes", kObjects | kIndices},
                                                                       {"samplers", kObjects},
                                                                       {"scenes", kObjects},
                                                                       {"skins", kObjects},
                                                                       {"textures", kObjects},
                                                                       {"lights", kObjects},
                                                                       {"primitives", kObjects},
                                                                       {"channels", kObjects},
                                                                       {"targets", kIndexMaps},
                                                                       {"attributes", kIndexMap},
                                                                       {"asset", kObject},
                                                                       {"extensions", kObject},
                                                                       {"extensionsUsed", kStrings},
                                                                       {"extensionsRequired", kStrings},
                                                                       {"scene", kIndex},
                                                                       {"bufferView", kIndex},
                                                                       {"buffer", kIndex},
                                                                       {"byteOffset", kSize},
                                                                       {"byteLength", kSize},
                                                                       {"byteStride", kSize},
                                                                       {"count", kSize},
                                                                       {"componentType", kIndex},
                                                                       {"normalized", kBoolean},
                                                                       {"type", kString},
                                                                       {"max", kNumbers},
                                                                       {"min", kNumbers},
                                                                       {"sparse", kObject},
                                                                       {"indices", kIndex | kObject},
                                                                       {"values", kObject},
                                                                       {"name", kString},
                                                                       {"uri", kString},
                                                                       {"mimeType", kString},
                                                                       {"target", kIndex | kObject},
                                                                       {"mode", kIndex},
                                                                       {"material", kIndex},
                                                                       {"mesh", kIndex},
                                                                       {"camera", kIndex},
                                                                       {"skin", kIndex},
                                                                       {"skeleton", kIndex},
                                                                       {"joints", kIndices},
                                                                       {"children", kIndices},
                                                                       {"inverseBindMatrices", kIndex},
                                                                       {"matrix", kNumbers},
                                                                       {"translation", kNumbers},
                                                                       {"rotation", kNumbers | kNumber},
                                                                       {"scale", kNumbers | kNumber},
                                                                       {"weights", kNumbers},
                                                                       {"node", kIndex},
                                                                       {"path", kString},
                                                                       {"input", kIndex},
                                                                       {"output", kIndex},
                                                                       {"interpolation", kString},
                                                                       {"sampler", kIndex},
                                                                       {"source", kIndex},
                                                                       {"magFilter", kIndex},
                                                                       {"minFilter", kIndex},
                                                                       {"wrapS", kIndex},
                                                                       {"wrapT", kIndex},
                                                                       {"index", kIndex},
                                                                       {"texCoord", kIndex},
                                                                       {"strength", kNumber},
                                                                       {"pbrMetallicRoughness", kObject},
                                                                       {"baseColorFactor", kNumbers},
                                                                       {"baseColorTexture", kObject},
                                                                       {"metallicFactor", kNumber},
                                                                       {"roughnessFactor", kNumber},
                                                                       {"metallicRoughnessTexture", kObject},
                                                                       {"normalTexture", kObject},
                                                                       {"occlusionTexture", kObject},
                                                                       {"emissiveTexture", kObject},
                                                                       {"emissiveFactor", kNumbers},
                                                                       {"alphaMode", kString},
                                                                       {"alphaCutoff", kNumber},
                                                                       {"doubleSided", kBoolean},
                                                                       {"perspective", kObject},
                                                                       {"orthographic", kObject},
                                                                       {"yfov", kNumber},
                                                                       {"znear", kNumber},
                                                                       {"zfar", kNumber},
                                                                       {"aspectRatio", kNumber},
                                                                       {"xmag", kNumber},
                                                                       {"ymag", kNumber},
                                                                       {"spot", kObject},
                                                                       {"innerConeAngle", kNumber},
                                                                       {"outerConeAngle", kNumber},
                                                                       {"color", kNumbers},
                                                                       {"intensity", kNumber},
                                                                       {"range", kNumber},
                                                                       {"light", kIndex},
                                                                       {"offset", kNumbers},
                                                                       {"emissiveStrength", kNumber},
                                                                       {"ior", kNumber},
                                                                       {"transmissionFactor", kNumber},
                                                                       {"transmissionTexture", kObject},
                                                                       {"thicknessFactor", kNumber},
                                                                       {"thicknessTexture", kObject},
                                                                       {"attenuationDistance", kNumber},
                                                                       {"attenuationColor", kNumbers},
                                                                       {"specularFactor", kNumber},
                                                                       {"specularTexture", kObject},
                                                                       {"specularColorFactor", kNumbers},
                                                                       {"specularColorTexture", kObject},
                                                                       {"clearcoatFactor", kNumber},
                                                                       {"clearcoatTexture", kObject},
                                                                       {"clearcoatRoughnessFactor", kNumber},
                                                                       {"clearcoatRoughnessTexture", kObject},
                                                                       {"clearcoatNormalTexture", kObject},
                                                                       {"version", kString},
                                                                       {"minVersion", kString}};
  return table;
}

std::string describeKinds(unsigned kind) {
  static constexpr std::string_view kNames[] = {"an index",
                                                "a non-negative integer",
                                                "a number",
                                                "a string",
                                                "true or false",
                                                "an array of numbers",
                                                "an array of indices",
                                                "an object",
                                                "an array of objects",
                                                "an object of indices",
                                                "an array of objects of indices",
                                                "an array of strings"};
  std::string text;
  for (unsigned bit = 0; bit < std::size(kNames); ++bit) {
    if ((kind & (1u << bit)) != 0) {
      text += (text.empty() ? "" : " or ") + std::string(kNames[bit]);
    }
  }
  return text;
}

constexpr std::uint64_t kMostIndex = std::numeric_limits<std::int32_t>::max();
constexpr std::uint64_t kMostSize = (1ull << 53) - 1;

/// Rewrites 3.0 to 3, then says whether the value is an integer in [0, most].
bool isWhole(json& value, std::uint64_t most) {
  if (value.is_number_float()) {
    const double number = value.get<double>();
    if (number >= 0.0 && number <= static_cast<double>(most) && number == std::floor(number)) {
      value = static_cast<std::uint64_t>(number);
    }
  }
  return value.is_number_unsigned() && value.get<std::uint64_t>() <= most;
}

/// Integers become floats: tinygltf cuts integers of extensions to 32 bits.
bool isNumber(json& value) {
  if (value.is_number_integer()) {
    value = value.get<double>();
  }
  return value.is_number();
}

template <class Predicate>
bool isArrayOf(json& value, Predicate predicate) {
  if (!value.is_array()) {
    return false;
  }
  for (json& element : value) {
    if (!predicate(element)) {
      return false;
    }
  }
  return true;
}

bool isIndexMap(json& value) {
  if (!value.is_object()) {
    return false;
  }
  for (auto& element : value) {
    if (!isWhole(element, kMostIndex)) {
      return false;
    }
  }
  return true;
}

bool hasKind(json& value, unsigned kind) {
  const auto is = [kind](Kind one) { return (kind & one) != 0; };
  return (is(kIndex) && isWhole(value, kMostIndex)) || (is(kSize) && isWhole(value, kMostSize)) ||
         (is(kNumber) && isNumber(value)) || (is(kString) && value.is_string()) ||
         (is(kBoolean) && value.is_boolean()) || (is(kNumbers) && isArrayOf(value, isNumber)) ||
         (is(kIndices) && isArrayOf(value, [](json& v) { return isWhole(v, kMostIndex); })) ||
         (is(kObject) && value.is_object()) ||
         (is(kObjects) && isArrayOf(value, [](json& v) { return v.is_object(); })) ||
         (is(kIndexMap) && isIndexMap(value)) || (is(kIndexMaps) && isArrayOf(value, isIndexMap)) ||
         (is(kStrings) && isArrayOf(value, [](json& v) { return v.is_string(); }));
}

/// A short, printable piece of the value.
std::string excerpt(const json& value) {
  if (value.is_array()) return "an array";
  if (value.is_object()) return "an object";
  return printable(value.dump().substr(0, 40));
}

class TypeChecker {
 public:
  explicit TypeChecker(const std::string& source) : source_(source) {}

  void object(json& value, const std::string& path) {
    for (auto& [key, member] : value.items()) {
      const std::string place = path.empty() ? printable(key) : path + '.' + printable(key);
      const auto known = kinds().find(key);
      if (known != kinds().end() && !hasKind(member, known->second)) {
        throw InputError(source_,
                         place + ": expected " + describeKinds(known->second) + ", found " + excerpt(member));
      }
      if (known != kinds().end() && (known->second & (kIndexMap | kIndexMaps)) != 0) {
        continue;  // the names in there are the file's own
      }
      if (member.is_object()) {
        object(member, place);
      } else if (member.is_array() && !member.empty() && member.front().is_object()) {
        for (std::size_t i = 0; i < member.size(); ++i) {
          if (member[i].is_object()) {
            object(member[i], place + '[' + std::to_string(i) + ']');
          }
        }
      }
    }
  }

 private:
  const std::string& source_;
};

}  // namespace

void checkPropertyTypes(nlohmann::json& document, const std::string& source) {
  TypeChecker(source).object(document, "");
}

}  // namespace promenade::scene
