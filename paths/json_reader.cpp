#include "paths/json_reader.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "paths/limits.h"
#include "paths/text.h"
#include "src/core/errors.h"
#include "src/core/nearest_name.h"

namespace promenade::paths {
namespace {

std::string found(const Json& value) {
  if (value.is_array()) return "an array of " + std::to_string(value.size());
  if (value.is_object()) return "an object";
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

std::string listed(std::initializer_list<std::string_view> names) {
  std::string list;
  for (const std::string_view name : names) {
    if (!list.empty()) list += ", ";
    list += '\'' + std::string(name) + '\'';
  }
  return list;
}

}  // namespace

Json parseJson(const std::string& text, const std::string& where) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const std::size_t end = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
    const auto begin = text.begin();
    const auto stop = begin + static_cast<std::ptrdiff_t>(end);
    const auto line = std::count(begin, stop, '\n') + 1;
    const std::size_t lineStart = end == 0 ? std::string::npos : text.rfind('\n', end - 1);
    const std::size_t column = lineStart == std::string::npos ? end + 1 : end - lineStart;
    throw InputError(where, "expected JSON, found a syntax error at line " + std::to_string(line) +
                                ", column " + std::to_string(column));
  } catch (const Json::exception&) {
    throw InputError(where, "expected JSON, found a number out of range");
  }
}

void expectKeys(const Json& value, std::initializer_list<std::string_view> known, const std::string& where) {
  if (!value.is_object()) throw InputError(where, "expected an object, found " + found(value));
  for (const auto& [key, unused] : value.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const std::string nearest = nearestName(key, std::span(known.begin(), known.size()));
    throw InputError(where, "unknown key " + found(Json(key)) + "; did you mean '" + nearest + "'?");
  }
}

double numberFrom(const Json& value, double limit, const std::string& where) {
  const double result = value.is_number() ? value.get<double>() : std::nan("");
  if (!(std::abs(result) <= limit)) {
    throw InputError(where, "expected a number of at most " + number(limit) + ", found " + found(value));
  }
  return result;
}

std::vector<double> numbersFrom(const Json& value, std::size_t count, double limit,
                                const std::string& where) {
  if (!value.is_array() || value.size() != count) {
    throw InputError(where, "expected " + std::to_string(count) + " numbers, found " + found(value));
  }
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(numberFrom(value[i], limit, element(where, i)));
  return numbers;
}

glm::dvec3 pointFrom(const Json& value, const std::string& where) {
  const auto xyz = numbersFrom(value, 3, kMaxCoordinateMetres, where);
  return {xyz[0], xyz[1], xyz[2]};
}

double fieldOfViewFrom(const Json& value, const std::string& where) {
  const double degrees = numberFrom(value, 1e6, where);
  if (!(degrees >= 0.01 && degrees <= 179.0)) {
    throw InputError(where,
                     "expected a vertical field of view of 0.01 to 179 degrees, found " + number(degrees));
  }
  return degrees * (std::numbers::pi / 180.0);
}

std::string choiceFrom(const Json& value, std::initializer_list<std::string_view> choices,
                       const std::string& where) {
  if (value.is_string()) {
    auto text = value.get<std::string>();
    if (std::find(choices.begin(), choices.end(), text) != choices.end()) return text;
  }
  throw InputError(where, "expected one of " + listed(choices) + ", found " + found(value));
}

std::string element(const std::string& array, std::size_t index) {
  return array + "[" + std::to_string(index) + "]";
}

}  // namespace promenade::paths
