// The pose between two sets of described points, with nothing known before: mutual nearest descriptors, then the pose
// that most pairs agree on (RANSAC on triples with the closed form of Umeyama, PAMI 1991), refined on those pairs.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "common/geometry.hpp"
#include "mapping3d/odometry/key_frame.hpp"

namespace swiftlet::mapping3d {

/// T_a_b; none if too few pairs agree. Deterministic: the random numbers come from `seed`.
std::optional<common::Pose3> registerPoints(const std::vector<DescribedPoint>& a, const std::vector<DescribedPoint>& b,
                                            std::uint64_t seed);

/// The rigid transform that brings the points of `b` to those of `a` with the least squares. At least three pairs that
/// are not on a line.
common::Pose3 rigidTransform(const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& a_and_b);

}  // namespace swiftlet::mapping3d
