#include "evaluation/exploration/flat_flight.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "planning/search/planner.hpp"
#include "planning/search/wavefront.hpp"

namespace swiftlet::evaluation {
namespace {

using common::CellIndex;
using planning::CostMap;
using planning::Viewpoint;
using Point = Eigen::Vector2d;

constexpr double kStep_s = 0.1;
/// A beam every 0.375 degrees: half of those of the shipped laser.
constexpr double kBeam_rad = 0.375 * std::numbers::pi / 180.0;
/// As in the maneuver `Explore`.
constexpr double kLook_s = 0.5, kPeriod_s = 0.5, kPeriodShare = 0.15, kTolerance_m = 0.15;
constexpr double kTolerance_rad = 12.0 * std::numbers::pi / 180.0;
/// The nose is along the path but near its end, as the follower of paths turns it.
constexpr double kTurnBefore_m = 0.6;
/// The share of the reachable places that may be left, as in trials of flights.
constexpr double kUnseen = 0.01;

/// The fastest way through a corner between two legs.
double cornerSpeed_m_s(const Point& before, const Point& after, const FlatFlightConfig& config) {
  const double lengths = before.norm() * after.norm();
  if (lengths < 1e-12) return 0.0;
  const double half = 0.5 * std::acos(std::clamp(before.dot(after) / lengths, -1.0, 1.0));
  const double radius_m = config.corner_deviation_m * std::cos(half) / std::max(1e-9, 1.0 - std::cos(half));
  return std::sqrt(config.acceleration_m_s2 * radius_m);
}

/// A point on a path.
class Mover {
 public:
  Mover(const Point& start_m, const FlatFlightConfig& config) : config_(config), pose_{start_m.x(), start_m.y(), 0.0} {}

  const common::Pose2& pose() const { return pose_; }
  double flown_m() const { return flown_m_; }
  double rest_m() const {
    double rest_m = 0.0;
    Point at_m = pose_.position_m();
    for (std::size_t i = next_; i < path_m_.size(); ++i) {
      rest_m += (path_m_[i] - at_m).norm();
      at_m = path_m_[i];
    }
    return rest_m;
  }
  const std::vector<Point>& path_m() const { return path_m_; }
  std::size_t next() const { return next_; }

  /// Speed in the direction of the new path is kept, the rest is lost.
  void follow(std::vector<Point> path_m, double goal_yaw_rad) {
    if (path_m.size() > 1) {
      const Point leg = path_m[1] - path_m[0];
      speed_m_s_ *= leg.norm() > 1e-9 ? std::max(0.0, heading_.dot(leg.normalized())) : 1.0;
    }
    path_m_ = std::move(path_m);
    next_ = 1;
    goal_yaw_rad_ = goal_yaw_rad;
  }
  void stop() {
    path_m_.clear();
    next_ = 0;
    speed_m_s_ = 0.0;
  }

  void step() {
    const double wanted_rad = move();
    const double turn_rad = common::wrapAngle(wanted_rad - pose_.yaw_rad), most_rad = config_.yaw_rate_rad_s * kStep_s;
    pose_.yaw_rad = common::wrapAngle(pose_.yaw_rad + std::clamp(turn_rad, -most_rad, most_rad));
  }

 private:
  /// Moves and returns the wanted yaw.
  double move() {
    if (next_ >= path_m_.size()) return path_m_.empty() ? pose_.yaw_rad : goal_yaw_rad_;
    const double rest_m = this->rest_m();
    speed_m_s_ = std::min(speed_m_s_ + config_.acceleration_m_s2 * kStep_s, allowedSpeed_m_s(rest_m));
    double budget_m = std::min(std::max(speed_m_s_, 0.02) * kStep_s, rest_m);
    flown_m_ += budget_m;
    while (next_ < path_m_.size()) {
      const Point leg = path_m_[next_] - pose_.position_m();
      const double leg_m = leg.norm(), go_m = std::min(budget_m, leg_m);
      if (leg_m > 1e-9) {
        heading_ = leg / leg_m;
        pose_.x_m += heading_.x() * go_m;
        pose_.y_m += heading_.y() * go_m;
      }
      budget_m -= go_m;
      if (go_m < leg_m - 1e-9) break;
      ++next_;
    }
    return rest_m < kTurnBefore_m ? goal_yaw_rad_ : std::atan2(heading_.y(), heading_.x());
  }

