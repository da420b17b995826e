#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "common/markup.hpp"
#include "interfaces/report/html.hpp"
#include "interfaces/report/report.hpp"

namespace swiftlet::interfaces {
namespace {

using common::escaped;
using common::Mark;

/// At most this many events are shown; the rest are in events.jsonl.
constexpr std::size_t kMaxEvents = 2000;

/// Colours that people with any colour vision can tell apart, on light and on dark (after Okabe and Ito).
constexpr std::array<const char*, 7> kPhaseColors = {"#0072b2", "#e69f00", "#009e73", "#cc79a7",
                                                     "#56b4e9", "#d55e00", "#8a8f98"};

std::string minutes(double seconds) {
  const int whole = static_cast<int>(std::lround(seconds));
  return whole < 60 ? fmt::format("{:.1f} s", seconds) : fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

/// Endings of names, the longest first, with their units for readers.
constexpr std::array<std::pair<std::string_view, const char*>, 8> kUnits = {{{"_m_s2", "m/s²"},
                                                                             {"_m_s", "m/s"},
                                                                             {"_rad", "rad"},
                                                                             {"_deg", "°"},
                                                                             {"_m2", "m²"},
                                                                             {"_hz", "Hz"},
                                                                             {"_m", "m"},
                                                                             {"_s", "s"}}};

/// "goal_error_m", 0.0213 -> {"goal error", "0.0213 m"}.
std::pair<std::string, std::string> rowOf(const Figure& figure) {
  std::string name = figure.name, unit;
  for (const auto& [ending, words] : kUnits) {
    if (!name.ends_with(ending)) continue;
    name.resize(name.size() - ending.size());
    unit = std::string(" ") + words;
    break;
  }
  std::replace(name.begin(), name.end(), '_', ' ');
  return {name, std::isfinite(figure.value) ? fmt::format("{:.4g}{}", figure.value, unit) : "not known"};
}

std::pair<std::string, Mark> verdictOf(const FlightSummary& summary) {
  switch (summary.outcome) {
    case Outcome::kFlying:
      return {"not finished", Mark::kNone};
    case Outcome::kDone:
      return {"done", Mark::kGood};
    case Outcome::kFailed:
      return {"failed", Mark::kBad};
    case Outcome::kCrashed:
      return {"crashed", Mark::kBad};
    case Outcome::kStopped:
      return {"stopped", Mark::kNone};
  }
  return {"", Mark::kNone};
}

/// "explore_and_return", with the vehicle's name where several flew.
std::string titleOf(const FlightSummary& summary) {
  return summary.info.mission + (summary.info.vehicle.empty() ? "" : ", " + summary.info.vehicle);
}

std::string header(const FlightSummary& summary) {
  const auto [verdict, mark] = verdictOf(summary);
  std::string text = fmt::format("<h1>{} {}</h1>\n", escaped(titleOf(summary)), html::pill(verdict, mark));
  if (!summary.reason.empty()) text += fmt::format("<p>{}</p>\n", escaped(summary.reason));
  if (summary.outcome == Outcome::kFlying)
    text += "<p>The flight goes on, or its program was ended before it could say how the flight ended.</p>\n";
  text += fmt::format("<p>{} in {}, system {}{}, seed {}{}</p>", escaped(summary.info.mission_file),
                      escaped(summary.info.world), escaped(summary.info.system),
                      summary.info.nature.empty() ? "" : ", nature " + escaped(summary.info.nature), summary.info.seed,
                      summary.info.started.empty() ? "" : ", started " + escaped(html::moment(summary.info.started)));
  return text;
}

std::string summarySection(const FlightSummary& summary) {
  std::vector<std::pair<std::string, std::string>> facts = {
      {"Mission time", minutes(summary.mission_time.seconds())},
      {"Distance flown", fmt::format("{:.1f} m", summary.distance_m)}};
  if (summary.explored_area_m2)
    facts.emplace_back("Area explored", fmt::format("{:.1f} m²", *summary.explored_area_m2));
  if (summary.coverage) facts.emplace_back("Coverage", fmt::format("{:.1f} %", 100 * *summary.coverage));
  if (summary.explored_area_m2) facts.emplace_back("Frontiers left", fmt::format("{}", summary.frontiers.size()));
  if (summary.localization) {
    const LocalizationSummary& localization = *summary.localization;
    facts.emplace_back("Found itself in the given map", localization.found_after_m
                                                            ? fmt::format("after {:.1f} m", *localization.found_after_m)
                                                            : "never");
    if (localization.flown_s > 0.0)
      facts.emplace_back("Knew its place",
                         fmt::format("{:.0f} % of the flight", 100 * localization.localized_s / localization.flown_s));
  }
  if (summary.octree_age_s)
    facts.emplace_back("Age of the octree (map.bt, map.ot)", fmt::format("{:.1f} s", *summary.octree_age_s));
  facts.emplace_back("Battery left", fmt::format("{:.0f} %", 100 * summary.battery_remaining));
  if (summary.realtime_factor) facts.emplace_back("Real time", fmt::format("× {:.1f}", *summary.realtime_factor));
  const common::MachineUse& machine = summary.machine;
  if (machine.memory_peak_MB)
    facts.emplace_back("Memory of the program", fmt::format("up to {:.0f} MB", *machine.memory_peak_MB));
  if (machine.frameGrowth())
    facts.emplace_back("Computing time of a camera frame",
                       fmt::format("{:.1f} ms, {:.1f} ms at the end", *machine.frame_first_ms, *machine.frame_last_ms));
  return html::section("Summary", html::facts(facts));
}

std::string figuresSection(const std::vector<Figure>& figures) {
  if (figures.empty()) return "";
  common::Table table{"", {"figure", "value"}, {}};
  for (const Figure& figure : figures) {
    auto [name, value] = rowOf(figure);
    table.rows.push_back({{std::move(name)}, {std::move(value)}});
  }
  return html::section("Figures", html::table(table));
}

std::string mapSection(const std::string& map_svg) {
  if (map_svg.empty()) return "";
  return html::section("Map", fmt::format("<figure class=\"map\">{}</figure>", map_svg));
}

std::string plotsSection(const std::vector<std::string>& plots_svg) {
  return plots_svg.empty() ? "" : html::section("Plots", html::plots(plots_svg));
}

std::string phasesSection(const std::vector<Phase>& phases) {
  if (phases.empty()) return "";
  std::string bar = "<div class=\"bar\">", rows;
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const Phase& phase = phases[i];
    const double duration_s = (phase.end - phase.begin).seconds();
    const auto first = std::find_if(phases.begin(), phases.end(), [&](const Phase& p) { return p.name == phase.name; });
    const char* color = kPhaseColors[static_cast<std::size_t>(first - phases.begin()) % kPhaseColors.size()];
    const std::string name = escaped(phase.name);
    bar += fmt::format("<span style=\"flex:{:.3f};background:{}\" title=\"{}, {:.1f} s\"></span>",
                       std::max(duration_s, 1e-3), color, name, duration_s);
    rows += fmt::format(
        "<tr><td><span class=\"dot\" style=\"background:{}\"></span>{}</td><td>{}</td><td class=\"number\">{:.1f} "
        "s</td><td class=\"number\">{:.1f} s</td><td class=\"quiet\">{}</td></tr>\n",
        color, name, escaped(phase.flown_by), phase.begin.seconds(), duration_s, escaped(phase.reason));
  }
  return html::section(
      "Phases",
      bar +
          "</div>\n<div class=\"wide\"><table><thead><tr><th>phase</th><th>flown by</th>"
          "<th class=\"number\">begins</th><th class=\"number\">takes</th><th>reason</th></tr></thead>\n<tbody>\n" +
          rows + "</tbody></table></div>");
}

/// The explanation without the reason at its beginning, which has a column of its own.
std::string detailOf(const common::Frontier& frontier) {
  const std::string reason = std::string(common::toString(frontier.reason)) + ": ";
  return frontier.explanation.starts_with(reason) ? frontier.explanation.substr(reason.size()) : frontier.explanation;
}

std::string frontiersSection(const FlightSummary& summary) {
  const std::vector<common::Frontier>& frontiers = summary.frontiers;
  if (!summary.explored_area_m2) return "";
  if (frontiers.empty())
    return html::section("Frontiers left", "<p class=\"empty\">None: nothing was left to explore.</p>");
  std::string rows;
  for (const common::Frontier& frontier : frontiers)
    rows += fmt::format("<tr><td>({:.2f}, {:.2f})</td><td>{:.2f} m</td><td>{}</td><td class=\"quiet\">{}</td></tr>\n",
                        frontier.centroid_map_m.x(), frontier.centroid_map_m.y(), frontier.length_m,
                        common::toString(frontier.reason), escaped(detailOf(frontier)));
  return html::section(
      "Frontiers left",
      "<div class=\"wide\"><table><thead><tr><th>at x, y in the map (m)</th><th>length</th><th>reason</th>"
      "<th>detail</th></tr></thead>\n<tbody>\n" +
          rows + "</tbody></table></div>");
}

common::Table tableOfPlaces(const char* what) {
  return {"", {what, "at x, y, z in the map (m)", "known to (m)", "seen from", "state"}, {}};
}

/// A row of such a table: `thing` is a Target or a RecognizedObject.
template <typename Thing>
void addPlace(const Thing& thing, const Eigen::Vector3d& at, int places, std::string state, common::Table& table) {
  table.rows.push_back({{labelOf(thing)},
                        {fmt::format("({:.2f}, {:.2f}, {:.2f})", at.x(), at.y(), at.z())},
                        {fmt::format("{:.2f}", thing.sigma_m())},
                        {fmt::format("{} places", places)},
                        {std::move(state)}});
}

std::string targetsSection(const std::vector<common::Target>& targets) {
  if (targets.empty()) return "";
  common::Table table = tableOfPlaces("target");
  for (const common::Target& target : targets)
    addPlace(target, target.position_map_m, target.views, common::toString(target.state), table);
  return html::section("Targets", html::table(table));
}

/// Candidates are counted: many of them are seen once and never again.
std::string objectsSection(const std::vector<common::RecognizedObject>& objects) {
  if (objects.empty()) return "";
  common::Table table = tableOfPlaces("object");
  for (const common::RecognizedObject& object : objects) {
    if (!object.confirmed) continue;
    const std::string size = fmt::format("{:.2f} x {:.2f} m", object.size_m.x(), object.size_m.y());
    addPlace(object, object.T_map_object.position_m, object.looks,
             object.passage == common::Passage::kNone ? size : size + ", " + common::toString(object.passage), table);
  }
  const std::size_t candidates = objects.size() - table.rows.size();
  std::string body = table.rows.empty() ? "" : html::table(table);
  if (candidates > 0)
    body += fmt::format("\n<p class=\"empty\">{} seen from too few places {} in objects.json.</p>", candidates,
                        candidates == 1 ? "is" : "are");
  return html::section("Recognized", body);
}

std::string photosSection(const char* title, const std::vector<ReportPhoto>& photos) {
  if (photos.empty()) return "";
  std::string body = "<div class=\"pictures\">\n";
  for (const ReportPhoto& photo : photos)
    body += fmt::format(
        "<figure><img alt=\"{0}\" src=\"data:image/jpeg;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
        escaped(photo.caption), photo.jpeg);
  return html::section(title, body + "</div>");
}

std::string eventsSection(const std::vector<common::Event>& events) {
  std::string rows;
  const std::size_t count = std::min(events.size(), kMaxEvents);
  for (std::size_t i = 0; i < count; ++i) {
    const common::Event& event = events[i];
    const std::string_view alarm = common::alarmOf(event);
    const char* style = !alarm.empty() || event.severity == common::Severity::kError ? "bad"
                        : event.severity == common::Severity::kWarning               ? "warn"
                                                                                     : "";
    rows += fmt::format(
        "<tr><td class=\"quiet\">{:.2f}</td><td class=\"quiet\">{}</td><td class=\"{}\">{}{}</td><td "
        "class=\"quiet\">{}</td></tr>\n",
        event.stamp.seconds(), escaped(event.source), style, alarm.empty() ? "" : "<b>alarm</b> ", escaped(event.text),
        escaped(event.reason));
  }
  std::string body =
      "<div "
      "class=\"wide\"><table><thead><tr><th>time "
      "(s)</th><th>by</th><th>event</th><th>reason</th></tr></thead>\n<tbody>\n" +
      rows + "</tbody></table></div>";
  if (events.size() > count)
    body += fmt::format("\n<p class=\"empty\">{} more are in events.jsonl.</p>", events.size() - count);
  return html::section("Events", events.empty() ? "<p class=\"empty\">None.</p>" : body);
}

std::string settingsSection(const std::string& config_yaml) {
  if (config_yaml.empty()) return "";
  return fmt::format("<section>\n<details><summary>Settings</summary>\n<pre>{}</pre></details>\n</section>\n",
                     escaped(config_yaml));
}

}  // namespace

std::string flightReport(const FlightSummary& summary, const std::vector<common::Event>& events,
                         const ReportPictures& pictures, const std::string& config_yaml) {
  const std::string body = summarySection(summary) + mapSection(pictures.map_svg) +
                           html::map3dSection(pictures.map3d_jpeg) + targetsSection(summary.targets) +
                           objectsSection(summary.objects) + photosSection("What was recognized", pictures.objects) +
                           photosSection("Photographs", pictures.photos) + phasesSection(summary.phases) +
                           plotsSection(pictures.plots_svg) + figuresSection(summary.figures) +
                           frontiersSection(summary) + eventsSection(events) + settingsSection(config_yaml);
  return html::page(titleOf(summary) + ": " + toString(summary.outcome), header(summary), body, summary.info.version);
}

}  // namespace swiftlet::interfaces
