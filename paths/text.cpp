#include "paths/text.h"

#include <array>
#include <charconv>

namespace promenade::paths {

std::string number(double value) {
  std::array<char, 64> buffer{};
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 9);
  return error == std::errc() ? std::string(buffer.data(), end) : std::string("?");
}

std::string exactNumber(double value) {
  std::array<char, 64> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return error == std::errc() ? std::string(buffer.data(), end) : std::string("?");
}

std::string triple(const glm::dvec3& value) {
  return std::string("(") + number(value.x) + ", " + number(value.y) + ", " + number(value.z) + ")";
}

}  // namespace promenade::paths
