#include "evaluation/explored_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "common/rgbd_frame.hpp"
#include "common/voxel_map.hpp"
#include "common/world/map3d_layer.hpp"
#include "simulation/truth_map.hpp"

namespace swiftlet::evaluation {
namespace {

using common::CellIndex;
using common::VoxelIndex;
using common::VoxelMap;
using ExploredCells = common::TiledGrid<std::uint8_t>;

/// Places that a certificate names.
constexpr std::size_t kMostNamed = 5;
/// Side of the cubes of a volume that is judged, in metres: what is smaller does not hide anything to fly to.
constexpr double kJudgedVoxel_m = 0.2;
constexpr std::int8_t kCouldBeSeen = -1, kLeft = 1;

/// nullopt if the flood of the true world does not tell what was to be explored.
std::optional<simulation::FreeSpace> explorableSpace(const BehaviorRecord::Explored& explored, const TrueWorld& world,
                                                     const common::Pose3& T_world_map) {
  if (!explored.keep_out->empty()) return std::nullopt;
  const double half_height_m = 0.5 * world.vehicle.hull_height_m, cell_m = explored.map->resolution_m();
  simulation::FreeSpaceQuery query;
  query.start_world_m = T_world_map.position_m.head<2>();
  // Where the hull fits by less than a cell, a map of cells cannot tell that it does.
  query.hull_radius_m = world.vehicle.hullRadius_m() + explored.asked.clearance_m + cell_m;
  query.bottom_m = explored.height_world_m - half_height_m;
  query.top_m = explored.height_world_m + half_height_m;
  query.resolution_m = cell_m;
  query.max_area_m2 = world.reachable_area_max_m2;
  query.closed_doors = explored.closed_doors;
  simulation::FreeSpace space = simulation::freeSpace(*world.rays, query);
  if (space.isOpen(query) || !(space.covered_area_m2 > 0.0)) return std::nullopt;
  return space;
}

bool isAskedFor(const BehaviorRecord::Explored& explored, const Eigen::Vector2d& place_map_m) {
  return !explored.asked.bounds || explored.asked.bounds->contains(place_map_m);
}

void sortByAmount(std::vector<UnseenPlace>& places) {
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.amount > b.amount; });
}

/// Takes the connected cells out of `unseen`.
std::vector<UnseenPlace> placesOf(ExploredCells& unseen, const common::Pose2& T_map_world, double height_m) {
  std::vector<CellIndex> cells;
  unseen.forEachCell([&](CellIndex cell, std::uint8_t value) {
    if (value != 0) cells.push_back(cell);
  });
  std::vector<UnseenPlace> places;
  const double cell_m2 = unseen.resolution_m() * unseen.resolution_m();
  for (const CellIndex seed : cells) {
    if (unseen.at(seed) == 0) continue;
    std::vector<CellIndex> open{seed};
    unseen.set(seed, 0);
    UnseenPlace place;
    std::size_t count = 0;
    while (!open.empty()) {
      const CellIndex at = open.back();
      open.pop_back();
      ++count;
      place.center_map_m += T_map_world * unseen.centerOf(at);
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          if (const CellIndex next{at.x + dx, at.y + dy}; unseen.at(next) != 0) {
            unseen.set(next, 0);
            open.push_back(next);
          }
    }
    if (count < 2) continue;
    place.center_map_m /= static_cast<double>(count);
    place.height_m = height_m;
    place.amount = static_cast<double>(count) * cell_m2;
    places.push_back(place);
  }
  sortByAmount(places);
  return places;
}

