#include "tests/behaviors/flight.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swiftlet::behaviors::testing {
namespace {

/// 10 m x 10 m of free floor around the origin, and a wall at x = 4 m.
std::shared_ptr<const common::OccupancyGrid> someGrid() {
  auto grid = std::make_shared<common::OccupancyGrid>(common::makeOccupancyGrid(0.1));
  for (int y = -50; y < 50; ++y)
    for (int x = -50; x < 50; ++x) grid->set({x, y}, x == 40 ? 50 : -50);
  return grid;
}

/// The same floor as a map that judges goals.
class SomeGoalMap final : public common::GoalMap {
 public:
  common::PlaceState stateAt(const Eigen::Vector2d& place_map_m, double clearance_m) const override {
    if (place_map_m.cwiseAbs().maxCoeff() >= 5.0) return common::PlaceState::kOutsideMap;
    const double from_wall_m = std::abs(place_map_m.x() - 4.05) - 0.05;
    if (from_wall_m <= 0.0) return common::PlaceState::kObstacle;
    return from_wall_m < kHullRadius_m + clearance_m ? common::PlaceState::kTooClose : common::PlaceState::kFree;
  }
  std::optional<Eigen::Vector2d> nearestFree(const Eigen::Vector2d& place_map_m, double reach_m,
                                             double clearance_m) const override {
    const Eigen::Vector2d free_m(std::min(place_map_m.x(), 4.0 - kHullRadius_m - clearance_m), place_map_m.y());
    return (free_m - place_map_m).norm() <= reach_m ? std::optional(free_m) : std::nullopt;
  }

 private:
  static constexpr double kHullRadius_m = 0.275;
};

test::Layers someLayers() {
  test::Layers layers;
  layers.map.grid = someGrid();
  layers.vehicle.flight_state = common::FlightState::kFlying;
  return layers;
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

Flight::Flight(const std::string& inside, const std::string& more)
    : Flight(Mission::fromText("<root BTCPP_format=\"4\" main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\">" + inside +
                                   "</BehaviorTree>" + more + "</root>",
                               "mission.xml")) {}

Flight::Flight(Mission flown) : mission(std::move(flown)) {
  context.world = std::make_shared<const common::World>(someLayers().world());
  context.goal_map = std::make_shared<SomeGoalMap>();
}

std::string Flight::tick() {
  context.now += common::Duration::fromMilliseconds(100);
  last = mission.tick(context);
  std::string text = upper(common::toString(last.state));
  if (context.intent)
    text += " " + std::to_string(context.intent->id) + " " + toString(*context.intent, context.world->map->names());
  return text;
}

Flight& Flight::runs() {
  context.status = {context.intent ? context.intent->id : 0, common::IntentState::kRunning, "", false};
  return *this;
}

Flight& Flight::stops() {
  runs();
  context.status.released = true;
  return *this;
}

Flight& Flight::succeeds() {
  stops();
  context.status.state = common::IntentState::kSucceeded;
  return *this;
}

Flight& Flight::fails(const std::string& reason) {
  stops();
  context.status.state = common::IntentState::kFailed;
  context.status.reason = reason;
  return *this;
}

Flight& Flight::holds(bool hold, const std::string& reason) {
  context.hold = hold;
  context.hold_reason = reason;
  return *this;
}

Flight& Flight::retreats(bool retreating, const std::string& reason) {
  return change([&](Layers& layers) {
    layers.vehicle.avoidance.retreating = retreating;
    layers.vehicle.avoidance.reason = reason;
  });
}

Flight& Flight::is(common::FlightState state) {
  return change([&](Layers& layers) { layers.vehicle.flight_state = state; });
}

Flight& Flight::localization(std::optional<common::LocalizationState> state) {
  return change([&](Layers& layers) {
    layers.map.localization.reset();
    if (state) layers.map.localization.emplace().state = *state;
  });
}

Flight& Flight::home(double x_m, double y_m) {
  return change([&](Layers& layers) { layers.vehicle.home_map = {x_m, y_m, 0.0}; });
}

Flight& Flight::at(double x_m, double y_m) {
  return change([&](Layers& layers) {
    layers.vehicle.state.T_odom_body.position_m.head<2>() = Eigen::Vector2d(x_m, y_m);
    layers.vehicle.state.horizontal_valid = true;
  });
}

Flight& Flight::goal(double x_m, double y_m) { return command({0, common::GoalCommand{{x_m, y_m}}}); }

Flight& Flight::homeCommand() { return command({0, common::HomeCommand{}}); }

Flight& Flight::command(common::OperatorCommand given) {
  given.id = ++commands_;
  context.commands.push_back(given);
  return *this;
}

std::vector<std::string> Flight::events() {
  std::vector<std::string> texts;
  for (const common::Event& event : std::exchange(context.events, {}))
    texts.push_back(event.text + (event.reason.empty() ? "" : " (" + event.reason + ")"));
  return texts;
}

std::vector<std::string> Flight::results() {
  std::vector<std::string> texts;
  for (const common::CommandResult& result : std::exchange(context.results, {}))
    texts.push_back(std::to_string(result.id) + (result.accepted ? " accepted" : " refused: " + result.reason));
  return texts;
}

std::string Flight::view() const {
  std::string text;
  for (const common::TreeNodeView& node : mission.view())
    text += (text.empty() ? "" : ", ") + node.name + " " + node.status;
  return text;
}

Flight& Flight::change(const std::function<void(Layers&)>& change) {
  Layers layers(*context.world);
  change(layers);
  context.world = std::make_shared<const common::World>(layers.world());
  return *this;
}

}  // namespace swiftlet::behaviors::testing
