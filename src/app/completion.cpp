#include "src/app/completion.h"

namespace promenade::app {
namespace {

struct Offer {
  std::string words;  ///< separated by blanks
  bool files = false;
  bool folders = false;
};

Offer offerOf(const OptionHelp& option) {
  Offer offer;
  for (const std::string& word : alternatives(option.value)) {
    if (word == "FILE") {
      offer.files = true;
    } else if (word == "DIR") {
      offer.folders = true;
    } else if (!isPlaceholder(word)) {
      offer.words += (offer.words.empty() ? "" : " ") + word;
    }
  }
  return offer;
}

// For text between single quotes.
std::string inQuotes(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
    } else {
      out += c;
    }
  }
  return out;
}

// For zsh's "[description]" and "name:description".
std::string inDescription(const std::string& text) {
  std::string out;
  for (const char c : inQuotes(text)) {
    if (c == '[' || c == ']' || c == ':') out += '\\';
    out += c;
  }
  return out;
}

std::string bashReply(const Offer& offer) {
  std::string reply;
  if (!offer.words.empty()) {
    reply = "COMPREPLY=($(compgen -W '" + inQuotes(offer.words) + "' -- \"$word\"))";
  } else {
    reply = "COMPREPLY=()";
  }
  if (offer.files) reply += "; _promenade_files -f";
  if (offer.folders) reply += "; _promenade_files -d";
  return reply;
}

std::string zshAction(const OptionHelp& option) {
  const Offer offer = offerOf(option);
  std::string action = ":" + inDescription(option.argument ? option.name : option.value) + ":";
  if (offer.files && offer.words.empty()) return action + "_files";
  if (offer.folders && offer.words.empty()) return action + "_files -/";
  if (offer.words.empty()) return action;
  if (!offer.files) return action + "(" + offer.words + ")";
  return action + "{ compadd -- " + offer.words + "; _files }";
}

}  // namespace

std::string bashCompletion(const std::vector<VerbHelp>& verbs) {
  std::string names;
  std::string options;
  std::string values;
  std::string arguments;
  for (const VerbHelp& verb : verbs) {
    names += verb.name + " ";
    options += "    " + verb.name + ") options='";
    std::string positional;
    for (const OptionHelp& option : verb.options) {
      if (option.argument) {
        if (positional.empty()) positional = bashReply(offerOf(option));
        continue;
      }
      options += option.name + " ";
      if (option.value.empty()) continue;
      values += "    " + verb.name + ":" + option.name + ") " + bashReply(offerOf(option)) + "; return ;;\n";
    }
    options += "--help' ;;\n";
    if (!positional.empty()) arguments += "    " + verb.name + ") " + positional + " ;;\n";
  }
  return R"(# bash completion for promenade. Made by `promenade completion bash`.
_promenade_files() {
  local IFS=$'\n'
  compopt -o filenames
  COMPREPLY+=($(compgen "$1" -- "$word"))
}

_promenade() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb=${COMP_WORDS[1]} options=
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W ')" +
         names + R"(--help --version' -- "$word"))
    return
  fi
  case "$verb" in
)" + options +
         R"(  esac
  case "$verb:$before" in
)" + values +
         R"(  esac
  if [[ "$word" == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
    return
  fi
  case "$verb" in
)" + arguments +
         R"(  esac
}

complete -F _promenade promenade
)";
}

std::string zshCompletion(const std::vector<VerbHelp>& verbs) {
  std::string names;
  std::string cases;
  for (const VerbHelp& verb : verbs) {
    names += "    '" + verb.name + ":" + inDescription(verb.about) + "'\n";
    cases += "      " + verb.name + ")\n        _arguments -s \\\n";
    for (const OptionHelp& option : verb.options) {
      if (option.argument) {
        cases += "          '" + zshAction(option) + "' \\\n";
      } else if (option.value.empty()) {
        cases += "          '" + option.name + "[" + inDescription(option.about) + "]' \\\n";
      } else {
        cases += "          '" + option.name + "=[" + inDescription(option.about) + "]" + zshAction(option) +
                 "' \\\n";
      }
    }
    cases += "          '--help[Describe the verb]'\n        ;;\n";
  }
  return R"(#compdef promenade
# zsh completion for promenade. Made by `promenade completion zsh`.
_promenade() {
  local context state line
  local -a verbs
  verbs=(
)" + names +
         R"(  )
  _arguments '(- *)--help[Describe the program]' '(- *)--version[Versions]' '1: :->verb' '*:: :->rest'
  case $state in
    verb) _describe -t verbs verb verbs ;;
    rest)
      case $line[1] in
)" + cases +
         R"(      esac
      ;;
  esac
}

if [ "$funcstack[1]" = "_promenade" ]; then
  _promenade "$@"
else
  compdef _promenade promenade
fi
)";
}

}  // namespace promenade::app