/// The same in space, of the voxels that are kLeft.
std::vector<UnseenPlace> placesOf(VoxelMap& voxels) {
  std::vector<UnseenPlace> places;
  const double voxel_m3 = std::pow(voxels.resolution_m(), 3);
  for (const VoxelIndex block : voxels.blocks())
    for (int offset = 0; offset < common::VoxelBlock::kVoxels; ++offset) {
      const VoxelIndex seed = VoxelMap::voxelOf(block, offset);
      if (voxels.evidence(seed) != kLeft) continue;
      std::vector<VoxelIndex> open{seed};
      voxels.set(seed, kCouldBeSeen);
      Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
      std::size_t count = 0;
      while (!open.empty()) {
        const VoxelIndex at = open.back();
        open.pop_back();
        ++count;
        sum_m += voxels.centerOf(at);
        for (const VoxelIndex next :
             {VoxelIndex{at.x + 1, at.y, at.z}, VoxelIndex{at.x - 1, at.y, at.z}, VoxelIndex{at.x, at.y + 1, at.z},
              VoxelIndex{at.x, at.y - 1, at.z}, VoxelIndex{at.x, at.y, at.z + 1}, VoxelIndex{at.x, at.y, at.z - 1}}) {
          if (voxels.evidence(next) != kLeft) continue;
          voxels.set(next, kCouldBeSeen);
          open.push_back(next);
        }
      }
      if (count < 2) continue;
      const Eigen::Vector3d center_m = sum_m / static_cast<double>(count);
      places.push_back({center_m.head<2>(), center_m.z(), static_cast<double>(count) * voxel_m3});
    }
  sortByAmount(places);
  return places;
}

/// Marks the voxels that a camera could see from there, turned in any direction.
void lookAllAround(const common::Pose3& T_map_body_level, const TrueWorld& world, const common::Pose3& T_world_map,
                   VoxelMap& voxels) {
  constexpr int kTurns = 90, kRows = 16;  // A ray every 4 degrees, 0.35 m at 5 m; and every 3 of a usual picture.
  const common::PinholeCamera pinhole = world.rgbd_camera->camera();
  const common::Pose3 T_world_body = T_world_map * T_map_body_level, T_map_world = T_world_map.inverse();
  for (int turn = 0; turn < kTurns; ++turn) {
    const Eigen::Quaterniond yaw(Eigen::AngleAxisd(2.0 * std::numbers::pi * turn / kTurns, Eigen::Vector3d::UnitZ()));
    const common::Pose3 T_world_camera =
        T_world_body * common::Pose3{yaw, Eigen::Vector3d::Zero()} * world.T_body_camera;
    for (int row = 0; row < kRows; ++row) {
      const Eigen::Vector3d along =
          pinhole.point_camera_m(0.5 * (pinhole.width_px - 1), (row + 0.5) / kRows * pinhole.height_px - 0.5, 1.0);
      const double range_m = world.rgbd_camera->range_max_m * along.norm();
      const Eigen::Vector3d direction = T_world_camera.rotation * along.normalized();
      const simulation::Hit hit = world.rays->cast(T_world_camera.position_m, direction, range_m);
      // What is in front of a surface, by a voxel of the map.
      const double free_m = (hit ? hit.distance_m : range_m) - 0.5 * voxels.resolution_m();
      for (double at_m = world.rgbd_camera->range_min_m; at_m < free_m; at_m += 0.5 * voxels.resolution_m())
        voxels.set(voxels.voxelAt(T_map_world * (T_world_camera.position_m + at_m * direction)), kCouldBeSeen);
    }
  }
}

/// Whether the map knows anything in the cube.
bool isKnownIn(const VoxelMap& map, const Eigen::Vector3d& center_m, double side_m) {
  if (map.isKnown(map.voxelAt(center_m))) return true;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner((i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2) - 0.5);
    if (map.isKnown(map.voxelAt(center_m + 0.5 * side_m * corner))) return true;
  }
  return false;
}

std::string textOf(const ExploredCheck& check, const char* what, const char* unit) {
  if (check.left.empty()) return fmt::format("all of {:.1f} {} {} was seen", check.amount, unit, what);
  std::string text =
      fmt::format("{:.1f} % of {:.1f} {} {} was not seen:", 100.0 * check.unseen_share, check.amount, unit, what);
  for (std::size_t i = 0; i < std::min(kMostNamed, check.left.size()); ++i) {
    const UnseenPlace& place = check.left[i];
    text += fmt::format("{} {:.2f} {} at ({:.2f}, {:.2f}, {:.2f})", i == 0 ? "" : ",", place.amount, unit,
                        place.center_map_m.x(), place.center_map_m.y(), place.height_m);
  }
  if (check.left.size() > kMostNamed) text += fmt::format(" and {} more places", check.left.size() - kMostNamed);
  return text;
}

