// promenade: the command line. Everything that goes wrong ends here, in one clear line and an exit status.

#include <cstdio>
#include <new>
#include <string>
#include <vector>

#include "src/app/displays.h"
#include "src/app/exit_status.h"
#include "src/app/interrupt.h"
#include "src/app/machine.h"
#include "src/app/options.h"
#include "src/app/printable.h"
#include "src/app/verbs.h"
#include "src/core/errors.h"
#include "src/core/worker_threads.h"

namespace promenade::app {
namespace {

ExitStatus runVerb(const CommandLine& line, Console& console) {
  switch (line.verb) {
    case Verb::kRender:
      return runRender(line.render, console);
    case Verb::kPlan:
      return runPlan(line.render, console);
    case Verb::kWork:
      return runWork(line.work, console);
    case Verb::kAssemble:
      return runAssemble(line.assemble, console);
    case Verb::kSubmit:
      return runSubmit(line.submit, console);
    case Verb::kCompare:
      return runCompare(line.compare, console);
    case Verb::kPath:
      return runPath(line.path, console);
    case Verb::kEncode:
      return runEncode(line.encode, console);
    case Verb::kReport:
      return runReport(line.report, console);
    case Verb::kInfo:
      return runInfo(line.info, console);
    case Verb::kConverge:
      return runConverge(line.converge, console);
    case Verb::kHelpOnly:
      console.result(line.text == "?" ? displayList() : line.text);
      return ExitStatus::kDone;
  }
  return ExitStatus::kDone;
}

ExitStatus run(const std::vector<std::string>& arguments) {
  const CommandLine line = parseCommandLine(arguments);
  Console console(line.console);
  try {
    return runVerb(line, console);
  } catch (const std::exception& error) {
    console.logError(error.what());
    throw;
  }
}

ExitStatus failed(const std::string& message, ExitStatus status) {
  const bool colours = coloursOnStderr();
  std::fprintf(stderr, "promenade: %serror%s: %s\n", colours ? "\x1b[31;1m" : "", colours ? "\x1b[m" : "",
               printable(message).c_str());
  return status;
}

}  // namespace
}  // namespace promenade::app

int main(int argc, char** argv) {
  using promenade::app::ExitStatus;
  using promenade::app::failed;
  const promenade::WorkerThreads workers;
  ExitStatus status = ExitStatus::kDone;
  try {
    promenade::app::keepFreedMemory();
    promenade::app::installInterruptHandlers();
    status = promenade::app::run(std::vector<std::string>(argv + (argc > 0 ? 1 : 0), argv + argc));
  } catch (const promenade::InputError& error) {
    status = failed(error.what(), ExitStatus::kBadInput);
  } catch (const promenade::CannotContinue& error) {
    status = failed(error.what(), ExitStatus::kCannotContinue);
  } catch (const promenade::Interrupted&) {
    status = failed("interrupted; what was finished is whole", ExitStatus::kInterrupted);
  } catch (const std::bad_alloc&) {
    status = failed("out of memory", ExitStatus::kCannotContinue);
  } catch (const std::exception& error) {
    status = failed(std::string("unexpected: ") + error.what(), ExitStatus::kCannotContinue);
  }
  return static_cast<int>(status);
}
