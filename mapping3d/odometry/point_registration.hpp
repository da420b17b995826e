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
  static constexpr int greatest_distance =
      64;  ///< Bits, of the 256 that describe a patch, in which two similar patches may differ.
  static constexpr double greatest_ratio =
      0.9;  ///< The most similar patch must differ by at most this part of what the second most similar differs by.
  static constexpr int trials =
      200;  ///< Triples of paired corners that are drawn to find a pose on which many pairs agree.
  static constexpr double agreeing_m = 0.02;  ///< Pairs agree on a pose when it maps their corners to within this
                                              ///< distance, and agreeing_slope, of each other.
  static constexpr double agreeing_slope =
      0.015;  ///< Growth of agreeing_m, in metres, with the square of the corner's depth in metres.
  static constexpr int least_pairs = 15;  ///< Least number of pairs that agree on a pose.
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
