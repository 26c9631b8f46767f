#include "src/app/verb_help.h"

#include <algorithm>

namespace promenade::app {

std::vector<std::string> alternatives(const std::string& value) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin < value.size();) {
    const std::size_t end = std::min(value.find('|', begin), value.size());
    words.push_back(value.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

bool isPlaceholder(const std::string& alternative) {
  return std::any_of(alternative.begin(), alternative.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
}

}  // namespace promenade::app
