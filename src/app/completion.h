#pragma once
// Completion scripts for shells. Pure.

#include <string>
#include <vector>

#include "src/app/verb_help.h"

namespace promenade::app {

/// For `source <(promenade completion bash)`, or a file of bash-completion. Needs bash alone.
[[nodiscard]] std::string bashCompletion(const std::vector<VerbHelp>& verbs);

/// For a file _promenade in $fpath, or `source <(promenade completion zsh)` after compinit.
[[nodiscard]] std::string zshCompletion(const std::vector<VerbHelp>& verbs);

}  // namespace promenade::app
