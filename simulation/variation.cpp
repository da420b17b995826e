#include "simulation/variation.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/random.hpp"
#include "simulation/nature.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/truth_map.hpp"

namespace swiftlet::simulation {
namespace {

using common::InputError;
using common::kRadPerDeg;
using common::Problem;

constexpr double kSearchFloorFrom_m = 0.5;   // Height above the start from which the floor is searched.
constexpr double kSearchFloorDown_m = 20.0;  // A start farther above a floor is a mistake.
constexpr double kUnevenFloor_m =
    0.03;  // Greatest height difference of the feet; the vehicle tips at 0.05 (referee.cpp).
constexpr double kTakeOffRoom_m = 0.10;  // Around the hull on its way up; gusts move it by up to 9 cm before it flies.
constexpr double kSameFloor_m = 0.05;    // A drawn start must be on the same floor as the nominal one, not on a crate.

StartConfig nominalStart(const WorldModel& world, const Scenario& scenario) {
  StartConfig start = scenario.start;
  if (start.from_world) {
    const common::Pose3 T_world_start = world.T_world_start.value_or(common::Pose3{});
    const Eigen::Vector3d& position = T_world_start.position_m;
    start = {false, position.x(), position.y(), position.z(), common::yawOf(T_world_start.rotation) / kRadPerDeg};
  }
  return start;
}

std::uint64_t streamSeed(int seed, std::size_t vehicle) {
  const auto own = static_cast<std::uint64_t>(seed);
  return vehicle == 0 ? own : common::RandomStream(own, "vehicle", vehicle).bits();
}

/// One vehicle and the world drawn with it.
struct Drawn : PlacedVehicle {
  WorldModel world;
};

void drawColors(const Variation& variation, common::RandomStream& random, WorldModel& world) {
  const auto share = [&random](double most) { return static_cast<float>(1.0 + random.uniform(-most, most)); };
  for (const std::string& model : variation.tinted) {
    const float red = share(variation.tint), green = share(variation.tint);
    world.tintModel(model, {red, green, share(variation.tint)});
  }
  if (variation.light_tint == 0.0 && variation.light_dimmed == 0.0) return;
  const float red = share(variation.light_tint), blue = share(variation.light_tint);
  world.light = static_cast<float>(1.0 - variation.light_dimmed * random.uniform()) * Color(red, 1.0F, blue);
}

/// One draw of everything the seed varies.
Drawn drawOnce(const WorldModel& world, const PlacedVehicle& nominal, int draw) {
  const Scenario& scenario = nominal.scenario;
  const Variation& variation = scenario.variation;
  common::RandomStream random(nominal.stream_seed, "variation", static_cast<std::uint64_t>(draw));
  const auto within = [&random](double most) { return random.uniform(-most, most); };
  Drawn drawn{nominal, world};
  drawn.redraws = draw;
  StartConfig& start = drawn.scenario.start = nominalStart(world, scenario);
  start.x_m += within(variation.start_position_m);
  start.y_m += within(variation.start_position_m);
  if (const std::vector<double>& area = variation.start_area_world_m; !area.empty()) {
    start.x_m = random.uniform(std::min(area[0], area[2]), std::max(area[0], area[2]));
    start.y_m = random.uniform(std::min(area[1], area[3]), std::max(area[1], area[3]));
  }
  start.yaw_deg += within(variation.start_yaw_deg);
  drawn.scenario.wind.mean_x_m_s += within(variation.wind_m_s);
  drawn.scenario.wind.mean_y_m_s += within(variation.wind_m_s);
  drawn.scenario.battery_remaining =
      std::max(0.01, scenario.battery_remaining - variation.battery_remaining * random.uniform());
  for (const std::string& obstacle : variation.obstacles) {
    const double x_m = within(variation.obstacle_m);
    drawn.world.moveModel(obstacle, {x_m, within(variation.obstacle_m)});
  }
  drawColors(variation, random, drawn.world);
  return drawn;
}

Problem startProblem(const Drawn& drawn, const std::string& message, const std::string& hint) {
  const StartConfig& start = drawn.scenario.start;
  return {drawn.world.start_source, drawn.name.empty() ? "start" : "start of `" + drawn.name + "`",
          fmt::format("at ({:.2f}, {:.2f}, {:.2f}) {}", start.x_m, start.y_m, start.z_m, message), hint};
}

/// Puts the start on its floor; returns what blocks it, if anything does.
std::optional<Problem> placeStart(Drawn& drawn, const RayCaster& rays) {
  const Scenario& scenario = drawn.scenario;
  const StartConfig& start = scenario.start;
  double lowest_m = INFINITY, highest_m = -INFINITY;
  for (int foot = 0; foot < 5; ++foot) {
    const double angle_rad = start.yaw_deg * kRadPerDeg + (0.25 + 0.5 * foot) * std::numbers::pi;
    const double reach_m = foot < 4 ? scenario.quadrotor.gear_radius_m : 0.0;
    const Eigen::Vector3d from(start.x_m + reach_m * std::cos(angle_rad), start.y_m + reach_m * std::sin(angle_rad),
                               start.z_m + kSearchFloorFrom_m);
    const Hit hit = rays.cast(from, -Eigen::Vector3d::UnitZ(), kSearchFloorDown_m);
    if (!hit) return startProblem(drawn, "has no floor under it", "give the scenario a start over a floor");
    lowest_m = std::min(lowest_m, from.z() - hit.distance_m);
    highest_m = std::max(highest_m, from.z() - hit.distance_m);
  }
  if (highest_m - lowest_m > kUnevenFloor_m)
    return startProblem(drawn,
                        fmt::format("stands on an edge: its feet are {:.2f} m apart in height", highest_m - lowest_m),
                        "move the start");
  drawn.T_world_map = common::lifted({start.x_m, start.y_m, start.yaw_deg * kRadPerDeg}, highest_m);

  const common::VehicleConfig& vehicle = scenario.vehicle;
  const Eigen::Vector3d body(start.x_m, start.y_m,
                             highest_m + scenario.quadrotor.gear_height_m - Quadrotor::kGearSag_m);
  const Hull hull{vehicle.hullRadius_m(), 0.5 * vehicle.hull_height_m};
  const Clearance clearance = rays.sweep(hull, body, body, 0.01);
  if (clearance.shape == Hit::kNothing) return std::nullopt;
  const Shape& shape = drawn.world.shapes[static_cast<std::size_t>(clearance.shape)];
  return startProblem(drawn,
                      fmt::format("is inside or touches `{}`{}", nameOf(shape),
                                  shape.source.file.empty() ? "" : " (" + toString(shape.source) + ")"),
                      "move the start");
}

/// A problem if the hull would touch that of another vehicle.
std::optional<Problem> touchesAnother(const Drawn& drawn, const std::vector<PlacedVehicle>& others) {
  const Eigen::Vector3d at = drawn.T_world_map.position_m;
  for (const PlacedVehicle& other : others) {
    const Eigen::Vector3d apart = other.T_world_map.position_m - at;
    const common::VehicleConfig &a = drawn.scenario.vehicle, &b = other.scenario.vehicle;
    if (apart.head<2>().norm() > a.hullRadius_m() + b.hullRadius_m() || std::abs(apart.z()) > a.hull_height_m) continue;
    return startProblem(drawn, fmt::format("touches the vehicle `{}`", other.name), "move one of the two starts");
  }
  return std::nullopt;
}

/// The cells that the vehicle can reach at its flight height from a placed start. They are computed once, at the first
/// call.
class Reach {
 public:
  Reach(const Drawn& drawn, const RayCaster& rays) : drawn_(drawn), rays_(rays) {}

