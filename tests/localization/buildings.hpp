// Random buildings, their maps, and walks through them, for the tests of localization. Only the scoring sees the truth.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>
#include <vector>

#include "common/check.hpp"
#include "common/occupancy_grid.hpp"
#include "common/random.hpp"
#include "perception/projection/scan_projection.hpp"
#include "tests/scan_matching/planar_world.hpp"

namespace swiftlet::test {

/// A rectangle along the axes.
struct Area {
  Eigen::Vector2d low_m, high_m;
  Eigen::Vector2d center() const { return 0.5 * (low_m + high_m); }
};

struct Building {
  PlanarWorld world;         ///< Walls, and the furniture that was there when the map was made.
  std::vector<Area> rooms;   ///< Where furniture may stand.
  Eigen::Vector2d inside_m;  ///< A free place.
};

/// A wall with doors of 1 m, each at its middle.
inline void addWall(PlanarWorld& world, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                    std::vector<double> doors_m) {
  const Eigen::Vector2d along = (to - from).normalized();
  const double length = (to - from).norm();
  std::sort(doors_m.begin(), doors_m.end());
  double at = 0.0;
  for (const double door : doors_m) {
    world.addPolyline({from + along * at, from + along * (door - 0.5)}, false);
    at = door + 0.5;
  }
  world.addPolyline({from + along * at, from + along * length}, false);
}

inline void addFurniture(PlanarWorld& world, const Area& room, int boxes, common::RandomStream& random) {
  for (int i = 0; i < boxes; ++i) {
    const double x = random.uniform(room.low_m.x() + 0.5, room.high_m.x() - 0.5);
    const double y = random.uniform(room.low_m.y() + 0.5, room.high_m.y() - 0.5);
    // Drawn one by one: compilers differ in the order of the arguments of a call.
    const double turn_rad = random.uniform(-1.5, 1.5), depth_m = random.uniform(0.3, 0.8);
    world.addBox(x, y, random.uniform(0.3, 1.0), depth_m, turn_rad);
  }
}

/// The outer walls and the corridor of offices.
struct Outline {
  double length_m = 0.0, half_corridor_m = 0.0;
  std::array<double, 2> depths_m{};  ///< Of the offices to the right and to the left.
};

/// A corridor with offices on both sides, each with its own width, door and furniture; with that outline, or one drawn.
inline Building offices(std::uint64_t seed, const std::optional<Outline>& outline = std::nullopt) {
  common::RandomStream random(seed, "offices");
  Building building;
  const double length = outline ? outline->length_m : random.uniform(18.0, 30.0);
  const double half = outline ? outline->half_corridor_m : random.uniform(0.9, 1.4);
  building.inside_m = {1.0, 0.0};
  for (const double side : {-1.0, 1.0}) {
    std::vector<double> doors;
    const double depth = outline ? outline->depths_m[side > 0.0 ? 1 : 0] : random.uniform(3.5, 6.0);
    for (double x = 0.0; x < length - 1.0;) {
      double width = random.uniform(2.8, 5.5);
      if (length - x - width < 2.8) width = length - x;
      doors.push_back(x + random.uniform(0.8, width - 0.8));
      if (x > 0.0) building.world.addPolyline({{x, side * half}, {x, side * (half + depth)}}, false);
      const double low = std::min(side * half, side * (half + depth)),
                   high = std::max(side * half, side * (half + depth));
      building.rooms.push_back({{x, low}, {x + width, high}});
      addFurniture(building.world, building.rooms.back(), static_cast<int>(random.uniform(1.0, 4.0)), random);
      x += width;
    }
    addWall(building.world, {0.0, side * half}, {length, side * half}, doors);
    building.world.addPolyline(
        {{0.0, side * half}, {0.0, side * (half + depth)}, {length, side * (half + depth)}, {length, side * half}},
        false);
  }
  building.world.addPolyline({{0.0, -half}, {0.0, half}}, false);
  building.world.addPolyline({{length, -half}, {length, half}}, false);
  return building;
}

/// A hall with columns and alcoves, beside it a few rooms.
inline Building hall(std::uint64_t seed) {
  common::RandomStream random(seed, "hall");
  Building building;
  const double width = random.uniform(10.0, 16.0), depth = random.uniform(8.0, 12.0);
  building.inside_m = {0.5 * width, 0.5 * depth};
  building.world.addPolyline({{0.0, depth}, {0.0, 0.0}, {width, 0.0}, {width, depth}}, false);
  for (int i = 0; i < 5; ++i) {
    const double turn_rad = random.uniform(-0.7, 0.7), y_m = random.uniform(1.5, depth - 1.5);
    building.world.addBox(random.uniform(1.5, width - 1.5), y_m, 0.5, 0.5, turn_rad);
  }
  building.rooms.push_back({{0.5, 0.5}, {width - 0.5, depth - 0.5}});
  std::vector<double> doors;
  const double room_depth = random.uniform(3.0, 5.0);
  for (double x = 0.0; x < width;) {
    double room = random.uniform(3.0, 5.0);
    if (width - x - room < 3.0) room = width - x;
    doors.push_back(x + random.uniform(0.8, room - 0.8));
    if (x > 0.0) building.world.addPolyline({{x, depth}, {x, depth + room_depth}}, false);
    building.rooms.push_back({{x, depth}, {x + room, depth + room_depth}});
    addFurniture(building.world, building.rooms.back(), 2, random);
    x += room;
  }
  addWall(building.world, {0.0, depth}, {width, depth}, doors);
  building.world.addPolyline({{0.0, depth}, {0.0, depth + room_depth}, {width, depth + room_depth}, {width, depth}},
                             false);
  // No column is so thick that its inside is farther than this from its faces.
  while (building.world.distanceToWall(building.inside_m) < 0.5)
    building.inside_m = {random.uniform(1.0, width - 1.0), random.uniform(1.0, depth - 1.0)};
  return building;
}

/// Two wings that are identical to the centimetre, turned by 180 degrees about the middle of a hallway that joins them.
/// Only the objects in the hallway distinguish them.
inline Building twinWings(std::uint64_t seed) {
  common::RandomStream random(seed, "twin wings");
  Building building;
  const double length = random.uniform(12.0, 18.0), half = random.uniform(0.9, 1.3);
  building.inside_m = {0.0, 0.0};
  const auto bothWings = [&](const std::vector<Eigen::Vector2d>& line) {
    building.world.addPolyline(line, false);
    std::vector<Eigen::Vector2d> turned;
    for (const Eigen::Vector2d& p : line) turned.push_back(-p);
    building.world.addPolyline(turned, false);
  };
  // Niches on either side of a wing, at the same places in the other.
  for (const double side : {-1.0, 1.0}) {
    std::vector<Eigen::Vector2d> line{{3.0, side * half}};
    for (double x = 4.0; x < length - 2.0;) {
      const double width = random.uniform(0.8, 2.0), depth = random.uniform(0.3, 1.5);
      for (const Eigen::Vector2d& p : {Eigen::Vector2d(x, half), Eigen::Vector2d(x, half + depth),
                                       Eigen::Vector2d(x + width, half + depth), Eigen::Vector2d(x + width, half)})
        line.emplace_back(p.x(), side * p.y());
      x += width + random.uniform(0.6, 2.5);
    }
    line.emplace_back(length, side * half);
    bothWings(line);
  }
  bothWings({{length, -half}, {length, half}});
  // The hallway: 6 m wide, with boxes on one side only.
  bothWings({{3.0, half}, {3.0, 4.0}, {-3.0, 4.0}, {-3.0, half}});
  building.world.addBox(2.2, 3.0, 1.2, 0.8, 0.2);
  building.world.addBox(-1.5, 3.3, 0.8, 0.6, -0.4);
  building.world.addBox(2.4, -2.0, 0.5, 0.5, 0.6);
  return building;
}

/// The map a robot would have made: occupied at the walls it saw, free where it can have been, unknown elsewhere.
inline common::OccupancyGrid mapOf(const Building& building, double resolution_m = 0.05) {
  common::OccupancyGrid map = common::makeOccupancyGrid(resolution_m);
  for (const Wall& wall : building.world.walls) {
    const double length = (wall.b_m - wall.a_m).norm();
    const int steps = std::max(1, static_cast<int>(std::ceil(3.0 * length / resolution_m)));
    for (int i = 0; i <= steps; ++i)
      map.set(map.cellAt(wall.a_m + (wall.b_m - wall.a_m) * (static_cast<double>(i) / steps)),
              common::occupancy::kMaxSteps);
  }
  std::deque<common::CellIndex> open{map.cellAt(building.inside_m)};
  map.set(open.front(), -common::occupancy::kMaxSteps);
  while (!open.empty()) {
    const common::CellIndex c = open.front();
    open.pop_front();
    for (const auto& [dx, dy] : std::array<std::array<int, 2>, 4>{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}}) {
      const common::CellIndex next{c.x + dx, c.y + dy};
      if (std::abs(next.x) > 4000 || std::abs(next.y) > 4000) return map;  // A leak in the walls.
      if (!common::occupancy::isUnknown(map.at(next))) continue;
      map.set(next, -common::occupancy::kMaxSteps);
      open.push_back(next);
    }
  }
  return map;
}

