#pragma once
// Options of the verbs for render farms, for the parser of the command line.

#include <CLI/CLI.hpp>

#include "src/app/farm_options.h"

namespace promenade::app {

void addWork(CLI::App& verb, WorkOptions& options);
void addAssemble(CLI::App& verb, AssembleOptions& options);
void addSubmit(CLI::App& verb, SubmitOptions& options);

}  // namespace promenade::app
