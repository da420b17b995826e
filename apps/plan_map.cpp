#include "apps/plan_map.hpp"

#include <fmt/core.h>

#include "apps/cloud_unit.hpp"
#include "apps/map_kind.hpp"
#include "common/error.hpp"
#include "interfaces/clouds/point_cloud.hpp"
#include "interfaces/files/map_server.hpp"
#include "interfaces/files/movingai.hpp"
#include "interfaces/files/octomap.hpp"
#include "mapping3d/voxels/free_space.hpp"

namespace swiftlet::apps {
namespace {

using common::InputError;
using common::Message;

/// Four bytes each: voxels, distances along z, squared distances.
constexpr double kMostPlanVoxels = 5e8;
/// Log odds of a voxel that is free or occupied; their amount does not matter here.
constexpr std::int8_t kFreeVoxel = -40;

void requirePlanSize(const PlanMapOptions& options, const mapping3d::SpaceExtent& extent) {
  if (extent.voxels() <= kMostPlanVoxels) return;
  throw InputError({options.from}, "",
                   Message("plan.too-many-voxels", "it reaches over {:.1e} voxels, more than {:.0e}", extent.voxels(),
                           kMostPlanVoxels),
                   "remove what is far away, or give a cloud a greater --resolution");
}

PlanMap readPlanCloud(const PlanMapOptions& options) {
  interfaces::CloudPlacement placement;
  placement.scale = options.scale.value_or(1.0);
  const interfaces::StoredCloud cloud = interfaces::readCloud(options.from, placement);
  if (cloud.points.empty()) throw InputError({options.from}, "", Message("world.no-points", "it has no points"));
  constexpr double kFarthest_m = 1.0;
  const double voxel_m =
      options.resolution_m.value_or(mapping3d::voxelSideOf_m(mapping3d::spacingOf_m(cloud.points, kFarthest_m)));
  PlanMap map;
  map.notes = mapNotes(options.from, cloud, options.scale.has_value());
  map.notes.push_back(fmt::format("{} points in voxels of {:g} m{}; where no point is, it is taken as free",
                                  cloud.points.size(), voxel_m, options.resolution_m ? "" : " (--resolution)"));
  const mapping3d::SpaceExtent extent = mapping3d::extentOf(cloud.points, voxel_m, 0);
  requirePlanSize(options, extent);
  map.space.emplace(voxel_m);
  for (int z = extent.begin.z; z < extent.end.z; ++z)
    for (int y = extent.begin.y; y < extent.end.y; ++y)
      for (int x = extent.begin.x; x < extent.end.x; ++x) map.space->set({x, y, z}, kFreeVoxel);
  for (const common::SurfacePoint& point : cloud.points)
    map.space->set(map.space->voxelAt(point.position_m.cast<double>()), -kFreeVoxel);
  return map;
}

PlanMap readPlanTree(const PlanMapOptions& options) {
  interfaces::StoredOctree octree = interfaces::readOctree(options.from);
  PlanMap map;
  map.notes = std::move(octree.notes);
  requirePlanSize(options, mapping3d::extentOf(octree.map));
  map.space = std::move(octree.map);
  return map;
}

}  // namespace

PlanMap readPlanMap(const PlanMapOptions& options) {
  PlanMap map;
  switch (mapKindOf(options.from)) {
    case MapKind::kOctree:
      return readPlanTree(options);
    case MapKind::kCloud:
      return readPlanCloud(options);
    case MapKind::kGrid:
      map.plane = interfaces::readOctileMap(options.from, options.resolution_m.value_or(1.0)).grid;
      if (!options.resolution_m) map.notes.push_back("cells of 1 m (--resolution)");
      return map;
    case MapKind::kFloorPlan:
      break;
  }
  interfaces::StoredMap stored = interfaces::readMap(options.from);
  map.plane = std::move(stored.grid);
  map.T_file_map = stored.T_map_grid;
  for (const common::Problem& note : stored.notes) map.notes.push_back(toString(note));
  return map;
}

}  // namespace swiftlet::apps