/// Paths through a building, clear of its walls.
class Walks {
 public:
  explicit Walks(const Building& building, double clearance_m = 0.35) : inside_m_(building.inside_m) {
    const common::OccupancyGrid map = mapOf(building, kCell_m);
    const common::CellRect known = common::knownExtent(map);
    const int margin = static_cast<int>(std::ceil(clearance_m / kCell_m));
    begin_ = known.begin;
    width_ = known.width();
    height_ = known.height();
    free_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        bool clear = common::occupancy::isFree(map.at({begin_.x + x, begin_.y + y}));
        for (int dy = -margin; clear && dy <= margin; ++dy)
          for (int dx = -margin; clear && dx <= margin; ++dx)
            clear = dx * dx + dy * dy > margin * margin ||
                    !common::occupancy::isOccupied(map.at({begin_.x + x + dx, begin_.y + y + dy}));
        free_[index({x, y})] = clear ? 1 : 0;
      }
    keepReachable();
  }

  Eigen::Vector2d somewhere(common::RandomStream& random) const {
    SWIFTLET_CHECK(!free_.empty(), free_.size());
    for (;;) {
      const auto at =
          std::min(free_.size() - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(free_.size())));
      if (free_[at] != 0) return pointOf({static_cast<int>(at) % width_, static_cast<int>(at) / width_});
    }
  }

  /// Waypoints some centimetres apart, along the shortest path over cells.
  std::vector<Eigen::Vector2d> path(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
    const common::CellIndex start = cellOf(from), goal = cellOf(to);
    std::vector<int> came(free_.size(), -1);
    std::deque<common::CellIndex> open{goal};
    came[index(goal)] = static_cast<int>(index(goal));
    while (!open.empty() && came[index(start)] < 0) {
      const common::CellIndex c = open.front();
      open.pop_front();
      for (const auto& [dx, dy] : kSteps) {
        const common::CellIndex next{c.x + dx, c.y + dy};
        if (!isFree(next) || came[index(next)] >= 0) continue;
        came[index(next)] = static_cast<int>(index(c));
        open.push_back(next);
      }
    }
    std::vector<Eigen::Vector2d> path{from};
    for (common::CellIndex c = start; came[index(c)] >= 0 && !(c == goal);) {
      const int next = came[index(c)];
      c = {next % width_, next / width_};
      path.push_back(pointOf(c));
    }
    return path;
  }

 private:
  static constexpr double kCell_m = 0.10;
  static constexpr std::array<std::array<int, 2>, 8> kSteps{
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

  std::size_t index(common::CellIndex c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(c.x);
  }
  bool isFree(common::CellIndex c) const {
    return c.x >= 0 && c.y >= 0 && c.x < width_ && c.y < height_ && free_[index(c)] != 0;
  }
  common::CellIndex cellOf(const Eigen::Vector2d& p) const {
    return {static_cast<int>(std::floor(p.x() / kCell_m)) - begin_.x,
            static_cast<int>(std::floor(p.y() / kCell_m)) - begin_.y};
  }
  Eigen::Vector2d pointOf(common::CellIndex c) const {
    return {(c.x + begin_.x + 0.5) * kCell_m, (c.y + begin_.y + 0.5) * kCell_m};
  }
  /// Of the free cells only the largest connected part.
  void keepReachable() {
    std::vector<std::uint8_t> best, seen(free_.size(), 0);
    std::size_t most = 0;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      if (free_[i] == 0 || seen[i] != 0) continue;
      std::vector<std::uint8_t> part(free_.size(), 0);
      std::deque<common::CellIndex> open{{static_cast<int>(i) % width_, static_cast<int>(i) / width_}};
      seen[i] = part[i] = 1;
      std::size_t count = 0;
      while (!open.empty()) {
        const common::CellIndex c = open.front();
        open.pop_front();
        ++count;
        for (const auto& [dx, dy] : kSteps) {
          const common::CellIndex next{c.x + dx, c.y + dy};
          if (!isFree(next) || seen[index(next)] != 0) continue;
          seen[index(next)] = part[index(next)] = 1;
          open.push_back(next);
        }
      }
      if (count > most) {
        most = count;
        best = part;
      }
    }
    free_ = best;
  }

  Eigen::Vector2d inside_m_;
  common::CellIndex begin_;
  int width_ = 0, height_ = 0;
  std::vector<std::uint8_t> free_;
};