  /// From which it can still slow down for each corner ahead and for the end.
  double allowedSpeed_m_s(double rest_m) const {
    const double a = config_.acceleration_m_s2;
    double allowed = std::min(config_.speed_m_s, std::sqrt(2.0 * a * rest_m));
    double ahead_m = 0.0;
    Point at_m = pose_.position_m();
    for (std::size_t i = next_; i + 1 < path_m_.size(); ++i) {
      ahead_m += (path_m_[i] - at_m).norm();
      const double corner = cornerSpeed_m_s(path_m_[i] - at_m, path_m_[i + 1] - path_m_[i], config_);
      allowed = std::min(allowed, std::sqrt(corner * corner + 2.0 * a * ahead_m));
      at_m = path_m_[i];
    }
    return allowed;
  }

  const FlatFlightConfig& config_;
  common::Pose2 pose_;
  std::vector<Point> path_m_;
  std::size_t next_ = 0;
  double goal_yaw_rad_ = 0.0, speed_m_s_ = 0.0, flown_m_ = 0.0;
  Point heading_ = Point::UnitX();
};

class Exploration {
 public:
  Exploration(const FlatBuilding& building, const Point& start_m, const FlatFlightConfig& config)
      : building_(building),
        start_m_(start_m),
        config_(config),
        grid_(common::makeOccupancyGrid(building.resolution_m())),
        known_(static_cast<std::size_t>(building.rect().width()) * building.rect().height(), false),
        map_(config.cost_map, building.resolution_m()),
        mover_(start_m, config),
        planner_(planning::makePlanner(config.planner)) {}

  FlatFlight fly() {
    takeOff();
    while (time_s_ < config_.limit_s && flight_.failure.empty() && !done_) {
      scan();
      look();
      if (isDue()) decide();
      if (done_) break;
      mover_.step();
      time_s_ += kStep_s;
    }
    if (!done_ && flight_.failure.empty()) flight_.failure = fmt::format("not done after {:.0f} s", time_s_);
    flight_.explore_s = time_s_;
    flight_.explore_m = mover_.flown_m();
    flight_.unseen_share = unseenShare();
    if (flight_.failure.empty() && flight_.unseen_share > kUnseen)
      flight_.failure = fmt::format("{:.1f} % of the reachable places unseen", 100.0 * flight_.unseen_share);
    if (done_) goHome();
    flight_.total_s = time_s_;
    flight_.total_m = mover_.flown_m();
    flight_.complete = flight_.failure.empty();
    return flight_;
  }

 private:
  /// What the hull covers at the start is free.
  void takeOff() {
    const double radius_m = config_.footprint.radius_m();
    const int reach = static_cast<int>(radius_m / building_.resolution_m()) + 1;
    const CellIndex middle = building_.cellAt(start_m_);
    for (int y = middle.y - reach; y <= middle.y + reach; ++y)
      for (int x = middle.x - reach; x <= middle.x + reach; ++x)
        if (!building_.isWall({x, y}) && (building_.centerOf({x, y}) - start_m_).norm() <= radius_m) see({x, y}, false);
  }

  void see(CellIndex cell, bool is_wall) {
    const std::size_t index = building_.indexOf(cell);
    if (known_[index]) return;
    known_[index] = true;
    grid_.set(cell, is_wall ? common::occupancy::kMaxSteps : -common::occupancy::kMaxSteps);
  }

  void scan() {
    const double fan_rad = config_.laser_field_of_view_deg * std::numbers::pi / 180.0;
    const int beams = static_cast<int>(fan_rad / kBeam_rad) + 1;
    for (int i = 0; i < beams; ++i)
      building_.cast(mover_.pose().position_m(), mover_.pose().yaw_rad - 0.5 * fan_rad + i * kBeam_rad,
                     config_.laser_range_m, [this](CellIndex cell, bool is_wall) { see(cell, is_wall); });
  }

  /// A viewpoint is finished when it has looked from there.
  void look() {
    looked_ = false;
    if (!current_) return;
    const common::Pose2& pose = mover_.pose();
    const bool there = (pose.position_m() - current_->pose_map.position_m()).norm() < kTolerance_m &&
                       std::abs(common::wrapAngle(pose.yaw_rad - current_->pose_map.yaw_rad)) < kTolerance_rad;
    looks_s_ = there ? looks_s_ + kStep_s : 0.0;
    if (looks_s_ < kLook_s) return;
    attempts_.push_back(planning::attemptFrom(*current_));
    current_.reset();
    looks_s_ = 0.0;
    looked_ = true;
  }

