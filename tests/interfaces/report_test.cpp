// Reports are one file each, show all their content, and never interpret given text as HTML.
#include "interfaces/report/report.hpp"

#include <limits>
#include <regex>
#include <set>

#include <gmock/gmock.h>

#include "interfaces/report/html.hpp"
#include "support.hpp"

namespace swiftlet::interfaces {
namespace {

using common::Mark;
using common::Time;
using testing::HasSubstr;
using testing::Not;

FlightSummary summaryOf(const std::string& text) {
  FlightSummary summary;
  summary.info = {text, text, text, text, 7, {text, text}, text};
  summary.outcome = Outcome::kFailed;
  summary.reason = text;
  summary.mission_time = common::Duration::fromSeconds(83.4);
  summary.coverage = 0.9931;
  summary.explored_area_m2 = 89.23;
  summary.phases = {{text, Time::fromSeconds(0), Time::fromSeconds(3)},
                    {"explore", Time::fromSeconds(3), Time::fromSeconds(9)}};
  common::Frontier frontier;
  frontier.reason = common::FrontierReason::kTooSmall;
  frontier.explanation = text;
  summary.frontiers = {frontier};
  summary.figures = {{text, 0.05}, {"unknown_m", std::numeric_limits<double>::quiet_NaN()}};
  return summary;
}

std::vector<common::Event> eventsOf(const std::string& text, std::size_t count) {
  return std::vector<common::Event>(count, {Time::fromSeconds(1), common::Severity::kWarning, text, text, text});
}

/// Tags that are opened are closed, in order.
void expectBalanced(const std::string& page) {
  const std::set<std::string> void_tags = {"meta", "img", "br"};
  std::vector<std::string> open;
  const std::regex tag("<(/?)([a-zA-Z0-9]+)[^>]*?(/?)>");
  const std::size_t body = page.find("</style>");
  for (std::sregex_iterator it(page.begin() + static_cast<std::ptrdiff_t>(body) + 8, page.end(), tag), end; it != end;
       ++it) {
    const std::string name = (*it)[2];
    if (void_tags.contains(name) || (*it)[3].length() > 0) continue;
    if ((*it)[1].length() == 0) {
      open.push_back(name);
    } else if (name != "head" && name != "html") {
      ASSERT_FALSE(open.empty()) << name;
      ASSERT_EQ(open.back(), name);
      open.pop_back();
    }
  }
  EXPECT_TRUE(open.empty());
}

TEST(FlightReport, ShowsTheFlight) {
  const std::string page = flightReport(summaryOf("house"), eventsOf("goal refused", 1),
                                        {"PNG", "<svg id=\"map\"></svg>", {"<svg id=\"plot\"></svg>"}}, "speed: 1\n");
  for (const char* part : {"failed", "1 min 23 s", "99.3 %", "too small", "goal refused", "<svg id=\"plot\">",
                           "speed: 1", "not known", "<svg id=\"map\">", "89.2 m²"})
    EXPECT_THAT(page, HasSubstr(part));
  expectBalanced(page);
}

TEST(FlightReport, LeavesOutMissingParts) {
  FlightSummary summary;
  summary.info.mission = "hold";
  const std::string page = flightReport(summary, {}, {}, "");
  EXPECT_THAT(page, HasSubstr("not finished"));
  for (const char* part : {"Coverage", "Area explored", "Frontiers left"}) EXPECT_THAT(page, Not(HasSubstr(part)));
  EXPECT_THAT(page, Not(HasSubstr("<img")));
  expectBalanced(page);
}

TEST(FlightReport, ReportsNothingLeftOnlyForAFlightThatExplored) {
  FlightSummary summary;
  summary.explored_area_m2 = 12.5;
  EXPECT_THAT(flightReport(summary, {}, {}, ""), HasSubstr("nothing was left to explore"));
}

TEST(FlightReport, EscapesText) {
  const std::string evil = "</pre><script>alert('1')</script>\" onload=\"x";
  const std::string page = flightReport(summaryOf(evil), eventsOf(evil, 1), {}, evil);
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("\" onload")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;alert(&#39;1&#39;)"));
  expectBalanced(page);
}

TEST(FlightReport, LoadsNoOtherFiles) {
  const std::string page = flightReport(summaryOf("house"), eventsOf("x", 3), {"PNG", "<svg></svg>", {}}, "a: 1");
  EXPECT_THAT(page, Not(testing::ContainsRegex("(src|href)=\"(https?:)?//")));
  EXPECT_THAT(page, Not(HasSubstr("@import")));
  EXPECT_THAT(page, Not(HasSubstr("url(")));
}

TEST(FlightReport, ShowsThe3dMapInside) {
  ReportPictures pictures;
  EXPECT_THAT(flightReport(summaryOf("house"), {}, pictures, ""), Not(HasSubstr("3D map")));
  pictures.map3d_jpeg = "/9j/4AAQ";
  const std::string page = flightReport(summaryOf("house"), {}, pictures, "");
  EXPECT_THAT(page, HasSubstr("src=\"data:image/jpeg;base64,/9j/4AAQ\""));
  EXPECT_THAT(page, HasSubstr("<h2>3D map</h2>"));
  expectBalanced(page);
  MapReport report;
  EXPECT_THAT(mapReport(report), Not(HasSubstr("3D map")));
  report.map3d_jpeg = "/9j/4AAQ";
  EXPECT_THAT(mapReport(report), HasSubstr("src=\"data:image/jpeg;base64,/9j/4AAQ\""));
}

TEST(FlightReport, HasTheTargetsAndThePhotographs) {
  FlightSummary summary = summaryOf("house");
  summary.targets.push_back({.id = 4, .name = "red", .number = 2, .position_map_m = {1.25, -2.0, 0.4}, .views = 5});
  ReportPictures pictures;
  pictures.photos = {{"red_2 & door", "/9j/4AAQ"}};
  const std::string page = flightReport(summary, {}, pictures, "");
  EXPECT_THAT(page, HasSubstr("(1.25, -2.00, 0.40)"));
  EXPECT_THAT(page, HasSubstr("5 places"));
  EXPECT_THAT(page, HasSubstr("<figcaption>red_2 &amp; door</figcaption>"));
  expectBalanced(page);
}

TEST(FlightReport, ShortensAFloodOfEventsAndReportsIt) {
  const std::string page = flightReport(summaryOf("house"), eventsOf("again", 5000), {}, "");
  EXPECT_THAT(page, HasSubstr("3000 more are in events.jsonl"));
}

TEST(TrialReport, ShowsTablesLinksAndPictures) {
  TrialReport report{"unb_case1", "20 flights", false, {}, {}};
  report.tables.push_back(
      {"Flights", {"seed", "passed"}, {{{"7", Mark::kNone, "flights/a b-7/report.html"}, {"no", Mark::kBad}}}});
  report.pictures.push_back({"seed 7", "flights/a b-7/map.png", "flights/a b-7/report.html", false});
  const std::string page = trialReport(report);
  for (const char* part : {"not passed", "<td class=\"bad\">no</td>", "href=\"./flights/a%20b-7/report.html\"",
                           "src=\"./flights/a%20b-7/map.png\"", "seed 7"})
    EXPECT_THAT(page, HasSubstr(part));
  expectBalanced(page);
}

TEST(Table, AlignsNumbersRightAndWordsLeft) {
  const common::Table table{"T", {"name", "x"}, {{{"é"}, {"-1.50"}}, {{"longer"}, {""}}, {{"z"}, {"12"}}}};
  EXPECT_TRUE(common::isNumeric(table, 1));
  EXPECT_FALSE(common::isNumeric(table, 0));
  EXPECT_EQ(toText(table), "T\nname        x\n-------------\né       -1.50\nlonger\nz          12\n");
  EXPECT_THAT(html::table(table), HasSubstr("<td class=\"number \">12</td>"));
}

}  // namespace
}  // namespace swiftlet::interfaces
