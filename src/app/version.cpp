#include "src/app/version.h"

#include <spdlog/version.h>
#include <tbb/version.h>
#include <CLI/Version.hpp>
#include <nlohmann/json.hpp>

#include "aqm/library_version.h"
#include "src/app/build_revision.h"
#include "src/app/formatted.h"
#include "src/io/library_versions.h"
#include "src/render/library_version.h"

namespace promenade::app {
namespace {

std::string dotted(int major, int minor, int patch) {
  return formatted("%d.%d.%d", major, minor, patch);
}

}  // namespace

std::string versionText() {
  std::string text = std::string("promenade ") + PROMENADE_VERSION + "\n";
  const auto line = [&](const std::string& name, const std::string& what) {
    std::string padded = name;
    padded.resize(15, ' ');
    text += "  " + padded + what + "\n";
  };
  line("revision", buildRevision());
  line("build", PROMENADE_BUILD);
  line("Embree", render::embreeVersion());
  for (const auto& [name, version] : io::libraryVersions()) line(name, version);
  line("FFTW", aqm::fftwVersion());
  line("TBB", std::string(TBB_runtime_version()).substr(0, 16));
  line("spdlog", dotted(SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH));
  line("CLI11", CLI11_VERSION);
  line("nlohmann-json",
       dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH));
  return text;
}

}  // namespace promenade::app
