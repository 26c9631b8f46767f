#include "src/app/verbs.h"
#include "src/scene/describe.h"
#include "src/scene/load.h"

namespace promenade::app {

ExitStatus runInfo(const InfoOptions& options, Console& console) {
  std::string text;
  for (const std::string& line : describe(loadScene(options.scene, loadOptions(options.load))))
    text += line + "\n";
  console.result(text);
  return ExitStatus::kDone;
}

}  // namespace promenade::app
