#include "src/app/option_values.h"

#include <algorithm>
#include <array>

#include "src/app/displays.h"
#include "src/core/tone_mapping.h"

namespace promenade::app {
namespace {

struct Values {
  const char* name;
  const char* values;
};

constexpr std::array kValues = {
    Values{"scene", "FILE"},
    Values{"file", "FILE"},
    Values{"test", "FILE"},
    Values{"reference", "FILE"},
    Values{"input", "FILE"},
    Values{"output", "FILE"},
    Values{"folder", "DIR"},
    Values{"--out", "DIR"},
    Values{"--renderer", "COMMAND"},
    Values{"--from", "DIR"},
    Values{"--path", "NAME|FILE"},
    Values{"--size", "WxH"},
    Values{"--fps", "RATE"},
    Values{"--frames", "A-B"},
    Values{"--frame", "N"},
    Values{"--supersample", "N"},
    Values{"--spp", "auto|N"},
    Values{"--preview", "SECONDS"},
    Values{"--most-spp", "N"},
    Values{"--converged-spp", "N"},
    Values{"--tolerance", "PERCENT"},
    Values{"--spacing", "N"},
    Values{"--method", "ibr|full"},
    Values{"--integrator", "path|walkthrough"},
    Values{"--light-solution", "FILE"},
    Values{"--unit", "auto|CD/M2"},
    Values{"--exposure", "auto|EV"},
    Values{"--ocio", "FILE"},
    Values{"--ocio-display", "NAME"},
    Values{"--ocio-view", "NAME"},
    Values{"--ocio-input", "NAME"},
    Values{"--environment", "FILE"},
    Values{"--sun", "ELEVATION,AZIMUTH"},
    Values{"--video", "FILE"},
    Values{"--threads", "N"},
    Values{"--texture-memory", "MB"},
    Values{"--task", "K"},
    Values{"--partition", "NAME"},
    Values{"--cpus", "N"},
    Values{"--memory", "SIZE"},
    Values{"--time", "LIMIT"},
    Values{"--seed", "N"},
    Values{"--metric", "aqm|aqm2000|revised|vdp|model1|model2|model3|rmse|psnr"},
    Values{"--eye", "tracking|fixating|stabilised"},
    Values{"--velocity", "VX,VY"},
    Values{"--ambient", "LUX"},
    Values{"--ppd", "N"},
    Values{"--maps", "DIR"},
    Values{"--heatmap", "DIR"},
    Values{"--csv", "FILE"},
    Values{"--fail-above", "PERCENT"},
    Values{"--plot", "FILE"},
    Values{"--crop", "WxH+X+Y"},
    Values{"--reference", "DIR"},
    Values{"--config", "FILE"},
    Values{"--layer", "NAME"},
    Values{"--name", "NAME"},
    Values{"--mask", "FILE"},
    Values{"--verify", "PERCENT"},
    Values{"--footprint-limit", "AREAS"},
    Values{"--contrast", "global|local"},
    Values{"--filter", "box|temporal"},
    Values{"--filter-radius", "FRAMES"},
    Values{"--filters", "energy|amplitude|laplacian"},
    Values{"--bands", "N"},
    Values{"--orientations", "N"},
    Values{"--csf", "kelly|moving|daly|mannos"},
    Values{"--csf-at", "bands|centres"},
    Values{"--onset", "HZ"},
    Values{"--masking", "mutual|test|reference|none"},
    Values{"--elevation", "unit|daly"},
    Values{"--pooling", "half-degree|none"},
    Values{"--gain", "N"},
    Values{"--log-level", "trace|debug|info|warning|error|critical|off"},
};

std::string toneNames() {
  std::string names;
  for (const ToneCurve curve : allToneCurves()) {
    if (!names.empty()) names += '|';
    names += nameOf(curve);
  }
  return names;
}

}  // namespace

std::string valuesOf(const std::string& name) {
  if (name == "--display") return displayNames() + "|FILE";
  if (name == "--tone") return toneNames();
  if (name == "--to") return "FORMAT FILE";
  if (name.starts_with("--max-")) return "N";
  const auto* found =
      std::find_if(kValues.begin(), kValues.end(), [&](const Values& v) { return name == v.name; });
  return found == kValues.end() ? std::string() : found->values;
}

}  // namespace promenade::app
