#include "simulation/referee.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

namespace swiftlet::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLandingSpeed_m_s = 1.0;                             // Above this speed the gear breaks.
constexpr double kLandingTilt_rad = 25.0 * std::numbers::pi / 180.0;  // A touch-down with more tilt is a crash.
constexpr double kSkidSpeed_m_s = 1.0;  // Above this speed along the floor the vehicle tumbles.
constexpr double kTipOver_m = 0.05;     // Above this height difference of the feet the vehicle tips over.
constexpr double kStill_m_s = 0.1;      // A slower vehicle stands: it did not fly into the person.
constexpr double kDeepest_m = 1000.0;   // Range of the ray to the floor; deeper than any world.

void crash(Truth& truth, common::Time now, const std::string& name, const std::string& reason) {
  if (truth.crashed) return;
  truth.crashed = true;
  truth.touched = name;
  truth.crash_reason = reason;
  truth.contact_time = now;
}

std::string touchedAt(const std::string& name, const Vector3d& point) {
  return fmt::format("touched `{}` at ({:.2f}, {:.2f}, {:.2f})", name, point.x(), point.y(), point.z());
}

}  // namespace

Referee::Referee(const WorldModel& world, const RayCaster& rays, const Scenario& scenario)
    : world_(world),
      rays_(rays),
      hull_{scenario.vehicle.hullRadius_m(), 0.5 * scenario.vehicle.hull_height_m},
      people_(scenario.laser, rays),
      gear_radius_m_(scenario.quadrotor.gear_radius_m),
      lowest_world_m_(world.bounds_world_m().min().z()),
      floor_world_m_(-std::numeric_limits<double>::infinity()) {}

