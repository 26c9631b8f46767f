#pragma once
// Reading JSON with messages that say where, what was expected and what was found. Private to paths.

#include <glm/vec3.hpp>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace promenade::paths {

using Json = nlohmann::json;

/// Throws InputError with line and column for text that is not JSON.
[[nodiscard]] Json parseJson(const std::string& text, const std::string& where);

/// Throws InputError unless `value` is an object all of whose keys are among `known`; names the nearest known
/// key.
void expectKeys(const Json& value, std::initializer_list<std::string_view> known, const std::string& where);

/// A finite number with |value| <= limit.
[[nodiscard]] double numberFrom(const Json& value, double limit, const std::string& where);
/// An array of exactly `count` finite numbers with |value| <= limit.
[[nodiscard]] std::vector<double> numbersFrom(const Json& value, std::size_t count, double limit,
                                              const std::string& where);
/// Three coordinates in metres.
[[nodiscard]] glm::dvec3 pointFrom(const Json& value, const std::string& where);
/// A vertical field of view in degrees, in (0, 180), as radians.
[[nodiscard]] double fieldOfViewFrom(const Json& value, const std::string& where);
/// One of `choices`.
[[nodiscard]] std::string choiceFrom(const Json& value, std::initializer_list<std::string_view> choices,
                                     const std::string& where);

/// "keys[3]"
[[nodiscard]] std::string element(const std::string& array, std::size_t index);

}  // namespace promenade::paths
