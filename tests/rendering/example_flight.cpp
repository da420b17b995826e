#include "tests/rendering/example_flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/observed_cell.hpp"

namespace swiftlet::testing {
namespace {

using common::CellIndex;
using Eigen::Vector2d;

struct Box {
  double x0, y0, x1, y1;
};

// Outer walls, inner walls with doors, two boxes and a round pillar; metres in `map`.
constexpr std::array<Box, 14> kWalls{{{-2.0, -3.2, 9.6, -3.0},
                                      {-2.0, 6.0, 9.6, 6.2},
                                      {-2.2, -3.2, -2.0, 6.2},
                                      {9.6, -3.2, 9.8, 6.2},
                                      {-2.0, 2.0, 1.2, 2.15},
                                      {2.4, 2.0, 5.0, 2.15},
                                      {4.85, 2.0, 5.0, 3.6},
                                      {4.85, 4.8, 5.0, 6.0},
                                      {5.0, -3.0, 5.15, -0.6},
                                      {5.0, 0.7, 5.15, 2.0},
                                      {2.6, -1.6, 3.4, -0.8},
                                      {7.2, -1.9, 8.2, -1.2},
                                      {-1.2, 4.6, 0.2, 5.2},
                                      {7.0, 3.4, 7.2, 6.0}}};
constexpr std::array<std::array<double, 2>, 10> kRoute{{{0.0, 0.0},
                                                        {1.8, 1.0},
                                                        {1.8, 3.2},
                                                        {0.8, 3.6},
                                                        {3.4, 4.2},
                                                        {6.0, 4.2},
                                                        {6.2, 2.6},
                                                        {6.6, 0.0},
                                                        {4.2, 0.1},
                                                        {0.6, -1.6}}};

double clearSeconds(double value) { return std::max(0.0, value); }

}  // namespace

ExampleFlight::ExampleFlight() {
  layers_.vehicle.flight_state = common::FlightState::kFlying;
  layers_.mission.status.state = common::MissionState::kRunning;
  layers_.vehicle.state.horizontal_valid = layers_.vehicle.state.vertical_valid = true;
  look();
  describe();
}

ExampleRoom ExampleFlight::room() {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (std::size_t i = 0; i < kWalls.size(); ++i) {
    const Box& wall = kWalls[i];
    // The furniture: a cupboard, a table and a chest.
    const double height_m = i == 10 ? 1.7 : i == 11 ? 0.76 : i == 12 ? 1.1 : 2.4;
    boxes.emplace_back(Eigen::Vector3d(wall.x0, wall.y0, 0.0), Eigen::Vector3d(wall.x1, wall.y1, height_m));
  }
  return ExampleRoom(std::move(boxes));
}

bool ExampleFlight::isWall(const Vector2d& p) const {
  for (const Box& wall : kWalls)
    if (p.x() >= wall.x0 && p.x() < wall.x1 && p.y() >= wall.y0 && p.y() < wall.y1) return true;
  return (p - Vector2d(3.4, 3.2)).norm() < 0.22;
}

void ExampleFlight::look() {
  auto laser = std::make_shared<common::LaserPoints>();
  for (int beam = 0; beam < 540; ++beam) {
    const double angle = pose_.yaw_rad + (beam - 270) * 0.5 * M_PI / 180.0;
    const Vector2d direction(std::cos(angle), std::sin(angle));
    CellIndex last{INT32_MIN, 0};
    for (double r = 0.1; r < 6.0; r += 0.02) {
      const Vector2d p = pose_.position_m() + r * direction;
      const CellIndex cell = grid_.cellAt(p);
      if (isWall(p)) {
        grid_.set(cell, test_support::observed(grid_.at(cell), 18));
        laser->points_map_m.push_back(p.cast<float>());
        break;
      }
      if (cell != last) grid_.set(cell, test_support::observed(grid_.at(cell), -5));
      last = cell;
    }
  }
  layers_.vehicle.laser = laser;
}

void ExampleFlight::move(double seconds) {
  std::optional<Vector2d>& goal_map_m = layers_.mission.goal_map_m;
  const Vector2d target = goal_map_m ? *goal_map_m : Vector2d(kRoute[waypoint_][0], kRoute[waypoint_][1]);
  const Vector2d to_target_m = target - pose_.position_m();
  const double step_m = std::min(to_target_m.norm(), 0.8 * seconds);
  if (to_target_m.norm() > 1e-6) {
    const double turn = common::wrapAngle(std::atan2(to_target_m.y(), to_target_m.x()) - pose_.yaw_rad);
    pose_.yaw_rad = common::wrapAngle(pose_.yaw_rad + std::clamp(turn, -1.5 * seconds, 1.5 * seconds));
    pose_.x_m += step_m / to_target_m.norm() * to_target_m.x();
    pose_.y_m += step_m / to_target_m.norm() * to_target_m.y();
    layers_.vehicle.state.velocity_odom_m_s = {to_target_m.x() / to_target_m.norm() * 0.8,
                                               to_target_m.y() / to_target_m.norm() * 0.8, 0.0};
  }
  if ((target - pose_.position_m()).norm() < 0.05) {
    if (!goal_map_m) waypoint_ = (waypoint_ + 1) % kRoute.size();
    goal_map_m.reset();
  }
  const auto trail_map_m = trail_.trail().points_map_m();
  if (trail_map_m.empty() || (trail_map_m.back() - pose_.position_m()).norm() > 0.08) trail_.add(pose_.position_m());
  layers_.vehicle.distance_flown_m += step_m;
}

void ExampleFlight::describe() {
  layers_.stamp = layers_.vehicle.state.stamp = common::Time::fromSeconds(time_s_);
  layers_.vehicle.state.T_odom_body = common::lifted(pose_, 1.0 + 0.02 * std::sin(time_s_));
  layers_.vehicle.state.height_above_ground_m = 1.0;
  layers_.vehicle.state.position_covariance_m2 = Eigen::Vector3d(4e-4, 3e-4, 1e-4).asDiagonal();
  layers_.map.flown = layers_.map.grid = std::make_shared<const common::OccupancyGrid>(grid_.snapshot());
  layers_.vehicle.trail = trail_.trail();
  layers_.vehicle.plan_map_m.clear();
  if (layers_.mission.goal_map_m) {
    layers_.vehicle.plan_map_m.push_back(*layers_.mission.goal_map_m);
  } else {
    for (std::size_t i = waypoint_; i < std::min(waypoint_ + 2, kRoute.size()); ++i)
      layers_.vehicle.plan_map_m.emplace_back(kRoute[i][0], kRoute[i][1]);
  }
  std::int64_t known = 0;
  grid_.forEachCell([&](CellIndex, common::occupancy::Cell c) { known += common::occupancy::isFree(c); });
  layers_.map.explored_area_m2 = static_cast<double>(known) * 0.0025;
  layers_.energy.battery_remaining = clearSeconds(1.0 - time_s_ / 900.0);
  layers_.energy.battery_voltage_v = 10.6 + 2.0 * layers_.energy.battery_remaining;
  layers_.energy.seconds_left = 600.0 * layers_.energy.battery_remaining;
  layers_.energy.thrust_margin = 1.2 + 0.3 * layers_.energy.battery_remaining;
  layers_.mission.intent = {3, common::IntentState::kRunning, "to the frontier at (6.20, 2.60), 2.4 m away", false};
  layers_.mission.status.phase = "explore";
  layers_.mission.status.tree = {
      {0, -1, "Priority", "RUNNING"}, {1, 0, "AvoidObstacle", "SKIPPED"}, {2, 0, "Hold", "SKIPPED"},
      {3, 0, "Sequence", "RUNNING"},  {4, 3, "TakeOff 1.0 m", "SUCCESS"}, {5, 3, "Explore", "RUNNING"},
      {6, 3, "MoveToGoal", "IDLE"},   {7, 3, "GoHome", "IDLE"},           {8, 3, "Land", "IDLE"}};

  auto levels = std::make_shared<common::LevelMap>();
  common::Level table{2, 0.76, 1e-4, {}}, chair{3, 0.48, 1e-4, {}};
  for (int x = -12; x < -2; ++x)
    for (int y = -22; y < -14; ++y) table.cells.push_back({x, y});
  for (int x = 56; x < 61; ++x)
    for (int y = 42; y < 47; ++y) chair.cells.push_back({x, y});
  levels->levels = {table, chair};
  layers_.map.levels = levels;

  auto frontiers = std::make_shared<std::vector<common::Frontier>>();
  const auto add = [&](double x0, double y0, double x1, double y1, common::FrontierReason reason, const char* why) {
    common::Frontier f;
    f.length_m = std::hypot(x1 - x0, y1 - y0);
    f.centroid_map_m = {0.5 * (x0 + x1), 0.5 * (y0 + y1)};
    for (double t = 0.0; t <= 1.0; t += 0.05 / f.length_m)
      f.cells.push_back(grid_.cellAt(x0 + t * (x1 - x0), y0 + t * (y1 - y0)));
    f.reason = reason;
    f.explanation = why;
    frontiers->push_back(f);
  };
  add(5.2, 3.6, 5.3, 4.8, common::FrontierReason::kOpen, "next: gain 9.2 m2, 4.1 m away");
  add(8.4, -2.6, 9.3, -1.9, common::FrontierReason::kUnreachable, "unreachable at clearance 0.10 m");
  add(-1.9, 5.4, -1.4, 5.8, common::FrontierReason::kTooSmall, "too small: 0.35 m of 0.40 m");
  add(7.3, 5.9, 9.4, 5.9, common::FrontierReason::kOutOfBounds, "out of bounds");
  add(3.5, -2.6, 4.6, -2.6, common::FrontierReason::kBlacklisted, "blacklisted after 3 attempts");
  layers_.map.frontiers = frontiers;
}

/// Five frames a second.
void ExampleFlight::lookInDepth() {
  mapped_s_ = time_s_;
  layers_.map3d =
      mapper_->look(common::lifted(pose_, 1.0 + 0.02 * std::sin(time_s_)), common::Time::fromSeconds(time_s_));
}

std::shared_ptr<const common::World> ExampleFlight::advance(double seconds) {
  for (double left = seconds; left > 1e-9; left -= 0.1) {
    const double step = std::min(left, 0.1);
    time_s_ += step;
    move(step);
    look();
    if (mapper_ && (time_s_ - mapped_s_ > 0.19)) lookInDepth();
  }
  describe();
  return std::make_shared<const common::World>(layers_.world());
}

bool ExampleFlight::isKnownFree(const Vector2d& point_map_m) const {
  return common::occupancy::isFree(grid_.at(grid_.cellAt(point_map_m)));
}

common::CameraFrame ExampleFlight::cameraFrame(double time_s, int width_px, int height_px) {
  common::CameraFrame frame;
  frame.stamps.measured = frame.stamps.arrived = common::Time::fromSeconds(time_s);
  frame.image = {width_px, height_px, {}};
  frame.image.rgb.resize(3 * static_cast<std::size_t>(width_px) * height_px);
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) {
      const double shade = 0.5 + 0.5 * std::sin(0.03 * x + 2.0 * time_s) * std::cos(0.02 * y);
      std::uint8_t* pixel = &frame.image.rgb[3 * (static_cast<std::size_t>(y) * width_px + x)];
      pixel[0] = static_cast<std::uint8_t>(70 + 120 * shade);
      pixel[1] = static_cast<std::uint8_t>(80 + 90 * shade);
      pixel[2] = static_cast<std::uint8_t>(y < height_px / 2 ? 150 : 90);
    }
  return frame;
}

}  // namespace swiftlet::testing
