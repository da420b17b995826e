// A room in which the reactive layer receives, tick by tick, what the laser sees.
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "grid_builder.hpp"
#include "perception/people/background_map.hpp"
#include "perception/people/dynamic_obstacles.hpp"
#include "planning/avoidance/avoidance.hpp"
#include "tests/support/observed_cell.hpp"

namespace swiftlet::planning::test {

using common::Duration;
using common::Pose2;
using common::Time;
using Point = Eigen::Vector2d;

inline constexpr double kHull_m = 0.275;
inline constexpr double kTick_s = 0.025;

struct Person {
  Point place_map_m;
  Point velocity_map_m_s;
  double radius_m = 0.25;
};

/// A room with a vehicle, a laser of 1,081 beams over 270 deg, and people who do not yield.
class Story {
 public:
  explicit Story(int width_cells = 200, int height_cells = 160, Avoidance::Config config = {})
      : grid_(room(width_cells, height_cells)),
        map_({}, 0.05),
        truth_({}, 0.05),
        avoidance_(config, kHull_m),
        config_(config),
        background_(Duration::fromSeconds(perception::DynamicObstacles::kBackgroundAge_s)) {
    learn();
    truth_ = map_;
  }

  void addWall(common::CellRect rect) {
    fill(grid_, rect, kWallCell);
    learn();
    truth_ = map_;
  }
  void learn() {
    snapshot_ = std::make_shared<common::OccupancyGrid>(grid_.snapshot());
    map_.update(*snapshot_, {});
    background_.add(now, snapshot_);
  }

  /// Draws standing people into the map and removes them again, as SLAM does all the time.
  void mapScan(const std::vector<Eigen::Vector2f>& points_map) {
    for (const auto& p : points_map) {
      const Point hit = p.cast<double>(), step = hit - pose.position_m();
      common::CellIndex last = grid_.cellAt(hit);
      for (double r = step.norm() - 0.05; r > 0.0; r -= 0.05) {
        const common::CellIndex cell = grid_.cellAt(pose.position_m() + step.normalized() * r);
        if (cell != last && cell != grid_.cellAt(hit)) grid_.set(cell, test_support::observed(grid_.at(cell), -8));
        last = cell;
      }
      grid_.set(grid_.cellAt(hit), test_support::observed(grid_.at(grid_.cellAt(hit)), 17));
    }
    learn();
  }

  double range(double bearing_map_rad) const {
    const Point u(std::cos(bearing_map_rad), std::sin(bearing_map_rad));
    double best = 30.0;
    for (double r = 0.0; r < best;) {
      const common::CellIndex cell = truth_.cellAt(pose.position_m() + r * u);
      if (truth_.states().at(cell) != CellState::kFree) best = std::min(best, r);
      r += std::max(0.01, truth_.clearance().at_m(cell, Against::kObstacles) - 0.1);
    }
    for (const Person& person : people) best = std::min(best, toDisc(person.place_map_m, person.radius_m, u));
    for (const Person& pole : poles) best = std::min(best, toDisc(pole.place_map_m, pole.radius_m, u));
    return best;
  }

  std::vector<Eigen::Vector2f> scan() const {
    std::vector<Eigen::Vector2f> points;
    for (int i = 0; i < beams; ++i) {
      const double bearing_rad = (i * 270.0 / (beams - 1) - 135.0) * std::numbers::pi / 180.0;
      const double r = range(pose.yaw_rad + bearing_rad);
      if (r < 30.0) points.push_back((r * Point(std::cos(bearing_rad), std::sin(bearing_rad))).cast<float>());
    }
    return points;
  }

  /// One scan, taken `age_s` ago; `wanted_map_m_s` is the velocity the intent asks for, in the map frame.
  AvoidanceDecision sense(const Point& wanted_map_m_s) {
    on_the_way_.push_back({now, pose, scan()});
    while (on_the_way_.size() > 1 && (now - on_the_way_[1].stamp).seconds() >= age_s - 1e-9) on_the_way_.pop_front();
    const auto& [stamp, at, points] = on_the_way_.front();
    std::vector<Eigen::Vector2f> points_map;
    for (const auto& p : points) points_map.push_back((at * Point(p.cast<double>())).cast<float>());
    if (live_map && ++scans_ % 4 == 0) mapScan(points_map);
    dynamic_.update(stamp, {at.position_m(), points_map, std::vector<float>(points_map.size(), 0.0F)},
                    *background_.at(stamp));
    const Eigen::Rotation2Dd to_level(-at.yaw_rad);
    std::vector<Point> edges_level_m;
    for (const Point& edge : keep_out_map_m) edges_level_m.push_back(at.inverse() * edge);
    std::vector<Eigen::Vector2f> below_level_m;
    for (const Point& point : below_the_beams_map_m) below_level_m.push_back((at.inverse() * point).cast<float>());
    return avoidance_.update({stamp, points, to_level * velocity_map_m_s, to_level * wanted_map_m_s, at,
                              &map_.clearance(), dynamic_.obstacles(), (now - stamp).seconds(), position_sigma_m,
                              below_level_m, edges_level_m});
  }

