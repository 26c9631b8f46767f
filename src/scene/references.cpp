#include "src/scene/references.h"

#include <map>
#include <string_view>

#include "src/core/errors.h"
#include "src/scene/text.h"

namespace promenade::scene {
namespace {

using nlohmann::json;

/// What a property refers to: one index, an array or an object of them.
const std::map<std::string_view, const char*>& targets() {
  static const std::map<std::string_view, const char*> table = {{"bufferView", "bufferViews"},
                                                                {"buffer", "buffers"},
                                                                {"mesh", "meshes"},
                                                                {"camera", "cameras"},
                                                                {"skin", "skins"},
                                                                {"scene", "scenes"},
                                                                {"nodes", "nodes"},
                                                                {"children", "nodes"},
                                                                {"joints", "nodes"},
                                                                {"skeleton", "nodes"},
                                                                {"node", "nodes"},
                                                                {"inverseBindMatrices", "accessors"},
                                                                {"input", "accessors"},
                                                                {"output", "accessors"},
                                                                {"indices", "accessors"},
                                                                {"attributes", "accessors"},
                                                                {"targets", "accessors"},
                                                                {"source", "images"},
                                                                {"material", "materials"},
                                                                {"index", "textures"},
                                                                {"sampler", "samplers"}};
  return table;
}

class ReferenceChecker {
 public:
  ReferenceChecker(const json& document, const std::string& source) : document_(document), source_(source) {}

  void object(const json& value, const std::string& path, bool inAnimation) const {
    for (const auto& [key, member] : value.items()) {
      const std::string place = path.empty() ? printable(key) : path + '.' + printable(key);
      const auto target = targets().find(key);
      if (target != targets().end() && !(inAnimation && key == "sampler")) {
        reference(member, target->second, place);
      }
      if (key == "light" && path.ends_with("KHR_lights_punctual")) {
        light(member, place);
      }
      if (key == "attributes" || key == "targets") {
        continue;
      }
      if (member.is_object()) {
        object(member, place, inAnimation);
      } else if (member.is_array() && !member.empty() && member.front().is_structured()) {
        for (std::size_t i = 0; i < member.size(); ++i) {
          if (member[i].is_object()) {
            object(member[i], place + '[' + std::to_string(i) + ']', inAnimation || key == "animations");
          }
        }
      }
    }
  }

 private:
  [[nodiscard]] static std::size_t sizeOf(const json& holder, const char* section) {
    const auto found = holder.find(section);
    return found != holder.end() && found->is_array() ? found->size() : 0;
  }

  void index(const json& value, std::size_t size, const char* section, const std::string& place) const {
    if (value.is_number_unsigned() && value.get<std::size_t>() >= size) {
      throw InputError(source_, place + ": found " + value.dump() + ", but the file has " +
                                    std::to_string(size) + ' ' + section);
    }
  }

  /// Numbers at any depth of `value`: properties that are no references but share the name are objects of
  /// objects.
  void reference(const json& value, const char* section, const std::string& place) const {
    if (value.is_number_unsigned()) {
      index(value, sizeOf(document_, section), section, place);
    } else if (value.is_array()) {
      for (const json& element : value) {
        if (!element.is_object() || place.ends_with("targets")) {
          reference(element, section, place);
        }
      }
    } else if (value.is_object() && (place.ends_with("attributes") || place.ends_with("targets"))) {
      for (const auto& [key, element] : value.items()) {
        reference(element, section, place + '.' + printable(key));
      }
    }
  }

  void light(const json& value, const std::string& place) const {
    const auto extensions = document_.find("extensions");
    if (extensions != document_.end() && extensions->contains("KHR_lights_punctual")) {
      index(value, sizeOf((*extensions)["KHR_lights_punctual"], "lights"), "lights", place);
    } else {
      index(value, 0, "lights", place);
    }
  }

  const json& document_;
  const std::string& source_;
};

}  // namespace

void checkReferences(const nlohmann::json& document, const std::string& source) {
  ReferenceChecker(document, source).object(document, "", false);
}

}  // namespace promenade::scene
