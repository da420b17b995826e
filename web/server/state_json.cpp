#include "web/server/state_json.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "common/operator_text.hpp"
#include "common/rounding.hpp"
#include "common/submap3d.hpp"
#include "common/world.hpp"
#include "common/world/energy_layer.hpp"
#include "common/world/map3d_layer.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/mission_layer.hpp"
#include "common/world/objects_layer.hpp"
#include "common/world/targets_layer.hpp"
#include "common/world/vehicle_layer.hpp"
#include "web/server/tree_json.hpp"

namespace swiftlet::web {
namespace {

using Json = nlohmann::ordered_json;

/// nlohmann::json writes null for numbers that are not finite.
Json number(double value, int decimals = 3) { return common::rounded(value, decimals); }

Json point(const Eigen::Vector2d& p) { return Json::array({number(p.x()), number(p.y())}); }

Json points(std::span<const Eigen::Vector2d> list, std::size_t from = 0) {
  Json array = Json::array();
  for (std::size_t i = from; i < list.size(); ++i) array.push_back(point(list[i]));
  return array;
}

/// Rows of cells as [x, y, length]; the cells may come in any order.
Json runs(std::vector<common::CellIndex> cells) {
  std::sort(cells.begin(), cells.end(),
            [](common::CellIndex a, common::CellIndex b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  Json array = Json::array();
  for (std::size_t begin = 0; begin < cells.size();) {
    std::size_t end = begin + 1;
    while (end < cells.size() && cells[end].y == cells[begin].y && cells[end].x <= cells[end - 1].x + 1) ++end;
    array.push_back({cells[begin].x, cells[begin].y, cells[end - 1].x - cells[begin].x + 1});
    begin = end;
  }
  return array;
}

const char* word(common::IntentState state) {
  switch (state) {
    case common::IntentState::kRunning:
      return "running";
    case common::IntentState::kSucceeded:
      return "succeeded";
    case common::IntentState::kFailed:
      return "failed";
  }
  return "unknown";
}

Json poseOf(const common::VehicleState& state) {
  const common::Pose3 pose = state.T_map_body();
  const common::RollPitchYaw angles = common::rollPitchYaw(pose.rotation);
  return {{"x_m", number(pose.position_m.x())},       {"y_m", number(pose.position_m.y())},
          {"z_m", number(pose.position_m.z())},       {"roll_rad", number(angles.roll_rad, 4)},
          {"pitch_rad", number(angles.pitch_rad, 4)}, {"yaw_rad", number(angles.yaw_rad, 4)}};
}

Json missionOf(const common::MissionLayer& layer) {
  const common::MissionStatus& mission = layer.status;
  return {{"state", common::toString(mission.state)},
          {"name", mission.name},
          {"flown_by", common::toString(mission.flown_by)},
          {"phase", mission.phase},
          {"reason", mission.reason},
          {"waiting", layer.waiting.empty() ? Json(nullptr) : Json(layer.waiting)},
          {"accepts_goals", mission.accepts_goals},
          {"question", mission.question}};
}

Json planarPose(const common::Pose2& pose) {
  return {{"x_m", number(pose.x_m)}, {"y_m", number(pose.y_m)}, {"yaw_rad", number(pose.yaw_rad, 4)}};
}

Json candidatesOf(const common::Localization& localization) {
  Json list = Json::array();
  for (const common::PlaceCandidate& candidate : localization.candidates) {
    list.push_back(planarPose(candidate.T_given_body));
    list.back()["weight"] = number(candidate.weight);
  }
  return list;
}

Json localizationOf(const common::MapLayer& map) {
  const auto& localization = map.localization;
  if (!localization) return nullptr;
  const bool known = localization->localized();
  const common::Pose2& at = localization->T_given_body;
  const double deviation_m = std::sqrt(std::max(0.0, localization->covariance.topLeftCorner<2, 2>().trace()));
  const double deviation_yaw_rad = std::sqrt(std::max(0.0, localization->covariance(2, 2)));
  return {{"state", common::toString(localization->state)},
          {"x_m", known ? number(at.x_m) : Json(nullptr)},
          {"y_m", known ? number(at.y_m) : Json(nullptr)},
          {"yaw_rad", known ? number(at.yaw_rad, 4) : Json(nullptr)},
          {"deviation_m", known ? number(deviation_m) : Json(nullptr)},
          {"explained", known ? number(localization->explained) : Json(nullptr)},
          {"deviation_yaw_rad", known ? number(deviation_yaw_rad, 4) : Json(nullptr)},
          {"places", localization->places},
          {"candidates", candidatesOf(*localization)},
          {"T_map_given", map.T_map_given ? planarPose(*map.T_map_given) : Json(nullptr)}};
}

Json avoidanceOf(const common::AvoidanceStatus& avoidance) {
  return {{"braking", avoidance.braking},
          {"retreating", avoidance.retreating},
          {"reason", avoidance.reason},
          {"nearest_m", number(avoidance.nearest_m, 2)}};
}

Json map3dOf(const std::shared_ptr<const common::Map3dLayer>& map3d, common::Time now) {
  if (!map3d) return nullptr;
  std::size_t points = 0;
  for (const common::Submap3d& submap : *map3d->submaps) points += submap.points->size();
  return {{"submaps", map3d->submaps->size()},
          {"points", points},
          {"tracked", map3d->tracked},
          {"fused_age_s", map3d->fused ? number((now - map3d->fused_stamp).seconds()) : Json(nullptr)}};
}

Json zonesOf(const std::vector<common::Polygon>& zones) {
  Json list = Json::array();
  for (const common::Polygon& zone : zones) list.push_back(points(zone.corners_map_m));
  return list;
}

Json targetsOf(const common::TargetsLayer& layer) {
  Json list = Json::array();
  for (const common::Target& target : layer.targets)
    list.push_back({{"id", target.id},
                    {"name", target.name},
                    {"label", labelOf(target)},
                    {"state", common::toString(target.state)},
                    {"x_m", number(target.position_map_m.x())},
                    {"y_m", number(target.position_map_m.y())},
                    {"z_m", number(target.position_map_m.z())},
                    {"deviation_m", number(target.sigma_m())},
                    {"diameter_m", number(target.diameter_m, 2)},
                    {"views", target.views}});
  return list;
}

Json objectsOf(const std::shared_ptr<const common::ObjectsLayer>& layer) {
  if (!layer) return nullptr;
  Json list = Json::array();
  for (const common::RecognizedObject& object : layer->objects) {
    const common::Pose3& T = object.T_map_object;
    list.push_back({{"id", object.id},
                    {"what", object.what},
                    {"label", labelOf(object)},
                    {"confirmed", object.confirmed},
                    {"passage", common::toString(object.passage)},
                    {"x_m", number(T.position_m.x())},
                    {"y_m", number(T.position_m.y())},
                    {"z_m", number(T.position_m.z())},
                    {"yaw_rad", number(common::yawOf(T.rotation), 4)},
                    {"deviation_m", number(object.sigma_m())},
                    {"deviation_yaw_rad", number(object.yaw_sigma_rad, 4)},
                    {"width_m", number(object.size_m.x(), 2)},
                    {"height_m", number(object.size_m.y(), 2)},
                    {"looks", object.looks},
                    {"last_seen_s", number(object.last_seen.seconds())}});
  }
  return list;
}

Json stateOf(const common::World& world, const Observation& seen) {
  const common::VehicleLayer& vehicle = *world.vehicle;
  const common::VehicleState& state = vehicle.state;
  const common::MissionLayer& mission = *world.mission;
  const Eigen::Vector3d velocity = state.velocity_map_m_s();
  const auto optional = [](const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); };
  Json json = {
      {"type", "state"},
      {"sequence", seen.sequence},
      {"stamp_s", number(world.stamp.seconds())},
      {"age_s", number(seen.world_age_s)},
      {"camera_age_s", optional(seen.camera_age_s)},
      {"depth_age_s", optional(seen.depth_age_s)},
      {"map3d", map3dOf(world.map3d, world.stamp)},
      {"realtime_factor", optional(seen.realtime_factor)},
      {"pose", poseOf(state)},
      {"velocity_m_s", {number(velocity.x()), number(velocity.y()), number(velocity.z())}},
      {"speed_m_s", number(velocity.norm())},
      {"height_above_ground_m", number(state.height_above_ground_m)},
      {"position_deviation_m",
       number(std::sqrt(std::max(0.0, state.position_covariance_m2.topLeftCorner<2, 2>().trace())))},
      {"drift_m", number(vehicle.drift_m)},
      {"localization", localizationOf(*world.map)},
      {"horizontal_valid", state.horizontal_valid},
      {"vertical_valid", state.vertical_valid},
      {"flight_state", common::toString(vehicle.flight_state)},
      {"battery",
       {{"voltage_v", number(world.energy->battery_voltage_v, 2)},
        {"remaining", number(world.energy->battery_remaining)},
        {"left_s", world.energy->seconds_left ? number(*world.energy->seconds_left, 0) : Json(nullptr)}}},
      {"thrust_margin", world.energy->thrust_margin > 0.0 ? number(world.energy->thrust_margin, 2) : Json(nullptr)},
      {"distance_flown_m", number(vehicle.distance_flown_m, 2)},
      {"explored_area_m2", world.map->explored_area_m2 > 0 ? number(world.map->explored_area_m2, 2) : Json(nullptr)},
      {"avoidance", avoidanceOf(vehicle.avoidance)},
      {"intent", {{"state", word(mission.intent.state)}, {"reason", mission.intent.reason}}},
      {"mission", missionOf(mission)},
      {"ending",
       mission.ending ? Json{{"outcome", mission.ending->outcome}, {"reason", mission.ending->reason}} : Json(nullptr)},
      {"home", {{"x_m", number(vehicle.home_map.x_m)}, {"y_m", number(vehicle.home_map.y_m)}}},
      {"goal", mission.goal_map_m
                   ? Json{{"x_m", number(mission.goal_map_m->x())}, {"y_m", number(mission.goal_map_m->y())}}
                   : Json(nullptr)},
      {"keep_out", zonesOf(*world.map->keep_out)},
      {"targets", targetsOf(*world.targets)},
      {"objects", objectsOf(world.objects)},
      {"plan", points(vehicle.plan_map_m)}};
  if (!vehicle.name.empty()) json["vehicle"] = vehicle.name;
  return json;
}

Json frontierOf(const common::Frontier& frontier) {
  return {{"reason", common::toString(frontier.reason)},
          {"explanation", frontier.explanation},
          {"centroid_m", point(frontier.centroid_map_m)},
          {"length_m", number(frontier.length_m, 2)},
          {"attempts", frontier.attempts},
          {"cells", runs(frontier.cells)}};
}

Json frontiersOf(const std::vector<common::Frontier>& frontiers, double resolution_m) {
  Json list = Json::array();
  for (const common::Frontier& frontier : frontiers) list.push_back(frontierOf(frontier));
  return {{"type", "frontiers"}, {"resolution_m", resolution_m}, {"frontiers", list}};
}

Json levelsOf(const common::LevelMap& levels) {
  Json list = Json::array();
  for (const common::Level& level : levels.levels)
    list.push_back({{"id", level.id},
                    {"height_m", number(level.height_m)},
                    {"deviation_m", number(std::sqrt(std::max(0.0, level.variance_m2)))},
                    {"cells", runs(level.cells)}});
  return {{"type", "levels"}, {"resolution_m", levels.resolution_m}, {"levels", list}};
}

Json eventsOf(std::span<const NumberedEvent> events) {
  Json list = Json::array();
  for (const auto& [number_in_flight, event] : events) {
    list.push_back({{"number", number_in_flight},
                    {"stamp_s", number(event.stamp.seconds())},
                    {"severity", common::toString(event.severity)},
                    {"source", event.source},
                    {"text", common::withoutFolders(event.text)},
                    {"reason", common::withoutFolders(event.reason)}});
    if (const auto alarm = common::alarmOf(event); !alarm.empty()) list.back()["alarm"] = alarm;
    if (!event.vehicle.empty()) list.back()["vehicle"] = event.vehicle;
  }
  return list;
}

/// A text that is not UTF-8 must not stop the page.
std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string stateJson(const common::World& world, const Observation& observation) {
  return dump(stateOf(world, observation));
}

std::string frontiersJson(const std::vector<common::Frontier>& frontiers, double resolution_m) {
  return dump(frontiersOf(frontiers, resolution_m));
}

std::string levelsJson(const common::LevelMap& levels) { return dump(levelsOf(levels)); }

std::string givenMapJson(const common::GivenMap* given) {
  Json json = {{"type", "given_map"}, {"resolution_m", nullptr}, {"T_given_grid", nullptr}};
  if (given != nullptr) {
    json["resolution_m"] = given->grid->resolution_m();
    json["T_given_grid"] = planarPose(given->T_given_grid);
  }
  return dump(json);
}

std::string trailJson(std::span<const Eigen::Vector2d> trail_map_m, std::size_t from) {
  return dump({{"type", "trail"}, {"from", from}, {"points", points(trail_map_m, from)}});
}

std::string eventsJson(std::span<const NumberedEvent> events) {
  return dump({{"type", "events"}, {"events", eventsOf(events)}});
}

std::string completeJson(const common::World& world, const Observation& observation,
                         std::span<const NumberedEvent> events) {
  Json json = stateOf(world, observation);
  json.erase("type");
  const common::MapLayer& map = *world.map;
  Json& tree = json["mission"]["tree"] = Json::array();
  for (const common::TreeNodeView& node : world.mission->status.tree) tree.push_back(nodeJson(node, true));
  json["trail"] = points(world.vehicle->trail.points_map_m());
  json["frontiers"] = frontiersOf(*map.frontiers, map.grid->resolution_m())["frontiers"];
  json["levels"] = levelsOf(*map.levels)["levels"];
  json["resolution_m"] = map.grid->resolution_m();
  json["levels_resolution_m"] = map.levels->resolution_m;
  json["events"] = eventsOf(events);
  return dump(json);
}

std::string helloJson(const std::string& title, double hull_diameter_m, const std::vector<std::string>& vehicles,
                      const std::string& vehicle) {
  Json hello = {{"type", "hello"}, {"title", title}, {"hull_diameter_m", hull_diameter_m}};
  if (!vehicles.empty()) {
    hello["vehicles"] = vehicles;
    hello["vehicle"] = vehicle;
  }
  return dump(hello);
}

}  // namespace swiftlet::web
