#include "mapping3d/odometry/point_registration.hpp"

#include <algorithm>
#include <array>

#include <Eigen/LU>
#include <Eigen/SVD>

#include "common/random.hpp"

namespace swiftlet::mapping3d {
namespace {

using PointPair = std::pair<Eigen::Vector3d, Eigen::Vector3d>;
using PointPairs = std::vector<PointPair>;

/// Bits, of the 256 that describe a patch, in which two similar patches may differ.
constexpr int kGreatestDistance = 64;
/// The most similar patch must differ by at most this part of what the second most similar differs by (the ratio test
/// of Lowe, IJCV 2004, section 7.1).
constexpr double kGreatestRatio = 0.9;
/// Pairs agree on a pose when it maps their corners to within this distance of each other, and this growth, in metres,
/// with the square of the corner's depth in metres: the noise of a depth grows with its square.
constexpr double kAgreeing_m = 0.02, kAgreeingSlope = 0.015;
/// Triples of paired corners that are drawn to find a pose on which many pairs agree.
constexpr int kTrials = 200;
/// Least number of pairs that agree on a pose.
constexpr std::size_t kLeastPairs = 15;

struct Nearest {
  std::size_t index = 0;
  int distance = 257, second = 257;
};

std::vector<Nearest> nearestOf(const std::vector<DescribedPoint>& from, const std::vector<DescribedPoint>& to) {
  std::vector<Nearest> all(from.size());
  for (std::size_t i = 0; i < from.size(); ++i)
    for (std::size_t j = 0; j < to.size(); ++j) {
      const int distance = from[i].descriptor.distance(to[j].descriptor);
      Nearest& nearest = all[i];
      if (distance < nearest.distance) {
        nearest.second = nearest.distance;
        nearest.distance = distance;
        nearest.index = j;
      } else if (distance < nearest.second) {
        nearest.second = distance;
      }
    }
  return all;
}

PointPairs similarPairs(const std::vector<DescribedPoint>& a, const std::vector<DescribedPoint>& b) {
  const std::vector<Nearest> of_a = nearestOf(a, b), of_b = nearestOf(b, a);
  PointPairs pairs;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Nearest& nearest = of_a[i];
    if (nearest.distance > kGreatestDistance || of_b[nearest.index].index != i) continue;
    if (nearest.distance > kGreatestRatio * nearest.second) continue;
    pairs.emplace_back(a[i].point_camera_m, b[nearest.index].point_camera_m);
  }
  return pairs;
}

bool agrees(const common::Pose3& T_a_b, const PointPair& pair) {
  const double depth_m = std::max(pair.first.x(), pair.second.x());
  const double tolerance_m = kAgreeing_m + kAgreeingSlope * depth_m * depth_m;
  return (pair.first - T_a_b * pair.second).squaredNorm() < tolerance_m * tolerance_m;
}

PointPairs agreeingPairs(const common::Pose3& T_a_b, const PointPairs& pairs) {
  PointPairs agreeing;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(agreeing),
               [&](const PointPair& pair) { return agrees(T_a_b, pair); });
  return agreeing;
}

/// Triples whose sides differ between the two sets, or that are small, give no pose.
bool isUsableTriple(const std::array<const PointPair*, 3>& triple) {
  for (std::size_t i = 0; i < 3; ++i) {
    const PointPair &p = *triple[i], &q = *triple[(i + 1) % 3];
    const double in_a_m = (p.first - q.first).norm(), in_b_m = (p.second - q.second).norm();
    const double depth_m = std::max(p.first.x(), q.first.x());
    if (in_a_m < 0.1 * depth_m || std::abs(in_a_m - in_b_m) > 2.0 * (kAgreeing_m + kAgreeingSlope * depth_m * depth_m))
      return false;
  }
  return true;
}

}  // namespace

common::Pose3 rigidTransform(const PointPairs& a_and_b) {
  Eigen::Vector3d mean_a = Eigen::Vector3d::Zero(), mean_b = Eigen::Vector3d::Zero();
  for (const auto& [a, b] : a_and_b) {
    mean_a += a;
    mean_b += b;
  }
  mean_a /= static_cast<double>(a_and_b.size());
  mean_b /= static_cast<double>(a_and_b.size());
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  for (const auto& [a, b] : a_and_b) correlation += (a - mean_a) * (b - mean_b).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(correlation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1.0, 1.0, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0);
  const Eigen::Matrix3d rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  return {Eigen::Quaterniond(rotation).normalized(), mean_a - rotation * mean_b};
}

std::optional<common::Pose3> registerPoints(const std::vector<DescribedPoint>& a, const std::vector<DescribedPoint>& b,
                                            std::uint64_t seed) {
  const PointPairs pairs = similarPairs(a, b);
  if (pairs.size() < kLeastPairs) return std::nullopt;
  common::RandomStream random(seed, "point registration");
  const auto draw = [&] {
    return &pairs[static_cast<std::size_t>(random.uniform() * static_cast<double>(pairs.size()))];
  };
  PointPairs best;
  for (int i = 0; i < kTrials; ++i) {
    const std::array<const PointPair*, 3> triple{draw(), draw(), draw()};
    if (!isUsableTriple(triple)) continue;
    PointPairs agreeing = agreeingPairs(rigidTransform({*triple[0], *triple[1], *triple[2]}), pairs);
    if (agreeing.size() > best.size()) best = std::move(agreeing);
  }
  if (best.size() < kLeastPairs) return std::nullopt;
  common::Pose3 T_a_b;
  for (int i = 0; i < 3 && best.size() >= kLeastPairs; ++i) {
    T_a_b = rigidTransform(best);
    best = agreeingPairs(T_a_b, pairs);
  }
  if (best.size() < kLeastPairs) return std::nullopt;
  return T_a_b;
}

}  // namespace swiftlet::mapping3d
