#pragma once
// One function a verb, each in its own file (verb_*.cpp). Results go to files and to the console's stdout.
// All throw InputError, CannotContinue or Interrupted.

#include "src/app/console.h"
#include "src/app/exit_status.h"
#include "src/app/options.h"

namespace promenade::app {

ExitStatus runRender(const RenderOptions& options, Console& console);
ExitStatus runPlan(const RenderOptions& options, Console& console);
ExitStatus runWork(const WorkOptions& options, Console& console);
ExitStatus runAssemble(const AssembleOptions& options, Console& console);
ExitStatus runSubmit(const SubmitOptions& options, Console& console);
ExitStatus runCompare(const CompareOptions& options, Console& console);
ExitStatus runPath(const PathOptions& options, Console& console);
ExitStatus runEncode(const EncodeOptions& options, Console& console);
ExitStatus runReport(const ReportOptions& options, Console& console);
ExitStatus runInfo(const InfoOptions& options, Console& console);
ExitStatus runConverge(const ConvergeOptions& options, Console& console);

}  // namespace promenade::app
