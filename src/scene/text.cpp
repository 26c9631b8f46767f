#include "src/scene/text.h"

#include <utility>

namespace promenade::scene {
namespace {

constexpr std::size_t kLongestText = 120;
constexpr std::size_t kMostWarnings = 100;

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  std::size_t end = std::min(text.size(), kLongestText);
  // Not within a UTF-8 sequence.
  while (end < text.size() && end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u) {
    --end;
  }
  for (const char c : text.substr(0, end)) {
    const auto byte = static_cast<unsigned char>(c);
    result.push_back(byte < 0x20 || byte == 0x7F ? '?' : c);
  }
  if (end < text.size()) {
    result += "...";
  }
  return result;
}

std::string inQuotes(std::string_view text) {
  return '"' + printable(text) + '"';
}

void Warnings::add(std::string line) {
  if (seen_.contains(line)) {
    return;
  }
  if (lines_.size() >= kMostWarnings) {
    ++unsaid_;
    return;
  }
  seen_.insert(line);
  lines_.push_back(std::move(line));
}

std::vector<std::string> Warnings::take() {
  if (unsaid_ > 0) {
    lines_.push_back("... and " + std::to_string(unsaid_) + " more warnings");
    unsaid_ = 0;
  }
  seen_.clear();
  return std::exchange(lines_, {});
}

}  // namespace promenade::scene
