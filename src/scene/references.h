#pragma once
// Internal: every index in the JSON must name something that is there.

#include <nlohmann/json.hpp>
#include <string>

namespace promenade::scene {

/// Checks all references of glTF 2.0 and of the supported extensions, in use or not, except a channel's
/// sampler, which counts within its animation. Throws InputError(source, "meshes[0].primitives[1].material:
/// there is no material 7, ..."). Precondition: checkPropertyTypes() has passed.
void checkReferences(const nlohmann::json& document, const std::string& source);

}  // namespace promenade::scene
