#pragma once
// The page that the program writes.

#include <filesystem>
#include <string>
#include <vector>

#include "src/io/plot.h"

namespace promenade::validation {

using io::Axis;
using io::Mark;
using io::Scale;
using io::Series;

class Report {
 public:
  explicit Report(std::filesystem::path docs) : docs_(std::move(docs)) {}

  void heading(const std::string& text) { markdown_ += "\n## " + text + "\n\n"; }
  /// A paragraph.
  void text(const std::string& text) { markdown_ += text + "\n\n"; }
  /// The first row is the head.
  void table(const std::vector<std::vector<std::string>>& rows);
  [[nodiscard]] static std::string markdownTable(const std::vector<std::vector<std::string>>& rows);
  /// A row of the summary at the top of the page.
  void verdict(const std::string& test, const std::string& found, const std::string& judgement) {
    verdicts_.push_back({test, found, judgement});
  }
  /// Written to docs/validation/`name`.svg.
  void plot(const std::string& name, const std::string& title, const Axis& x, const Axis& y,
            const std::vector<Series>& series);
  /// Writes docs/validation.md.
  void write(const std::string& preface) const;

 private:
  std::filesystem::path docs_;
  std::string markdown_;
  std::vector<std::vector<std::string>> verdicts_;
};

/// printf's "%.*f"; "-" for what is not finite.
[[nodiscard]] std::string fixed(double value, int decimals);

}  // namespace promenade::validation
