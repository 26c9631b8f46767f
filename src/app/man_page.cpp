#include "src/app/man_page.h"

#include <algorithm>

namespace promenade::app {
namespace {

// A line of text: no request at its beginning, no escape within; a hyphen that may be copied is a minus.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else if (c == '\n') {
      out += "\n.br\n";
    } else {
      out += c;
    }
  }
  const bool request = !out.empty() && (out.front() == '.' || out.front() == '\'');
  return request ? "\\&" + out : out;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return text;
}

std::string header(const std::string& name, const std::string& about, const std::string& version) {
  return ".TH " + upper(name) + " 1 \"\" \"Promenade " + version + "\" \"User Commands\"\n.SH NAME\n" +
         roff(name) + " \\- " + roff(about) + "\n";
}

std::string entry(const OptionHelp& option) {
  std::string text = ".TP\n\\fB" + roff(option.name) + "\\fR";
  if (!option.value.empty() && !option.argument) text += " \\fI" + roff(option.value) + "\\fR";
  text += "\n" + roff(option.about);
  if (!option.otherwise.empty()) text += " (default: " + roff(option.otherwise) + ")";
  return text + "\n";
}

std::string example(const std::string& command) {
  return ".SH EXAMPLE\n.nf\n" + roff(command) + "\n.fi\n";
}

}  // namespace

std::string manPage(const std::vector<VerbHelp>& verbs, const std::string& version) {
  std::string text = header("promenade", "walkthrough animations of static scenes", version);
  text +=
      ".SH SYNOPSIS\n\\fBpromenade\\fR \\fIVERB\\fR ...\n"
      ".SH DESCRIPTION\nA few frames of a walk through a scene are ray traced; all others are warped from "
      "them, and "
      "only what cannot be warped is ray traced. A model of human vision decides where a viewer could tell.\n"
      ".SH VERBS\n";
  std::string also;
  for (const VerbHelp& verb : verbs) {
    text += ".TP\n\\fB" + roff(verb.name) + "\\fR\n" + roff(verb.about) + "\n";
    also += (also.empty() ? "" : ",\n") + std::string(".BR promenade\\-") + verb.name + " (1)";
  }
  text +=
      ".SH OPTIONS\n.TP\n\\fB\\-\\-help\\fR\nDescribe the program; after a verb, the verb\n"
      ".TP\n\\fB\\-\\-version\\fR\nVersions of the program and its libraries\n"
      ".SH EXIT STATUS\n.TP\n0\nDone\n.TP\n1\nA comparison found more difference than allowed\n"
      ".TP\n2\nBad input or usage\n.TP\n3\nCannot continue: disk full, out of "
      "memory\n.TP\n130\nInterrupted\n";
  text += example("promenade render hall.glb --size 640x360 --out walk");
  return text + ".SH SEE ALSO\n" + also + "\n";
}

std::string manPageOf(const VerbHelp& verb, const std::string& version) {
  std::string text = header("promenade-" + verb.name, verb.about, version);
  text += ".SH SYNOPSIS\n\\fBpromenade " + roff(verb.name) + "\\fR";
  std::vector<std::string> groups = {""};
  for (const OptionHelp& option : verb.options) {
    if (option.argument) text += " \\fI" + roff(upper(option.name)) + "\\fR";
    if (std::find(groups.begin(), groups.end(), option.group) == groups.end()) groups.push_back(option.group);
  }
  text += " [\\fIOPTION\\fR ...]\n.SH DESCRIPTION\n" + roff(verb.about) + "\n";
  for (const std::string& group : groups) {
    text += group.empty() ? ".SH OPTIONS\n" : ".SS \"" + roff(group) + "\"\n";
    for (const OptionHelp& option : verb.options) {
      if (option.group == group) text += entry(option);
    }
  }
  if (!verb.example.empty()) text += example(verb.example);
  return text + ".SH SEE ALSO\n.BR promenade (1)\n";
}

}  // namespace promenade::app
