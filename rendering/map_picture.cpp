#include "rendering/map_picture.hpp"

#include "common/world.hpp"
#include "common/world/map_layer.hpp"
#include "common/world/mission_layer.hpp"
#include "common/world/objects_layer.hpp"
#include "common/world/targets_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::rendering {
namespace {

/// Of what was confirmed: a mirror and a closed opening alike let nothing through, a pattern is a target.
void addObjects(const common::ObjectsLayer& layer, std::vector<MapMark>& marks) {
  for (const common::RecognizedObject& object : layer.objects) {
    if (!object.confirmed) continue;
    const common::Pose3& T = object.T_map_object;
    const bool open = object.passage == common::Passage::kOpen;
    const bool opening = open || object.passage == common::Passage::kClosed || object.what == "mirror";
    marks.push_back({labelOf(object),
                     {T.position_m.x(), T.position_m.y(), common::yawOf(T.rotation)},
                     !opening ? MarkStyle::kTarget
                     : open   ? MarkStyle::kOpen
                              : MarkStyle::kClosed,
                     object.size_m.x()});
  }
}

}  // namespace

MapPicture pictureOf(const common::World& world, double hull_diameter_m) {
  const common::VehicleLayer& vehicle = *world.vehicle;
  const common::Pose2 T_map_body = vehicle.state.T_map_body_planar();
  MapPicture picture;
  picture.grid = world.map->grid;
  picture.shown = shownFrame(world);
  picture.levels = world.map->levels;
  picture.frontiers = world.map->frontiers;
  if (vehicle.laser) picture.scan_map_m = vehicle.laser->points_map_m;

  for (const common::Polygon& zone : *world.map->keep_out) {
    MapLine edge{"keep out", {zone.corners_map_m.begin(), zone.corners_map_m.end()}, LineStyle::kReference};
    edge.points_map_m.push_back(zone.corners_map_m.front());
    picture.lines.push_back(std::move(edge));
  }

  const auto trail_map_m = vehicle.trail.points_map_m();
  MapLine trail{"trail", {trail_map_m.begin(), trail_map_m.end()}, LineStyle::kTrail};
  trail.points_map_m.push_back(T_map_body.position_m());
  picture.lines.push_back(std::move(trail));
  if (!vehicle.plan_map_m.empty()) {
    MapLine plan{"plan", {T_map_body.position_m()}, LineStyle::kPlan};
    plan.points_map_m.insert(plan.points_map_m.end(), vehicle.plan_map_m.begin(), vehicle.plan_map_m.end());
    picture.lines.push_back(std::move(plan));
  }

  picture.marks.push_back({"home", vehicle.home_map, MarkStyle::kHome});
  picture.in_view_map_m = {vehicle.home_map.position_m(), T_map_body.position_m()};
  if (const auto& goal_map_m = world.mission->goal_map_m) {
    picture.marks.push_back({"goal", {goal_map_m->x(), goal_map_m->y(), 0.0}, MarkStyle::kGoal});
    picture.in_view_map_m.push_back(*goal_map_m);
  }
  for (const common::Target& target : world.targets->targets) {
    const bool found = target.state == common::TargetState::kFound;
    picture.marks.push_back({labelOf(target),
                             {target.position_map_m.x(), target.position_map_m.y(), 0.0},
                             found ? MarkStyle::kTarget : MarkStyle::kCandidate});
  }
  if (world.objects) addObjects(*world.objects, picture.marks);
  picture.marks.push_back({"vehicle", T_map_body, MarkStyle::kVehicle, hull_diameter_m});
  return picture;
}

}  // namespace swiftlet::rendering
