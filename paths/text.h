#pragma once
// Numbers as text, independent of the locale.

#include <glm/vec3.hpp>
#include <string>

namespace promenade::paths {

/// Short, for messages: at most nine significant digits.
[[nodiscard]] std::string number(double value);
/// The shortest text that reads back as the same double, for files.
[[nodiscard]] std::string exactNumber(double value);
/// "(x, y, z)", for messages.
[[nodiscard]] std::string triple(const glm::dvec3& value);

}  // namespace promenade::paths
