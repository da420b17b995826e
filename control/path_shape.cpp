#include "control/path_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace swiftlet::control {
namespace {

constexpr double kSame_m = 1e-4;  ///< Nearer points give no direction in double arithmetic of a map.
constexpr double kArcStep_rad = 6.0 * std::numbers::pi / 180.0;  ///< A chord is off its arc by 0.14 % of the radius.
constexpr double kReversal_rad =
    150.0 * std::numbers::pi / 180.0;  ///< A sharper turn has no arc that fits: it is a stop.
constexpr double kCreep_m_s = 0.05;    ///< Least speed at a corner, so that it is passed at all.

double distanceToSegment(const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double length2 = along.squaredNorm();
  const double share = length2 > 0.0 ? std::clamp((point - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (point - a - share * along).norm();
}

double turnBetween(const Eigen::Vector3d& in, const Eigen::Vector3d& out) {
  return std::atan2(in.cross(out).norm(), in.dot(out));
}

/// The arc that replaces the corner b of a-b-c, tangent to both legs `tangent_m` away from it.
void appendArc(Points& out, const Eigen::Vector3d& b, const Eigen::Vector3d& in, const Eigen::Vector3d& leave,
               double turn_rad, double tangent_m) {
  const double radius_m = tangent_m / std::tan(0.5 * turn_rad);
  const Eigen::Vector3d start = b - tangent_m * in;
  const Eigen::Vector3d inward = (leave - leave.dot(in) * in).normalized();
  const int steps = std::max(1, static_cast<int>(std::ceil(turn_rad / kArcStep_rad)));
  for (int i = 0; i <= steps; ++i) {
    const double angle_rad = turn_rad * i / steps;
    out.push_back(start + radius_m * (std::sin(angle_rad) * in + (1.0 - std::cos(angle_rad)) * inward));
  }
}

}  // namespace

Points simplified(const Points& points, double tolerance_m) {
  if (points.size() < 2) return points;
  std::vector<bool> keep(points.size(), false);
  keep.front() = keep.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    double worst_m = tolerance_m;
    std::size_t split = 0;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double off_m = distanceToSegment(points[i], points[first], points[last]);
      if (off_m <= worst_m) continue;
      worst_m = off_m;
      split = i;
    }
    if (split == 0) continue;
    keep[split] = true;
    open.push_back({first, split});
    open.push_back({split, last});
  }
  Points out;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (keep[i] && (out.empty() || (points[i] - out.back()).norm() > kSame_m)) out.push_back(points[i]);
  // The last point is exactly the goal.
  out.back() = points.back();
  return out;
}

Points rounded(const Points& points, double deviation_m, bool free_first_corner) {
  if (points.size() < 3) return points;
  Points out{points.front()};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Eigen::Vector3d before = points[i] - points[i - 1], after = points[i + 1] - points[i];
    const double turn_rad = turnBetween(before, after);
    const bool is_free = free_first_corner && i == 1;
    if (turn_rad < kArcStep_rad || turn_rad > kReversal_rad) {
      out.push_back(points[i]);
      continue;
    }
    const double radius_m =
        is_free ? std::numeric_limits<double>::infinity() : deviation_m / (1.0 / std::cos(0.5 * turn_rad) - 1.0);
    // A leg between two corners is shared by both arcs; the first and the last leg belong to one.
    const double before_m = before.norm() * (i == 1 ? 1.0 : 0.5),
                 after_m = after.norm() * (i + 2 == points.size() ? 0.9 : 0.5);
    const double tangent_m = std::min({radius_m * std::tan(0.5 * turn_rad), before_m, after_m});
    appendArc(out, points[i], before.normalized(), after.normalized(), turn_rad, tangent_m);
  }
  out.push_back(points.back());
  Points distinct;
  for (const Eigen::Vector3d& point : out)
    if (distinct.empty() || (point - distinct.back()).norm() > kSame_m) distinct.push_back(point);
  if (distinct.size() == 1) distinct.push_back(points.back());
  distinct.back() = points.back();
  return distinct;
}

std::vector<double> distancesAlong(const Points& points) {
  std::vector<double> distances_m(points.size(), 0.0);
  for (std::size_t i = 1; i < points.size(); ++i)
    distances_m[i] = distances_m[i - 1] + (points[i] - points[i - 1]).norm();
  return distances_m;
}

Eigen::Vector3d pointOn(const Points& points, const std::vector<double>& distances_m, double distance_m) {
  if (points.size() < 2 || distance_m <= 0.0) return points.front();
  if (distance_m >= distances_m.back()) return points.back();
  const auto after = std::upper_bound(distances_m.begin(), distances_m.end(), distance_m) - distances_m.begin();
  const auto next = static_cast<std::size_t>(after);
  const double share = (distance_m - distances_m[next - 1]) / (distances_m[next] - distances_m[next - 1]);
  return points[next - 1] + share * (points[next] - points[next - 1]);
}

Nearest nearestOn(const Points& points, const std::vector<double>& distances_m, const Eigen::Vector3d& point,
                  double within_m) {
  Nearest best{0.0, (point - points.front()).norm()};
  for (std::size_t i = 1; i < points.size() && distances_m[i - 1] <= within_m; ++i) {
    const Eigen::Vector3d along = points[i] - points[i - 1];
    const double length_m = distances_m[i] - distances_m[i - 1];
    if (length_m <= 0.0) continue;
    const double at_m = std::clamp((point - points[i - 1]).dot(along) / length_m, 0.0,
                                   std::min(length_m, within_m - distances_m[i - 1]));
    const double off_m = (point - points[i - 1] - at_m / length_m * along).norm();
    if (off_m < best.off_m) best = {distances_m[i - 1] + at_m, off_m};
  }
  return best;
}

std::vector<double> speedsAlong(const Points& points, const SpeedLimits& limits) {
  std::vector<double> speeds_m_s(points.size(), limits.speed_m_s);
  if (points.empty()) return speeds_m_s;
  speeds_m_s.back() = 0.0;
  for (std::size_t i = points.size() - 1; i-- > 0;) {
    const Eigen::Vector3d after = points[i + 1] - points[i];
    const double length_m = after.norm();
    double& speed = speeds_m_s[i];
    const double climb_share = length_m > 0.0 ? std::abs(after.z()) / length_m : 0.0;
    if (climb_share > 0.0) speed = std::min(speed, limits.climb_m_s / climb_share);
    if (i > 0) {
      const Eigen::Vector3d before = points[i] - points[i - 1];
      const double turn_rad = turnBetween(before, after);
      const double curvature_1_m = turn_rad / (0.5 * (before.norm() + length_m));
      // A curve of many points is limited by its curvature, a lone corner by its change of velocity.
      if (turn_rad > 1e-3) {
        const double kink = limits.kink_m_s / (2.0 * std::sin(0.5 * turn_rad));
        const double curve = std::sqrt(limits.acceleration_m_s2 / curvature_1_m);
        speed = std::min(speed, std::max(kCreep_m_s, turn_rad > 1.5 * kArcStep_rad ? kink : std::min(curve, kink)));
      }
    }
    speed =
        std::min(speed, std::sqrt(speeds_m_s[i + 1] * speeds_m_s[i + 1] + 2.0 * limits.acceleration_m_s2 * length_m));
  }
  return speeds_m_s;
}

}  // namespace swiftlet::control
