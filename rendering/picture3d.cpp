#include "rendering/picture3d.hpp"

#include "common/world.hpp"
#include "common/world/map3d_layer.hpp"
#include "common/world/objects_layer.hpp"
#include "common/world/targets_layer.hpp"
#include "common/world/vehicle_layer.hpp"

namespace swiftlet::rendering {
namespace {

Line3d atHeight(std::span<const Eigen::Vector2d> points_map_m, double z_m, Line3dStyle style) {
  Line3d line;
  line.style = style;
  line.points_map_m.reserve(points_map_m.size() + 1);
  for (const Eigen::Vector2d& point : points_map_m) line.points_map_m.emplace_back(point.x(), point.y(), z_m);
  return line;
}

void addMap(const common::Map3dLayer& map3d, Picture3d& picture) {
  for (const common::Submap3d& submap : *map3d.submaps)
    picture.surfaces.push_back({submap.points, submap.T_map_submap(*map3d.keys), submap.cube_m, submap.coarse});
  if (map3d.frame) picture.camera = PlacedCamera{map3d.T_map_camera, map3d.frame->camera};
}

/// Coloured targets that are found, and patterns that are confirmed; openings are not marked.
std::vector<Eigen::Vector3d> targetsIn(const common::World& world) {
  std::vector<Eigen::Vector3d> places_map_m;
  for (const common::Target& target : world.targets->targets)
    if (target.state == common::TargetState::kFound) places_map_m.push_back(target.position_map_m);
  if (!world.objects) return places_map_m;
  for (const common::RecognizedObject& object : world.objects->objects)
    if (object.confirmed && object.passage == common::Passage::kNone && object.what != "mirror")
      places_map_m.push_back(object.T_map_object.position_m);
  return places_map_m;
}

}  // namespace

Picture3d picture3dOf(const common::World& world, double hull_diameter_m) {
  const common::VehicleLayer& vehicle = *world.vehicle;
  const common::Pose3 T_map_body = vehicle.state.T_map_body();
  Picture3d picture;
  picture.shown = shownFrame(world);
  if (world.map3d) addMap(*world.map3d, picture);
  picture.vehicle = PlacedVehicle{T_map_body, hull_diameter_m};
  picture.targets_map_m = targetsIn(world);

  Line3d trail = atHeight(vehicle.trail.points_map_m(), 0.0, Line3dStyle::kTrail);
  trail.points_map_m.emplace_back(T_map_body.position_m.x(), T_map_body.position_m.y(), 0.0);
  picture.lines.push_back(std::move(trail));
  if (!vehicle.plan_map_m.empty()) {
    Line3d plan = atHeight(vehicle.plan_map_m, T_map_body.position_m.z(), Line3dStyle::kPlan);
    plan.points_map_m.insert(plan.points_map_m.begin(), T_map_body.position_m);
    picture.lines.push_back(std::move(plan));
  }
  return picture;
}

}  // namespace swiftlet::rendering
