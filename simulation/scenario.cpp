#include "simulation/scenario.hpp"

#include <limits>

#include <fmt/format.h>

#include "common/validation.hpp"

namespace swiftlet::simulation {
namespace {

constexpr double kAnywhere_m = 1e4;

common::Validation& finitePairs(common::Validation& validation, const char* name, const std::vector<double>& values) {
  validation.require(values.size() % 2 == 0, name, fmt::format("{} numbers are no list of x, y pairs", values.size()));
  for (const double value : values) validation.within(name, value, -kAnywhere_m, kAnywhere_m);
  return validation;
}

}  // namespace

void StartConfig::describe(common::config::Fields& fields) {
  fields("from_world", from_world, "Start at the world's frame `start`, or its origin where it has none.");
  fields("x_m", x_m, "Start in the world's frame, unless from_world.");
  fields("y_m", y_m, "Start in the world's frame, unless from_world.");
  fields("z_m", z_m, "The floor is the first surface below half a metre above this.");
  fields("yaw_deg", yaw_deg, "Heading in the world's frame, unless from_world.");
}

std::vector<std::string> StartConfig::validate() const {
  return common::Validation()
      .within("x_m", x_m, -kAnywhere_m, kAnywhere_m)
      .within("y_m", y_m, -kAnywhere_m, kAnywhere_m)
      .within("z_m", z_m, -kAnywhere_m, kAnywhere_m)
      .within("yaw_deg", yaw_deg, -360, 360)
      .problems();
}

void WindConfig::describe(common::config::Fields& fields) {
  fields("mean_x_m_s", mean_x_m_s, "Mean wind along the world's x.");
  fields("mean_y_m_s", mean_y_m_s, "Mean wind along the world's y.");
  fields("gust_m_s", gust_m_s, "Standard deviation of each horizontal component.");
  fields("gust_time_s", gust_time_s, "Correlation time of the gusts.");
}

std::vector<std::string> WindConfig::validate() const {
  return common::Validation()
      .within("mean_x_m_s", mean_x_m_s, -30, 30)
      .within("mean_y_m_s", mean_y_m_s, -30, 30)
      .within("gust_m_s", gust_m_s, 0, 30)
      .within("gust_time_s", gust_time_s, 0.01, 1000)
      .problems();
}

void Variation::describe(common::config::Fields& fields) {
  fields("start_position_m", start_position_m, "Shift of the start, in x and in y.");
  fields("start_yaw_deg", start_yaw_deg, "Turn of the start.");
  fields("start_area_world_m", start_area_world_m,
         "x, y, x, y of two corners: the start is anywhere between them from where the vehicle can fly to the start "
         "that is given.");
  fields("obstacles", obstacles, "Models that are shifted.");
  fields("obstacle_m", obstacle_m, "Their shift, in x and in y.");
  fields("wind_m_s", wind_m_s, "Added to each component of the mean wind.");
  fields("battery_remaining", battery_remaining, "The start charge is lowered by up to this.");
  fields("reachable_map_m", reachable_map_m, "x, y, x, y of goals in `map` that must be reachable.");
  fields("flight_height_m", flight_height_m, "Height of the body above the take-off floor where that is judged.");
}

std::vector<std::string> Variation::validate() const {
  common::Validation validation;
  validation.within("start_position_m", start_position_m, 0, 100)
      .within("start_yaw_deg", start_yaw_deg, 0, 180)
      .require(start_area_world_m.empty() || start_area_world_m.size() == 4, "start_area_world_m",
               fmt::format("{} numbers are not two corners x, y, x, y", start_area_world_m.size()))
      .within("obstacle_m", obstacle_m, 0, 100)
      .within("wind_m_s", wind_m_s, 0, 30)
      .within("battery_remaining", battery_remaining, 0, 1)
      .within("flight_height_m", flight_height_m, 0.1, 100);
  finitePairs(validation, "start_area_world_m", start_area_world_m);
  return finitePairs(validation, "reachable_map_m", reachable_map_m).problems();
}

void WalkerConfig::describe(common::config::Fields& fields) {
  fields.choice("mode", mode, {"path", "cross_path", "follow"},
                "Walks its path, crosses the vehicle's way, or follows the vehicle.");
  fields("path_world_m", path_world_m, "x, y, x, y of its points, for mode path.");
  fields.choice("at_end", at_end, {"stay", "leave", "return", "loop"}, "What it does at the end of its path.");
  fields("speed_m_s", speed_m_s, "Walking speed.");
  fields("radius_m", radius_m, "Radius.");
  fields("height_m", height_m, "Height.");
  fields("start_s", start_s, "When it appears.");
  fields("distance_m", distance_m, "cross_path: how far ahead. follow: how near it comes, hull to person.");
  fields("repeat_s", repeat_s, "cross_path: crosses again after this long; 0: once.");
}

std::vector<std::string> WalkerConfig::validate() const {
  common::Validation validation;
  validation.within("speed_m_s", speed_m_s, 0, 20)
      .within("radius_m", radius_m, 0.05, 2)
      .within("height_m", height_m, 0.1, 5)
      .within("start_s", start_s, 0, 1e6)
      .within("distance_m", distance_m, 0.1, 100)
      .within("repeat_s", repeat_s, 0, 1e6)
      .require(mode != WalkerMode::kPath || path_world_m.size() >= 2, "path_world_m", "a path needs a point");
  return finitePairs(validation, "path_world_m", path_world_m).problems();
}

void PushConfig::describe(common::config::Fields& fields) {
  fields("time_s", time_s, "When.");
  fields("x_n_s", x_n_s, "Impulse along the world's x.");
  fields("y_n_s", y_n_s, "Impulse along the world's y.");
  fields("z_n_s", z_n_s, "Impulse upwards.");
}

std::vector<std::string> PushConfig::validate() const {
  return common::Validation()
      .within("time_s", time_s, 0, 1e6)
      .within("x_n_s", x_n_s, -1000, 1000)
      .within("y_n_s", y_n_s, -1000, 1000)
      .within("z_n_s", z_n_s, -1000, 1000)
      .problems();
}

void FaultConfig::describe(common::config::Fields& fields) {
  fields.choice("sensor", sensor, {"imu", "laser", "battery", "pilot", "camera"}, "Which sensor.");
  fields.choice("kind", kind, {"silent", "nan", "repeat", "late"}, "What goes wrong.");
  fields("from_s", from_s, "From this time on.");
  fields("to_s", to_s, "Until this time.");
  fields("late_s", late_s, "How late, for kind late.");
}

std::vector<std::string> FaultConfig::validate() const {
  return common::Validation()
      .within("from_s", from_s, 0, 1e6)
      .within("to_s", to_s, from_s, 1e6)
      .within("late_s", late_s, 0, 100)
      .problems();
}

void PilotConfig::describe(common::config::Fields& fields) {
  fields("time_s", time_s, "From this time until the next entry.");
  fields("roll", roll, "Stick in [-1, 1].");
  fields("pitch", pitch, "Stick in [-1, 1].");
  fields("yaw_rate", yaw_rate, "Stick in [-1, 1].");
  fields("thrust", thrust, "Stick in [0, 1].");
  fields("takes_over", takes_over, "The pilot flies alone.");
}

std::vector<std::string> PilotConfig::validate() const {
  return common::Validation()
      .within("time_s", time_s, 0, 1e6)
      .within("roll", roll, -1, 1)
      .within("pitch", pitch, -1, 1)
      .within("yaw_rate", yaw_rate, -1, 1)
      .within("thrust", thrust, 0, 1)
      .problems();
}

void Scenario::describe(common::config::Fields& fields) {
  fields("seed", seed, "Names every random stream.");
  fields("world", world, "SDF file.");
  fields("model_paths", model_paths, "Folders that hold the models it includes.");
  fields.section("start", start, "Where the vehicle stands.");
  fields("battery_remaining", battery_remaining, "Charge at the start, 0 to 1.");
  fields.section("wind", wind, "Wind.");
  fields.section("variation", variation, "What the seed varies.");
  fields.list("walkers", walkers, "People.");
  fields.list("pushes", pushes, "Pushes.");
  fields.list("faults", faults, "Sensor faults.");
  fields.list("pilot", pilot, "The pilot's sticks over time; none: no remote control.");
  fields.section("quadrotor", quadrotor, "The airframe's physics.");
  fields.section("autopilot", autopilot, "The inner loop.");
  fields.section("sensors", sensors, "What is wrong with the sensors.");
}

std::vector<std::string> Scenario::validate() const {
  common::Validation validation;
  validation.within("seed", seed, 0, std::numeric_limits<int>::max())
      .within("battery_remaining", battery_remaining, 0.01, 1);
  for (std::size_t i = 1; i < pilot.size(); ++i)
    validation.require(pilot[i].time_s > pilot[i - 1].time_s, "pilot", "entries are not in the order of their time");
  return validation.problems();
}

}  // namespace swiftlet::simulation
