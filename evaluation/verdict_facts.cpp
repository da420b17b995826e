#include "evaluation/verdict_facts.hpp"

// The facts about the end of a flight, from its record and the true world.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "common/small_matrices.hpp"
#include "evaluation/flight_recorder.hpp"
#include "evaluation/true_world.hpp"
#include "simulation/nature.hpp"
#include "simulation/truth_map.hpp"

namespace swiftlet::evaluation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The bounds and their sources: docs/decisions/simulation.md#031.
constexpr double kHome_m = 0.5;         // As near as the hull is wide.
constexpr double kStepDown_m = 0.5;     // A floor that far below the take-off floor is another one.
constexpr double kResolution_m = 0.05;  // As fine as the vehicle's own map.
constexpr double kStops_s = 20.0;       // Stopping, turning and landing on the way home.
constexpr double kSlowest_m_s = 0.2;    // Slower flights home count as this fast.
constexpr double kFarther = 10.0;       // Factor on the area of the flood if it filled outside of an open door first.

double marginAt(double charge, int lost_cells, const TrueWorld& world) {
  return simulation::thrustOverWeight(world.vehicle, world.quadrotor, charge, simulation::Nature::kFullThrottle,
                                      lost_cells);
}

/// The least charge in steps of 1 % whose thrust margin is kLowMargin; 1 if there is no such charge.
double leastCharge(int lost_cells, const TrueWorld& world) {
  for (int percent = 1; percent < 100; ++percent)
    if (marginAt(0.01 * percent, lost_cells, world) >= kLowMargin) return 0.01 * percent;
  return 1.0;
}

