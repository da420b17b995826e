#include "autonomy/supervisor_intents.hpp"

#include <vector>

#include "autonomy/trail_back.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::autonomy {
namespace {

/// Ids of the supervisor's intents; those of the mission count from 1.
constexpr std::uint64_t kHold = 1ULL << 62;
/// Of the landing, which is final: there is one.
constexpr std::uint64_t kLand = kHold + 1;
/// Of the first flight home by a path; that along the trail is the next, and so for each further flight home.
constexpr std::uint64_t kHome = kHold + 2;
/// Of the first flight back along the trail.
constexpr std::uint64_t kBack = kHome + (1ULL << 32);

std::vector<Eigen::Vector2d> trailBack_map_m(const common::World& world) {
  const auto trail_map_m = world.vehicle->trail.points_map_m();
  return {trail_map_m.rbegin(), trail_map_m.rend()};
}

}  // namespace

common::Intent SupervisorIntents::hold() { return {kHold, common::HoldIntent{}}; }
common::Intent SupervisorIntents::land() { return {kLand, common::LandIntent{}}; }

std::optional<common::Intent> SupervisorIntents::flight(const Supervision& asked, const SupervisedFlight& flight,
                                                        Supervisor& supervisor) {
  const bool stopped = flight.present.id >= kHome || flight.status.released;
  if (!stopped) return std::nullopt;
  if (asked.back > 0) return back(kBack + asked.back - 1, flight, supervisor);
  if (asked.home > 0) return home(asked.home, flight, supervisor);
  return std::nullopt;
}

/// Where no path is known, or it could not be flown, the path home is the trail. At its end the vehicle holds.
common::Intent SupervisorIntents::home(unsigned count, const SupervisedFlight& flight, Supervisor& supervisor) const {
  const std::uint64_t by_path = kHome + 2ULL * (count - 1), along_trail = by_path + 1;
  const common::IntentStatus& status = flight.status;
  const bool begun = status.id == by_path || status.id == along_trail;
  const bool failed = begun && status.state == common::IntentState::kFailed;
  if (!begun && flight.home_planned) {
    common::GoToIntent to_home;
    to_home.goal_map_m = flight.world.vehicle->home_map.position_m();
    to_home.shift_m = common::kHomeShift_m;
    to_home.clearance_m = clearance_m_;
    return {by_path, to_home};
  }
  if (!begun || (failed && status.id == by_path)) {
    const auto trail_map_m = flight.world.vehicle->trail.points_map_m();
    return {along_trail, common::RetraceIntent{trailBackWithoutLoops(trail_map_m), std::nullopt}};
  }
  if (status.state == common::IntentState::kRunning) return flight.present;
  supervisor.homeEnded(flight.now, status.state == common::IntentState::kSucceeded, status.reason);
  return hold();
}

/// The path back is the whole trail; the supervisor ends the flight where height and position are known again.
common::Intent SupervisorIntents::back(std::uint64_t id, const SupervisedFlight& flight, Supervisor& supervisor) {
  if (back_.id != id) back_ = {id, common::RetraceIntent{trailBack_map_m(flight.world), wanted_to_see_map_m_}};
  if (flight.status.id != id) return back_;
  if (flight.status.state == common::IntentState::kRunning) return flight.present;
  supervisor.backEnded(flight.now);
  return hold();
}

}  // namespace swiftlet::autonomy