/// A robot that moves from place to place, looks along its path, and can be carried away.
class Walker {
 public:
  Walker(const Walks& walks, std::uint64_t seed, double speed_m_s = 0.7)
      : walks_(&walks), random_(seed, "walker"), speed_m_s_(speed_m_s) {
    carry(walks_->somewhere(random_), random_.uniform(-3.1, 3.1));
  }

  const common::Pose2& pose() const { return pose_; }

  void carry(const Eigen::Vector2d& to, double yaw_rad) {
    pose_ = {to.x(), to.y(), yaw_rad};
    path_.clear();
  }
  Eigen::Vector2d somewhereElse(double least_m) {
    for (int i = 0;; ++i) {
      Eigen::Vector2d place = walks_->somewhere(random_);
      if ((place - pose_.position_m()).norm() > least_m || i > 1000) return place;
    }
  }

  void advance(double dt_s) {
    while (path_.size() < 2) plan();
    double left_m = speed_m_s_ * dt_s;
    Eigen::Vector2d at = pose_.position_m();
    while (left_m > 0.0 && path_.size() > 1) {
      const Eigen::Vector2d to = path_[1] - at;
      if (to.norm() > left_m) {
        at += to.normalized() * left_m;
        left_m = 0.0;
      } else {
        left_m -= to.norm();
        at = path_[1];
        path_.pop_front();
      }
    }
    // It looks a little ahead and turns with at most 1.5 rad/s.
    const Eigen::Vector2d ahead = path_[std::min<std::size_t>(path_.size() - 1, 5)] - at;
    double turn = ahead.norm() > 0.05 ? common::wrapAngle(std::atan2(ahead.y(), ahead.x()) - pose_.yaw_rad) : 0.0;
    turn = std::clamp(turn, -1.5 * dt_s, 1.5 * dt_s);
    pose_ = {at.x(), at.y(), common::wrapAngle(pose_.yaw_rad + turn)};
  }

