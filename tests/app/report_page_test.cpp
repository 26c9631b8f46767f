#include "src/app/report_page.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "src/app/page_parts.h"
#include "src/app/shell_words.h"

namespace promenade::app {
namespace {

using testing::HasSubstr;
using testing::Not;

RenderedJob aJob() {
  RenderedJob job;
  job.folder = "walk";
  job.report =
      R"({"version": "1", "note": "</script><!-- <b>", "totals": {"traced_fraction": 0.10000000000000001}})";
  job.scene = "some/a<b>&c.glb";
  job.size = {4, 2};
  job.frames = {3, 4};
  job.wallSeconds = 10.0;
  job.integrator = "path";
  job.pathsPerSample = 8;
  job.threads = 2;
  return job;
}

std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const auto begin = text.find(from) + from.size();
  return text.substr(begin, text.find(to, begin) - begin);
}

ReportContents twoPictures() {
  ReportContents contents;
  contents.pictureSize = {4, 2};
  contents.frames.push_back({.index = 3,
                             .result = "data:a",
                             .source = "data:b",
                             .metric = "data:c",
                             .reference = "data:d",
                             .percentVisible = 1.0});
  contents.frames.push_back({.index = 4,
                             .result = "data:e",
                             .source = "",
                             .metric = "",
                             .reference = "data:f",
                             .percentVisible = 4.0});
  return contents;
}

TEST(ReportPage, HoldsTheReportAsItStandsWhateverIsInIt) {
  const std::string page = reportPage(aJob(), twoPictures());
  const std::string data = between(page, "id=\"data\">", "</script>");
  EXPECT_THAT(data, HasSubstr("0.10000000000000001"));  // not formatted again
  const auto root = nlohmann::json::parse(data);
  EXPECT_EQ(root["report"], nlohmann::json::parse(aJob().report));
  EXPECT_EQ(root["pictures"]["frames"][0]["source"], "data:b");
  EXPECT_FALSE(root["pictures"]["frames"][1].contains("source"));
  EXPECT_EQ(root["comparison"]["percent_visible_mean"], 2.5);  // (1 + 4) / 2
  EXPECT_EQ(root["comparison"]["worst_frame"], 4);
  EXPECT_EQ(root["sources"].size(), 7u);
}

TEST(ReportPage, IsWholeAndAsksForNothing) {
  const std::string page = reportPage(aJob(), twoPictures());
  EXPECT_THAT(page, HasSubstr("<title>Walkthrough of a&lt;b&gt;&amp;c.glb</title>"));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, HasSubstr("Chart.js v"));
  EXPECT_THAT(page, HasSubstr("Copyright (c) 2014-2022 Chart.js Contributors"));
  EXPECT_THAT(page, Not(HasSubstr("{{title}}")));
  EXPECT_THAT(page, Not(HasSubstr("{{script}}")));
  EXPECT_THAT(std::string(pageTemplate()), HasSubstr("{{data}}"));
}

TEST(ReportPage, SaysWhetherTheSpeedupIsMeasuredOrEstimated) {
  RenderedJob job = aJob();
  EXPECT_FALSE(speedupOf(job, nullptr).has_value());  // an old report: neither is known
  job.speedupEstimated = 3.0;
  RenderedJob full = aJob();
  full.everyFrameTraced = true;
  full.wallSeconds = 50.0;
  const auto measured = speedupOf(job, &full);
  ASSERT_TRUE(measured.has_value());
  EXPECT_TRUE(measured->measured);
  EXPECT_DOUBLE_EQ(measured->value, 5.0);  // 50 s over 10 s
  // Another number of paths is another job: its time says nothing.
  full.pathsPerSample = 9;
  const auto estimated = speedupOf(job, &full);
  ASSERT_TRUE(estimated.has_value());
  EXPECT_FALSE(estimated->measured);
  EXPECT_DOUBLE_EQ(estimated->value, 3.0);
  EXPECT_FALSE(speedupOf(full, nullptr).has_value());  // nothing was saved, nothing is claimed
}

TEST(ShellWords, AreReadBackByAShell) {
  EXPECT_EQ(shellWords({"promenade", "render", "a.glb"}), "promenade render a.glb");
  EXPECT_EQ(shellWords({"a b", "", "it's", "$x"}), R"('a b' '' 'it'\''s' '$x')");
}

}  // namespace
}  // namespace promenade::app
