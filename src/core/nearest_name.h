#pragma once
// Error messages that say what was probably meant.

#include <span>
#include <string>
#include <string_view>

namespace promenade {

/// Number of insertions, deletions, substitutions and swaps of neighbouring letters that turn `a` into `b`
/// (optimal string alignment distance); upper and lower case are the same letter.
[[nodiscard]] int editDistance(std::string_view a, std::string_view b);

/// The candidate with the smallest edit distance (the first of equals); empty if there are no candidates.
[[nodiscard]] std::string nearestName(std::string_view name, std::span<const std::string_view> candidates);

}  // namespace promenade
