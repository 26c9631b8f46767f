#include "tests/validation/tables.h"

#include <sstream>

#include "src/core/errors.h"
#include "src/io/text_file.h"

namespace promenade::validation {
namespace {

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

}  // namespace

std::vector<Row> readTable(const std::filesystem::path& file) {
  std::istringstream lines(io::readTextFile(file));
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> head = cellsOf(line);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = cellsOf(line);
    Row row;
    for (std::size_t i = 0; i < cells.size() && i < head.size(); ++i) row[head[i]] = cells[i];
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

double numberIn(const Row& row, const std::string& column) {
  const auto cell = row.find(column);
  try {
    if (cell != row.end()) return std::stod(cell->second);
  } catch (const std::logic_error&) {
  }
  throw InputError("column " + column, "expected a number");
}

}  // namespace promenade::validation
