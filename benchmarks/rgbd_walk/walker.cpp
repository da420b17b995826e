#include "benchmarks/rgbd_walk/walker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <stdexcept>
#include <utility>

#include "common/random.hpp"

namespace swiftlet::rgbd_walk {
namespace {

using Eigen::Vector2d;
using Path = std::vector<Vector2d>;

constexpr double kCell_m = 0.1;
/// A place to go to is at least so far away, or it is the farthest of those that were drawn.
constexpr double kLeastLeg_m = 4.0;
constexpr int kDraws = 40;
/// Paths are rounded over this length to both sides.
constexpr double kRounding_m = 0.3;
/// At a place the person looks around for so long.
constexpr double kStop_s = 1.6;

/// Where the person can stand.
class Floor {
 public:
  Floor(const simulation::WorldModel& world, const simulation::RayCaster& rays, const Eigen::Vector3d& start_world_m,
        const WalkConfig& config) {
    const Eigen::AlignedBox3f bounds = world.bounds_world_m();
    origin_m_ = bounds.min().head<2>().cast<double>();
    columns_ = static_cast<int>(bounds.sizes().x() / kCell_m) + 1;
    rows_ = static_cast<int>(bounds.sizes().y() / kCell_m) + 1;
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column) {
        bool is_free = true;
        for (double height_m = config.clearance_m + 0.05; is_free && height_m < config.height_m + 0.2;
             height_m += config.clearance_m) {
          Eigen::Vector3d at_m;
          at_m << centre(row * columns_ + column), start_world_m.z() + height_m;
          is_free = rays.nearest(at_m, config.clearance_m).shape == simulation::Hit::kNothing;
        }
        free_.push_back(is_free);
      }
  }

  int cellAt(const Vector2d& at_m) const {
    const Eigen::Vector2i cell = ((at_m - origin_m_) / kCell_m).array().floor().cast<int>();
    return std::clamp(cell.y(), 0, rows_ - 1) * columns_ + std::clamp(cell.x(), 0, columns_ - 1);
  }
  bool isFree(int cell) const { return free_[static_cast<std::size_t>(cell)]; }
  Vector2d centre(int cell) const {
    return origin_m_ + kCell_m * Vector2d(cell % columns_ + 0.5, cell / columns_ + 0.5);
  }

  /// From a cell to all others: Dijkstra's algorithm over eight neighbours.
  struct Distances {
    std::vector<double> length_m;
    std::vector<int> before;
  };
  Distances from(int start) const {
    Distances all{std::vector<double>(free_.size(), std::numeric_limits<double>::infinity()),
                  std::vector<int>(free_.size(), -1)};
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    all.length_m[static_cast<std::size_t>(start)] = 0.0;
    open.emplace(0.0, start);
    while (!open.empty()) {
      const auto [length_m, cell] = open.top();
      open.pop();
      if (length_m > all.length_m[static_cast<std::size_t>(cell)]) continue;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int column = cell % columns_ + dx, row = cell / columns_ + dy;
          if (column < 0 || row < 0 || column >= columns_ || row >= rows_) continue;
          const int next = row * columns_ + column;
          const double next_m = length_m + kCell_m * std::hypot(dx, dy);
          if (!isFree(next) || next_m >= all.length_m[static_cast<std::size_t>(next)]) continue;
          all.length_m[static_cast<std::size_t>(next)] = next_m;
          all.before[static_cast<std::size_t>(next)] = cell;
          open.emplace(next_m, next);
        }
    }
    return all;
  }

  /// Whether the straight line is free.
  bool isStraight(const Vector2d& a_m, const Vector2d& b_m) const {
    const int steps = static_cast<int>((b_m - a_m).norm() / (0.5 * kCell_m)) + 1;
    for (int i = 0; i <= steps; ++i)
      if (!isFree(cellAt(a_m + (b_m - a_m) * i / steps))) return false;
    return true;
  }
  int cells() const { return static_cast<int>(free_.size()); }

 private:
  Vector2d origin_m_;
  int columns_ = 0, rows_ = 0;
  std::vector<bool> free_;
};

/// The corners of the path from one cell to another that straight lines cannot leave out.
Path pulled(const Floor& floor, const Floor::Distances& distances, int goal) {
  Path cells;
  for (int at = goal; at >= 0; at = distances.before[static_cast<std::size_t>(at)]) cells.push_back(floor.centre(at));
  std::reverse(cells.begin(), cells.end());
  Path path{cells.front()};
  for (std::size_t i = 0; i + 1 < cells.size();) {
    std::size_t next = i + 1;
    while (next + 1 < cells.size() && floor.isStraight(cells[i], cells[next + 1])) ++next;
    path.push_back(cells[next]);
    i = next;
  }
  return path;
}

/// Points every centimetre.
Path sampled(const Path& corners) {
  constexpr double kStep_m = 0.01;
  Path points;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const int steps = std::max(1, static_cast<int>((corners[i] - corners[i - 1]).norm() / kStep_m));
    for (int k = 0; k < steps; ++k) points.push_back(corners[i - 1] + (corners[i] - corners[i - 1]) * k / steps);
  }
  points.push_back(corners.back());
  return points;
}

/// The mean over some length to both sides; the ends stay.
Path rounded(const Path& points) {
  const auto reach = static_cast<std::ptrdiff_t>(kRounding_m / 0.01);
  Path round;
  const auto count = static_cast<std::ptrdiff_t>(points.size());
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const std::ptrdiff_t half = std::min({reach, i, count - 1 - i});
    Vector2d sum = Vector2d::Zero();
    for (std::ptrdiff_t k = i - half; k <= i + half; ++k) sum += points[static_cast<std::size_t>(k)];
    round.push_back(sum / static_cast<double>(2 * half + 1));
  }
  return round;
}

