#include "vision/point_registration.hpp"

#include <algorithm>
#include <array>

#include <Eigen/LU>
#include <Eigen/SVD>

#include "common/random.hpp"

namespace swiftlet::vision {
namespace {

using PointPair = std::pair<Eigen::Vector3d, Eigen::Vector3d>;
using PointPairs = std::vector<PointPair>;
using IndexPairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// Bits, of the 256 that describe a patch, in which two similar patches may differ.
constexpr int kGreatestDistance = 64;
/// The most similar patch must differ by at most this part of what the second most similar differs by (the ratio test
/// of Lowe, IJCV 2004, section 7.1).
constexpr double kGreatestRatio = 0.9;
/// Triples of paired corners that are drawn to find a pose on which many pairs agree.
constexpr int kTrials = 200;
/// Least number of pairs that agree on a pose.
constexpr std::size_t kLeastPairs = 15;

/// The nearest of the others, for each of both sets. Each distance is computed once.
struct NearestBothWays {
  std::vector<NearestDescriptor> of_a, of_b;
};

NearestBothWays nearestOf(const std::vector<DescribedPoint>& a, const std::vector<DescribedPoint>& b,
                          const std::optional<Expectation>& expectation) {
  NearestBothWays nearest{std::vector<NearestDescriptor>(a.size()), std::vector<NearestDescriptor>(b.size())};
  for (std::size_t j = 0; j < b.size(); ++j) {
    const Eigen::Vector3d at_m =
        expectation ? expectation->T_a_b * b[j].point_camera_m : Eigen::Vector3d(Eigen::Vector3d::Zero());
    const double off_m = expectation ? expectation->share_of_depth * at_m.x() : 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (expectation && (a[i].point_camera_m - at_m).squaredNorm() > off_m * off_m) continue;
      const int distance = a[i].descriptor.distance(b[j].descriptor);
      nearest.of_a[i].consider(distance, j);
      nearest.of_b[j].consider(distance, i);
    }
  }
  return nearest;
}

IndexPairs similarPairs(const std::vector<DescribedPoint>& a, const std::vector<DescribedPoint>& b,
                        const std::optional<Expectation>& expectation) {
  const auto [of_a, of_b] = nearestOf(a, b, expectation);
  IndexPairs pairs;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const NearestDescriptor& nearest = of_a[i];
    if (nearest.distance > kGreatestDistance || of_b[nearest.index].index != i) continue;
    if (nearest.distance > kGreatestRatio * nearest.second) continue;
    pairs.emplace_back(i, nearest.index);
  }
  return pairs;
}

/// The search for the pose that most pairs agree on.
class Consensus {
 public:
  Consensus(const std::vector<DescribedPoint>& a, const std::vector<DescribedPoint>& b, const Agreement& agreement,
            const std::optional<Expectation>& expectation)
      : agreement_(agreement), indices_(similarPairs(a, b, expectation)) {
    for (const auto& [i, j] : indices_) points_.emplace_back(a[i].point_camera_m, b[j].point_camera_m);
  }

  std::optional<Registration> find(std::uint64_t seed) const;

 private:
  using Members = std::vector<std::size_t>;  ///< Numbers of pairs.

  double tolerance_m(double depth_m) const { return agreement_.floor_m + agreement_.slope_1_m * depth_m * depth_m; }
  bool agrees(const common::Pose3& T_a_b, const PointPair& pair) const {
    const double most_m = tolerance_m(std::max(pair.first.x(), pair.second.x()));
    return (pair.first - T_a_b * pair.second).squaredNorm() < most_m * most_m;
  }
  Members agreeing(const common::Pose3& T_a_b) const {
    Members members;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (agrees(T_a_b, points_[i])) members.push_back(i);
    return members;
  }
  common::Pose3 poseBy(const Members& members) const {
    PointPairs pairs;
    for (const std::size_t i : members) pairs.push_back(points_[i]);
    return rigidTransform(pairs);
  }
  bool isUsableTriple(const std::array<const PointPair*, 3>& triple) const;

  Agreement agreement_;
  IndexPairs indices_;
  PointPairs points_;
};

/// Triples whose sides differ between the two sets, or that are small, give no pose.
bool Consensus::isUsableTriple(const std::array<const PointPair*, 3>& triple) const {
  for (std::size_t i = 0; i < 3; ++i) {
    const PointPair &p = *triple[i], &q = *triple[(i + 1) % 3];
    const double in_a_m = (p.first - q.first).norm(), in_b_m = (p.second - q.second).norm();
    const double depth_m = std::max(p.first.x(), q.first.x());
    if (in_a_m < 0.1 * depth_m || std::abs(in_a_m - in_b_m) > 2.0 * tolerance_m(depth_m)) return false;
  }
  return true;
}

std::optional<Registration> Consensus::find(std::uint64_t seed) const {
  if (points_.size() < kLeastPairs) return std::nullopt;
  common::RandomStream random(seed, "point registration");
  const auto draw = [&] {
    return &points_[static_cast<std::size_t>(random.uniform() * static_cast<double>(points_.size()))];
  };
  Members best;
  for (int i = 0; i < kTrials; ++i) {
    const std::array<const PointPair*, 3> triple{draw(), draw(), draw()};
    if (!isUsableTriple(triple)) continue;
    Members members = agreeing(rigidTransform({*triple[0], *triple[1], *triple[2]}));
    if (members.size() > best.size()) best = std::move(members);
  }
  if (best.size() < kLeastPairs) return std::nullopt;
  common::Pose3 T_a_b;
  for (int i = 0; i < 3 && best.size() >= kLeastPairs; ++i) {
    T_a_b = poseBy(best);
    best = agreeing(T_a_b);
  }
  if (best.size() < kLeastPairs) return std::nullopt;
  Registration found{T_a_b, {}};
  for (const std::size_t i : best) found.pairs.push_back(indices_[i]);
  return found;
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

std::optional<Registration> registerPairs(const std::vector<DescribedPoint>& a, const std::vector<DescribedPoint>& b,
                                          std::uint64_t seed, const Agreement& agreement,
                                          const std::optional<Expectation>& expectation) {
  return Consensus(a, b, agreement, expectation).find(seed);
}

std::optional<common::Pose3> registerPoints(const std::vector<DescribedPoint>& a, const std::vector<DescribedPoint>& b,
                                            std::uint64_t seed) {
  const auto found = registerPairs(a, b, seed);
  return found ? std::optional(found->T_a_b) : std::nullopt;
}

}  // namespace swiftlet::vision
