#pragma once
// Other programs.

#include <string>
#include <vector>

namespace promenade::app {

struct ProgramResult {
  int status = 0;      ///< exit status; 128 + the signal that ended it
  std::string output;  ///< what it wrote to stdout; stderr goes where ours goes
};

/// Runs a program (no shell; found along PATH) to its end. Throws InputError if there is no such program.
[[nodiscard]] ProgramResult runProgram(const std::vector<std::string>& arguments);

/// The file of the program that runs.
[[nodiscard]] std::string ownProgram();

}  // namespace promenade::app
