#include "src/app/report_page.h"
#include "src/app/threads.h"
#include "src/app/values.h"
#include "src/app/verbs.h"

namespace promenade::app {

ExitStatus runReport(const ReportOptions& options, Console& console) {
  const ThreadLimit threads(integerFrom(options.threads, 0, 4096, "--threads"));
  const std::filesystem::path folder(options.folder);
  const std::filesystem::path file =
      options.out.empty() ? folder / "report.html" : std::filesystem::path(options.out);
  std::optional<std::filesystem::path> reference;
  if (!options.reference.empty()) reference = options.reference;
  writeReportPage(folder, reference, file, console.progress());
  console.endProgress();
  console.result(file.string() + "\n");
  return ExitStatus::kDone;
}

}  // namespace promenade::app