 private:
  void plan() {
    const std::vector<Eigen::Vector2d> path = walks_->path(pose_.position_m(), walks_->somewhere(random_));
    path_.assign(path.begin(), path.end());
  }

  const Walks* walks_;
  common::RandomStream random_;
  double speed_m_s_;
  common::Pose2 pose_;
  std::deque<Eigen::Vector2d> path_;
};

/// Level scans of a laser with 181 beams over 270 degrees and 12 m, 2 cm noise, 1 % dropouts.
inline perception::ProjectedScan levelScan(const PlanarWorld& world, const common::Pose2& pose, common::Time stamp,
                                           common::RandomStream& random) {
  constexpr int kBeams = 181;
  constexpr double kRange_m = 12.0;
  perception::ProjectedScan scan;
  scan.stamp = stamp;
  const Eigen::Vector3d origin(pose.x_m, pose.y_m, 1.0);
  for (int i = 0; i < kBeams; ++i) {
    const double angle = (-135.0 + 270.0 * i / (kBeams - 1)) * common::kRadPerDeg;
    const Eigen::Vector3d direction(std::cos(pose.yaw_rad + angle), std::sin(pose.yaw_rad + angle), 0.0);
    const double range = world.cast(origin, direction) + random.gaussian(0.02);
    if (!(range < kRange_m) || range < 0.05 || random.chance(0.01)) continue;
    scan.points_level_m.emplace_back(static_cast<float>(range * std::cos(angle)),
                                     static_cast<float>(range * std::sin(angle)));
    scan.heights_level_m.push_back(0.0F);
  }
  return scan;
}

/// Odometry that drifts: by 2 % of the path length, by half a degree a metre, and by 2 % of each turn (one sigma). It
/// does not notice when the robot is carried.
class DriftingOdometry {
 public:
  explicit DriftingOdometry(std::uint64_t seed) : random_(seed, "odometry") {}

  const common::Pose2& pose() const { return pose_; }
  void step(const common::Pose2& moved) {
    // Errors of single steps that add up to those per metre.
    const double path_length_m = moved.position_m().norm(), turn_rad = std::abs(common::wrapAngle(moved.yaw_rad));
    const double root = std::sqrt(path_length_m);
    pose_ = pose_ * common::Pose2{moved.x_m + random_.gaussian(0.02 * root), moved.y_m + random_.gaussian(0.02 * root),
                                  moved.yaw_rad + random_.gaussian(0.5 * common::kRadPerDeg * root + 0.02 * turn_rad)};
  }

 private:
  common::RandomStream random_;
  common::Pose2 pose_{3.0, -2.0, 1.0};  ///< An arbitrary origin.
};

}  // namespace swiftlet::test
