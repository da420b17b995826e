#include "autonomy/autonomy_config.hpp"

#include <algorithm>

#include "common/config_fields.hpp"
#include "perception/people/dynamic_obstacles.hpp"

namespace swiftlet::autonomy {

void AutonomyConfig::describe(common::config::Fields& fields) {
  fields.section("estimator", estimator, "From raw samples to a state and a map.");
  fields.section("reactive", reactive, "Braking and retreat at the laser rate.");
  fields.section("execution", execution, "Planning and exploring to carry out intents.");
  fields.section("control", control, "State machine, trajectories and controllers.");
  fields.section("supervisor", supervisor, "Hold and landing above the mission.");
  fields.section("energy", energy, "Consumption, and the charge for the flight home.");
  fields.section("scans", scans, "Scans that arrive late or out of order.");
  fields.section("assist", assist, "Assistance for a pilot who flies by hand.");
}

std::vector<common::Problem> AutonomyConfig::validate() const {
  std::vector<common::Problem> problems = problemsWith(execution.clearance_m);
  for (common::Problem& problem : problems) problem.element = "reactive.avoidance." + problem.element;
  return problems;
}

void AutonomyConfig::limitTo(const common::LaserConfig& laser) {
  double& avoidance_deg = reactive.avoidance.field_of_view_deg;
  planning::ExplorerConfig& explorer = execution.planning.explorer;
  avoidance_deg = std::min(avoidance_deg, laser.field_of_view_deg);
  explorer.laser_field_of_view_deg = std::min(explorer.laser_field_of_view_deg, laser.field_of_view_deg);
  explorer.laser_range_m = std::min(explorer.laser_range_m, laser.range_max_m);
}

std::vector<common::Problem> AutonomyConfig::problemsWith(double clearance_m) const {
  return reactive.avoidance.validateAgainst(clearance_m, perception::DynamicObstacles::kKeepOut_m);
}

}  // namespace swiftlet::autonomy