  bool has(const Eigen::Vector2d& place_world_m) {
    if (!cells_) cells_ = reachableSpace(rays_, atFlightHeight());
    return cells_->at(cells_->cellAt(place_world_m)) != 0;
  }

 private:
  FreeSpaceQuery atFlightHeight() const {
    const common::VehicleConfig& vehicle = drawn_.scenario.vehicle;
    FreeSpaceQuery query;
    query.start_world_m = drawn_.T_world_map.position_m.head<2>();
    query.hull_radius_m = vehicle.hullRadius_m() + 0.1;
    const double middle_m = drawn_.T_world_map.position_m.z() + drawn_.scenario.variation.flight_height_m;
    query.bottom_m = middle_m - 0.5 * vehicle.hull_height_m;
    query.top_m = middle_m + 0.5 * vehicle.hull_height_m;
    query.resolution_m = 0.1;
    return query;
  }

  const Drawn& drawn_;
  const RayCaster& rays_;
  std::optional<common::TiledGrid<std::uint8_t>> cells_;
};

/// A problem if the vehicle would touch something on its way up to its flight height: under a chair the hull may fit.
std::optional<Problem> noRoomAbove(const Drawn& drawn, const RayCaster& rays) {
  const common::VehicleConfig& vehicle = drawn.scenario.vehicle;
  const Eigen::Vector3d floor_m = drawn.T_world_map.position_m;
  const Hull hull{vehicle.hullRadius_m(), 0.5 * vehicle.hull_height_m};
  const double standing_m = drawn.scenario.quadrotor.gear_height_m - Quadrotor::kGearSag_m;
  for (double height_m = standing_m; height_m < drawn.scenario.variation.flight_height_m;
       height_m += hull.half_height_m) {
    const Eigen::Vector3d at = floor_m + height_m * Eigen::Vector3d::UnitZ();
    if (rays.sweep(hull, at, at, kTakeOffRoom_m).shape != Hit::kNothing)
      return startProblem(drawn, "has no room above it", "move the start, or lower variation.flight_height_m");
  }
  return std::nullopt;
}

/// Conditions for a start that is drawn: nothing is above it. In an area it is also on the floor of the nominal start,
/// which can be reached from it.
std::optional<Problem> badPlace(const Drawn& drawn, const StartConfig& nominal, const RayCaster& rays, Reach& reach) {
  const Variation& variation = drawn.scenario.variation;
  const bool in_area = !variation.start_area_world_m.empty();
  if (!in_area && variation.start_position_m == 0.0) return std::nullopt;
  if (in_area && std::abs(drawn.T_world_map.position_m.z() - nominal.z_m) > kSameFloor_m)
    return startProblem(drawn, "is not on the floor of the start that is given", "choose the area elsewhere");
  if (auto problem = noRoomAbove(drawn, rays); problem || !in_area) return problem;
  if (reach.has({nominal.x_m, nominal.y_m})) return std::nullopt;
  return startProblem(drawn, "does not lead to the start that is given", "choose the area elsewhere");
}

std::optional<Problem> unreachableGoal(const Drawn& drawn, Reach& reach) {
  const std::vector<double>& goals = drawn.scenario.variation.reachable_map_m;
  for (std::size_t i = 0; i + 1 < goals.size(); i += 2) {
    const Eigen::Vector3d goal_world = drawn.T_world_map * Eigen::Vector3d(goals[i], goals[i + 1], 0.0);
    if (!reach.has(goal_world.head<2>()))
      return Problem{drawn.world.start_source, "reachable_map_m",
                     fmt::format("the goal ({:.2f}, {:.2f}) cannot be reached from the start", goals[i], goals[i + 1]),
                     "move the goal or the start"};
  }
  return std::nullopt;
}

bool varies(const Variation& v) {
  return v.start_position_m > 0.0 || v.start_yaw_deg > 0.0 || !v.start_area_world_m.empty() ||
         (!v.obstacles.empty() && v.obstacle_m > 0.0);
}

/// The wind, the obstacles and the colours are those drawn with the first vehicle.
void takeWindAndObstaclesOf(const PlacedVehicle& first, Scenario& scenario) {
  scenario.wind = first.scenario.wind;
  scenario.variation.wind_m_s = 0.0;
  scenario.variation.obstacles.clear();
  scenario.variation.tinted.clear();
  scenario.variation.light_tint = scenario.variation.light_dimmed = 0.0;
}

Drawn drawUntilItWillDo(const WorldModel& world, const PlacedVehicle& nominal,
                        const std::vector<PlacedVehicle>& others) {
  const int draws = varies(nominal.scenario.variation) ? kMostDraws : 1;
  std::optional<Problem> blocked, unreachable;
  for (int draw = 0; draw < draws; ++draw) {
    Drawn drawn = drawOnce(world, nominal, draw);
    const RayCaster rays(drawn.world);
    Reach reach(drawn, rays);
    auto problem = placeStart(drawn, rays);
    if (!problem) problem = touchesAnother(drawn, others);
    if (!problem) problem = badPlace(drawn, nominalStart(world, nominal.scenario), rays, reach);
    if (problem) {
      if (!blocked) blocked = problem;
      continue;
    }
    problem = unreachableGoal(drawn, reach);
    if (!problem) return drawn;
    if (!unreachable) unreachable = problem;
  }
  // A start that was free but cut off from a goal is a better explanation than a blocked start.
  Problem problem = unreachable ? *unreachable : *blocked;
  if (draws > 1) problem.message += fmt::format("; none of the {} draws of the seed's variation is suitable", draws);
  throw InputError(problem);
}

}  // namespace

Realization realize(const WorldModel& world, const Scenario& scenario) {
  const std::vector<std::string> models = world.modelNames();
  const auto mustExist = [&](const std::vector<std::string>& names, const char* key) {
    for (const std::string& name : names)
      if (!world.hasModel(name))
        throw InputError(
            Problem{{world.file}, key, fmt::format("there is no model `{}`", name), common::didYouMean(name, models)});
  };
  mustExist(scenario.variation.obstacles, "variation.obstacles");
  mustExist(scenario.variation.tinted, "variation.tinted");
  Realization realization{world, {}};
  std::vector<PlacedVehicle>& placed = realization.vehicles;
  for (std::size_t i = 0; i < scenario.vehicleCount(); ++i) {
    const std::uint64_t stream_seed = streamSeed(scenario.seed, i);
    const Scenario alone = scenario.withVehicleAlone(i);
    PlacedVehicle nominal{scenario.vehicles.empty() ? "" : scenario.vehicles[i].name,
                          scenario.nature ? scenario.nature->drawn(alone, stream_seed) : alone,
                          stream_seed,
                          {},
                          0};
    if (i > 0) takeWindAndObstaclesOf(placed.front(), nominal.scenario);
    Drawn drawn = drawUntilItWillDo(realization.world, nominal, placed);
    realization.world = std::move(drawn.world);
    placed.push_back(std::move(static_cast<PlacedVehicle&>(drawn)));
  }
  return realization;
}

}  // namespace swiftlet::simulation
