#include "apps/map_outputs.hpp"

#include <algorithm>
#include <functional>
#include <memory>

#include <Eigen/LU>

#include "apps/required.hpp"
#include "common/world.hpp"
#include "interfaces/files/atomic_file.hpp"
#include "interfaces/files/g2o.hpp"
#include "interfaces/files/map_server.hpp"
#include "interfaces/files/tum.hpp"
#include "interfaces/report/report.hpp"
#include "rendering/encode.hpp"
#include "rendering/map_renderer.hpp"
#include "rendering/map_svg.hpp"
#include "rendering/plot_svg.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using common::Pose2;

/// Points of a trajectory nearer than this to the one before are not drawn.
constexpr double kDrawnStep_m = 0.05;
constexpr std::size_t kDrawnPoints = 50'000;

using PoseOf = std::function<Pose2(const perception::TrackedScan&)>;

void writeTrajectory(const fs::path& file, const TrackSpool& track, const PoseOf& poseOf) {
  auto writer = required(interfaces::TumWriter::create(file));
  track.forEach([&](const StampedScan& tracked) {
    required(writer.write({tracked.stamp, common::lifted(poseOf(tracked.scan), 0.0)}));
  });
}

interfaces::G2oGraph2D graphOf(const std::vector<Pose2>& keys, const std::vector<perception::SlamEdge>& edges) {
  interfaces::G2oGraph2D graph;
  for (std::size_t i = 0; i < keys.size(); ++i) graph.ids.push_back(static_cast<std::int64_t>(i));
  graph.poses = keys;
  graph.fixed = {0};
  for (const perception::SlamEdge& edge : edges) {
    // g2o's error has the axes of the measured pose of `to`, ours those of `from`.
    const Eigen::Matrix3d covariance = common::turned(edge.covariance, -edge.T_from_to.yaw_rad);
    Eigen::Matrix3d information = covariance.inverse();
    information = 0.5 * (information + information.transpose()).eval();
    graph.edges.push_back({edge.from, edge.to, edge.T_from_to, information});
  }
  return graph;
}

/// Of bounded length: the longer the way, the coarser it is drawn.
std::vector<Eigen::Vector2d> lineOf(const TrackSpool& track, const PoseOf& poseOf) {
  std::vector<Eigen::Vector2d> line;
  double step_m = kDrawnStep_m;
  track.forEach([&](const StampedScan& tracked) {
    const Eigen::Vector2d at = poseOf(tracked.scan).position_m();
    if (line.empty() || (at - line.back()).norm() >= step_m) line.push_back(at);
    if (line.size() <= kDrawnPoints) return;
    for (std::size_t i = 0; 2 * i < line.size(); ++i) line[i] = line[2 * i];
    line.resize((line.size() + 1) / 2);
    step_m *= 2.0;
  });
  return line;
}

std::string mapPicture(const common::World& world) {
  rendering::MapView view;
  view.width_px = 1280;
  view.height_px = 960;
  view.layers.laser = view.layers.plan = view.layers.vehicle = view.layers.home = view.layers.goal = false;
  const rendering::Bytes png = rendering::encodePng(rendering::renderMap(world, view));
  return {png.begin(), png.end()};
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

void writeMapOutputs(const fs::path& out, perception::LaserSlam& slam, const TrackSpool& track,
                     const MapFigures& figures) {
  const std::vector<Pose2> keys = slam.keyPoses();
  const PoseOf poseOf = [&](const perception::TrackedScan& scan) {
    return keys[static_cast<std::size_t>(scan.key)] * scan.T_key_robot;
  };
  common::World world;
  world.grid = std::make_shared<const common::OccupancyGrid>(slam.map());
  const std::vector<Eigen::Vector2d> line = lineOf(track, poseOf);
  world.levels = std::make_shared<const common::LevelMap>();
  world.frontiers = std::make_shared<const std::vector<common::Frontier>>();
  world.trail_map_m = std::make_shared<const std::vector<Eigen::Vector2d>>(line);

  std::vector<rendering::MapLine> lines{{"trajectory", line, false}};
  for (const perception::SlamEdge& edge : slam.slam().edges())
    if (edge.loop)
      lines.push_back({"loop closures",
                       {keys[static_cast<std::size_t>(edge.from)].position_m(),
                        keys[static_cast<std::size_t>(edge.to)].position_m()},
                       true});

  interfaces::MapReport report;
  report.title = kMapTitle + figures.log;
  report.facts = figures.facts;
  report.warnings = figures.warnings;
  report.map_svg = rendering::mapSvg(world, lines, {{"begin", keys.front().position_m()}});
  report.plots_svg = {plotOver("Time per scan", "ms", figures.milliseconds)};

  writeTrajectory(out / "trajectory.tum", track, poseOf);
  required(interfaces::writeMap(out, "map", *world.grid));
  required(interfaces::writeAtomically(out / "map.png", mapPicture(world)));
  if (!slam.particles())
    required(interfaces::writeAtomically(out / "graph.g2o", interfaces::toG2o(graphOf(keys, slam.slam().edges()))));
  required(interfaces::writeAtomically(out / "report.html", interfaces::mapReport(report)));
}

}  // namespace swiftlet::apps
