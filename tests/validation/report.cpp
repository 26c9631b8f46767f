#include "tests/validation/report.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "src/io/text_file.h"

namespace promenade::validation {

std::string Report::markdownTable(const std::vector<std::vector<std::string>>& rows) {
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const std::string& cell : rows[i]) text += "| " + cell + " ";
    text += "|\n";
    if (i == 0) {
      for (std::size_t k = 0; k < rows[i].size(); ++k) text += k == 0 ? "|---" : "|---:";
      text += "|\n";
    }
  }
  return text + "\n";
}

void Report::table(const std::vector<std::vector<std::string>>& rows) {
  markdown_ += markdownTable(rows);
}

void Report::plot(const std::string& name, const std::string& title, const Axis& x, const Axis& y,
                  const std::vector<Series>& series) {
  std::filesystem::create_directories(docs_ / "validation");
  io::writeTextFile(docs_ / "validation" / (name + ".svg"), io::plotted(title, x, y, series));
  markdown_ += "![" + title + "](validation/" + name + ".svg)\n\n";
}

void Report::write(const std::string& preface) const {
  std::vector<std::vector<std::string>> summary{{"test", "found", "verdict"}};
  summary.insert(summary.end(), verdicts_.begin(), verdicts_.end());
  std::string text = preface + "## What fits and what does not\n\n";
  for (std::size_t i = 0; i < summary.size(); ++i) {
    text += "| " + summary[i][0] + " | " + summary[i][1] + " | " + summary[i][2] + " |\n";
    if (i == 0) text += "|---|---|---|\n";
  }
  text += markdown_;
  while (text.ends_with("\n\n")) text.pop_back();
  io::writeTextFile(docs_ / "validation.md", text);
}

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

}  // namespace promenade::validation
