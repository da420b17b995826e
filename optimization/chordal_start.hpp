// An initial guess for a pose graph: first the rotations, then the positions, each by one linear least squares
// problem ("chordal relaxation": Martinec and Pajdla 2007; Carlone et al. 2015). Where the noise is that of real
// sensors it lies near the best solution, whatever the guess in the file.
#pragma once

#include <vector>

#include "optimization/pose_graph_2d.hpp"
#include "optimization/pose_graph_3d.hpp"

namespace swiftlet::optimization {

/// Fixed poses stay, and so does the first pose of each connected part without a fixed one. Where the equations cannot
/// be solved, the graph's own poses are returned.
std::vector<common::Pose2> chordalStart(const PoseGraph2D& graph);
std::vector<common::Pose3> chordalStart(const PoseGraph3D& graph);

}  // namespace swiftlet::optimization
