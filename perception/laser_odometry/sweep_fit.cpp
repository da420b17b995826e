#include "perception/laser_odometry/sweep_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>

#include "common/square.hpp"
#include "perception/scan_matching/contour_normals.hpp"

namespace swiftlet::perception {
namespace {

using common::Pose2;
using common::square;

/// Parts of a sweep in which the velocity is constant: a robot may begin to turn at any time.
constexpr int kParts = 4;
constexpr int kUnknowns = 3 * (kParts + 1);
using Vector = Eigen::Matrix<double, kUnknowns, 1>;
using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

constexpr double kMaxGap_m = 0.4;  ///< Neighbouring points nearer than this are joined to a contour.
constexpr double kMaxRange_m = 20.0;
/// Pairing distances of the iterations.
constexpr std::array<double, 10> kReach_m{0.4, 0.3, 0.25, 0.2, 0.15, 0.12, 0.12, 0.12, 0.12, 0.12};
/// Error of a point. Larger ones count less and less.
constexpr double kPoint_m = 0.03;
constexpr double kStart_m = 0.01, kStart_rad = 0.005;  ///< Error of the pose at which a sweep begins.
/// Changes of the velocity from part to part. Where the robot moves evenly, each part of a sweep always sees the same
/// walls, and only this keeps the parts together. The turn rate may change at once, so its larger changes count less
/// and less; a wall ahead shows every part the turn, but only one part how far away it is.
constexpr double kSpeed_m_s = 0.08, kTurnRate_rad_s = 0.05, kGreatTurnRate_rad_s = 0.3;
constexpr double kScored_m = 0.2;

Eigen::Vector3d vectorOf(const Pose2& pose) { return {pose.x_m, pose.y_m, pose.yaw_rad}; }

Eigen::Vector3d velocityBetween(const Pose2& a, const Pose2& b, double seconds) {
  return (vectorOf(b) - vectorOf(a)) / std::max(seconds, 1e-3);
}

/// A point of a sweep with the normal of its contour, in the frame of the robot at the time of the beam.
struct SweptContourPoint {
  SweptPoint swept;
  Eigen::Vector2d normal;
};

/// The contours of a sweep in the frame of its first pose. orientedPoints() leaves points out, and keeps the order.
std::vector<OrientedPoint> contours(const Sweep& sweep, const SweepMotion& motion, std::vector<std::size_t>* indices) {
  const Pose2 T_start_reference = motion.knots.front().inverse();
  ProjectedScan scan;
  scan.points_level_m.reserve(sweep.points.size());
  for (const SweptPoint& point : sweep.points)
    scan.points_level_m.push_back((T_start_reference * (motion.at(point.share) * point.point_m)).cast<float>());
  std::vector<OrientedPoint> oriented = orientedPoints(scan, 0, kMaxGap_m, kMaxRange_m);
  if (indices == nullptr) return oriented;
  std::size_t index = 0;
  for (const OrientedPoint& point : oriented) {
    while (scan.points_level_m[index] != point.point_m) ++index;
    indices->push_back(index++);
  }
  return oriented;
}

std::vector<SweptContourPoint> sweptContours(const Sweep& sweep, const SweepMotion& motion) {
  std::vector<std::size_t> indices;
  const std::vector<OrientedPoint> oriented = contours(sweep, motion, &indices);
  std::vector<SweptContourPoint> result;
  for (std::size_t i = 0; i < oriented.size(); ++i) {
    const SweptPoint& swept = sweep.points[indices[i]];
    const double turned_rad = motion.knots.front().yaw_rad - motion.at(swept.share).yaw_rad;
    result.push_back({swept, Eigen::Rotation2Dd(turned_rad) * oriented[i].normal.cast<double>()});
  }
  return result;
}

/// The sum of squares around one set of knots, as normal equations of their changes.
class Equations {
 public:
  Equations() : matrix_(Matrix::Zero()), right_(Vector::Zero()) {}

  /// A residual that changes by `slope` with the pose at a share of the sweep.
  void addPoint(double share, const Eigen::Vector3d& slope, double residual, double weight) {
    const double place = share * kParts;
    const int k = std::min(static_cast<int>(place), kParts - 1);
    const double part = place - k;
    Eigen::Matrix<double, 6, 1> row;
    row << (1.0 - part) * slope, part * slope;
    matrix_.block<6, 6>(3 * k, 3 * k) += weight * row * row.transpose();
    right_.segment<6>(3 * k) -= weight * residual * row;
  }

  /// Residuals of three components, sum over knots of factor * knot - target; `factors` begins at knot `first`.
  template <std::size_t kCount>
  void addKnots(int first, const std::array<double, kCount>& factors, const Eigen::Vector3d& residual,
                const Eigen::Vector3d& weights) {
    for (std::size_t a = 0; a < kCount; ++a) {
      const int row = 3 * (first + static_cast<int>(a));
      for (std::size_t b = 0; b < kCount; ++b)
        matrix_.block<3, 3>(row, 3 * (first + static_cast<int>(b))).diagonal() += factors[a] * factors[b] * weights;
      right_.segment<3>(row) -= factors[a] * weights.cwiseProduct(residual);
    }
  }

  Vector solution() const { return matrix_.ldlt().solve(right_); }

