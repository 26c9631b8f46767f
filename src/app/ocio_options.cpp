#include "src/app/ocio_options.h"

#include <cstdlib>

#include "src/core/errors.h"
#include "src/io/ocio.h"

namespace promenade::app {

std::shared_ptr<const ColourView> viewFrom(const OcioOptions& options) {
  std::string config = options.config;
  if (const char* known = std::getenv("OCIO"); config.empty() && known != nullptr) config = known;
  if (config.empty()) {
    throw InputError("--tone ocio: there is no config; expected --ocio FILE, or a file named by $OCIO");
  }
  return std::make_shared<const ColourView>(
      io::openColourView({config, options.display, options.view, options.input}));
}

}  // namespace promenade::app
