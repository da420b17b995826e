// A pose graph as a g2o file has it.
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

  /// "Seen from the vertex `from`, the vertex `to` stands at T_from_to."
  struct Edge {
    int from = 0;  ///< Indices of `ids`, not ids.
    int to = 0;
    Pose T_from_to;
    Information information = Information::Identity();
  };

  std::vector<std::int64_t> ids;  ///< Of each vertex; in the file's order, or ascending when it has only edges.
  std::vector<Pose> poses;        ///< Of each vertex; empty when the file has only edges.
  std::vector<Edge> edges;
  std::vector<int> fixed;  ///< Indices of `ids`, ascending.
};

using G2oGraph2D = G2oGraph<common::Pose2, 3>;
using G2oGraph3D = G2oGraph<common::Pose3, 6>;

struct G2oOptions {
  /// Of an information that is not positive definite only the diagonal counts.
  bool ignore_cross_terms = false;
};

}  // namespace swiftlet::interfaces
