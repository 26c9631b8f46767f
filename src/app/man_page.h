#pragma once
// Manual pages in man(7) format. Pure.

#include <string>
#include <vector>

#include "src/app/verb_help.h"

namespace promenade::app {

/// promenade(1): what the verbs are, exit statuses.
[[nodiscard]] std::string manPage(const std::vector<VerbHelp>& verbs, const std::string& version);

/// promenade-VERB(1).
[[nodiscard]] std::string manPageOf(const VerbHelp& verb, const std::string& version);

}  // namespace promenade::app
