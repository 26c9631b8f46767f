#include "src/render/path_settings.h"

#include <string>

#include "src/core/errors.h"

namespace promenade::render {
namespace {

void requireSetting(bool good, const std::string& what) {
  if (!good) throw InputError("path renderer settings", what);
}

}  // namespace

void requireGood(const PathSettings& settings) {
  requireSetting(settings.pathsPerSample >= 1,
                 "pathsPerSample: expected at least 1, found " + std::to_string(settings.pathsPerSample));
  requireSetting(settings.maxBounces >= 0,
                 "maxBounces: expected at least 0, found " + std::to_string(settings.maxBounces));
  requireSetting(settings.threads >= 0,
                 "threads: expected at least 0, found " + std::to_string(settings.threads));
  requireSetting(settings.sampleWidth > 0.0f, "sampleWidth: expected more than 0");
  requireSetting(settings.indirectLimit > 0.0f, "indirectLimit: expected more than 0");
  requireSetting(settings.leastIndirectRoughness >= 0.0f && settings.leastIndirectRoughness <= 1.0f,
                 "leastIndirectRoughness: expected a number from 0 to 1");
}

std::uint32_t seedOf(const PathSettings& settings) {
  return static_cast<std::uint32_t>(settings.seed ^ (settings.seed >> 32));
}

}  // namespace promenade::render