  bool isDue() {
    const double period_s = std::max(kPeriod_s, kPeriodShare * mover_.rest_m() / config_.speed_m_s);
    return !current_ || looked_ || time_s_ - asked_s_ >= period_s - 1e-9 || isBlocked();
  }

  /// What was seen since then is in the way of the path.
  bool isBlocked() {
    if (time_s_ - mapped_s_ < kMapPeriod_s - 1e-9) return false;
    updateMap();
    for (std::size_t i = std::max<std::size_t>(1, mover_.next()); i < mover_.path_m().size(); ++i)
      if (i > escape_points_ &&
          segmentCost(map_, i == mover_.next() ? mover_.pose().position_m() : mover_.path_m()[i - 1],
                      mover_.path_m()[i])
              .lethal)
        return true;
    return false;
  }

  void updateMap() {
    mapped_s_ = time_s_;
    map_.update(grid_.snapshot(), config_.footprint);
  }

  void decide() {
    updateMap();
    asked_s_ = time_s_;
    const double begin_s = clock_s();
    planning::ExplorationInput input;
    input.cost_map = std::make_shared<const CostMap>(map_);
    input.pose_map = mover_.pose();
    input.current = current_;
    input.attempts = attempts_;
    input.leave_building = true;
    input.home_map_m = start_m_;
    const planning::ExplorationResult result = planning::explore(input, config_.explorer);
    ++flight_.calls;
    done_ = result.done;
    if (done_) return mover_.stop();
    if (!result.next) {
      flight_.failure = result.reason;
      return;
    }
    auto path = planner_->plan(map_, mover_.pose().position_m(), result.next->pose_map.position_m());
    flight_.longest_call_s = std::max(flight_.longest_call_s, clock_s() - begin_s);
    if (!path) {
      flight_.failure = "no path to a viewpoint: " + path.error().text;
      return;
    }
    if (!result.kept_current) {
      ++flight_.viewpoints;
      looks_s_ = 0.0;
      current_ = result.next;
    }
    escape_points_ = path->escape_points;
    mover_.follow(std::move(path->points_map_m), current_->pose_map.yaw_rad);
  }

  double clock_s() const { return config_.clock_s ? config_.clock_s() : 0.0; }

  double unseenShare() const {
    CostMap truth(config_.cost_map, building_.resolution_m());
    planning::Footprint footprint = config_.footprint;
    footprint.clearance_m += building_.resolution_m();
    truth.update(building_.seen(), footprint);
    const CellIndex start = truth.cellAt(start_m_);
    if (truth.costAt(start) == CostMap::kLethal) return 0.0;
    planning::CostField field;
    field.spread(truth, start);
    std::size_t reachable = 0, unseen = 0;
    for (int i = 0; i < static_cast<int>(truth.costs().size()); ++i) {
      if (!field.reached(i)) continue;
      ++reachable;
      unseen += known_[building_.indexOf(truth.cellOf(i))] ? 0 : 1;
    }
    return static_cast<double>(unseen) / static_cast<double>(reachable);
  }

  void goHome() {
    updateMap();
    auto path = planner_->plan(map_, mover_.pose().position_m(), start_m_);
    if (!path) {
      flight_.failure = "no path home: " + path.error().text;
      return;
    }
    mover_.follow(std::move(path->points_map_m), mover_.pose().yaw_rad);
    while (mover_.rest_m() > kTolerance_m && time_s_ < 2.0 * config_.limit_s) {
      mover_.step();
      time_s_ += kStep_s;
    }
  }

  /// The cost map of a flight is never older than this.
  static constexpr double kMapPeriod_s = 0.25;

  const FlatBuilding& building_;
  Point start_m_;
  const FlatFlightConfig& config_;
  common::OccupancyGrid grid_;
  std::vector<bool> known_;
  CostMap map_;
  Mover mover_;
  std::unique_ptr<planning::Planner> planner_;
  std::optional<Viewpoint> current_;
  std::vector<planning::ExplorationAttempt> attempts_;
  FlatFlight flight_;
  std::size_t escape_points_ = 0;
  double time_s_ = 0.0, asked_s_ = -1.0, mapped_s_ = -1.0, looks_s_ = 0.0;
  bool looked_ = false, done_ = false;
};

}  // namespace

FlatFlight exploreFlat(const FlatBuilding& building, const Point& start_m, const FlatFlightConfig& config) {
  return Exploration(building, start_m, config).fly();
}

}  // namespace swiftlet::evaluation
