#include "apps/localize_outputs.hpp"

#include <memory>

#include <fmt/core.h>

#include "apps/map_png.hpp"
#include "flight/build_version.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/json_lines.hpp"
#include "interfaces/files/required.hpp"
#include "interfaces/files/tum.hpp"
#include "interfaces/report/report.hpp"
#include "rendering/map_svg.hpp"

namespace swiftlet::apps {
namespace {

using Paths = std::vector<std::vector<Eigen::Vector2d>>;

/// A point of a path nearer than this to the one before is not drawn.
constexpr double kDrawnPathStep_m = 0.05;

/// Pictures are drawn in the grid's frame.
Paths inGrid(const Paths& paths_map_m, const common::Pose2& T_map_grid) {
  const common::Pose2 T_grid_map = T_map_grid.inverse();
  Paths paths = paths_map_m;
  for (auto& path : paths)
    for (Eigen::Vector2d& point : path) point = T_grid_map * point;
  return paths;
}

rendering::MapPicture pictureOf(const interfaces::StoredMap& map, const Paths& paths_grid_m) {
  rendering::MapPicture picture;
  picture.grid = std::make_shared<const common::OccupancyGrid>(map.grid);
  for (const std::vector<Eigen::Vector2d>& path : paths_grid_m)
    picture.lines.push_back({"localized", path, rendering::LineStyle::kTrack});
  return picture;
}

/// Starts of the paths, numbered.
std::string mapDrawing(rendering::MapPicture picture) {
  for (const rendering::MapLine& line : picture.lines) {
    const Eigen::Vector2d& begin = line.points_map_m.front();
    picture.marks.push_back({fmt::format("{}", picture.marks.size() + 1), {begin.x(), begin.y(), 0.0}});
  }
  return rendering::mapSvg(picture);
}

void writeTrajectory(const std::filesystem::path& file, const Spool<LocalizedScan>& track) {
  auto writer = required(interfaces::TumWriter::create(file));
  track.forEach([&](const LocalizedScan& scan) {
    required(writer.write({scan.stamp, common::lifted(scan.T_map_body, 0.0)}));
  });
}

common::Table tableOf(const std::vector<ReportedEvent>& events) {
  common::Table table{"", {"when", "state", "reason"}, {}};
  for (const ReportedEvent& event : events)
    table.rows.push_back(
        {{event.when}, {event.state, event.bad ? common::Mark::kBad : common::Mark::kNone}, {event.reason}});
  return table;
}

}  // namespace

void LocalizedPaths::add(const perception::LocalizationEstimate& estimate) {
  if (estimate.state != perception::LocalizationState::kLocalized) {
    open_ = false;
    return;
  }
  const Eigen::Vector2d at = estimate.T_map_body.position_m();
  if (!open_)
    paths_.push_back({at});
  else if ((at - paths_.back().back()).norm() >= kDrawnPathStep_m)
    paths_.back().push_back(at);
  open_ = true;
}

std::vector<ReportedEvent> reported(const std::vector<LoggedEvent>& events, bool has_stamps) {
  std::vector<ReportedEvent> reported;
  std::size_t again = 0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const common::Event& event = events[i].event;
    const std::string when =
        has_stamps ? fmt::format("{:.3f} s", event.stamp.seconds()) : fmt::format("scan {}", events[i].scan);
    const bool repeated = i > 0 && event.text == events[i - 1].event.text && event.reason == events[i - 1].event.reason;
    again = repeated ? again + 1 : 0;
    if (repeated)
      reported.back().reason = fmt::format("{} (again {} x, the last at {})", event.reason, again, when);
    else
      reported.push_back({when, event.text, event.reason, event.severity == common::Severity::kWarning});
  }
  return reported;
}

void writeLocalizeOutputs(const std::filesystem::path& out, const interfaces::StoredMap& map,
                          const LocalizeFigures& figures) {
  const rendering::MapPicture picture = pictureOf(map, inGrid(figures.paths.paths_map_m(), map.T_map_grid));
  interfaces::LocalizationReport report;
  report.version = flight::buildVersion();
  report.title =
      fmt::format("{}{} in {}", kLocalizeTitle, std::filesystem::path(figures.log).filename().string(), figures.map);
  report.facts = figures.facts;
  report.warnings = figures.warnings;
  report.events = tableOf(reported(figures.events, figures.has_stamps));
  report.map_svg = mapDrawing(picture);
  report.plots_svg = {plotOver("Not explained by the map", "% of a scan", figures.unexplained),
                      plotOver("Time per scan", "ms", figures.milliseconds)};
  std::string events;
  for (const LoggedEvent& logged : figures.events) events += interfaces::toJson(logged.event) + "\n";
  writeTrajectory(out / "trajectory.tum", figures.track);
  required(interfaces::writeAtomically(out / "events.jsonl", events));
  required(interfaces::writeAtomically(out / "map.png", mapPng(picture)));
  required(interfaces::writeAtomically(out / "report.html", interfaces::localizationReport(report)));
}

}  // namespace swiftlet::apps
