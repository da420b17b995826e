#include "control/path_join.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swiftlet::control {
namespace {

using Eigen::Vector3d;

/// Greatest distance of the reference from a new path. Beyond it, an extra line leads the reference to the path.
constexpr double kOnPath_m = 0.03;
/// The reference joins a new path within its first stretch of this length.
constexpr double kJoin_m = 1.5;
constexpr double kLeastJoin_m = 0.3;  ///< Least distance along the path from abreast of the reference to the join.

class PathJoin {
 public:
  PathJoin(const Points& path, const JoinStart& from, const common::ClearanceAlong& clearance_m)
      : path_(path),
        from_(from),
        clearance_m_(clearance_m),
        along_m_(distancesAlong(path)),
        nearest_(nearestOn(path, along_m_, from.position_m, kJoin_m)) {}

  Points lines() const {
    const Points on_path = rest(nearest_.distance_m);
    // Within reach of the reference filter: the carrot starts on the path itself.
    const Vector3d direction =
        on_path.size() > 1 ? Vector3d((on_path[1] - on_path[0]).normalized()) : Vector3d(Vector3d::Zero());
    const Vector3d across = from_.velocity_m_s - std::max(0.0, from_.velocity_m_s.dot(direction)) * direction;
    if (nearest_.off_m <= kOnPath_m && across.norm() <= 2.0 * from_.kink_m_s)
      return rounded(on_path, from_.corner_deviation_m);
    return from_.velocity_m_s.norm() <= 2.0 * from_.kink_m_s ? straight() : turning();
  }

 private:
  struct Lines {
    Points points;
    double length_m;  ///< At least up to the path.
    double to_m;      ///< Along the path, where they join it.
  };

  Points straight() const {
    Lines ahead = through({from_.position_m}, nearest_.distance_m + nearest_.off_m, false);
    if (isFree(ahead)) return std::move(ahead.points);
    return roomier(std::move(ahead), through({from_.position_m}, nearest_.distance_m, false));
  }

  /// The first corner may deviate as far as its legs allow, so that it is flown at speed.
  Points turning() const {
    const double speed_m_s = from_.velocity_m_s.norm();
    const Vector3d heading = from_.velocity_m_s / speed_m_s;
    const Vector3d target = pointOn(
        path_, along_m_, std::min(nearest_.distance_m + std::max(nearest_.off_m, kLeastJoin_m), along_m_.back()));
    const double cosine = std::clamp(heading.dot((target - from_.position_m).normalized()), -1.0, 1.0);
    const double stop_m = 0.5 * speed_m_s * speed_m_s / from_.acceleration_m_s2;
    const double turn_m = 2.0 * stop_m * std::sqrt((1.0 - cosine) / std::max(1e-6, 1.0 + cosine));
    const double bend_m = std::min(stop_m, turn_m);
    const Vector3d corner = from_.position_m + bend_m * heading;
    const auto [corner_m, corner_off_m] = nearestOn(path_, along_m_, corner, kJoin_m);
    Lines smooth = through({from_.position_m, corner}, corner_m + std::max(corner_off_m, bend_m), true);
    if (isFree(smooth)) return std::move(smooth.points);
    const Vector3d stopped = from_.position_m + stop_m * heading;
    return roomier(std::move(smooth), through({from_.position_m, stopped},
                                              nearestOn(path_, along_m_, stopped, kJoin_m).distance_m, false));
  }

  Points rest(double from_m) const {
    Points points{pointOn(path_, along_m_, from_m)};
    for (std::size_t i = 0; i < path_.size(); ++i)
      if (along_m_[i] > from_m + 1e-6) points.push_back(path_[i]);
    return points;
  }

  Lines through(Points points, double to_m, bool free_first_corner) const {
    to_m = std::min(to_m, along_m_.back());
    const Points on_path = rest(to_m);
    points.push_back(on_path.front());
    const double length_m = distancesAlong(points).back();
    points.insert(points.end(), on_path.begin() + 1, on_path.end());
    return {rounded(points, from_.corner_deviation_m, free_first_corner), length_m, to_m};
  }

  bool isFree(const Lines& lines) const {
    if (!clearance_m_) return true;
    const double left_out_m = leastRoom_m(rest(nearest_.distance_m), std::max(0.0, lines.to_m - nearest_.distance_m));
    return room_m(lines) >= std::min(left_out_m, clearance_m_(from_.position_m, from_.position_m));
  }

  Points roomier(Lines smooth, Lines braked) const {
    return room_m(braked) > room_m(smooth) ? std::move(braked.points) : std::move(smooth.points);
  }

  double room_m(const Lines& lines) const { return leastRoom_m(lines.points, lines.length_m); }

  /// The least of all lines that begin within that length.
  double leastRoom_m(const Points& points, double length_m) const {
    double least_m = clearance_m_(points.front(), points.front());
    double at_m = 0.0;
    for (std::size_t i = 1; i < points.size() && at_m < length_m; ++i) {
      least_m = std::min(least_m, clearance_m_(points[i - 1], points[i]));
      at_m += (points[i] - points[i - 1]).norm();
    }
    return least_m;
  }

  const Points& path_;
  const JoinStart& from_;
  const common::ClearanceAlong& clearance_m_;
  std::vector<double> along_m_;
  Nearest nearest_;
};

}  // namespace

Points joined(const Points& path, const JoinStart& from, const common::ClearanceAlong& clearance_m) {
  return PathJoin(path, from, clearance_m).lines();
}

}  // namespace swiftlet::control