double angleBetween(double to_rad, double from_rad) {
  return std::remainder(to_rad - from_rad, 2.0 * std::numbers::pi);
}

/// The hand that holds the camera.
class Hand {
 public:
  Hand(const WalkConfig& config, double floor_m, double heading_rad, std::uint64_t seed)
      : config_(config), floor_m_(floor_m), yaw_rad_(heading_rad), random_(seed, "hand") {
    for (double& phase : phases_) phase = 2.0 * std::numbers::pi * random_.uniform();
  }

  double yaw_rad() const { return yaw_rad_; }
  /// Turns towards a heading as fast as people do, and looks to both sides of it by `look_rad`.
  common::Pose3 step(const Vector2d& at_m, double heading_rad, double look_rad) {
    time_s_ += kWalkStep_s;
    const double wanted_rad = heading_rad + look_rad * std::sin(2.0 * std::numbers::pi * time_s_ / 4.5 + phases_[0]);
    constexpr double kResponse_s = 0.25;
    const double rate =
        std::clamp(angleBetween(wanted_rad, yaw_rad_) / kResponse_s, -config_.turn_rate_rad_s, config_.turn_rate_rad_s);
    rate_rad_s_ += (rate - rate_rad_s_) * kWalkStep_s / 0.1;
    yaw_rad_ += kWalkStep_s * rate_rad_s_;
    const auto swing = [&](double hz, int i) { return std::sin(2.0 * std::numbers::pi * hz * time_s_ + phases_[i]); };
    return {
        common::quaternionFrom({0.035 * swing(0.9, 1), 0.12 + 0.05 * swing(0.5, 2) + 0.015 * swing(1.8, 3), yaw_rad_}),
        {at_m.x(), at_m.y(), floor_m_ + config_.height_m + 0.02 * swing(1.8, 4)}};
  }

 private:
  WalkConfig config_;
  double floor_m_, yaw_rad_, rate_rad_s_ = 0.0, time_s_ = 0.0;
  common::RandomStream random_;
  double phases_[5] = {};
};

/// Draws where to go next, until the walk is long enough.
class Walker {
 public:
  Walker(const Floor& floor, const WalkConfig& config, const Vector2d& start_m, double floor_m, std::uint64_t seed)
      : floor_(floor), config_(config), at_m_(start_m), hand_(config, floor_m, 0.0, seed), random_(seed, "walk") {}

  std::vector<common::Pose3> walk() {
    for (double walked_m = 0.0; walked_m < config_.length_m;) {
      const Path path = rounded(sampled(nextLeg()));
      walked_m += 0.01 * static_cast<double>(path.size());
      follow(path);
      for (double stop_s = 0.0; stop_s < kStop_s; stop_s += kWalkStep_s)
        poses_.push_back(hand_.step(at_m_, heading_rad_, 1.2));
    }
    return std::move(poses_);
  }

 private:
  Path nextLeg() {
    const Floor::Distances distances = floor_.from(floor_.cellAt(at_m_));
    int best = -1;
    double best_m = 0.0;
    for (int i = 0; i < kDraws && best_m < kLeastLeg_m; ++i) {
      const int cell = std::min(floor_.cells() - 1, static_cast<int>(random_.uniform() * floor_.cells()));
      const double length_m = distances.length_m[static_cast<std::size_t>(cell)];
      if (!std::isfinite(length_m) || length_m <= best_m) continue;
      best = cell;
      best_m = length_m;
    }
    if (best < 0) throw std::runtime_error("the start of the world leaves no room to walk");
    return pulled(floor_, distances, best);
  }

  /// Slower while the view is far from the way.
  void follow(const Path& path) {
    for (double walked_m = 0.0; walked_m < 0.01 * static_cast<double>(path.size() - 1);) {
      const auto at = static_cast<std::size_t>(walked_m / 0.01);
      const Vector2d ahead = path[std::min(at + 40, path.size() - 1)] - path[at];
      if (ahead.norm() > 0.02) heading_rad_ = std::atan2(ahead.y(), ahead.x());
      const double off_rad = std::abs(angleBetween(heading_rad_, hand_.yaw_rad()));
      walked_m += kWalkStep_s * config_.speed_m_s * std::clamp(1.8 - off_rad, 0.1, 1.0);
      at_m_ =
          path[at] + (path[std::min(at + 1, path.size() - 1)] - path[at]) * (walked_m / 0.01 - static_cast<double>(at));
      poses_.push_back(hand_.step(at_m_, heading_rad_, 0.5));
    }
    at_m_ = path.back();
  }

  const Floor& floor_;
  WalkConfig config_;
  Vector2d at_m_;
  double heading_rad_ = 0.0;
  Hand hand_;
  common::RandomStream random_;
  std::vector<common::Pose3> poses_;
};

}  // namespace

std::vector<common::Pose3> walkThrough(const simulation::WorldModel& world, const simulation::RayCaster& rays,
                                       const WalkConfig& config, std::uint64_t seed) {
  const Eigen::Vector3d start_m = world.T_world_start ? world.T_world_start->position_m : Eigen::Vector3d::Zero();
  const Floor floor(world, rays, start_m, config);
  return Walker(floor, config, start_m.head<2>(), start_m.z(), seed).walk();
}

}  // namespace swiftlet::rgbd_walk