ExploredCheck checkArea(const simulation::FreeSpace& space, const BehaviorRecord::Explored& explored,
                        const common::Pose3& T_world_map) {
  const common::Pose2 T_map_world = common::planar(T_world_map).inverse();
  ExploredCells unseen(space.covered.resolution_m());
  std::size_t all = 0, left = 0;
  space.covered.forEachCell([&](CellIndex cell, std::uint8_t covered) {
    if (covered == 0) return;
    const Eigen::Vector2d place_map_m = T_map_world * space.covered.centerOf(cell);
    if (!isAskedFor(explored, place_map_m)) return;
    ++all;
    if (!common::occupancy::isUnknown(explored.map->at(explored.map->cellAt(place_map_m)))) return;
    ++left;
    unseen.set(cell, 1);
  });
  ExploredCheck check;
  check.amount = static_cast<double>(all) * unseen.resolution_m() * unseen.resolution_m();
  check.unseen_share = all == 0 ? 0.0 : static_cast<double>(left) / static_cast<double>(all);
  check.left = placesOf(unseen, T_map_world, explored.height_world_m - T_world_map.position_m.z());
  return check;
}

std::optional<ExploredCheck> checkVolume(const simulation::FreeSpace& space, const BehaviorRecord::Explored& explored,
                                         const TrueWorld& world, const common::Pose3& T_world_map) {
  if (!world.rgbd_camera || !explored.map3d || !explored.map3d->fused) return std::nullopt;
  const common::Pose2 T_map_world = common::planar(T_world_map).inverse();
  const double height_m = explored.height_world_m - T_world_map.position_m.z();
  // Places half a metre from each other, or more in a large building.
  constexpr double kApart_m = 0.5, kMostPlaces = 1000.0;
  const double apart_m = std::max(kApart_m, std::sqrt(space.reachable_area_m2 / kMostPlaces));
  const int step = static_cast<int>(std::lround(apart_m / space.reachable.resolution_m()));
  VoxelMap voxels(kJudgedVoxel_m);
  space.reachable.forEachCell([&](CellIndex cell, std::uint8_t is_reachable) {
    if (is_reachable == 0 || cell.x % step != 0 || cell.y % step != 0) return;
    const Eigen::Vector2d place_map_m = T_map_world * space.reachable.centerOf(cell);
    if (!isAskedFor(explored, place_map_m)) return;
    lookAllAround({Eigen::Quaterniond::Identity(), {place_map_m.x(), place_map_m.y(), height_m}}, world, T_world_map,
                  voxels);
  });
  std::size_t all = 0, left = 0;
  for (const VoxelIndex block : voxels.blocks())
    for (int offset = 0; offset < common::VoxelBlock::kVoxels; ++offset) {
      const VoxelIndex voxel = VoxelMap::voxelOf(block, offset);
      if (!voxels.isKnown(voxel) || !isAskedFor(explored, voxels.centerOf(voxel).head<2>())) continue;
      ++all;
      if (isKnownIn(*explored.map3d->fused, voxels.centerOf(voxel), kJudgedVoxel_m)) continue;
      ++left;
      voxels.set(voxel, kLeft);
    }
  if (all == 0) return std::nullopt;
  ExploredCheck check;
  check.amount = static_cast<double>(all) * std::pow(kJudgedVoxel_m, 3);
  check.unseen_share = static_cast<double>(left) / static_cast<double>(all);
  check.left = placesOf(voxels);
  return check;
}

}  // namespace

ExploredChecks checkExplored(const BehaviorRecord::Explored& explored, const TrueWorld& world,
                             const common::Pose3& T_world_map) {
  const auto space = explorableSpace(explored, world, T_world_map);
  if (!space) return {};
  return {checkArea(*space, explored, T_world_map), checkVolume(*space, explored, world, T_world_map)};
}

std::string certificateOf(const std::optional<ExploredCheck>& area, const std::optional<ExploredCheck>& volume) {
  if (!area)
    return "explored: not judged, the true world is open, has keep-out zones, or the hull hardly fits at the start";
  std::string text = "explored: " + textOf(*area, "reachable", "m2");
  if (volume) text += "; " + textOf(*volume, "that the camera could see", "m3");
  return text;
}

}  // namespace swiftlet::evaluation
