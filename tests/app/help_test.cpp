// Man pages and completion are made of the same description as --help.

#include <gmock/gmock.h>

#include <algorithm>

#include "src/app/completion.h"
#include "src/app/man_page.h"
#include "src/app/options.h"
#include "src/app/verb_help.h"
#include "tests/app/refused.h"

namespace promenade::app {
namespace {

using testing::HasSubstr;

const OptionHelp& optionOf(const std::vector<VerbHelp>& verbs, const std::string& verb,
                           const std::string& name) {
  const auto found = std::ranges::find(verbs, verb, &VerbHelp::name);
  return *std::ranges::find(found->options, name, &OptionHelp::name);
}

TEST(VerbHelp, DescribesWhatCanBeTyped) {
  const auto verbs = describeVerbs();
  const OptionHelp& method = optionOf(verbs, "render", "--method");
  EXPECT_EQ(method.value, "ibr|full");
  EXPECT_EQ(method.otherwise, "ibr");
  EXPECT_FALSE(method.required);
  EXPECT_TRUE(optionOf(verbs, "render", "scene").argument);
  EXPECT_TRUE(optionOf(verbs, "render", "--out").required);
  EXPECT_EQ(optionOf(verbs, "render", "--maps").value, "");   // a flag
  EXPECT_EQ(optionOf(verbs, "compare", "--fast").value, "");  // the opposite of one
  EXPECT_EQ(optionOf(verbs, "info", "--max-triangles").group, "Limits of the scene reader");
  EXPECT_THAT(optionOf(verbs, "compare", "--display").value, HasSubstr("fhd-24|crt-100"));
}

TEST(VerbHelp, EveryValueSaysWhatItIs) {
  for (const VerbHelp& verb : describeVerbs()) {
    EXPECT_THAT(verb.example, testing::StartsWith("promenade " + verb.name));
    for (const OptionHelp& option : verb.options) {
      EXPECT_NE(option.value, "TEXT") << verb.name << " " << option.name << ": see option_values.cpp";
    }
  }
}

TEST(VerbHelp, ChoicesAreTold) {
  EXPECT_EQ(alternatives("ibr|full"), (std::vector<std::string>{"ibr", "full"}));
  EXPECT_TRUE(alternatives("").empty());
  EXPECT_TRUE(isPlaceholder("WxH"));
  EXPECT_FALSE(isPlaceholder("crt-100"));
}

TEST(ManPage, HasEveryOptionAndNoStrayRequest) {
  for (const VerbHelp& verb : describeVerbs()) {
    const std::string page = manPageOf(verb, "1.2");
    EXPECT_THAT(page, testing::StartsWith(".TH PROMENADE-"));
    for (const OptionHelp& option : verb.options) {
      std::string name = option.name;
      for (std::size_t at = name.find('-'); at != std::string::npos; at = name.find('-', at + 2))
        name.insert(at, "\\");
      EXPECT_THAT(page, HasSubstr("\\fB" + name + "\\fR"));
    }
  }
  VerbHelp odd{"odd", "about", "promenade odd", std::vector<OptionHelp>(1)};
  odd.options[0].name = "--dot";
  odd.options[0].about = ".starts\\with";
  EXPECT_THAT(manPageOf(odd, "1"), HasSubstr("\n\\&.starts\\ewith\n"));
  EXPECT_THAT(manPage(describeVerbs(), "1.2"), HasSubstr("promenade\\-compare (1)"));
}

TEST(Completion, QuotesWhatAShellWouldTakeForItsOwn) {
  VerbHelp verb{"try", "it's: a [test]", "", std::vector<OptionHelp>(1)};
  verb.options[0].name = "--kind";
  verb.options[0].value = "a|b|FILE";
  verb.options[0].about = "it's [one]";
  const std::string zsh = zshCompletion({verb});
  EXPECT_THAT(zsh, HasSubstr("'try:it'\\''s\\: a \\[test\\]'"));
  EXPECT_THAT(zsh, HasSubstr("{ compadd -- a b; _files }"));
  EXPECT_THAT(bashCompletion({verb}),
              HasSubstr("try:--kind) COMPREPLY=($(compgen -W 'a b' -- \"$word\")); _promenade_files -f"));
}

TEST(CommandLine, PrintsCompletionAndManPages) {
  EXPECT_THAT(parseCommandLine({"completion", "bash"}).text, HasSubstr("complete -F"));
  EXPECT_THAT(parseCommandLine({"man", "render"}).text, HasSubstr("PROMENADE-RENDER"));
  expectRefused([] { (void)parseCommandLine({"completion", "fish"}); }, "expected bash or zsh");
  expectRefused([] { (void)parseCommandLine({"man", "rendr"}); }, "did you mean 'render'?");
}

}  // namespace
}  // namespace promenade::app
