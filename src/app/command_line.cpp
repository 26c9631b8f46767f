#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include "src/app/completion.h"
#include "src/app/config_file.h"
#include "src/app/farm_command_line.h"
#include "src/app/man_page.h"
#include "src/app/option_values.h"
#include "src/app/options.h"
#include "src/app/printable.h"
#include "src/app/shell_words.h"
#include "src/app/verb_help.h"
#include "src/app/version.h"
#include "src/core/errors.h"
#include "src/core/nearest_name.h"
#include "src/io/text_file.h"

namespace promenade::app {
namespace {

void addSceneOptions(CLI::App& verb, SceneOptions& o) {
  const std::string group = "Limits of the scene reader";
  verb.add_flag("--allow-outside-folder", o.allowOutsideFolder,
                "The scene may name files outside of its folder")
      ->group(group);
  verb.add_option("--max-file-bytes", o.maxFileBytes, "All files of the scene together")->group(group);
  verb.add_option("--max-json-bytes", o.maxJsonBytes, "The scene's JSON")->group(group);
  verb.add_option("--max-texture-bytes", o.maxTextureBytes, "Decoded textures")->group(group);
  verb.add_option(
          "--texture-memory", o.textureMemory,
          "MB of decoded textures that are kept; what does not fit is decoded again when it is needed")
      ->capture_default_str()
      ->group(group);
  verb.add_option("--max-geometry-bytes", o.maxGeometryBytes, "Decoded geometry")->group(group);
  verb.add_option("--max-triangles", o.maxTriangles, "Stored triangles")->group(group);
  verb.add_option("--max-instances", o.maxInstances, "Placed meshes")->group(group);
  verb.add_option("--max-expansion", o.maxExpansion, "Decoded bytes for each byte read")->group(group);
}

void addTone(CLI::App& verb, std::string& tone, std::string& unit, OcioOptions& ocio) {
  verb.add_option(
      "--tone", tone,
      "How radiance becomes light on the display. Curves: neutral, linear (clipped), agx (filmic), "
      "schlick (rational), chiu (every place by what surrounds it), ocio (of --ocio). As the eye adapts "
      "along the "
      "walk: tumblin-rushmeier (equal brightness), ward (what is just visible stays so), ferwerda "
      "(the same of cones and rods: the dark takes colour and detail), larson (what is there "
      "shares the display's range) (default: neutral, or ocio with --ocio)");
  verb.add_option("--unit", unit,
                  "For tones of the eye: cd/m2 of a radiance of 1 (default: 1 in scenes with punctual "
                  "lights, else what makes exposed white 159)")
      ->capture_default_str();
  verb.add_option(
      "--ocio", ocio.config,
      "OpenColorIO config whose view is shown, instead of a curve (with --tone ocio alone: $OCIO)");
  verb.add_option("--ocio-display", ocio.display, "Display of the config (default: its default)");
  verb.add_option("--ocio-view", ocio.view, "View of that display (default: its default)");
  verb.add_option("--ocio-input", ocio.input,
                  "The config's name of linear Rec.709 (default: by usual names or ACES, else scene_linear)");
}

void addRender(CLI::App& verb, RenderOptions& o) {
  verb.add_option("scene", o.scene,
                  "Scene: .glb or .gltf; with --renderer what the command reads, or nothing");
  verb.add_option("--path", o.path, "Camera path: a file, or an animation or camera of the scene by name");
  verb.add_option("--renderer", o.renderer,
                  "Command that renders a keyframe, with {frame}, {camera}, {out} and {scene} in it: nothing "
                  "is ray traced then (docs/external-renderers.md)");
  verb.add_option(
      "--from", o.from,
      "Folder of OpenEXR frames with Z that another renderer made: those that are missing between "
      "them are made");
  verb.add_option("--out", o.out, "Folder for frames, video and report")->required();
  verb.add_option("--size", o.size, "Frame size in pixels")->capture_default_str();
  verb.add_option("--fps", o.fps, "Frame rate (default: the path's, else 25)");
  verb.add_option("--frames", o.frames, "Only frames A-B, numbered from 0");
  verb.add_option("--supersample", o.supersample, "Samples along a pixel's edge")->capture_default_str();
  verb.add_option(
          "--filter", o.filter,
          "How samples become pixels. box: the mean of the frame's own; temporal: also of the samples of "
          "the frames around it, moved with the camera (antialiasing; not with --from, --renderer)")
      ->capture_default_str();
  verb.add_option("--filter-radius", o.filterRadius,
                  "Frames before and after that --filter temporal looks at")
      ->capture_default_str();
  verb.add_option("--spp", o.spp,
                  "Paths a sample, or 'auto': in every part of a frame until a viewer would not see noise")
      ->capture_default_str();
  verb.add_option("--tolerance", o.tolerance, "Per cent of pixels that may differ visibly")
      ->capture_default_str();
  verb.add_option("--spacing", o.spacing,
                  "Frames from keyframe to keyframe at most, at first: fewer where more would cost more")
      ->capture_default_str();
  verb.add_option(
          "--verify", o.verify,
          "Per cent of the warped samples of a segment's middle that are ray traced to check the warp")
      ->capture_default_str();
  verb.add_option("--footprint-limit", o.footprintLimit,
                  "What would be warped from samples that cover more than so many times its area is a hole")
      ->capture_default_str();
  verb.add_option("--method", o.method, "ibr, or full: every frame ray traced")->capture_default_str();
  verb.add_option(
          "--integrator", o.integrator,
          "Light transport: walkthrough (light on matt surfaces solved once for the whole walk), or path "
          "(unbiased, noisier)")
      ->capture_default_str();
  verb.add_option(
      "--light-solution", o.lightSolution,
      "File that keeps the light of --integrator walkthrough: read if it is there, extended where this walk "
      "looks anew (default: DIR/light-solution.bin)");
  verb.add_option("--display", o.display, "Display preset or file; '?' lists them")->capture_default_str();
  addTone(verb, o.tone, o.unit, o.ocio);
  verb.add_option("--exposure", o.exposure, "Stops, or 'auto': one value for the walk")
      ->capture_default_str();
  verb.add_option("--environment", o.environment, "Light from infinity: a lat-long .exr or .hdr image");
  verb.add_flag("--sky", o.sky, "Light from infinity: a clear daylight sky");
  verb.add_option("--sun", o.sun, "Where --sky has its sun: elevation and azimuth in degrees")
      ->capture_default_str();
  verb.add_option("--video", o.video, "Video file (default: DIR/walkthrough.mp4)");
  verb.add_option("--threads", o.threads, "Threads, 0: all")->capture_default_str();
  verb.add_option("--seed", o.seed, "Seed of the random numbers")->capture_default_str();
  verb.add_flag("--resume", o.resume,
                "Go on with this very job in DIR (done anyway where DIR holds it), or fail");
  verb.add_flag("--overwrite", o.overwrite, "Replace the frames of another job in DIR");
  verb.add_flag("--maps", o.maps, "Also write the metric's maps");
  addSceneOptions(verb, o.load);
  verb.footer("Example:\n  promenade render hall.glb --size 640x360 --out walk");
}

void addPipeline(CLI::App& verb, PipelineOptions& o) {
  const std::string group = "Choices of the metric's pipeline, instead of those of --metric";
  const auto add = [&](const char* name, std::string& value, const char* about) {
    verb.add_option(name, value, about)->group(group);
  };
  add("--contrast", o.contrast, "global: relative to the frames' mean; local: to the surroundings");
  add("--filters", o.filters, "energy: squares sum to 1; amplitude: Daly's; laplacian: Burt's pyramid");
  add("--bands", o.bands, "Frequency bands, 2 to 12");
  add("--orientations", o.orientations, "Orientations of each band, 1 to 24");
  add("--csf", o.csf,
      "Contrast sensitivity: kelly (knows of motion), moving (Daly's, changed by motion as kelly), daly, "
      "mannos");
  add("--csf-at", o.csfAt, "bands: shapes each band; centres: one value a band");
  add("--onset", o.onset,
      "How fast the picture comes and goes on the retina, Hz: 0 for a steady gaze, 0.9 for glances (as "
      "revised has)");
  add("--masking", o.masking,
      "Which frame hides differences: mutual (where both do), test, reference or none");
  add("--elevation", o.elevation, "How masking raises thresholds: unit (slope 1), or daly (0.7 to 1)");
  add("--pooling", o.pooling, "What is seen together: half-degree, or none (each pixel by itself)");
  add("--gain", o.gain, "What responses are multiplied by");
}

void addConverge(CLI::App& verb, ConvergeOptions& o) {
  verb.add_option("scene", o.job.scene, "Scene: .glb or .gltf")->required();
  verb.add_option("--out", o.job.out, "Folder for convergence.csv, convergence.svg and difference.svg")
      ->required();
  verb.add_option("--path", o.job.path,
                  "Camera path: a file, or an animation or camera of the scene by name");
  verb.add_option("--frame", o.frame, "Frame of the path, numbered from 0")->capture_default_str();
  verb.add_option("--size", o.job.size, "Frame size in pixels")->capture_default_str();
  verb.add_option("--supersample", o.job.supersample, "Samples along a pixel's edge")->capture_default_str();
  verb.add_option("--most-spp", o.mostPaths, "Paths a sample at the end of each curve; a power of two")
      ->capture_default_str();
  verb.add_option("--converged-spp", o.convergedPaths,
                  "Paths a sample of the converged image (path tracing, another seed); a power of two")
      ->capture_default_str();
  verb.add_option("--display", o.job.display, "Display preset or file; ? lists them")->capture_default_str();
  addTone(verb, o.job.tone, o.job.unit, o.job.ocio);
  verb.add_option("--exposure", o.job.exposure, "Stops, or 'auto'")->capture_default_str();
  verb.add_option("--environment", o.job.environment, "Light from infinity: a lat-long .exr or .hdr image");
  verb.add_flag("--sky", o.job.sky, "Light from infinity: a clear daylight sky");
  verb.add_option("--sun", o.job.sun, "Where --sky has its sun: elevation and azimuth in degrees")
      ->capture_default_str();
  verb.add_option("--threads", o.job.threads, "Threads, 0: all")->capture_default_str();
  verb.add_option("--seed", o.job.seed, "Seed of the random numbers")->capture_default_str();
  addSceneOptions(verb, o.job.load);
  verb.footer("Example:\n  promenade converge hall.glb --frame 40 --out curves");
}

void addCompare(CLI::App& verb, CompareOptions& o) {
  verb.add_option("test", o.test, "Image, sequence (folder, dir/%06d.exr, glob) or video")->required();
  verb.add_option("reference", o.reference, "The same kind of thing, of equal size and length")->required();
  verb.add_option(
          "--metric", o.metric,
          "aqm; revised (adapts to the frames' luminance, fits still patterns better); aqm2000 (as "
          "published); vdp (Daly's, for still images); model1, model2, model3 (Rushmeier's distances); "
          "rmse; psnr")
      ->capture_default_str();
  verb.add_option("--velocity", o.velocity,
                  "Image velocity VX,VY in degrees per second (default: the Vector channels, else 0)");
  verb.add_option("--eye", o.eye,
                  "What the eye does as the image moves: tracking (default), fixating or "
                  "stabilised (not even drift)");
  o.exact = true;
  verb.add_flag("--exact,!--fast", o.exact,
                "--fast: a third of the time; on rendered frames within 0.1 per cent of the pixels");
  verb.add_option("--display", o.display, "Display preset or file; '?' lists them")->capture_default_str();
  verb.add_option("--ambient", o.ambient, "Light on the screen in lux (default: the display's)");
  verb.add_option("--ppd", o.ppd, "Pixels per degree (default: the display's)");
  verb.add_option("--fps", o.fps, "Frame rate (default: the files', else 25)");
  verb.add_flag("--absolute", o.absolute, "Channel Y of the EXR files is luminance in cd/m2");
  verb.add_option("--layer", o.layer,
                  "Layer of the EXR files that holds the picture, as diffuse (default: the whole picture)");
  verb.add_option("--mask", o.mask, "Image, or sequence, that is white where pixels count (default: all do)");
  addTone(verb, o.tone, o.unit, o.ocio);
  verb.add_option("--exposure", o.exposure, "Stops for EXR frames, or 'auto'")->capture_default_str();
  verb.add_option(
      "--maps", o.maps,
      "Folder for an EXR a frame with the maps J, Jp, P (of vdp also SignedP: negative where darker)");
  verb.add_option("--heatmap", o.heatmap,
                  "Folder for a PNG a frame: both frames, where the difference is seen, how clearly");
  verb.add_option("--csv", o.csv, "File for a table of the frames");
  verb.add_flag("--json", o.json, "Print JSON instead of the summary");
  verb.add_option("--fail-above", o.failAbove,
                  "Exit status 1 if more than so many per cent of the worst frame's pixels differ visibly");
  verb.add_option("--threads", o.threads, "Threads, 0: all")->capture_default_str();
  addPipeline(verb, o.pipeline);
  verb.footer("Example:\n  promenade compare walk reference --heatmap differences --fail-above 5");
}

void addPath(CLI::App& verb, PathOptions& o) {
  verb.add_option("file", o.file, "Path file, or a glTF scene with a camera animation")->required();
  verb.add_option("--name", o.name, "Animation or camera of a glTF scene (default: the first animation)");
  verb.add_option("--fps", o.fps, "Frame rate (default: the path's, else 25)");
  verb.add_option("--to", o.to, "Also write it: FORMAT (promenade, nerfstudio, tum, gltf) and FILE")
      ->expected(2);
  verb.add_option("--plot", o.plot, "SVG file: plan view, speed and turn rate over time");
  addSceneOptions(verb, o.load);
  verb.footer("Example:\n  promenade path walk.json --plot walk.svg --to tum walk.txt");
}

void addEncode(CLI::App& verb, EncodeOptions& o) {
  verb.add_option("input", o.input, "Rendered folder, sequence or video")->required();
  verb.add_option("output", o.output, "Video: .mp4 (H.264), .mkv (FFV1), .webm (VP9), .gif")->required();
  verb.add_option("--display", o.display, "Display preset or file (default: as rendered, else fhd-24)");
  addTone(verb, o.tone, o.unit, o.ocio);
  verb.add_option("--exposure", o.exposure,
                  "Stops for EXR frames, or 'auto': as rendered, else from the frames")
      ->capture_default_str();
  verb.add_option("--fps", o.fps, "Frame rate (default: the frames', else 25)");
  verb.add_option("--frames", o.frames, "Only frames A-B, numbered from 0");
  verb.add_option("--crop", o.crop, "Part of the frame: WIDTHxHEIGHT+X+Y");
  verb.footer("Example:\n  promenade encode walk walk.mkv --tone linear --exposure -0.5");
}

void addReport(CLI::App& verb, ReportOptions& o) {
  verb.add_option("folder", o.folder, "Folder that `promenade render` filled")->required();
  verb.add_option(
      "--reference", o.reference,
      "Folder of the same walk with every frame ray traced: shown beside, and compared frame by frame");
  verb.add_option("--out", o.out, "Page to write (default: FOLDER/report.html)");
  verb.add_option("--threads", o.threads, "Threads, 0: all")->capture_default_str();
  verb.footer("Example:\n  promenade report walk --reference reference");
}

void addInfo(CLI::App& verb, InfoOptions& o) {
  verb.add_option("scene", o.scene, "Scene: .glb or .gltf")->required();
  addSceneOptions(verb, o.load);
  verb.footer("Example:\n  promenade info hall.glb");
}

struct VerbEntry {
  Verb verb;
  const char* name;
  const char* about;
};

constexpr std::array<VerbEntry, 11> kVerbs = {{
    {Verb::kRender, "render", "Render a walk through a scene: frames, video and report"},
    {Verb::kPlan, "plan", "Divide a walk into tasks for many machines"},
    {Verb::kWork, "work", "Do one task of a plan"},
    {Verb::kAssemble, "assemble", "Make video and report when all tasks of a plan are done"},
    {Verb::kSubmit, "submit", "Give a plan to a queue and watch it"},
    {Verb::kCompare, "compare",
     "Where would a viewer see a difference between two images, sequences or videos?"},
    {Verb::kPath, "path", "Describe, convert or draw a camera path"},
    {Verb::kEncode, "encode",
     "Make a video of rendered frames with another tone mapping, crop or frame rate"},
    {Verb::kReport, "report", "Make the page report.html of a rendered folder again, with a reference"},
    {Verb::kInfo, "info", "What a scene holds"},
    {Verb::kConverge, "converge",
     "How fast do the ways to light a scene become, to a viewer, the converged picture?"},
}};

std::vector<std::string> verbNames() {
  std::vector<std::string> names;
  for (const VerbEntry& entry : kVerbs) names.emplace_back(entry.name);
  return names;
}

std::string nearest(const std::string& name, const std::vector<std::string>& known) {
  const std::vector<std::string_view> views(known.begin(), known.end());
  return nearestName(name, views);
}

std::vector<std::string> optionNames(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

bool given(const std::vector<std::string>& arguments, const std::string& option) {
  return std::any_of(arguments.begin(), arguments.end(), [&](const std::string& argument) {
    return argument == option || argument.starts_with(option + "=");
  });
}

// The values of --config FILE, as if they had been typed; what was typed wins.
std::vector<std::string> withConfig(std::vector<std::string> arguments, const CLI::App& verb) {
  const auto typed = arguments;
  std::string file;
  for (std::size_t i = 0; i < typed.size(); ++i) {
    if (typed[i].starts_with("--config=")) file = typed[i].substr(9);
    if (typed[i] == "--config" && i + 1 < typed.size()) file = typed[i + 1];
  }
  if (file.empty()) return arguments;
  for (const ConfigEntry& entry : parseConfig(io::readTextFile(file), file, verb.get_name(), verbNames())) {
    const std::string name = "--" + entry.key;
    const CLI::Option* option =
        entry.key == "config" || entry.key == "help" ? nullptr : verb.get_option_no_throw(name);
    if (option == nullptr) {
      throw InputError(entry.place, "unknown key '" + printable(entry.key) + "'; did you mean '" +
                                        nearest(name, optionNames(verb)).substr(2) + "'?");
    }
    if (given(typed, name)) continue;
    const bool flag = option->get_expected_max() == 0;
    if (!flag) {
      arguments.push_back(name + "=" + entry.value);
    } else if (entry.value == "true") {
      arguments.push_back(name);
    } else if (entry.value != "false") {
      throw InputError(entry.place, "expected true or false, found '" + printable(entry.value) + "'");
    }
  }
  return arguments;
}

[[noreturn]] void refuseUnknownOptions(const std::vector<std::string>& arguments, const CLI::App& verb) {
  const auto known = optionNames(verb);
  for (const std::string& argument : arguments) {
    const std::string name = argument.substr(0, argument.find('='));
    if (!name.starts_with("-") || name.size() < 2 ||
        std::find(known.begin(), known.end(), name) != known.end())
      continue;
    if (name[1] == '.' || (name[1] >= '0' && name[1] <= '9')) continue;  // a negative number
    throw InputError("unknown option '" + printable(name) + "'; did you mean '" + nearest(name, known) +
                     "'? (promenade " + verb.get_name() + " --help lists all)");
  }
  const std::string hint =
      verb.get_name() == "compare" ? "; quote a pattern from the shell, as 'dir/*.png'" : "";
  throw InputError("there are more arguments than expected" + hint + " (promenade " + verb.get_name() +
                   " --help lists all)");
}

void parseVerb(CLI::App& verb, const std::vector<std::string>& arguments) {
  std::vector<std::string> reversed = withConfig(arguments, verb);
  std::reverse(reversed.begin(), reversed.end());  // as CLI11 wants it
  try {
    verb.parse(reversed);
  } catch (const CLI::ExtrasError&) {
    refuseUnknownOptions(arguments, verb);
  } catch (const CLI::CallForHelp&) {
    throw;
  } catch (const CLI::RequiredError& error) {
    // An unknown option takes the blame before the argument that is missing because of it.
    const auto known = optionNames(verb);
    for (const std::string& argument : arguments) {
      const std::string name = argument.substr(0, argument.find('='));
      if (name.starts_with("--") && std::find(known.begin(), known.end(), name) == known.end()) {
        refuseUnknownOptions(arguments, verb);
      }
    }
    throw InputError(printable(error.what()) + " (promenade " + verb.get_name() + " --help)");
  } catch (const CLI::ParseError& error) {
    throw InputError(printable(error.what()) + " (promenade " + verb.get_name() + " --help)");
  }
}

// What every verb knows, too.
void addVerb(CLI::App& verb, Verb which, CommandLine& line, std::string& config) {
  verb.get_formatter()->column_width(28);
  switch (which) {
    case Verb::kRender:
      addRender(verb, line.render);
      verb.add_option("--preview", line.render.preview,
                      "Instead of the walk, the best picture of its first frame that can be had in so many "
                      "seconds: DIR/preview.exr and .png");
      break;
    case Verb::kPlan:
      addRender(verb, line.render);
      verb.footer("Example:\n  promenade plan hall.glb --size 640x360 --out walk");
      break;
    case Verb::kWork:
      addWork(verb, line.work);
      break;
    case Verb::kAssemble:
      addAssemble(verb, line.assemble);
      break;
    case Verb::kSubmit:
      addSubmit(verb, line.submit);
      break;
    case Verb::kCompare:
      addCompare(verb, line.compare);
      break;
    case Verb::kPath:
      addPath(verb, line.path);
      break;
    case Verb::kEncode:
      addEncode(verb, line.encode);
      break;
    case Verb::kReport:
      addReport(verb, line.report);
      break;
    case Verb::kInfo:
      addInfo(verb, line.info);
      break;
    case Verb::kConverge:
      addConverge(verb, line.converge);
      break;
    case Verb::kHelpOnly:
      break;
  }
  verb.add_option("--config", config, "TOML or JSON file with options; typed ones win");
  verb.add_flag("--quiet", line.console.quiet, "Neither progress nor notices");
  verb.add_option("--log-level", line.console.logLevel, "How much is said on standard error")
      ->capture_default_str();
  for (CLI::Option* option : verb.get_options()) {
    const std::string values = valuesOf(option->get_name());
    if (!values.empty() && option->get_expected_max() > 0) option->type_name(values);
    // The last of a repeated option wins, so that a command can be recalled and amended.
    if (!option->get_positional() && option->get_expected_max() == 1) {
      option->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    }
  }
}

// `name` is one of the option's: a flag and its opposite are described apart.
OptionHelp helpOf(const CLI::Option& option, const std::string& name) {
  OptionHelp help;
  help.argument = option.get_positional();
  help.name = name;
  if (option.get_expected_max() > 0) help.value = option.get_type_name();
  help.about = option.get_description();
  help.otherwise = option.get_default_str();
  if (option.get_group() != "Options") help.group = option.get_group();
  help.required = option.get_required();
  return help;
}

// `completion SHELL` and `man [VERB]`: text made of the same description; nothing if it is neither.
std::optional<std::string> madeOfHelp(const std::vector<std::string>& arguments) {
  const std::string& first = arguments.front();
  if (first == "completion") {
    const std::string shell = arguments.size() == 2 ? arguments[1] : "";
    if (shell == "bash") return bashCompletion(describeVerbs());
    if (shell == "zsh") return zshCompletion(describeVerbs());
    throw InputError("completion: expected bash or zsh");
  }
  if (first != "man") return std::nullopt;
  if (arguments.size() < 2) return manPage(describeVerbs(), PROMENADE_VERSION);
  for (const VerbHelp& verb : describeVerbs()) {
    if (verb.name == arguments[1]) return manPageOf(verb, PROMENADE_VERSION);
  }
  throw InputError("man: unknown verb '" + printable(arguments[1]) + "'; did you mean '" +
                   nearest(arguments[1], verbNames()) + "'?");
}

std::map<std::string, std::string> givenTo(const CLI::App& verb) {
  std::map<std::string, std::string> values;
  for (const CLI::Option* option : verb.get_options()) {
    if (option->get_positional() || option->get_lnames().empty()) continue;
    const bool flag = option->get_expected_max() == 0;
    const std::string value = option->count() == 0 ? option->get_default_str()
                              : flag               ? "true"
                                                   : option->results().back();
    if (!value.empty()) values.emplace(option->get_lnames().front(), value);
  }
  return values;
}

std::string generalHelp() {
  std::string text =
      "Promenade: walkthrough animations of static scenes, by image-based rendering under a perceptual "
      "metric\n\n"
      "Usage: promenade VERB ...\n\n";
  for (const VerbEntry& entry : kVerbs) {
    std::string name(entry.name);
    name.resize(10, ' ');
    text += "  " + name + entry.about + "\n";
  }
  return text +
         "\n  --help     this text; promenade VERB --help describes a verb\n  --version  versions of the "
         "program "
         "and its libraries\n  completion bash|zsh  completion script for a shell\n  man [VERB]           "
         "manual "
         "page\n\n"
         "Example:\n  promenade render hall.glb --size 640x360 --out walk\n";
}

}  // namespace

std::vector<VerbHelp> describeVerbs() {
  constexpr std::string_view kExample = "Example:\n  ";
  std::vector<VerbHelp> verbs;
  for (const VerbEntry& entry : kVerbs) {
    CLI::App verb(entry.about, entry.name);
    CommandLine line;
    std::string config;
    addVerb(verb, entry.verb, line, config);
    VerbHelp help{entry.name, entry.about, verb.get_footer(), {}};
    if (help.example.starts_with(kExample)) help.example.erase(0, kExample.size());
    for (const CLI::Option* option : verb.get_options()) {
      if (option->check_lname("help")) continue;
      if (option->get_positional()) help.options.push_back(helpOf(*option, option->get_name()));
      for (const std::string& name : option->get_lnames())
        help.options.push_back(helpOf(*option, "--" + name));
    }
    verbs.push_back(std::move(help));
  }
  return verbs;
}

CommandLine parseCommandLine(const std::vector<std::string>& arguments) {
  CommandLine line;
  if (arguments.empty())
    throw InputError(
        "expected a verb: render, plan, work, assemble, submit, compare, path, encode, report, info or "
        "converge (promenade --help)");
  const std::string& first = arguments.front();
  if (const auto text = madeOfHelp(arguments)) {
    line.text = *text;
    return line;
  }
  if (first == "--help" || first == "-h" || first == "help") {
    line.text = generalHelp();
    return line;
  }
  if (first == "--version") {
    line.text = versionText();
    return line;
  }
  const auto entry =
      std::find_if(kVerbs.begin(), kVerbs.end(), [&](const VerbEntry& e) { return first == e.name; });
  if (entry == kVerbs.end()) {
    if (first.starts_with("-")) {
      throw InputError("unknown option '" + printable(first) + "' before the verb; did you mean '" +
                       nearest(first, {"--help", "--version"}) + "'?");
    }
    throw InputError("unknown verb '" + printable(first) + "'; did you mean '" + nearest(first, verbNames()) +
                     "'?");
  }

  CLI::App verb(entry->about, entry->name);
  std::string config;
  addVerb(verb, entry->verb, line, config);
  // `--display ?` lists the presets, whatever else is there.
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    if (arguments[i] == "--display=?" || (arguments[i] == "?" && arguments[i - 1] == "--display")) {
      line.text = "?";
      return line;
    }
  }
  try {
    parseVerb(verb, {arguments.begin() + 1, arguments.end()});
  } catch (const CLI::CallForHelp&) {
    line.text = verb.help("promenade");
    return line;
  }
  line.verb = entry->verb;
  std::vector<std::string> words = {"promenade"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  line.render.command = shellWords(words);
  line.render.all = givenTo(verb);
  return line;
}

}  // namespace promenade::app
