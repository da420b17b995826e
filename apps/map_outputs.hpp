// The results of `swiftlet map`: map.pgm, map.yaml, map.png, trajectory.tum, report.html and, if there is a graph,
// graph.g2o.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "apps/log_mapping.hpp"
#include "apps/results_folder.hpp"
#include "common/occupancy_grid.hpp"
#include "perception/slam2d/laser_slam.hpp"
#include "rendering/thinned_curve.hpp"

namespace swiftlet::apps {

inline const std::string kMapTitle = "Map of ";
inline const ResultsKind kMapResults{"map",
                                     "report.html",
                                     "<title>" + kMapTitle,
                                     {"report.html", "map.pgm", "map.yaml", "map.png", "trajectory.tum", "graph.g2o"}};

/// SVG of a curve over the scans of a log.
std::string plotOver(const std::string& title, const std::string& unit, const rendering::ThinnedCurve& curve);

struct MapFigures {
  std::string log;
  std::vector<std::pair<std::string, std::string>> facts;
  std::vector<std::string> warnings;
  std::vector<perception::SeenTwice> contradicting;  ///< Of a map that is not trusted: drawn, the worst first.
  rendering::ThinnedCurve milliseconds;              ///< Computing time over the index of the scan.
};

/// Why a map cannot be written, for people: it is larger than readMap accepts. Empty if it can.
std::string whyNoMap(const common::OccupancyGrid& map);

/// Writes all files into the folder `out`; without `map`, it writes no map and no picture of it. Throws InputError if
/// one cannot be written.
void writeMapOutputs(const std::filesystem::path& out, const perception::LaserSlam& slam,
                     const common::OccupancyGrid* map, const TrackSpool& track, const MapFigures& figures);

}  // namespace swiftlet::apps