/// Casts a horizontal ray in each of kDirections directions.
constexpr int kDirections = 180;
template <typename Use>
void lookAround(const Vector3d& from_world_m, const TrueWorld& world, Use use) {
  for (int i = 0; i < kDirections; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kDirections;
    const Vector3d direction(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    if (const simulation::Hit hit = world.rays->cast(from_world_m, direction, world.laser.range_max_m)) use(hit);
  }
}

/// Whether the walls in sight fix the position in every direction: the least eigenvalue of the sum of their normals'
/// outer products counts the beams that fix the weakest direction (Zhang, Kaess, Singh 2016, "On degeneracy of
/// optimization-based state estimation problems").
bool fixesPosition(const Vector3d& position_world_m, const TrueWorld& world) {
  constexpr double kLeastBeams = 0.01 * kDirections;
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  lookAround(position_world_m + Vector3d(0, 0, world.laser.mount.z_m), world, [&](const simulation::Hit& hit) {
    const Vector2d normal = hit.normal_world.head<2>().cast<double>();
    information += normal * normal.transpose();
  });
  return common::symmetricEigenvalues(information)(0) >= kLeastBeams;
}

bool isEnclosed(const Vector3d& position_world_m, const TrueWorld& world) {
  int walls = 0;
  lookAround(position_world_m + Vector3d(0, 0, world.laser.mount.z_m), world, [&](const simulation::Hit&) { ++walls; });
  return 2 * walls >= kDirections;
}

/// Whether a floor no more than kStepDown_m below that of the take-off is below.
bool isAboveFloor(const Vector3d& position_world_m, const FlightRecord& record, const TrueWorld& world) {
  const double down_m = position_world_m.z() - record.T_world_start.position_m.z() + kStepDown_m;
  return down_m <= 0.0 || world.rays->cast(position_world_m, -Vector3d::UnitZ(), down_m);
}

void lookBack(const FlightRecord& record, const TrueWorld& world, VerdictFacts& facts) {
  constexpr double kUnfixed_s = 3.0, kNoFloor_s = 0.9;  // Of the last EndingRecord::kTrail_s; simulation.md#031.
  int unfixed = 0, no_floor = 0;
  for (const Vector3d& position : record.ending.trail_world_m) {
    unfixed += fixesPosition(position, world) ? 0 : 1;
    no_floor += isAboveFloor(position, record, world) ? 0 : 1;
  }
  facts.position_seen = unfixed * EndingRecord::kTrailPeriod_s < kUnfixed_s;
  if (!record.ending.flew) facts.position_seen = fixesPosition(record.last_truth.T_world_body.position_m, world);
  facts.floor_seen = no_floor * EndingRecord::kTrailPeriod_s < kNoFloor_s;
}

simulation::FreeSpaceQuery queryOf(const FlightRecord& record, const TrueWorld& world) {
  const double height_m = record.ending.flew ? record.cruise_height_world_m : record.T_world_start.position_m.z() + 1.0;
  simulation::FreeSpaceQuery query;
  query.start_world_m = record.T_world_start.position_m.head<2>();
  query.hull_radius_m = world.vehicle.hullRadius_m();
  query.bottom_m = height_m - 0.5 * world.vehicle.hull_height_m;
  query.top_m = height_m + 0.5 * world.vehicle.hull_height_m;
  query.resolution_m = kResolution_m;
  query.max_area_m2 = world.reachable_area_max_m2;
  query.closed_doors = record.ending.then.closed_doors;
  return query;
}

/// Charge that the true path home takes, at the consumption of the flight until then.
std::optional<double> homeShare(const FlightRecord& record, const std::optional<double>& path_m) {
  const EndingRecord& ending = record.ending;
  if (!path_m || ending.airborne_until_then_s <= 0.0) return std::nullopt;
  const double speed_m_s = std::max(kSlowest_m_s, record.true_distance_m / ending.airborne_until_then_s);
  const double share_per_s = (ending.charge_at_take_off - ending.then.battery_remaining) / ending.airborne_until_then_s;
  return share_per_s * (*path_m / speed_m_s + kStops_s);
}

/// Where the world is open, the area may be full before the vehicle's place is reached.
std::optional<double> pathHome_m(const common::TiledGrid<std::uint8_t>& reachable, const Vector2d& from_world_m,
                                 simulation::FreeSpaceQuery query, const TrueWorld& world) {
  const auto path_m = simulation::pathLength_m(reachable, from_world_m, query.start_world_m);
  if (path_m || simulation::area_m2(reachable) < query.max_area_m2) return path_m;
  query.max_area_m2 *= kFarther;
  return simulation::pathLength_m(simulation::reachableSpace(*world.rays, query), from_world_m, query.start_world_m);
}

/// As it was when the goal failed; `reachable` is what could be reached later, with the doors of `query` closed.
bool isReachable(const Vector2d& goal_world_m, const FlightRecord& record, simulation::FreeSpaceQuery query,
                 const common::TiledGrid<std::uint8_t>& reachable, const TrueWorld& world) {
  const auto& doors = record.ending.doors_at_failed_goal;
  if (doors.empty() && query.closed_doors.empty()) return reachable.at(reachable.cellAt(goal_world_m)) != 0;
  query.closed_doors = doors;
  const auto then = simulation::reachableSpace(*world.rays, query);
  return then.at(then.cellAt(goal_world_m)) != 0;
}

void lookForWays(const FlightRecord& record, const TrueWorld& world, VerdictFacts& facts) {
  const simulation::FreeSpaceQuery query = queryOf(record, world);
  const auto reachable = simulation::reachableSpace(*world.rays, query);
  const bool open = simulation::area_m2(reachable) >= query.max_area_m2;
  const Vector2d then_m = record.ending.then.T_world_body.position_m.head<2>();
  facts.home_share = homeShare(record, pathHome_m(reachable, then_m, query, world));
  if (const auto& goal_map_m = record.ending.failed_goal_map_m) {
    const Vector3d goal_world_m = record.T_world_map * Vector3d(goal_map_m->x(), goal_map_m->y(), 0.0);
    facts.goal_reachable = open || isReachable(goal_world_m.head<2>(), record, query, reachable, world);
  }
  facts.inside = !open || isEnclosed(record.last_truth.T_world_body.position_m, world);
}

/// Whether the hull fits between where the vehicle stood and the height of its take-off; true of a vehicle that was not
/// taking off.
bool hasRoomToTakeOff(const ContactRecord& contact, const TrueWorld& world) {
  const double climb_m = contact.take_off_height_m - world.quadrotor.gear_height_m;
  if (world.rays == nullptr || contact.flight != common::FlightState::kTakingOff || climb_m <= 0.0) return true;
  const simulation::Hull hull{world.vehicle.hullRadius_m(), 0.5 * world.vehicle.hull_height_m};
  const Vector3d low = contact.stood_world_m, high = low + climb_m * Vector3d::UnitZ();
  return world.rays->sweep(hull, low, high, 1e-6).shape == simulation::Hit::kNothing;
}

ContactFacts contactFacts(const ContactRecord& contact, const TrueWorld& world) {
  const simulation::Truth& truth = contact.truth;
  ContactFacts facts;
  facts.what = contact.what;
  facts.by_person = truth.by_walker;
  facts.yielding = truth.yielding;
  facts.remains = contact.replay.standing && contact.replay.landing;
  facts.person_in_field_s = truth.walker_in_field_s;
  facts.motors_off = contact.motors_off;
  facts.unseen_glass = truth.unseen_glass;
  facts.room_to_take_off = hasRoomToTakeOff(contact, world);
  facts.thrust_margin = marginAt(truth.battery_remaining, truth.lost_cells, world);
  facts.thrust_margin_before = marginAt(contact.charge_before, contact.lost_cells_before, world);
  return facts;
}

}  // namespace

VerdictFacts factsOf(const FlightRecord& record, const TrueWorld& world) {
  const EndingRecord& ending = record.ending;
  const simulation::Truth& last = record.last_truth;
  VerdictFacts facts;
  facts.mission_done = record.mission.state == common::MissionState::kDone;
  facts.flew = ending.flew;
  facts.in_the_air = last.airborne;
  facts.motors_off = record.motors_off;
  facts.at_home = (last.T_world_body.position_m - record.T_world_start.position_m).head<2>().norm() <= kHome_m;
  facts.order = ending.order;
  facts.faulty_sensor = ending.faulty_sensor;
  facts.charge = ending.then.battery_remaining;
  facts.position_error_m = ending.position_error_m;
  if (record.contact) {
    facts.contact = contactFacts(*record.contact, world);
  } else if (!facts.mission_done && !facts.in_the_air) {
    facts.thrust_margin = marginAt(facts.charge, ending.then.lost_cells, world);
    facts.least_charge = leastCharge(ending.then.lost_cells, world);
    if (world.rays == nullptr) return facts;
    lookBack(record, world, facts);
    lookForWays(record, world, facts);
  }
  return facts;
}

}  // namespace swiftlet::evaluation
