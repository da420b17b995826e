#include "apps/map_outputs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>

#include <fmt/format.h>
#include <Eigen/LU>

#include "apps/map_png.hpp"
#include "flight/build_version.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/g2o.hpp"
#include "interfaces/files/map_server.hpp"
#include "interfaces/files/required.hpp"
#include "interfaces/files/tum.hpp"
#include "interfaces/report/report.hpp"
#include "rendering/map_svg.hpp"
#include "rendering/plot_svg.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using common::Pose2;

/// A point of a trajectory nearer than this to the one before is not drawn.
constexpr double kDrawnStep_m = 0.05;
constexpr std::size_t kDrawnPoints = 50'000;

void writeTrajectory(const fs::path& file, const TrackSpool& track, const std::vector<Pose2>& keys) {
  auto writer = required(interfaces::TumWriter::create(file));
  track.forEach([&](const StampedScan& tracked) {
    required(writer.write({tracked.stamp, common::lifted(tracked.scan.T_map_robot(keys), 0.0)}));
  });
}

interfaces::G2oGraph2D graphOf(const std::vector<Pose2>& keys, std::span<const perception::SlamEdge> edges) {
  interfaces::G2oGraph2D graph;
  for (std::size_t i = 0; i < keys.size(); ++i) graph.ids.push_back(static_cast<std::int64_t>(i));
  graph.poses = keys;
  graph.fixed = {0};
  for (const perception::SlamEdge& edge : edges) {
    // The error of g2o is in the axes of the measured pose of `to`, that of Swiftlet in those of `from`.
    const Eigen::Matrix3d covariance = common::turned(edge.covariance, -edge.T_from_to.yaw_rad);
    Eigen::Matrix3d information = covariance.inverse();
    information = 0.5 * (information + information.transpose()).eval();
    graph.edges.push_back({edge.from, edge.to, edge.T_from_to, information});
  }
  return graph;
}

/// The number of points is bounded: a longer path is drawn more coarsely.
std::vector<Eigen::Vector2d> lineOf(const TrackSpool& track, const std::vector<Pose2>& keys) {
  std::vector<Eigen::Vector2d> line;
  double step_m = kDrawnStep_m;
  track.forEach([&](const StampedScan& tracked) {
    const Eigen::Vector2d at = tracked.scan.T_map_robot(keys).position_m();
    if (line.empty() || (at - line.back()).norm() >= step_m) line.push_back(at);
    if (line.size() <= kDrawnPoints) return;
    for (std::size_t i = 0; 2 * i < line.size(); ++i) line[i] = line[2 * i];
    line.resize((line.size() + 1) / 2);
    step_m *= 2.0;
  });
  return line;
}

std::vector<rendering::MapLine> loopsOf(std::span<const perception::SlamEdge> edges, const std::vector<Pose2>& keys) {
  const auto at_m = [&](int key) { return keys[static_cast<std::size_t>(key)].position_m(); };
  std::vector<rendering::MapLine> lines;
  for (const perception::SlamEdge& edge : edges)
    if (edge.loop)
      lines.push_back({"loop closures", {at_m(edge.from), at_m(edge.to)}, rendering::LineStyle::kReference});
  return lines;
}

/// A ring around each of the places where the map contradicts itself most.
std::vector<rendering::MapLine> doubtsOf(const std::vector<perception::SeenTwice>& contradicting) {
  constexpr std::size_t kMost = 5;
  constexpr double kRadius_m = 1.5;
  std::vector<rendering::MapLine> rings;
  for (std::size_t i = 0; i < std::min(contradicting.size(), kMost); ++i) {
    rendering::MapLine& ring = rings.emplace_back();
    ring.name = "contradicts itself";
    for (int deg = 0; deg <= 360; deg += 15)
      ring.points_map_m.emplace_back(
          contradicting[i].at_map_m +
          kRadius_m * Eigen::Vector2d(std::cos(deg * common::kRadPerDeg), std::sin(deg * common::kRadPerDeg)));
  }
  return rings;
}

}  // namespace

std::string plotOver(const std::string& title, const std::string& unit, const rendering::ThinnedCurve& curve) {
  rendering::Plot plot;
  plot.title = title;
  plot.x_label = "scan";
  plot.y_label = unit;
  plot.series = {{"greatest of each stretch", curve.points(), false}};
  plot.y_min = 0.0;
  return rendering::plotSvg(plot);
}

std::string whyNoMap(const common::OccupancyGrid& map) {
  if (interfaces::isReadable(map)) return "";
  const common::CellRect known = common::knownExtent(map);
  return fmt::format(
      "the map would be {} by {} cells of {:g} m: the log's odometry or scans jump; trajectory and "
      "graph are written, the map is not",
      known.width(), known.height(), map.resolution_m());
}

void writeMapOutputs(const fs::path& out, const perception::LaserSlam& slam, const common::OccupancyGrid* map,
                     const TrackSpool& track, const MapFigures& figures) {
  const std::vector<Pose2> keys = slam.keyPoses();
  writeTrajectory(out / "trajectory.tum", track, keys);
  if (slam.slam().method() == perception::SlamMethod::kGraph)
    required(interfaces::writeAtomically(out / "graph.g2o", interfaces::toG2o(graphOf(keys, slam.slam().edges()))));

  interfaces::MapReport report;
  report.version = flight::buildVersion();
  report.title = kMapTitle + fs::path(figures.log).filename().string();
  report.subtitle = figures.log;
  report.facts = figures.facts;
  report.warnings = figures.warnings;
  report.plots_svg = {plotOver("Time per scan", "ms", figures.milliseconds)};
  report.map_svg = "<p class=\"empty\">None.</p>";
  if (map) {
    rendering::MapPicture picture;
    picture.grid = std::make_shared<const common::OccupancyGrid>(*map);
    picture.lines = {{"trajectory", lineOf(track, keys), rendering::LineStyle::kTrail}};
    const std::vector<rendering::MapLine> doubts = doubtsOf(figures.contradicting);
    picture.lines.insert(picture.lines.end(), doubts.begin(), doubts.end());
    required(interfaces::writeAtomically(out / "map.png", mapPng(picture)));
    const std::vector<rendering::MapLine> loops = loopsOf(slam.slam().edges(), keys);
    picture.lines.insert(picture.lines.end(), loops.begin(), loops.end());
    picture.marks = {{"begin", keys.front(), rendering::MarkStyle::kHome}};
    report.map_svg = rendering::mapSvg(picture);
    required(interfaces::writeMap(out, "map", *map));
  }
  required(interfaces::writeAtomically(out / "report.html", interfaces::mapReport(report)));
}

}  // namespace swiftlet::apps
