#include "simulation/scenario.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "common/check.hpp"
#include "common/config_fields.hpp"
#include "common/error.hpp"
#include "common/validation.hpp"

namespace swiftlet::simulation {
namespace {

using common::Message;

constexpr double kAnywhere_m = 1e4;  // Farther, single-precision rays are coarser than a millimetre.

Message noPairs(const std::vector<double>& values) {
  return Message("scenario.no-pairs", "{} numbers are not a list of x, y pairs", values.size());
}

/// Whether each entry is later than the previous one.
bool inOrder(const std::vector<PilotConfig>& pilot) {
  const auto not_later = [](const PilotConfig& a, const PilotConfig& b) { return a.time_s >= b.time_s; };
  return std::adjacent_find(pilot.begin(), pilot.end(), not_later) == pilot.end();
}

/// The names of a list, which must differ.
template <typename Named>
std::vector<std::string> distinctNames(const char* list, const std::vector<Named>& all,
                                       common::Validation& validation) {
  std::vector<std::string> names;
  for (const Named& one : all) {
    validation.require(std::find(names.begin(), names.end(), one.name) == names.end(), list,
                       Message("config.name-twice", "two are called `{}`", one.name));
    names.push_back(one.name);
  }
  return names;
}

Message notInOrder() { return Message("pilot.not-in-order", "entries are not in the order of their time"); }

/// Problems of the list of vehicles and of the settings that refer to it.
std::vector<common::Problem> vehicleProblems(const Scenario& scenario) {
  common::Validation validation;
  const std::vector<std::string> names = distinctNames("vehicles", scenario.vehicles, validation);
  for (const WalkerConfig& walker : scenario.walkers)
    validation.require(walker.vehicle.empty() || std::find(names.begin(), names.end(), walker.vehicle) != names.end(),
                       "walkers", Message("scenario.no-vehicle", "there is no vehicle `{}`", walker.vehicle),
                       common::didYouMean(walker.vehicle, names));
  const auto alone = [&](const char* field, bool is_default) {
    validation.require(
        scenario.vehicles.empty() || is_default, field,
        Message("scenario.single-vehicle", "is for a single vehicle; with `vehicles`, give it for each vehicle there"));
  };
  alone("start", scenario.start.from_world);
  alone("battery_remaining", scenario.battery_remaining == 1.0);
  alone("pushes", scenario.pushes.empty());
  alone("hands", scenario.hands.empty());
  alone("faults", scenario.faults.empty());
  alone("pilot", scenario.pilot.empty());
  return validation.problems();
}

/// Whether it can be used in messages and in the name of a folder.
bool isName(const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  return !name.empty() && name.size() <= 40 && std::all_of(name.begin(), name.end(), plain);
}

}  // namespace

void StartConfig::describe(common::config::Fields& fields) {
  fields("from_world", from_world,
         "Whether the vehicle starts at the world's frame `start`, or at its origin where it has none.");
  fields("x_m", x_m, {-kAnywhere_m, kAnywhere_m}, "Start along the world's x; not with from_world.");
  fields("y_m", y_m, {-kAnywhere_m, kAnywhere_m}, "Start along the world's y; not with from_world.");
  fields("z_m", z_m, {-kAnywhere_m, kAnywhere_m},
         "The floor of the start is the first surface below half a metre above this; not with from_world.");
  fields("yaw_deg", yaw_deg, {-360, 360}, "Heading in the world's frame; not with from_world.");
}

std::vector<common::Problem> StartConfig::validate() const {
  common::Validation validation;
  const auto unused = [&](const char* field, double value) {
    validation.require(!from_world || value == 0.0, field,
                       Message("scenario.start-ignored",
                               "is ignored, because the vehicle starts where the world says; add from_world: false"));
  };
  unused("x_m", x_m);
  unused("y_m", y_m);
  unused("z_m", z_m);
  unused("yaw_deg", yaw_deg);
  return validation.problems();
}

void WindConfig::describe(common::config::Fields& fields) {
  fields.choice("model", model, {"gauss_markov", "dryden"},
                "Spectrum of the gusts: of first order and horizontal, or that of Dryden, vertical ones too.");
  fields("mean_x_m_s", mean_x_m_s, {-30, 30}, "Mean wind along the world's x.");
  fields("mean_y_m_s", mean_y_m_s, {-30, 30}, "Mean wind along the world's y.");
  fields("gust_m_s", gust_m_s, {0, 30}, "Standard deviation of each component of the gusts.");
  fields("gust_time_s", gust_time_s, {0.01, 1000}, "Correlation time of the gusts.");
}

void Variation::describe(common::config::Fields& fields) {
  fields("start_position_m", start_position_m, {0, 100}, "Greatest shift of the start, in x and in y.");
  fields("start_yaw_deg", start_yaw_deg, {0, 180}, "Greatest turn of the start.");
  fields("start_area_world_m", start_area_world_m, {-kAnywhere_m, kAnywhere_m},
         "Two corners x, y, x, y: the start is anywhere between them, on the floor of the given start, from where the "
         "vehicle can fly to that start; empty for near the given start.");
  fields("obstacles", obstacles, "Models that are shifted.");
  fields("obstacle_m", obstacle_m, {0, 100}, "Greatest shift of each model of obstacles, in x and in y.");
  fields("tinted", tinted, "Models whose colour is changed.");
  fields("tint", tint, {0, 1},
         "Greatest change of each channel of the colour of the models of tinted, as a share of it.");
  fields("light_tint", light_tint, {0, 1},
         "Greatest change of the red and of the blue of the light, as a share of it.");
  fields("light_dimmed", light_dimmed, {0, 1}, "Greatest loss of the light, as a share of it.");
  fields("wind_m_s", wind_m_s, {0, 30}, "Greatest change of each component of the mean wind.");
  fields("battery_remaining", battery_remaining, {0, 1},
         "Greatest loss of the start charge, unless the nature draws the charge.");
  fields("reachable_map_m", reachable_map_m, {-kAnywhere_m, kAnywhere_m},
         "Goals x, y, x, y in `map`: a draw is taken only if the vehicle can get to all of them.");
  fields("flight_height_m", flight_height_m, {0.1, 100},
         "Height of the body above the take-off floor where reachability is judged.");
}

std::vector<common::Problem> Variation::validate() const {
  return common::Validation()
      .require(start_area_world_m.empty() || start_area_world_m.size() == 4, "start_area_world_m",
               Message("scenario.no-corners", "{} numbers are not two corners x, y, x, y", start_area_world_m.size()))
      .require(reachable_map_m.size() % 2 == 0, "reachable_map_m", noPairs(reachable_map_m))
      .problems();
}

void WalkerConfig::describe(common::config::Fields& fields) {
  fields.choice("mode", mode, {"path", "cross_path", "follow"},
                "Whether the person walks a path, crosses the vehicle's, or follows the vehicle.");
  fields("path_world_m", path_world_m, {-kAnywhere_m, kAnywhere_m},
         "Points x, y, x, y of the person's path, for mode path.");
  fields.choice("at_end", at_end, {"stay", "leave", "return", "loop"}, "What the person does at the end of the path.");
  fields("speed_m_s", speed_m_s, {0, 20}, "Walking speed.");
  fields("speeds_m_s", speeds_m_s, {0.01, 20},
         "For mode path, the person's speeds from point to point, again from the first one after the last; empty for "
         "speed_m_s.");
  fields("pause_s", pause_s, {0, 1e4}, "For mode path, how long the person stands at each point.");
  fields("radius_m", radius_m, {0.05, 2}, "Radius of the person.");
  fields("height_m", height_m, {0.1, 5}, "Height of the person.");
  fields("start_s", start_s, {0, 1e6}, "Time at which the person appears.");
  fields("distance_m", distance_m, {0.1, 100},
         "For cross_path, how far ahead the person crosses; for follow, how near the person comes, hull to person.");
  fields("repeat_s", repeat_s, {0, 1e6}, "For cross_path, the person crosses again after this long; 0 for once.");
  fields("vehicle", vehicle, "Name of the vehicle that the person crosses or follows; empty for the first.");
}

std::vector<common::Problem> WalkerConfig::validate() const {
  return common::Validation()
      .require(mode != WalkerMode::kPath || path_world_m.size() >= 2, "path_world_m",
               Message("walker.no-point", "a path needs a point"))
      .require(path_world_m.size() != 2 || (speeds_m_s.empty() && pause_s == 0.0), "path_world_m",
               Message("walker.one-point", "speeds_m_s and pause_s need two points"))
      .require(path_world_m.size() % 2 == 0, "path_world_m", noPairs(path_world_m))
      .require((speeds_m_s.empty() && pause_s == 0.0) || at_end != WalkerEnd::kReturn, "at_end",
               Message("walker.return", "return knows neither speeds_m_s nor pause_s"))
      .problems();
}

void PushConfig::describe(common::config::Fields& fields) {
  fields("time_s", time_s, {0, 1e6}, "Time of the push.");
  fields("x_n_s", x_n_s, {-1000, 1000}, "Impulse along the world's x.");
  fields("y_n_s", y_n_s, {-1000, 1000}, "Impulse along the world's y.");
  fields("z_n_s", z_n_s, {-1000, 1000}, "Impulse upwards.");
}

void PilotConfig::describe(common::config::Fields& fields) {
  fields("time_s", time_s, {0, 1e6}, "Time from which these sticks apply, until the next entry.");
  fields("roll", roll, {-1, 1}, "Stick of the roll.");
  fields("pitch", pitch, {-1, 1}, "Stick of the pitch.");
  fields("yaw_rate", yaw_rate, {-1, 1}, "Stick of the yaw rate.");
  fields("thrust", thrust, {0, 1}, "Stick of the thrust.");
  fields("takes_over", takes_over, "Whether the pilot flies alone.");
}

void ScenarioVehicle::describe(common::config::Fields& fields) {
  fields("name", name, "Name of the vehicle.");
  fields("mission", mission, "Mission file of this vehicle; empty for the trial's mission.");
  fields.section("start", start, "Where the vehicle stands.");
  fields("battery_remaining", battery_remaining, {0.01, 1}, "Charge at the start, as a share of the full one.");
  fields.list("pushes", pushes, "Pushes of the vehicle.");
  fields.list("hands", hands, "Hands that take the vehicle, carry and turn it, and let go.");
  fields.list("faults", faults, "Faults of sensors, and of the battery.");
  fields.list("pilot", pilot, "The pilot's sticks over time; without entries there is no remote control.");
}

std::vector<common::Problem> ScenarioVehicle::validate() const {
  return common::Validation()
      .require(isName(name), "name", Message("scenario.no-name", "is not 1 to 40 letters, digits, `_` and `-`"))
      .require(inOrder(pilot), "pilot", notInOrder())
      .problems();
}

void Scenario::describe(common::config::Fields& fields) {
  fields("seed", seed, {0, kGreatestSeed}, "Seed of every random stream.");
  fields("world", world, "SDF file.");
  fields("model_paths", model_paths, "Folders that hold the models the world includes.");
  fields("allow_incomplete_world", allow_incomplete_world,
         "Whether a world is flown of which models, meshes or collisions are missing, without them.");
  fields("indoor_light", indoor_light, {0, 1},
         "Light for the onboard camera under a roof, as a share of that under the open sky; 1: the same everywhere.");
  fields.section("start", start, "Where the vehicle stands.");
  fields("battery_remaining", battery_remaining, {0.01, 1}, "Charge at the start, as a share of the full one.");
  fields.section("wind", wind, "Wind.");
  fields.section("variation", variation, "What the seed varies, each uniformly up to the given value.");
  fields.list("walkers", walkers, "People; they never yield.");
  fields.list("doors", doors, "Doors that close during the flight. People walk through them.");
  fields.list("pushes", pushes, "Pushes of the vehicle.");
  fields.list("hands", hands, "Hands that take the vehicle, carry and turn it, and let go.");
  fields.list("faults", faults, "Faults of sensors, and of the battery.");
  fields.list("pilot", pilot, "The pilot's sticks over time; without entries there is no remote control.");
  fields.section("quadrotor", quadrotor, "The airframe's physics.");
  fields.section("autopilot", autopilot, "The inner loop.");
  fields.section("sensors", sensors, "Errors and delays of the sensors.");
  fields.list("vehicles", vehicles,
              "The vehicles if there are several; each then has its own start, battery_remaining, pushes, hands, "
              "faults and pilot.");
}

std::vector<common::Problem> Scenario::validate() const {
  common::Validation validation;
  validation.require(inOrder(pilot), "pilot", notInOrder());
  (void)distinctNames("doors", doors, validation);
  std::vector<common::Problem> problems = validation.problems(), more = vehicleProblems(*this);
  problems.insert(problems.end(), more.begin(), more.end());
  return problems;
}

void Scenario::setCharge(double remaining) {
  battery_remaining = remaining;
  variation.battery_remaining = 0.0;
  written.emplace_back("battery_remaining");
  for (std::size_t i = 0; i < vehicles.size(); ++i) {
    vehicles[i].battery_remaining = remaining;
    written.push_back(fmt::format("vehicles[{}].battery_remaining", i));
  }
}

std::size_t Scenario::vehicleNumber(const std::string& name) const {
  if (name.empty()) return 0;
  const auto found =
      std::find_if(vehicles.begin(), vehicles.end(), [&name](const ScenarioVehicle& one) { return one.name == name; });
  SWIFTLET_CHECK(found != vehicles.end(), name);
  return static_cast<std::size_t>(found - vehicles.begin());
}

Scenario Scenario::withVehicleAlone(std::size_t number) const {
  SWIFTLET_CHECK(number < vehicleCount(), number, vehicleCount());
  Scenario alone = *this;
  if (vehicles.empty()) return alone;
  alone.vehicles.clear();
  const ScenarioVehicle& own = vehicles[number];
  alone.start = own.start;
  alone.battery_remaining = own.battery_remaining;
  alone.pushes = own.pushes;
  alone.hands = own.hands;
  alone.faults = own.faults;
  alone.pilot = own.pilot;
  const std::string own_keys = fmt::format("vehicles[{}].", number);
  for (const std::string& key : written)
    if (key.starts_with(own_keys)) alone.written.push_back(key.substr(own_keys.size()));
  return alone;
}

}  // namespace swiftlet::simulation
