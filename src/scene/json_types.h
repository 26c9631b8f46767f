#pragma once
// What type each property of glTF 2.0 and of the supported extensions must have.

#include <nlohmann/json.hpp>
#include <string>

namespace promenade::scene {

/// Checks every known property of `document` and rewrites whole numbers given as floats (glTF 2.0, 2.7:
/// allowed) to integers. Throws InputError(source, "accessors[3].count: expected ..., found ...").
/// Precondition: nesting is limited, since this recurses.
void checkPropertyTypes(nlohmann::json& document, const std::string& source);

}  // namespace promenade::scene