 private:
  Matrix matrix_;
  Vector right_;
};

Eigen::Vector3d weightsOf(double metres, double radians) {
  return {1.0 / square(metres), 1.0 / square(metres), 1.0 / square(radians)};
}

/// Weights of a change of the velocity.
Eigen::Vector3d changeWeights(const Eigen::Vector3d& change) {
  Eigen::Vector3d weights = weightsOf(kSpeed_m_s, kGreatTurnRate_rad_s);
  weights.z() += 1.0 / (square(kTurnRate_rad_s) + square(change.z()));
  return weights;
}

Eigen::Vector3d offset(const Pose2& from, const Pose2& to) {
  return {to.x_m - from.x_m, to.y_m - from.y_m, common::wrapAngle(to.yaw_rad - from.yaw_rad)};
}

void addPriors(const SweepEnd& before, const std::optional<SweepEnd>& after, const Sweep& sweep, Equations& equations) {
  const std::vector<Pose2>& knots = sweep.motion.knots;
  const double dt = std::max(sweep.duration_s / kParts, 1e-3);
  const Eigen::Vector3d at_ends = weightsOf(kStart_m, kStart_rad);
  const auto velocity = [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    return velocityBetween(knots[i], knots[i + 1], dt);
  };
  const auto addChange = [&]<std::size_t kCount>(int first, const std::array<double, kCount>& factors,
                                                 const Eigen::Vector3d& change) {
    equations.addKnots(first, factors, change, changeWeights(change));
  };
  const double rate = 1.0 / dt;
  equations.addKnots<1>(0, {1.0}, offset(before.pose, knots.front()), at_ends);
  addChange.operator()<2>(0, {-rate, rate}, velocity(0) - before.velocity);
  for (int k = 1; k < kParts; ++k)
    addChange.operator()<3>(k - 1, {rate, -2.0 * rate, rate}, velocity(k) - velocity(k - 1));
  if (!after) return;
  equations.addKnots<1>(kParts, {1.0}, offset(after->pose, knots.back()), at_ends);
  addChange.operator()<2>(kParts - 1, {-rate, rate}, velocity(kParts - 1) - after->velocity);
}

struct PairedPoint {
  Eigen::Vector3d slope;  ///< Of the distance, by the pose.
  double distance_m = 0.0;
};

std::optional<PairedPoint> paired(const OrientedPoints& reference, const SweptContourPoint& point, const Pose2& pose,
                                  double reach_m) {
  const double c = std::cos(pose.yaw_rad), s = std::sin(pose.yaw_rad);
  const auto turned = [&](const Eigen::Vector2d& v) {
    return Eigen::Vector2d(c * v.x() - s * v.y(), s * v.x() + c * v.y());
  };
  const Eigen::Vector2d arm_m = turned(point.swept.point_m), at_m = arm_m + pose.position_m();
  const int nearest = reference.nearest(at_m, turned(point.normal), reach_m);
  if (nearest == OrientedPoints::kNone) return std::nullopt;
  const Eigen::Vector2d& normal = reference.normal(nearest);
  return PairedPoint{{normal.x(), normal.y(), arm_m.x() * normal.y() - arm_m.y() * normal.x()},
                     normal.dot(at_m - reference.point_m(nearest))};
}

}  // namespace

Eigen::Vector3d Sweep::lastVelocity() const {
  const std::vector<Pose2>& k = motion.knots;
  return velocityBetween(k[k.size() - 2], k.back(), duration_s / kParts);
}

Eigen::Vector3d Sweep::firstVelocity() const {
  return velocityBetween(motion.knots[0], motion.knots[1], duration_s / kParts);
}

Eigen::Vector3d Sweep::meanVelocity() const {
  return velocityBetween(motion.knots.front(), motion.knots.back(), duration_s);
}

SweepMotion uniformMotion(const Pose2& start, const Eigen::Vector3d& velocity, double duration_s) {
  SweepMotion motion;
  for (int k = 0; k <= kParts; ++k) {
    const Eigen::Vector3d moved = velocity * (duration_s * k / kParts);
    motion.knots.push_back({start.x_m + moved.x(), start.y_m + moved.y(), start.yaw_rad + moved.z()});
  }
  return motion;
}

void addSweep(const Sweep& sweep, OrientedPoints& reference) {
  reference.add(contours(sweep, sweep.motion, nullptr), sweep.motion.knots.front(), kMaxGap_m);
}

double fitOf(const OrientedPoints& reference, const Sweep& sweep, const SweepMotion& motion) {
  const std::vector<SweptContourPoint> points = sweptContours(sweep, motion);
  if (points.empty() || reference.empty()) return 0.0;
  double sum = 0.0;
  for (const SweptContourPoint& point : points)
    if (const auto pair = paired(reference, point, motion.at(point.swept.share), kScored_m))
      sum += std::max(0.0, 1.0 - square(pair->distance_m / kScored_m));
  return sum / static_cast<double>(points.size());
}

void fitSweep(const OrientedPoints& reference, const SweepEnd& before, const std::optional<SweepEnd>& after,
              Sweep& sweep) {
  for (const double reach_m : kReach_m) {
    const std::vector<SweptContourPoint> points = sweptContours(sweep, sweep.motion);
    Equations equations;
    addPriors(before, after, sweep, equations);
    for (const SweptContourPoint& point : points) {
      const auto pair = paired(reference, point, sweep.motion.at(point.swept.share), reach_m);
      if (!pair) continue;
      const double weight = 1.0 / (square(kPoint_m) + square(pair->distance_m));
      equations.addPoint(point.swept.share, pair->slope, pair->distance_m, weight);
    }
    const Vector change = equations.solution();
    if (!change.allFinite()) return;
    for (int k = 0; k <= kParts; ++k) {
      Pose2& knot = sweep.motion.knots[static_cast<std::size_t>(k)];
      knot.x_m += change(3 * k);
      knot.y_m += change(3 * k + 1);
      knot.yaw_rad += change(3 * k + 2);
    }
  }
}

}  // namespace swiftlet::perception
