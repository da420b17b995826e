// The pose between two sets of described points, with nothing known before: mutual nearest descriptors, then the pose
// that most pairs agree on (RANSAC on triples with the closed form of Umeyama, PAMI 1991), refined on those pairs.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "mapping3d/odometry/key_frame.hpp"

namespace swiftlet::mapping3d {

struct PointRegistrationConfig {
  int greatest_distance = 64;
  double greatest_ratio = 0.9;
  int trials = 200;
  double agreeing_m = 0.02;
  double agreeing_slope = 0.015;
  int least_pairs = 15;

  void describe(common::config::Fields& fields);
};

struct PointRegistration {
  common::Pose3 T_a_b;
  int agreeing = 0;  ///< Pairs that the pose brings together.
};

/// None if too few pairs agree. Deterministic: the random numbers come from `seed`.
std::optional<PointRegistration> registerPoints(const std::vector<DescribedPoint>& a,
                                                const std::vector<DescribedPoint>& b, std::uint64_t seed,
                                                const PointRegistrationConfig& config);

/// The rigid transform that brings the points of `b` to those of `a` with the least squares. At least three pairs that
/// are not on a line.
common::Pose3 rigidTransform(const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& a_and_b);

}  // namespace swiftlet::mapping3d