void Referee::lookDown(const QuadrotorState& state) {
  const Vector3d& position = state.T_world_body.position_m;
  const double yaw_rad = common::yawOf(state.T_world_body.rotation);
  double lowest_m = std::numeric_limits<double>::infinity();
  floor_world_m_ = -lowest_m;
  floor_shape_ = Hit::kNothing;
  for (int foot = 0; foot < 5; ++foot) {
    const double angle_rad = yaw_rad + (0.25 + 0.5 * foot) * std::numbers::pi;
    const double reach_m = foot < 4 ? gear_radius_m_ : 0.0;
    const Vector3d from = position + reach_m * Vector3d(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    const Hit hit = rays_.cast(from, -Vector3d::UnitZ(), kDeepest_m);
    const double height_m = from.z() - hit.distance_m;
    lowest_m = std::min(lowest_m, height_m);
    if (!hit || height_m <= floor_world_m_) continue;
    floor_world_m_ = height_m;
    floor_shape_ = hit.shape;
  }
  feet_apart_m_ = floor_world_m_ - lowest_m;
}

void Referee::judgeTouchDown(common::Time now, const QuadrotorState& before, const QuadrotorState& after,
                             Truth& truth) const {
  const Vector3d& position = after.T_world_body.position_m;
  if (position.z() < lowest_world_m_ - 2.0) crash(truth, now, "", "fell out of the world");
  if (!after.standing || floor_shape_ == Hit::kNothing) return;
  const std::string& name = nameOf(world_.shapes[static_cast<std::size_t>(floor_shape_)]);
  const Vector3d point(position.x(), position.y(), floor_world_m_);
  if (feet_apart_m_ > kTipOver_m) crash(truth, now, name, "tipped over: " + touchedAt(name, point));
  if (before.standing) return;
  const double sink_m_s = -before.velocity_world_m_s.z();
  const double skid_m_s = before.velocity_world_m_s.head<2>().norm();
  const double tilt_rad = std::acos(std::clamp(common::cosTilt(before.T_world_body.rotation), -1.0, 1.0));
  const char* how = sink_m_s > kLandingSpeed_m_s  ? "too fast"
                    : skid_m_s > kSkidSpeed_m_s   ? "skidding"
                    : tilt_rad > kLandingTilt_rad ? "tilted"
                                                  : nullptr;
  if (how != nullptr)
    crash(truth, now, name, fmt::format("{} {}, sinking {:.2f} m/s", touchedAt(name, point), how, sink_m_s));
}

void Referee::judgeContacts(common::Time now, const QuadrotorState& state, std::span<const Walker> walkers,
                            std::span<const Door> doors, const std::vector<bool>& seen, Truth& truth) {
  if (first_) last_position_world_m_ = state.T_world_body.position_m;
  first_ = false;
  judgeWorld(now, state, seen, truth);
  people_.look(now, state.T_world_body, walkers);
  for (std::size_t i = 0; i < walkers.size(); ++i)
    if (walkers[i].actor()) judgeWalker(now, state, *walkers[i].actor(), i, truth);
  for (const Door& door : doors)
    if (door.isClosed()) judgeDoor(now, state, door, truth);
  last_position_world_m_ = state.T_world_body.position_m;
}

void Referee::judgeWorld(common::Time now, const QuadrotorState& state, const std::vector<bool>& seen, Truth& truth) {
  clearance_ = rays_.sweep(hull_, last_position_world_m_, state.T_world_body.position_m, Truth::kClearanceLimit_m);
  if (!state.standing) truth.min_clearance_m = std::min(truth.min_clearance_m, clearance_.distance_m);
  if (clearance_.shape == Hit::kNothing || clearance_.distance_m > 0.0) return;
  // A gear on a slope tilts the hull along.
  if (state.standing && clearance_.shape == floor_shape_) return;
  const auto shape = static_cast<std::size_t>(clearance_.shape);
  const std::string name = nameOf(world_.shapes[shape]);
  if (!truth.crashed) {
    truth.glass = world_.shapes[shape].glass;
    truth.unseen_glass = truth.glass && shape < seen.size() && !seen[shape];
  }
  crash(truth, now, name, touchedAt(name, clearance_.point_world_m));
}

void Referee::judgeWalker(common::Time now, const QuadrotorState& state, const Actor& walker, std::size_t number,
                          Truth& truth) const {
  const Vector3d& position = state.T_world_body.position_m;
  const Vector2d to_walker = walker.position_world_m - position.head<2>();
  const double distance_m = gapTo_m(walker, hull_, position);
  if (!state.standing) truth.min_walker_clearance_m = std::min(truth.min_walker_clearance_m, distance_m);
  if (distance_m > 0.0 || truth.crashed) return;
  const Vector2d velocity = state.velocity_world_m_s.head<2>();
  truth.by_walker = true;
  truth.yielding = velocity.norm() < kStill_m_s || velocity.dot(to_walker) < 0.0;
  if (const auto& since = people_.since(number)) truth.walker_in_field_s = (now - *since).seconds();
  const std::string name = fmt::format("walker {}", number + 1);
  crash(truth, now, name, touchedAt(name, hullPointTowards(position, to_walker)));
}

/// A closed door is a wall. The hull is wider than its way between two looks.
void Referee::judgeDoor(common::Time now, const QuadrotorState& state, const Door& door, Truth& truth) const {
  const Vector3d& position = state.T_world_body.position_m;
  const double gap_m = gapTo_m(door.actor(), hull_, position);
  if (!state.standing) truth.min_clearance_m = std::min(truth.min_clearance_m, gap_m);
  if (gap_m > 0.0) return;
  const Vector2d contact = nearestWithin(door.actor(), position.head<2>());
  const std::string name = "door " + door.name();
  crash(truth, now, name, touchedAt(name, {contact.x(), contact.y(), position.z()}));
}

void Referee::judgeMeeting(common::Time now, const QuadrotorState& state, double gap_m, const Actor& other,
                           const std::string& name, Truth& truth) const {
  if (!state.standing) truth.min_vehicle_clearance_m = std::min(truth.min_vehicle_clearance_m, gap_m);
  if (gap_m > 0.0) return;
  const Vector3d& position = state.T_world_body.position_m;
  crash(truth, now, name, touchedAt(name, hullPointTowards(position, other.position_world_m - position.head<2>())));
}

Vector3d Referee::hullPointTowards(const Vector3d& position_world_m, const Vector2d& direction) const {
  const Vector2d point = position_world_m.head<2>() + hull_.radius_m * direction.normalized();
  return {point.x(), point.y(), position_world_m.z()};
}

}  // namespace swiftlet::simulation