  /// Senses, obeys with its acceleration, and lets time pass. Returns the smallest gap to any person.
  AvoidanceDecision tick(const Point& wanted_map_m_s) {
    AvoidanceDecision decision = sense(wanted_map_m_s);
    Point target = wanted_map_m_s;
    if (target.norm() > decision.speed_limit_m_s) target = target.normalized() * decision.speed_limit_m_s;
    if (decision.retreat_velocity_level_m_s)
      target = Eigen::Rotation2Dd(pose.yaw_rad) * *decision.retreat_velocity_level_m_s;
    delayed_.push_back(target);
    if (delayed_.size() > 4) delayed_.erase(delayed_.begin());
    const Point change = delayed_.front() - velocity_map_m_s;
    const double most = 1.2 * kTick_s;
    velocity_map_m_s += change.norm() > most ? Point(change.normalized() * most) : change;
    pose.x_m += (velocity_map_m_s + unknown_velocity_map_m_s).x() * kTick_s;
    pose.y_m += (velocity_map_m_s + unknown_velocity_map_m_s).y() * kTick_s;
    for (Person& person : people) person.place_map_m += person.velocity_map_m_s * kTick_s;
    now += Duration::fromSeconds(kTick_s);
    for (const Person& person : people)
      least_gap_m = std::min(least_gap_m, (person.place_map_m - pose.position_m()).norm() - person.radius_m - kHull_m);
    least_wall_m = std::min(least_wall_m,
                            truth_.clearance().at_m(truth_.cellAt(pose.position_m()), Against::kObstacles) - kHull_m);
    retreats += decision.status.retreating && !was_retreating_;
    was_retreating_ = decision.status.retreating;
    return decision;
  }

  Pose2 pose{5.0, 4.0, 0.0};
  Point velocity_map_m_s = Point::Zero();
  Point unknown_velocity_map_m_s = Point::Zero();  ///< By which the estimated velocity is wrong.
  double position_sigma_m = 0.0;
  std::vector<Person> people;
  std::vector<Person> poles;
  std::vector<Point> keep_out_map_m;         ///< Of the edges of keep-out zones.
  std::vector<Point> below_the_beams_map_m;  ///< Of obstacles that the 3D map has and no beam meets.
  Time now = Time::fromSeconds(10.0);
  double least_gap_m = 1e9;
  double least_wall_m = 1e9;
  int retreats = 0;
  bool live_map = false;
  int beams = 1081;
  double age_s = 0.0;
  const CostMap& map() const { return map_; }

 private:
  double toDisc(const Point& center_m, double radius_m, const Point& u) const {
    const Point to = center_m - pose.position_m();
    const double ahead_m = to.dot(u), aside2 = to.squaredNorm() - ahead_m * ahead_m;
    if (ahead_m <= 0.0 || aside2 >= radius_m * radius_m) return 30.0;
    return ahead_m - std::sqrt(radius_m * radius_m - aside2);
  }

  common::OccupancyGrid grid_;
  std::shared_ptr<const common::OccupancyGrid> snapshot_;
  CostMap map_;
  CostMap truth_;
  Avoidance avoidance_;
  Avoidance::Config config_;
  perception::BackgroundMap background_;
  perception::DynamicObstacles dynamic_;
  struct Seen {
    Time stamp;
    Pose2 pose;
    std::vector<Eigen::Vector2f> points;
  };
  std::deque<Seen> on_the_way_;  ///< Scans that have not arrived, after the one that has.
  std::vector<Point> delayed_;
  bool was_retreating_ = false;
  int scans_ = 0;
};

}  // namespace swiftlet::planning::test
