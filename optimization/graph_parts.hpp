// What pose graphs of the plane and of space have in common: which pose holds which part in place, and the poses that a
// tree of edges gives.
#pragma once

#include <cstddef>
#include <vector>

#include "optimization/graph_2d.hpp"
#include "optimization/graph_3d.hpp"

namespace swiftlet::optimization {

/// Poses and edges are numbered by int.
inline std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// The fixed poses, and the first pose of each connected part that has none; ascending.
std::vector<int> anchorsOf(const PoseGraph2D& graph);
std::vector<int> anchorsOf(const PoseGraph3D& graph);

/// These poses do not move, whatever the graph said.
void fix(PoseGraph2D& graph, std::vector<int> poses);
void fix(PoseGraph3D& graph, std::vector<int> poses);

/// The poses that follow from the anchors along the shortest chains of edges (breadth first, in the order of the
/// edges). Needs no guess but that of the anchors.
std::vector<common::Pose2> chainedPoses(const PoseGraph2D& graph);
std::vector<common::Pose3> chainedPoses(const PoseGraph3D& graph);

/// e' * information * e of each edge at `poses`.
std::vector<double> squaredErrors(const PoseGraph2D& graph, const std::vector<common::Pose2>& poses);
std::vector<double> squaredErrors(const PoseGraph3D& graph, const std::vector<common::Pose3>& poses);
/// Their sum.
double chi2Of(const std::vector<double>& squared_errors);

}  // namespace swiftlet::optimization
