// The results of `swiftlet map3d`: trajectory.tum, cloud.ply, map.bt and report.html; pieces.txt where the map is not
// all.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "apps/results_folder.hpp"
#include "common/submap3d.hpp"
#include "common/trajectory.hpp"
#include "common/voxel_map.hpp"
#include "rendering/thinned_curve.hpp"

namespace swiftlet::apps {

inline const std::string kMap3dTitle = "3D map of ";
inline const ResultsKind kMap3dResults{
    "3D map",
    "report.html",
    "<title>" + kMap3dTitle,
    {"report.html", "trajectory.tum", "pieces.txt", "cloud.ply", "map.bt", "mesh.ply", "mesh.obj"}};

/// In the frame of the trajectory.
struct Map3dMap {
  std::vector<common::SurfacePoint> cloud;
  common::VoxelMap voxels;
};

struct Map3dFigures {
  std::string folder;
  std::vector<std::pair<std::string, std::string>> facts;
  std::vector<std::string> warnings;
  rendering::ThinnedCurve milliseconds;  ///< Over the index of the frame.
  /// Part of the points that do not agree with the map, over the index of the frame.
  rendering::ThinnedCurve disagreement;
};

/// `pieces` has the poses of the recorder's camera (axes of image processing), first those of the map in its frame,
/// then those of other pieces, each in a frame of its own: pieces.txt has a line `t x y z qx qy qz qw piece` for each.
/// Throws InputError if a file cannot be written.
void writeMap3dOutputs(const std::filesystem::path& out, const std::vector<common::Trajectory>& pieces,
                       const Map3dMap& map, const Map3dFigures& figures);

}  // namespace swiftlet::apps
