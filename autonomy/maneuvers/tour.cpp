#include "autonomy/maneuvers/tour.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "planning/search/planner.hpp"

namespace swiftlet::autonomy {
namespace {

/// A station to which the vehicle has set out this many times is left out: an unmapped obstacle keeps it away.
constexpr int kMostTries = 5;
/// This many interrupted tours are kept. A mission that halts a tour forever never requests it again.
constexpr std::size_t kMostTours = 8;

/// The state of the intent's tour, or of the one that it resumes, or a new one.
std::shared_ptr<TourState> stateFor(const ManeuverSetup& setup) {
  auto& tours = setup.memory.tours;
  auto found = std::find_if(tours.begin(), tours.end(), [&](const auto& tour) {
    return tour->intent_id == setup.client.intent_id || (setup.resumes != 0 && tour->intent_id == setup.resumes);
  });
  if (found == tours.end()) {
    if (tours.size() >= kMostTours) tours.erase(tours.begin());
    found = tours.insert(tours.end(), std::make_shared<TourState>());
  }
  (*found)->intent_id = setup.client.intent_id;
  return *found;
}

}  // namespace

using common::Time;

Tour::Tour(const ManeuverSetup& setup, std::string purpose, common::FlightMode mode, double corner_m)
    : PathManeuver(setup, std::move(purpose), mode),
      corner_m_(corner_m),
      state_(stateFor(setup)),
      stations_(state_->stations) {}

std::optional<Eigen::Vector2d> Tour::standFor(const planning::CostMap& map, const Eigen::Vector2d& place_map_m) const {
  return isLethalAt(map, place_map_m) ? std::nullopt : std::optional(place_map_m);
}

Aim Tour::aim(const common::VehicleState& state) const {
  Aim aim = PathManeuver::aim(state);
  if (const auto station = next()) aim.goal_map_m = stations_[*station].place_map_m;
  return aim;
}

std::size_t Tour::passed() const {
  return static_cast<std::size_t>(
      std::count_if(stations_.begin(), stations_.end(), [](const Station& s) { return s.state == State::kPassed; }));
}

std::optional<std::size_t> Tour::next() const {
  const auto open =
      std::find_if(stations_.begin(), stations_.end(), [](const Station& s) { return s.state == State::kOpen; });
  return open == stations_.end() ? std::nullopt
                                 : std::optional(static_cast<std::size_t>(std::distance(stations_.begin(), open)));
}

Progress Tour::fly(const ManeuverInput& input) {
  const auto map = setup_.desk.costMap();
  if (!map) return Progress::running("waits for a map");
  if (stations_.empty()) {
    for (const Eigen::Vector2d& place : lay(*map, input)) stations_.push_back({place, place});
    open(*map);
  }
  pass(input.position_map_m());
  leaveBlocked(*map);
  if (!next() && !std::exchange(state_->second_look, true)) open(*map);
  const auto station = next();
  if (!station) {
    flight_.abandon();
    return ended();
  }
  (void)flight_.keep(input);
  if (flight_.mayAsk()) asked_.reset();  // An answer that came during a retreat was dropped.
  const bool under_way = flight_.plan() != nullptr && !setup_.controller.follower().finished();
  if (!under_way && !asked_ && ready(input)) flyOn(*map, input, *station);
  return {common::IntentState::kRunning, fmt::format("{}, {} of {} places", doing(input), passed(), stations_.size()),
          inspecting(input)};
}

/// Opens the stations that are not passed, where the map has a free place for them.
void Tour::open(const planning::CostMap& map) {
  for (Station& station : stations_) {
    if (station.state == State::kPassed) continue;
    const auto place = standFor(map, station.wanted_map_m);
    station.state = place ? State::kOpen : State::kLeft;
    station.tries = 0;
    if (place) station.place_map_m = *place;
  }
}

/// The stations that the vehicle comes by in their order.
void Tour::pass(const Eigen::Vector2d& here_map_m) {
  while (const auto station = next()) {
    if ((stations_[*station].place_map_m - here_map_m).norm() >= corner_m_) return;
    stations_[*station].state = State::kPassed;
  }
}

void Tour::leaveBlocked(const planning::CostMap& map) {
  for (Station& station : stations_)
    if (station.state == State::kOpen && isLethalAt(map, station.place_map_m)) station.state = State::kLeft;
}

void Tour::flyOn(const planning::CostMap& map, const ManeuverInput& input, std::size_t station) {
  if (++stations_[station].tries > kMostTries) {
    stations_[station].state = State::kLeft;
    return;
  }
  if (planning::Path run = straightRun(map, input.position_map_m(), station); run.points_map_m.size() > 1) {
    flight_.release();
    flight_.offer(run, input.now, input.state);
  } else if (flight_.mayAsk()) {
    asked_ = station;
    flight_.ask(input, GoalRequest{stations_[station].place_map_m, 0.0});
  }
}

/// Through the open stations from the first on, as far as straight lines are free. The very first one is flown to by
/// itself.
planning::Path Tour::straightRun(const planning::CostMap& map, const Eigen::Vector2d& from_map_m,
                                 std::size_t first) const {
  planning::Path run{{from_map_m}, 0.0, 0.0};
  for (std::size_t i = first; i < stations_.size(); ++i) {
    if (stations_[i].state != State::kOpen) continue;
    const planning::SegmentCost leg = segmentCost(map, run.points_map_m.back(), stations_[i].place_map_m);
    if (leg.lethal) break;
    run.length_m += (stations_[i].place_map_m - run.points_map_m.back()).norm();
    run.cost_m += leg.cost_m;
    run.points_map_m.push_back(stations_[i].place_map_m);
    if (passed() == 0) break;
  }
  return run;
}

Progress Tour::answered(const PlanningAnswer& answer, Time now, const common::VehicleState& state) {
  if (!answer.path || !asked_) return Progress::running();
  const std::size_t station = *std::exchange(asked_, std::nullopt);
  if (*answer.path) {
    flight_.release();
    flight_.offer(**answer.path, now, state);
  } else if (station < stations_.size()) {
    stations_[station].state = State::kLeft;
    no_path_ = answer.path->error().text;
  }
  return Progress::running();
}

Progress Tour::ended() {
  std::erase(setup_.memory.tours, state_);
  if (passed() == 0)
    return Progress::failed(no_path_.empty() ? "none of its places is free"
                                             : "none of its places is reached: " + no_path_);
  return Progress::done(fmt::format("{} of {} places, the others are not free", passed(), stations_.size()));
}

}  // namespace swiftlet::autonomy
