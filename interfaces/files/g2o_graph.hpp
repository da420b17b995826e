// A pose graph as it is in a g2o file.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace swiftlet::interfaces {

template <typename Pose_, int kErrors_>
struct G2oGraph {
  using Pose = Pose_;
  static constexpr int kErrors = kErrors_;
  using Information = Eigen::Matrix<double, kErrors, kErrors>;

  /// The pose of vertex `to` seen from vertex `from` is T_from_to.
  struct Edge {
    int from = 0;  ///< Index into `ids`, not an id.
    int to = 0;
    Pose T_from_to;
    Information information = Information::Identity();
  };

  std::vector<std::int64_t> ids;  ///< Id of each vertex: in the file's order, or ascending if the file has only edges.
  std::vector<Pose> poses;        ///< Pose of each vertex; empty if the file has only edges.
  std::vector<Edge> edges;
  std::vector<int> fixed;  ///< Indices into `ids`, ascending.
};

using G2oGraph2D = G2oGraph<common::Pose2, 3>;
using G2oGraph3D = G2oGraph<common::Pose3, 6>;

/// The format whose element a line is.
enum class GraphFormat { kG2o, kToro };

struct G2oOptions {
  /// For an information that is not positive definite, use only its diagonal.
  bool ignore_cross_terms = false;
};

}  // namespace swiftlet::interfaces
