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

PointPairs similarPairs(const std::vector<DescribedPoint>& a, const std::vector<DescribedPoint>& b,
                        const PointRegistrationConfig& config) {
  const std::vector<Nearest> of_a = nearestOf(a, b), of_b = nearestOf(b, a);
  PointPairs pairs;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Nearest& nearest = of_a[i];
    if (nearest.distance > config.greatest_distance || of_b[nearest.index].index != i) continue;
    if (nearest.distance > config.greatest_ratio * nearest.second) continue;
    pairs.emplace_back(a[i].point_camera_m, b[nearest.index].point_camera_m);
  }
  return pairs;
}

/// The tolerance grows with the square of the depth, as the noise does.
bool agrees(const common::Pose3& T_a_b, const PointPair& pair, const PointRegistrationConfig& config) {
  const double depth_m = std::max(pair.first.x(), pair.second.x());
  const double tolerance_m = config.agreeing_m + config.agreeing_slope * depth_m * depth_m;
  return (pair.first - T_a_b * pair.second).squaredNorm() < tolerance_m * tolerance_m;
}

PointPairs agreeingPairs(const common::Pose3& T_a_b, const PointPairs& pairs, const PointRegistrationConfig& config) {
  PointPairs agreeing;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(agreeing),
               [&](const PointPair& pair) { return agrees(T_a_b, pair, config); });
  return agreeing;
}

/// Triples whose sides differ between the two sets, or that are small, give no pose.
bool isUsableTriple(const std::array<const PointPair*, 3>& triple, const PointRegistrationConfig& config) {
  for (std::size_t i = 0; i < 3; ++i) {
    const PointPair &p = *triple[i], &q = *triple[(i + 1) % 3];
    const double in_a_m = (p.first - q.first).norm(), in_b_m = (p.second - q.second).norm();
    const double depth_m = std::max(p.first.x(), q.first.x());
    if (in_a_m < 0.1 * depth_m ||
        std::abs(in_a_m - in_b_m) > 2.0 * (config.agreeing_m + config.agreeing_slope * depth_m * depth_m))
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

std::optional<PointRegistration> registerPoints(const std::vector<DescribedPoint>& a,
                                                const std::vector<DescribedPoint>& b, std::uint64_t seed,
                                                const PointRegistrationConfig& config) {
  const PointPairs pairs = similarPairs(a, b, config);
  const auto least = static_cast<std::size_t>(config.least_pairs);
  if (pairs.size() < least) return std::nullopt;
  common::RandomStream random(seed, "point registration");
  const auto draw = [&] {
    return &pairs[static_cast<std::size_t>(random.uniform() * static_cast<double>(pairs.size()))];
  };
  PointPairs best;
  for (int i = 0; i < config.trials; ++i) {
    const std::array<const PointPair*, 3> triple{draw(), draw(), draw()};
    if (!isUsableTriple(triple, config)) continue;
    PointPairs agreeing = agreeingPairs(rigidTransform({*triple[0], *triple[1], *triple[2]}), pairs, config);
    if (agreeing.size() > best.size()) best = std::move(agreeing);
  }
  if (best.size() < least) return std::nullopt;
  PointRegistration found;
  for (int i = 0; i < 3 && best.size() >= least; ++i) {
    found.T_a_b = rigidTransform(best);
    best = agreeingPairs(found.T_a_b, pairs, config);
  }
  if (best.size() < least) return std::nullopt;
  found.agreeing = static_cast<int>(best.size());
  return found;
}

}  // namespace swiftlet::mapping3d
