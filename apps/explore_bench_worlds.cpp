#include "apps/explore_bench_worlds.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

#include "apps/map_kind.hpp"
#include "common/error.hpp"
#include "common/lower_case.hpp"
#include "interfaces/files/map_server.hpp"
#include "interfaces/files/movingai.hpp"
#include "interfaces/files/unpacked_stream.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/truth_map.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::apps {
namespace {

namespace fs = std::filesystem;
using common::InputError;
using common::Message;

constexpr double kUsualGridCell_m = 1.0, kWorldCell_m = 0.05;
/// Above the start, and half of a hull's height around it.
constexpr double kFlightHeight_m = 1.0, kHalfHull_m = 0.15;

bool isWorldFile(const fs::path& file) {
  const std::string ending = common::endingOf(file);
  return ending == ".sdf" || ending == ".world";
}

bool isBenchFile(const fs::path& file) {
  const std::string ending = common::endingOf(interfaces::unpackedName(file));
  if (isWorldFile(file)) return !fs::exists(fs::path(file).replace_extension(".yaml"));
  return ending == ".yaml" || ending == ".yml" || ending == ".map";
}

BenchWorld slicedWorld(const std::string& file, const BenchWorldOptions& options) {
  const simulation::WorldModel world = simulation::loadWorld(file, options.model_paths);
  const simulation::RayCaster rays(world);
  const Eigen::Vector3d start_m =
      world.T_world_start ? world.T_world_start->position_m : Eigen::Vector3d(0.0, 0.0, 0.0);
  simulation::FreeSpaceQuery query;
  query.start_world_m = start_m.head<2>();
  query.hull_radius_m = kWorldCell_m;
  query.resolution_m = kWorldCell_m;
  query.bottom_m = start_m.z() + kFlightHeight_m - kHalfHull_m;
  query.top_m = start_m.z() + kFlightHeight_m + kHalfHull_m;
  const auto reached = simulation::reachableSpace(rays, query);
  if (!(simulation::area_m2(reached) > 0.0))
    throw InputError({file}, "", Message("explore-bench.no-room", "nothing is free 1 m above its start"));
  if (simulation::area_m2(reached) >= query.max_area_m2)
    throw InputError({file}, "", Message("explore-bench.open", "is open: what can be reached has no end"),
                     "close it by walls");
  BenchWorld sliced;
  sliced.start_m = query.start_world_m;
  sliced.plan = common::makeOccupancyGrid(kWorldCell_m);
  reached.forEachCell([&](common::CellIndex cell, std::uint8_t is_reached) {
    if (is_reached != 0) sliced.plan.set(cell, -common::occupancy::kMaxSteps);
  });
  return sliced;
}

}  // namespace

std::vector<std::string> benchFiles(const std::vector<std::string>& places) {
  std::vector<std::string> files;
  for (const std::string& place : places) {
    std::error_code error;
    if (!fs::is_directory(place, error)) {
      files.push_back(place);
      continue;
    }
    std::vector<std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(place, error))
      if (entry.is_regular_file(error) && isBenchFile(entry.path())) found.push_back(entry.path().string());
    if (found.empty())
      throw InputError({place}, "", Message("explore-bench.no-maps", "has no floor plan, grid or world"));
    std::sort(found.begin(), found.end());
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

BenchWorld readBenchWorld(const std::string& file, const BenchWorldOptions& options) {
  BenchWorld world;
  if (isWorldFile(file)) {
    world = slicedWorld(file, options);
  } else {
    switch (mapKindOf(file)) {
      case MapKind::kFloorPlan:
        world.plan = interfaces::readMap(file).grid;
        break;
      case MapKind::kGrid:
        world.plan = interfaces::readOctileMap(file, options.cell_m.value_or(kUsualGridCell_m)).grid;
        break;
      case MapKind::kOctree:
      case MapKind::kCloud:
        throw InputError({file}, "",
                         Message("explore-bench.in-space", "is a map in space, explorers are compared in the plane"),
                         "make a world of it with `swiftlet world`, and give that");
    }
  }
  world.name = fs::path(file).filename().string();
  return world;
}

}  // namespace swiftlet::apps
