#pragma once
// What a user may type, as typed: the verbs turn the texts into values (values.h), so that every mistake gets
// one clear line.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "src/app/console.h"
#include "src/app/farm_options.h"
#include "src/app/ocio_options.h"
#include "src/app/scene_options.h"

namespace promenade::app {

struct RenderOptions {
  std::string scene;
  std::string path;      ///< empty: the scene's first camera animation
  std::string renderer;  ///< command that renders a keyframe; empty: none
  std::string from;      ///< folder of another renderer's frames; empty: none
  std::string out;
  std::string size = "1280x720";
  std::string fps;     ///< empty: the path's, else 25
  std::string frames;  ///< empty: all
  std::string supersample = "2";
  std::string filter = "box";
  std::string filterRadius = "3";
  std::string spp = "auto";
  std::string tolerance = "3";
  std::string spacing = "16";
  std::string verify = "1";            ///< per cent
  std::string footprintLimit = "2.5";  ///< areas
  std::string method = "ibr";
  std::string integrator = "walkthrough";
  std::string lightSolution;  ///< empty: DIR/light-solution.bin
  std::string display = "fhd-24";
  std::string tone;  ///< empty: neutral, or ocio where that is given
  OcioOptions ocio;
  std::string exposure = "auto";
  std::string unit = "auto";
  std::string environment;
  bool sky = false;
  std::string sun = "45,30";  ///< degrees: elevation, azimuth
  std::string video;          ///< empty: DIR/walkthrough.mp4
  std::string threads = "0";
  std::string seed = "0";
  bool resume = false;
  bool overwrite = false;
  bool maps = false;
  std::string preview;  ///< seconds; empty: the walk
  SceneOptions load;
  std::string command;  ///< the command line itself, for a shell
  /// Every option by its long name without "--", as typed, configured or by default; "true" for flags that
  /// are set. Sorted by name.
  std::map<std::string, std::string> all;
};

/// Choices of the metric's pipeline, each empty: as --metric has it.
struct PipelineOptions {
  std::string contrast, filters, bands, orientations, csf, csfAt, onset, masking, elevation, pooling, gain;
};

struct CompareOptions {
  std::string test;
  std::string reference;
  std::string velocity;  ///< empty: the Vector channels, else 0
  std::string display = "fhd-24";
  std::string ambient;  ///< lux; empty: the display's
  std::string ppd;      ///< empty: the display's
  std::string fps;      ///< empty: the files', else 25
  bool absolute = false;
  std::string metric = "aqm";
  std::string eye;  ///< empty: tracking
  bool exact = false;
  PipelineOptions pipeline;
  std::string layer;  ///< of OpenEXR files; empty: the whole picture
  std::string mask;   ///< image or sequence; empty: every pixel counts
  std::string tone;   ///< empty: neutral, or ocio where that is given
  OcioOptions ocio;
  std::string exposure = "auto";
  std::string unit = "auto";
  std::string maps;
  std::string heatmap;
  std::string csv;
  bool json = false;
  std::string failAbove;
  std::string threads = "0";
};

struct PathOptions {
  std::string file;
  std::string name;  ///< of an animation in a glTF file
  std::string fps;
  std::vector<std::string> to;  ///< format, file
  std::string plot;
  SceneOptions load;
};

struct EncodeOptions {
  std::string input;
  std::string output;
  std::string display;  ///< empty: as rendered, else fhd-24
  std::string tone;     ///< empty: neutral, or ocio where that is given
  OcioOptions ocio;
  std::string exposure = "auto";
  std::string unit = "auto";
  std::string fps;
  std::string frames;
  std::string crop;
};

struct ReportOptions {
  std::string folder;
  std::string reference;  ///< empty: none
  std::string out;        ///< empty: DIR/report.html
  std::string threads = "0";
};

struct InfoOptions {
  std::string scene;
  SceneOptions load;
};

struct ConvergeOptions {
  ConvergeOptions() { job.size = "160x90"; }
  RenderOptions job;  ///< scene, path, size, light, display and so on
  std::string frame = "0";
  std::string mostPaths = "256";
  std::string convergedPaths = "1024";
};

enum class Verb {
  kHelpOnly,
  kRender,
  kPlan,
  kWork,
  kAssemble,
  kSubmit,
  kCompare,
  kPath,
  kEncode,
  kReport,
  kInfo,
  kConverge
};

struct CommandLine {
  Verb verb = Verb::kHelpOnly;
  std::string text;  ///< kHelpOnly: what to print
  ConsoleOptions console;
  RenderOptions render;  ///< of kPlan, too
  WorkOptions work;
  AssembleOptions assemble;
  SubmitOptions submit;
  CompareOptions compare;
  PathOptions path;
  EncodeOptions encode;
  ReportOptions report;
  InfoOptions info;
  ConvergeOptions converge;
};

/// `arguments` without the program's name. Reads --config. Throws InputError for unknown or missing
/// arguments; an unknown option or key is answered with the nearest known one.
[[nodiscard]] CommandLine parseCommandLine(const std::vector<std::string>& arguments);

}  // namespace promenade::app
