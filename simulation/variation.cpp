#include "simulation/variation.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/random.hpp"
#include "simulation/nature.hpp"
#include "simulation/quadrotor.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/start_surroundings.hpp"
#include "simulation/truth_map.hpp"

namespace swiftlet::simulation {
namespace {

using common::InputError;
using common::kRadPerDeg;
using common::Message;
using common::Problem;

constexpr double kSearchFloorFrom_m = 0.5;   // Height above the start from which the floor is searched.
constexpr double kSearchFloorDown_m = 20.0;  // A start farther above a floor is a mistake.
constexpr double kUnevenFloor_m =
    0.03;  // Greatest height difference of the feet; the vehicle tips at 0.05 (referee.cpp).
constexpr double kTakeOffRoom_m = 0.10;  // Around the hull on its way up; gusts move it by up to 9 cm before it flies.
constexpr double kTouching_m = 0.01;
constexpr double kSameFloor_m = 0.05;  // A drawn start must be on the same floor as the nominal one, not on a crate.

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
  drawn.world.indoor_light = static_cast<float>(scenario.indoor_light);
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

Problem startProblem(const PlacedVehicle& drawn, const WorldModel& world, const Message& message, const char* hint) {
  const StartConfig& start = drawn.scenario.start;
  return {world.start_source, drawn.name.empty() ? "start" : "start of `" + drawn.name + "`",
          message.behind(fmt::format("at ({:.2f}, {:.2f}, {:.2f}) ", start.x_m, start.y_m, start.z_m)), hint};
}

/// "`model/part` (file:line)".
std::string described(const Shape& shape) {
  return fmt::format("`{}`{}", nameOf(shape), shape.source.file.empty() ? "" : " (" + toString(shape.source) + ")");
}

/// How often a vertical ray from `from` meets a shape, upwards and downwards.
std::pair<int, int> crossings(const Shape& shape, const Eigen::Vector3d& from) {
  std::pair<int, int> count{0, 0};
  for (const auto& corners : shape.triangles) {
    const auto corner = [&](std::size_t i) -> Eigen::Vector3d {
      return shape.vertices_world_m[corners[i]].cast<double>() - from;
    };
    const Eigen::Vector3d a = corner(0), b = corner(1), c = corner(2);
    const auto area = [](const Eigen::Vector3d& p, const Eigen::Vector3d& q) { return p.x() * q.y() - p.y() * q.x(); };
    const double u = area(b, c), v = area(c, a), w = area(a, b);
    if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) continue;
    if (u + v + w == 0.0) continue;  // Seen edge-on.
    ++((u * a.z() + v * b.z() + w * c.z()) / (u + v + w) > 0.0 ? count.first : count.second);
  }
  return count;
}

/// The solid that a point is in: a hull in the middle of a large box touches no surface. A mesh may be a house.
const Shape* solidAround(const WorldModel& world, const RayCaster& rays, const Eigen::Vector3d& point) {
  constexpr std::size_t kMostTriangles = 5000;  // Solids have less; terrain is no solid.
  const Eigen::Vector3d beside = point + Eigen::Vector3d(1.3e-4, 0.7e-4, 0.0);  // A ray along an edge hits it twice.
  for (const double up : {1.0, -1.0}) {
    const Hit hit = rays.cast(beside, up * Eigen::Vector3d::UnitZ(), 1e4);
    if (!hit || static_cast<std::size_t>(hit.shape) >= world.shapes.size()) continue;
    const Shape& shape = world.shapes[static_cast<std::size_t>(hit.shape)];
    if (!shape.materials.empty() || shape.triangles.size() > kMostTriangles) continue;
    const auto [above, below] = crossings(shape, beside);
    if (above % 2 == 1 && below % 2 == 1) return &shape;
  }
  return nullptr;
}

Hull hullOf(const Scenario& scenario) {
  return {scenario.vehicle.hullRadius_m(), 0.5 * scenario.vehicle.hull_height_m};
}

/// Of the body above the floor, before the take-off and after it.
double standingHeight_m(const Scenario& scenario) { return scenario.quadrotor.gear_height_m - Quadrotor::kGearSag_m; }

double flightHeight_m(const Scenario& scenario) {
  return std::min(scenario.variation.flight_height_m, scenario.vehicle.max_height_m);
}

/// The ground below the feet of a standing vehicle.
struct Footing {
  double lowest_world_m = INFINITY, highest_world_m = -INFINITY;
  double gradient = 0.0;  ///< Rise over run of the plane through the four feet.
};

/// nullopt without a floor below each foot and the middle.
std::optional<Footing> footingOf(const Scenario& scenario, const RayCaster& rays) {
  const StartConfig& start = scenario.start;
  const double gear_m = scenario.quadrotor.gear_radius_m;
  Footing footing;
  Eigen::Vector2d rise_m2(0.0, 0.0);
  for (int foot = 0; foot < 5; ++foot) {
    const double angle_rad = start.yaw_deg * kRadPerDeg + (0.25 + 0.5 * foot) * std::numbers::pi;
    const Eigen::Vector2d aside_m =
        (foot < 4 ? gear_m : 0.0) * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
    const Eigen::Vector3d from(start.x_m + aside_m.x(), start.y_m + aside_m.y(), start.z_m + kSearchFloorFrom_m);
    const Hit hit = rays.cast(from, -Eigen::Vector3d::UnitZ(), kSearchFloorDown_m);
    if (!hit) return std::nullopt;
    const double height_m = from.z() - hit.distance_m;
    footing.lowest_world_m = std::min(footing.lowest_world_m, height_m);
    footing.highest_world_m = std::max(footing.highest_world_m, height_m);
    rise_m2 += height_m * aside_m;
  }
  if (gear_m > 0.0) footing.gradient = rise_m2.norm() / (2.0 * gear_m * gear_m);  // Four feet in a square.
  return footing;
}

/// What the hull may touch around a body at that place. Ground that slopes as the feet stand on it is higher beside the
/// hull than below it, and a gear on a slope tilts the hull along: the part below the rise of the ground is left out.
Clearance aboveGround(const RayCaster& rays, const Hull& hull, const Footing& footing, Eigen::Vector3d body_world_m,
                      double margin_m) {
  const double rise_m = std::min(footing.gradient * (hull.radius_m + margin_m), hull.half_height_m);
  body_world_m.z() += 0.5 * rise_m;
  return rays.sweep({hull.radius_m, hull.half_height_m - 0.5 * rise_m}, body_world_m, body_world_m, margin_m);
}

/// Puts the start on its floor; returns what blocks it, if anything does.
std::optional<Problem> placeStart(PlacedVehicle& drawn, const WorldModel& world, const RayCaster& rays) {
  const Scenario& scenario = drawn.scenario;
  const StartConfig& start = scenario.start;
  const std::optional<Footing> footing = footingOf(scenario, rays);
  if (!footing)
    return startProblem(
        drawn, world, Message("start.no-floor", "has no floor under it"),
        "give a start over a floor, or the world one: <include><uri>model://ground_plane</uri></include>");
  const double lowest_m = footing->lowest_world_m, highest_m = footing->highest_world_m;
  if (highest_m - lowest_m > kUnevenFloor_m)
    return startProblem(
        drawn, world,
        Message("start.on-an-edge", "stands on an edge: its feet are {:.2f} m apart in height", highest_m - lowest_m),
        "move the start");
  drawn.T_world_map = common::lifted({start.x_m, start.y_m, start.yaw_deg * kRadPerDeg}, highest_m);

  const Eigen::Vector3d body(start.x_m, start.y_m, highest_m + standingHeight_m(scenario));
  const Clearance clearance = aboveGround(rays, hullOf(scenario), *footing, body, kTouching_m);
  if (const Shape* terrain = terrainAbove(world, rays, body))
    return startProblem(drawn, world,
                        Message("start.beneath-terrain", "is beneath the terrain {}", described(*terrain)),
                        "move the start");
  const Shape* shape = clearance.shape == Hit::kNothing ? solidAround(world, rays, body)
                                                        : &world.shapes[static_cast<std::size_t>(clearance.shape)];
  if (shape == nullptr) return std::nullopt;
  return startProblem(drawn, world, Message("start.in-obstacle", "is inside or touches {}", described(*shape)),
                      "move the start");
}

/// A problem if the hull would touch that of another vehicle.
std::optional<Problem> touchesAnother(const PlacedVehicle& drawn, const WorldModel& world,
                                      const std::vector<PlacedVehicle>& others) {
  const Eigen::Vector3d at = drawn.T_world_map.position_m;
  for (const PlacedVehicle& other : others) {
    const Eigen::Vector3d apart = other.T_world_map.position_m - at;
    const common::VehicleConfig &a = drawn.scenario.vehicle, &b = other.scenario.vehicle;
    if (apart.head<2>().norm() > a.hullRadius_m() + b.hullRadius_m() || std::abs(apart.z()) > a.hull_height_m) continue;
    return startProblem(drawn, world, Message("start.touches-vehicle", "touches the vehicle `{}`", other.name),
                        "move one of the two starts");
  }
  return std::nullopt;
}

/// A problem if something is nearer than the margin on the way up to the flight height: under a chair the hull may fit.
std::optional<Problem> noRoomAbove(const PlacedVehicle& drawn, const WorldModel& world, const RayCaster& rays,
                                   double margin_m) {
  const Eigen::Vector3d floor_m = drawn.T_world_map.position_m;
  const Hull hull = hullOf(drawn.scenario);
  const Footing footing = footingOf(drawn.scenario, rays).value_or(Footing());
  for (double height_m = standingHeight_m(drawn.scenario); height_m < flightHeight_m(drawn.scenario);
       height_m += hull.half_height_m) {
    const Eigen::Vector3d at = floor_m + height_m * Eigen::Vector3d::UnitZ();
    const Clearance near = aboveGround(rays, hull, footing, at, margin_m);
    if (near.shape == Hit::kNothing) continue;
    return startProblem(
        drawn, world,
        Message("start.no-room", "has no room for the take-off to {:g} m: {} is in the way, {:.2f} m over the floor",
                flightHeight_m(drawn.scenario), described(world.shapes[static_cast<std::size_t>(near.shape)]),
                near.point_world_m.z() - floor_m.z()),
        "move the start, or lower variation.flight_height_m");
  }
  return std::nullopt;
}

/// A free place near a blocked start, on a floor like that of the start, or on top of everything: the nearest one, or
/// one little farther that is better to fly from.
std::optional<StartConfig> nearestFree(const PlacedVehicle& blocked, const WorldModel& world, const RayCaster& rays,
                                       const std::vector<PlacedVehicle>& others) {
  constexpr double kStep_m = 0.25, kFarthest_m = 20.0, kLittleFarther_m = 2.0;
  const Scenario& scenario = blocked.scenario;
  const StartConfig& start = scenario.start;
  const double above_m = static_cast<double>(world.bounds_world_m().max().z()) + kSearchFloorFrom_m;
  const Eigen::Vector3d standing = standingHeight_m(scenario) * Eigen::Vector3d::UnitZ();
  const StartSurroundings around(rays, hullOf(scenario), Eigen::Vector3d(start.x_m, start.y_m, start.z_m) + standing,
                                 flightHeight_m(scenario) - standing.z());
  const auto rounded = [](double value, double digits = 100.0) { return std::round(value * digits) / digits; };
  PlacedVehicle place = blocked;
  StartConfig& at = place.scenario.start;
  at.yaw_deg = rounded(start.yaw_deg, 1.0);
  std::optional<std::pair<int, StartConfig>> best;
  for (const bool on_top : {false, true}) {
    double farthest_m = kFarthest_m;
    for (double ring_m = 0.0; ring_m <= farthest_m; ring_m += kStep_m) {
      const int places = std::max(1, static_cast<int>(2.0 * std::numbers::pi * ring_m / kStep_m));
      for (int i = 0; i < places; ++i) {
        const double angle_rad = 2.0 * std::numbers::pi * i / places;
        at.x_m = rounded(start.x_m + ring_m * std::cos(angle_rad));
        at.y_m = rounded(start.y_m + ring_m * std::sin(angle_rad));
        const Hit top = on_top ? rays.cast({at.x_m, at.y_m, above_m}, -Eigen::Vector3d::UnitZ(), above_m + 1e3) : Hit();
        at.z_m = rounded(top ? above_m - top.distance_m : start.z_m);
        if (placeStart(place, world, rays) || touchesAnother(place, world, others) ||
            noRoomAbove(place, world, rays, kTakeOffRoom_m))
          continue;
        const int drawbacks = around.drawbacksOf(place.T_world_map.position_m + standing);
        if (!best) farthest_m = std::min(kFarthest_m, ring_m + kLittleFarther_m);
        if (!best || drawbacks < best->first) best = {drawbacks, at};
        if (drawbacks == 0) return at;
      }
    }
    if (best) return best->second;
  }
  return std::nullopt;
}

/// What to write for a start.
std::string hintOf(const StartConfig& start) {
  const std::string height = start.z_m == 0.0 ? "" : fmt::format("{:.2f};", start.z_m);
  return fmt::format("the nearest free place is --start \"{:.2f};{:.2f};{}{:.0f}\" (in a trial: scenario.start)",
                     start.x_m, start.y_m, height, start.yaw_deg);
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

/// Conditions for a drawn start: no shape is above it. In an area it is also on the floor of the nominal start,
/// which can be reached from it.
std::optional<Problem> badPlace(const Drawn& drawn, const StartConfig& nominal, const RayCaster& rays, Reach& reach) {
  const Variation& variation = drawn.scenario.variation;
  const bool in_area = !variation.start_area_world_m.empty();
  if (!in_area && variation.start_position_m == 0.0) return std::nullopt;
  if (in_area && std::abs(drawn.T_world_map.position_m.z() - nominal.z_m) > kSameFloor_m)
    return startProblem(drawn, drawn.world,
                        Message("start.other-floor", "is not on the floor of the start that is given"),
                        "choose the area elsewhere");
  if (auto problem = noRoomAbove(drawn, drawn.world, rays, kTakeOffRoom_m); problem || !in_area) return problem;
  if (reach.has({nominal.x_m, nominal.y_m})) return std::nullopt;
  return startProblem(drawn, drawn.world, Message("start.cut-off", "does not lead to the start that is given"),
                      "choose the area elsewhere");
}

std::optional<Problem> unreachableGoal(const Drawn& drawn, Reach& reach) {
  const std::vector<double>& goals = drawn.scenario.variation.reachable_map_m;
  for (std::size_t i = 0; i + 1 < goals.size(); i += 2) {
    const Eigen::Vector3d goal_world = drawn.T_world_map * Eigen::Vector3d(goals[i], goals[i + 1], 0.0);
    if (!reach.has(goal_world.head<2>()))
      return Problem{drawn.world.start_source, "reachable_map_m",
                     Message("start.goal-not-reached", "the goal ({:.2f}, {:.2f}) cannot be reached from the start",
                             goals[i], goals[i + 1]),
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
    auto problem = placeStart(drawn, drawn.world, rays);
    if (!problem) problem = touchesAnother(drawn, drawn.world, others);
    if (!problem) problem = noRoomAbove(drawn, drawn.world, rays, kTouching_m);
    if (!problem) problem = badPlace(drawn, nominalStart(world, nominal.scenario), rays, reach);
    if (problem) {
      if (const auto free = draws == 1 ? nearestFree(drawn, drawn.world, rays, others) : std::nullopt)
        problem->hint = hintOf(*free);
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
        throw InputError({world.file}, key, Message("world.no-model", "there is no model `{}`", name),
                         common::didYouMean(name, models));
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
