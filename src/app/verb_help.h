#pragma once
// The command line described: one source for --help, shell completion and man pages, so that none of them can
// say what another does not.

#include <string>
#include <vector>

namespace promenade::app {

struct OptionHelp {
  std::string name;   ///< "--size", or "scene" of an argument
  std::string value;  ///< what follows it: "WxH", "FILE", or the choices "ibr|full"; empty for a flag
  std::string about;
  std::string otherwise;  ///< the default as text; empty: none
  std::string group;      ///< heading, empty for the usual options
  bool argument = false;  ///< given by its place, not by its name
  bool required = false;
};

struct VerbHelp {
  std::string name;
  std::string about;
  std::string example;  ///< a command
  std::vector<OptionHelp> options;
};

/// All verbs, in the order of `promenade --help`.
[[nodiscard]] std::vector<VerbHelp> describeVerbs();

/// The words and placeholders of OptionHelp::value: "ibr|full" -> {"ibr", "full"}. Placeholders are capitals.
[[nodiscard]] std::vector<std::string> alternatives(const std::string& value);
[[nodiscard]] bool isPlaceholder(const std::string& alternative);

}  // namespace promenade::app
