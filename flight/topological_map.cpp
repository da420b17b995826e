#include "flight/topological_map.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "behaviors/tree/value.hpp"
#include "common/world.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/mission_layer.hpp"
#include "common/world/objects_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::flight {
namespace {

using common::TopologicalMap;

/// A given passage of that kind, or a given zone, that is this near to a found one is the same.
constexpr double kSamePassage_m = 0.5, kSameCorner_m = 0.1;

double metres(double value) { return std::round(1e3 * value) / 1e3; }
double degrees(double value_rad) { return std::round(1e2 * value_rad / common::kRadPerDeg) / 1e2; }

class MapMaker {
 public:
  MapMaker(const common::World& world, const TopologicalMap* given) : world_(world) {
    const common::MapLayer& map = *world.map;
    const bool localized = map.localization && map.T_map_given;
    if (localized) T_named_map_ = common::lifted(map.T_map_given->inverse(), 0.0);
    made_.frame = localized ? common::PlacesFrame::kGiven : common::PlacesFrame::kMap;
    // Without its place in the given map the flight cannot say where in `map` the named places are.
    if (map.localization && !localized) return;
    if (given != nullptr) given_ = *given;
    names_mission_places_ = true;
  }

  TopologicalMap make() {
    addObjects();
    for (const common::MapPassage& passage : given_.passages)
      if (!isFoundAgain(passage)) made_.passages.push_back(take(passage));
    for (const common::MapPlace& place : given_.places)
      if (!isFoundAgain(place)) made_.places.push_back(take(place));
    for (const common::DangerZone& zone : given_.danger_zones) made_.danger_zones.push_back(take(zone));
    addHome();
    if (names_mission_places_) addMissionPlaces();
    addZones();
    return std::move(made_);
  }

 private:
  /// "landing_pad_4": as an entry of a mission may be called.
  static std::string entryName(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
  }
  /// The name, or one with a further number if it is taken.
  std::string freeName(const std::string& wanted) {
    const std::string base = entryName(wanted);
    std::string name = base;
    for (int i = 2; isGiven(name) || !taken_.insert(name).second; ++i) name = base + "_" + std::to_string(i);
    return name;
  }
  bool isGiven(const std::string& name) const {
    const std::vector<std::string> names = given_.names();
    return std::find(names.begin(), names.end(), name) != names.end();
  }
  template <typename Named>
  Named take(Named named) {
    taken_.insert(named.name);
    return named;
  }

  void addObjects() {
    if (!world_.objects) return;
    for (const common::RecognizedObject& object : world_.objects->objects) {
      if (!object.confirmed || object.what == "mirror") continue;
      const common::Pose3 T = T_named_map_ * object.T_map_object;
      const Eigen::Vector3d at = T.position_m.unaryExpr(&metres);
      const double yaw_deg = degrees(common::yawOf(T.rotation)), sigma_m = metres(object.sigma_m());
      if (object.passage == common::Passage::kNone)
        made_.places.push_back({givenNameOf(object, at), object.what, at.x(), at.y(), at.z(), yaw_deg, sigma_m});
      else
        made_.passages.push_back({givenNameOf(object, at), object.what, at.x(), at.y(), at.z(), yaw_deg,
                                  metres(object.size_m.x()), metres(object.size_m.y()), sigma_m, object.passage});
    }
  }

  /// A passage or pattern that the given map has at that place keeps its name.
  std::string givenNameOf(const common::RecognizedObject& object, const Eigen::Vector3d& at) {
    const auto same = [&](const auto& one) {
      return (Eigen::Vector3d(one.x_m, one.y_m, one.z_m) - at).norm() <= kSamePassage_m && !taken_.contains(one.name);
    };
    std::string name;
    if (object.passage == common::Passage::kNone) {
      for (const common::MapPlace& place : given_.places)
        if (place.what == object.what && same(place)) name = place.name;
    } else {
      for (const common::MapPassage& passage : given_.passages)
        if (same(passage)) name = passage.name;
    }
    if (name.empty()) return freeName(object.what + "_" + std::to_string(object.id));
    taken_.insert(name);
    return name;
  }
  template <typename Named>
  bool isFoundAgain(const Named& named) const {
    return taken_.contains(named.name);
  }

  void addHome() {
    if (taken_.contains("home")) return;
    const common::Pose3 T = T_named_map_ * common::lifted(world_.vehicle->home_map, 0.0);
    made_.places.push_back(take(common::MapPlace{"home", "", metres(T.position_m.x()), metres(T.position_m.y()), 0.0,
                                                 degrees(common::yawOf(T.rotation)), 0.0}));
  }

  /// A node that was given a name and flies to a place that stands in the mission: `<MoveToGoal name="kitchen" .../>`.
  void addMissionPlaces() {
    for (const common::TreeNodeView& node : world_.mission->status.tree) {
      if (node.name.empty() || node.name == node.type) continue;
      for (const common::TreePortView& port : node.ports) {
        if (port.name != "goal" || !port.entry.empty() || !port.value) continue;
        const auto value = tree::parseValue(*port.value, tree::PortType::kPoint, {});
        if (!value || isGiven(entryName(node.name))) continue;
        const auto& point = std::get<tree::Point>(*value);
        made_.places.push_back(
            {freeName(node.name), "", metres(point.x), metres(point.y), metres(point.z.value_or(0.0)), 0.0, 0.0});
      }
    }
  }

  /// The keep-out zones, but for those that the map has a name for.
  void addZones() {
    for (const common::Polygon& zone : *world_.map->keep_out) {
      common::DangerZone danger;
      for (const Eigen::Vector2d& corner : zone.corners_map_m) {
        const Eigen::Vector3d at = T_named_map_ * Eigen::Vector3d(corner.x(), corner.y(), 0.0);
        danger.corners_m.push_back(metres(at.x()));
        danger.corners_m.push_back(metres(at.y()));
      }
      const bool known = std::any_of(made_.danger_zones.begin(), made_.danger_zones.end(), [&](const auto& other) {
        if (other.corners_m.size() != danger.corners_m.size()) return false;
        for (std::size_t i = 0; i < other.corners_m.size(); ++i)
          if (std::abs(other.corners_m[i] - danger.corners_m[i]) > kSameCorner_m) return false;
        return true;
      });
      if (known) continue;
      danger.name = freeName("keep_out_" + std::to_string(made_.danger_zones.size() + 1));
      made_.danger_zones.push_back(std::move(danger));
    }
  }

  const common::World& world_;
  common::Pose3 T_named_map_;
  TopologicalMap given_, made_;
  std::set<std::string> taken_;
  bool names_mission_places_ = false;
};

}  // namespace

common::TopologicalMap topologicalMapOf(const common::World& world, const common::TopologicalMap* given) {
  return MapMaker(world, given).make();
}

}  // namespace swiftlet::flight
