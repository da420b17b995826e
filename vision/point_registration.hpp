// The pose between two sets of described points, with nothing known before: mutual nearest descriptors, then the pose
// that most pairs agree on (RANSAC on triples with the closed form of Umeyama, PAMI 1991), refined on those pairs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "vision/binary_descriptor.hpp"

namespace swiftlet::vision {

/// A point that can be recognized by its surroundings in the picture.
struct DescribedPoint {
  Eigen::Vector3d point_camera_m;
  BinaryDescriptor descriptor;
};

/// Pairs agree on a pose when it maps their points to within this distance of each other: floor + slope * depth^2, as
/// the noise of a depth grows with its square.
struct Agreement {
  double floor_m = 0.02;
  double slope_1_m = 0.015;
};

/// Where the points of b are to be found: T_a_b is known so well that it takes each to within this share of its depth.
struct Expectation {
  common::Pose3 T_a_b;
  double share_of_depth = 0.15;
};

struct Registration {
  common::Pose3 T_a_b;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;  ///< Indices of the points that agree, of a and of b.
};

/// None if too few pairs agree. Points that are not where they are expected make no pair, so that a pattern that
/// repeats itself has one place. Deterministic: the random numbers come from `seed`.
std::optional<Registration> registerPairs(const std::vector<DescribedPoint>& a, const std::vector<DescribedPoint>& b,
                                          std::uint64_t seed, const Agreement& agreement = {},
                                          const std::optional<Expectation>& expectation = {});
/// T_a_b alone.
std::optional<common::Pose3> registerPoints(const std::vector<DescribedPoint>& a, const std::vector<DescribedPoint>& b,
                                            std::uint64_t seed);

/// The rigid transform that brings the points of `b` to those of `a` with the least squares. At least three pairs that
/// are not on a line.
common::Pose3 rigidTransform(const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& a_and_b);

}  // namespace swiftlet::vision
