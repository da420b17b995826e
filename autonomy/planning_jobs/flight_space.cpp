#include "autonomy/planning_jobs/flight_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace swiftlet::autonomy {
namespace {

using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Room around vehicle and goal for a way around: a depth camera sees little farther.
constexpr double kSpaceAround_m = 4.0;
/// The box moves in steps of this many voxels, so that it stays the same for a while.
constexpr int kBoxStep_voxels = 32;
/// About 40 x 25 x 2.5 m in voxels of 5 cm, and 40 MB.
constexpr double kMostBoxVoxels = 20e6;
/// From the origin of a submap to the farthest voxel in it.
constexpr double kSubmapDrawn_m = 7.5;
/// What submaps say of a voxel is limited to the log odds that a free voxel has, so that the newest prevails.
constexpr int kMostEvidence = static_cast<int>(2.0 / VoxelMap::kLogOddsStep);
/// A voxel is occupied with the evidence of two frames, in log odds: a single one may have met a mixed pixel.
constexpr int kLeastOccupied = static_cast<int>(1.5 / VoxelMap::kLogOddsStep);
/// The floor's voxels, and one more for their noise.
constexpr double kFloorVoxels_m = 0.10;
/// No hull flies below, where the floor is near and legs of chairs are thin: a path in space is at least 0.5 m high.
constexpr double kLeastBottom_m = 0.20;
/// Above a surface the flight controller lifts a path to 0.40 m (control.clearance.least_m). With this air below the
/// hull it lifts by less than a voxel and a half, for which there is room above.
constexpr double kAirBelowHull_m = 0.20, kAirAboveHull_m = 0.10;
/// Of a hull that flies at one height: as far as it rises and sinks.
constexpr double kHullSways_m = 0.10;
/// Of the grid at the height at which the vehicle is: farther than the reactive layer looks.
constexpr double kGridReach_m = 3.0;
/// Where the camera saw free space, it is as certain as by some beams of the laser.
constexpr common::occupancy::Cell kSurelyFreeCell = -20;
constexpr double kFlownEach_m = 0.1, kFlownJump_m = 1.0;

int floorTo(int value, int step) { return value >= 0 ? value / step * step : -((-value + step - 1) / step) * step; }

}  // namespace

double FlightSpace::middle_m() const { return 0.5 * (kAirAboveHull_m - kAirBelowHull_m); }

VoxelIndex FlightSpace::voxelAt(const Vector3d& place_map_m) const {
  const Vector3d voxel = (place_map_m / voxel_m_).array().floor();
  return {static_cast<int>(voxel.x()), static_cast<int>(voxel.y()), static_cast<int>(voxel.z())};
}

FlightSpace::Box FlightSpace::boxAround(const Vector2d& a_map_m, const Vector2d& b_map_m, double highest_m) const {
  const Vector2d low_m = a_map_m.cwiseMin(b_map_m).array() - kSpaceAround_m,
                 high_m = a_map_m.cwiseMax(b_map_m).array() + kSpaceAround_m;
  const auto number = [&](double at_m) { return static_cast<int>(std::floor(at_m / voxel_m_)); };
  const VoxelIndex begin{floorTo(number(low_m.x()), kBoxStep_voxels), floorTo(number(low_m.y()), kBoxStep_voxels), 0};
  const int top = number(highest_m + 0.5 * hull_height_m_ + kAirAboveHull_m) + 2;
  const VoxelIndex end{floorTo(number(high_m.x()), kBoxStep_voxels) + kBoxStep_voxels,
                       floorTo(number(high_m.y()), kBoxStep_voxels) + kBoxStep_voxels,
                       floorTo(top, VoxelBlock::kSide) + VoxelBlock::kSide};
  return {begin, {end.x - begin.x, end.y - begin.y, end.z - begin.z}};
}

bool FlightSpace::update(const PlanningRequest& request, const Vector2d& goal_map_m, const FlightHeights& heights,
                         const planning::CellStates& grid) {
  const std::vector<PlacedSubmap> submaps = placedSubmaps(*request.map3d);
  const Vector2d here_map_m = request.T_map_body.position_m();
  if (submaps.empty() || !goal_map_m.allFinite()) return false;
  constexpr double kFarthest_m = 1000.0;  // Before distances are counted in voxels.
  if ((goal_map_m - here_map_m).norm() > kFarthest_m) return false;
  voxel_m_ = submaps.front().voxels->resolution_m();
  const Box box = boxAround(here_map_m, goal_map_m, heights.highest_m);
  if (static_cast<double>(box.size.x) * box.size.y * box.size.z > kMostBoxVoxels) return false;
  if (!clearance_ || clearance_->resolution_m() != voxel_m_)
    clearance_ = planning::Clearance::ofSpace(voxel_m_, hull_height_m_ + kAirBelowHull_m + kAirAboveHull_m);
  if (box != box_ || !voxels_) {
    box_ = box;
    submaps_.clear();
    voxels_.emplace(voxel_m_);
  }
  addEvidence(submaps);
  const Vector3d place_map_m(here_map_m.x(), here_map_m.y(), heights.reference_m);
  if (flown_map_m_.empty() || (place_map_m - flown_map_m_.back()).norm() > kFlownEach_m)
    flown_map_m_.push_back(place_map_m);
  setStates(heights, grid);
  addFlown(request.footprint);
  closeSlivers();
  addLayers(request);
  writeBlocks();
  clearance_->update(voxels_->snapshot());
  return true;
}

void FlightSpace::addEvidence(const std::vector<PlacedSubmap>& submaps) {
  const Vector2d low_m = Vector2d(box_.begin.x, box_.begin.y) * voxel_m_,
                 high_m = low_m + Vector2d(box_.size.x, box_.size.y) * voxel_m_;
  std::vector<PlacedSubmap> near;
  for (const PlacedSubmap& submap : submaps) {
    const Vector2d origin_m = submap.T_submap_map.inverse().position_m();
    if ((origin_m - origin_m.cwiseMax(low_m).cwiseMin(high_m)).norm() < kSubmapDrawn_m) near.push_back(submap);
  }
  const auto same = [](const PlacedSubmap& a, const PlacedSubmap& b) { return a.isSame(b); };
  if (!evidence_.empty() && !near.empty() &&
      std::equal(near.begin(), near.end(), submaps_.begin(), submaps_.end(), same))
    return;
  submaps_ = std::move(near);
  evidence_.assign(static_cast<std::size_t>(box_.size.x) * static_cast<std::size_t>(box_.size.y) *
                       static_cast<std::size_t>(box_.size.z),
                   VoxelBlock::kUnknown);
  for (const PlacedSubmap& submap : submaps_) addEvidence(submap);
}

/// Column by column: submaps are level, so a column of the map is one of theirs.
void FlightSpace::addEvidence(const PlacedSubmap& submap) {
  const int layers = box_.size.z / VoxelBlock::kSide;
  const std::size_t layer_voxels = static_cast<std::size_t>(box_.size.x) * static_cast<std::size_t>(box_.size.y);
  std::vector<const VoxelBlock*> blocks(static_cast<std::size_t>(layers), nullptr);
  std::optional<VoxelIndex> of;
  for (int y = 0; y < box_.size.y; ++y)
    for (int x = 0; x < box_.size.x; ++x) {
      const Vector2d place_m =
          submap.T_submap_map * Vector2d((box_.begin.x + x + 0.5) * voxel_m_, (box_.begin.y + y + 0.5) * voxel_m_);
      const VoxelIndex voxel = submap.voxels->voxelAt({place_m.x(), place_m.y(), 0.0});
      const VoxelIndex block = VoxelMap::blockOf(voxel);
      if (of != block) {
        of = block;
        for (int layer = 0; layer < layers; ++layer)
          blocks[static_cast<std::size_t>(layer)] =
              submap.voxels->block({block.x, block.y, box_.begin.z / VoxelBlock::kSide + layer});
      }
      const int offset = VoxelBlock::offsetOf({voxel.x, voxel.y, 0});
      std::size_t at =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(box_.size.x) + static_cast<std::size_t>(x);
      for (const VoxelBlock* in : blocks)
        for (int z = 0; z < VoxelBlock::kSide; ++z, at += layer_voxels) {
          if (in == nullptr) continue;
          const std::int8_t seen =
              in->evidence[static_cast<std::size_t>(offset + z * VoxelBlock::kSide * VoxelBlock::kSide)];
          if (seen == VoxelBlock::kUnknown) continue;
          const int before = evidence_[at] == VoxelBlock::kUnknown ? 0 : evidence_[at];
          evidence_[at] = static_cast<std::int8_t>(std::clamp(before + seen, -kMostEvidence, kMostEvidence));
        }
    }
}

/// Where the camera has seen nothing, the grid says what is at the height of flight.
void FlightSpace::setStates(const FlightHeights& heights, const planning::CellStates& grid) {
  states_.assign(evidence_.size(), kUnknown);
  // As tall as the hull with its air, and a voxel for its place within one.
  const double half_m = 0.5 * (hull_height_m_ + kAirBelowHull_m + kAirAboveHull_m) + voxel_m_;
  const int low = voxelAt({0.0, 0.0, heights.cruise_m + middle_m() - half_m}).z,
            high = voxelAt({0.0, 0.0, heights.cruise_m + middle_m() + half_m}).z,
            floor = static_cast<int>(std::lround(kLeastBottom_m / voxel_m_));
  std::size_t at = 0;
  for (int z = box_.begin.z; z < box_.begin.z + box_.size.z; ++z)
    for (int y = box_.begin.y; y < box_.begin.y + box_.size.y; ++y)
      for (int x = box_.begin.x; x < box_.begin.x + box_.size.x; ++x, ++at) {
        State& state = states_[at];
        const int seen = evidence_[at];
        if (z < floor) {
          state = kOccupied;
        } else if (seen != VoxelBlock::kUnknown) {
          if (seen <= 0) state = kFree;
          if (seen >= kLeastOccupied) state = kOccupied;
        } else if (z >= low && z <= high) {
          const auto cell = grid.at(grid.grid().cellAt(Vector2d((x + 0.5) * voxel_m_, (y + 0.5) * voxel_m_)));
          if (cell == planning::CellState::kFree) state = kFree;
          if (cell == planning::CellState::kOccupied) state = kOccupied;
        }
      }
}

/// The hull has been there, and its own place is not in the view of its camera.
void FlightSpace::addFlown(const planning::Footprint& footprint) {
  const double radius_m = footprint.hull_radius_m + 0.5 * footprint.clearance_m + voxel_m_;
  const double half_m = 0.5 * (hull_height_m_ + kAirBelowHull_m + kAirAboveHull_m) + voxel_m_;
  const auto clear = [&](const Vector3d& place_map_m) {
    const Vector3d middle_map_m = place_map_m + middle_m() * Vector3d::UnitZ();
    const VoxelIndex low = voxelAt(middle_map_m - Vector3d(radius_m, radius_m, half_m)),
                     high = voxelAt(middle_map_m + Vector3d(radius_m, radius_m, half_m));
    const VoxelIndex end{box_.begin.x + box_.size.x, box_.begin.y + box_.size.y, box_.begin.z + box_.size.z};
    for (int z = std::max(low.z, box_.begin.z); z < std::min(high.z + 1, end.z); ++z)
      for (int y = std::max(low.y, box_.begin.y); y < std::min(high.y + 1, end.y); ++y)
        for (int x = std::max(low.x, box_.begin.x); x < std::min(high.x + 1, end.x); ++x) {
          const Vector2d center_m((x + 0.5) * voxel_m_, (y + 0.5) * voxel_m_);
          if ((center_m - middle_map_m.head<2>()).norm() > radius_m) continue;
          if (State& state = states_[indexOf({x, y, z})]; state == kUnknown) state = kFree;
        }
  };
  for (std::size_t i = 0; i < flown_map_m_.size(); ++i) {
    clear(flown_map_m_[i]);
    if (i == 0) continue;
    const Vector3d step_m = flown_map_m_[i] - flown_map_m_[i - 1];
    const int steps = static_cast<int>(step_m.norm() / kFlownEach_m);
    if (step_m.norm() > kFlownJump_m) continue;  // A correction of the map and not a flight.
    for (int k = 1; k < steps; ++k) clear(flown_map_m_[i - 1] + step_m * k / steps);
  }
}

/// Beams spread and leave single voxels unseen: those count as free where four of the six neighbours are.
void FlightSpace::closeSlivers() {
  const std::ptrdiff_t row = box_.size.x, layer = row * box_.size.y;
  const std::array<std::ptrdiff_t, 6> steps{1, -1, row, -row, layer, -layer};
  std::vector<std::size_t> slivers;
  for (int z = 1; z + 1 < box_.size.z; ++z)
    for (int y = 1; y + 1 < box_.size.y; ++y)
      for (int x = 1; x + 1 < box_.size.x; ++x) {
        const std::ptrdiff_t at = z * layer + y * row + x;
        if (states_[static_cast<std::size_t>(at)] != kUnknown) continue;
        const auto free = std::count_if(steps.begin(), steps.end(), [&](std::ptrdiff_t step) {
          return states_[static_cast<std::size_t>(at + step)] == kFree;
        });
        if (free >= 4) slivers.push_back(static_cast<std::size_t>(at));
      }
  for (const std::size_t at : slivers) states_[at] = kFree;
}

void FlightSpace::addLayers(const PlanningRequest& request) {
  const auto occupy = [&](const Vector2d& low_m, const Vector2d& high_m, const auto& covers) {
    if (!low_m.allFinite() || !high_m.allFinite()) return;
    const VoxelIndex end{box_.begin.x + box_.size.x, box_.begin.y + box_.size.y, box_.begin.z + box_.size.z};
    const VoxelIndex low = voxelAt({low_m.x(), low_m.y(), 0.0}), high = voxelAt({high_m.x(), high_m.y(), 0.0});
    for (int y = std::max(low.y, box_.begin.y); y < std::min(high.y + 1, end.y); ++y)
      for (int x = std::max(low.x, box_.begin.x); x < std::min(high.x + 1, end.x); ++x) {
        if (!covers(Vector2d((x + 0.5) * voxel_m_, (y + 0.5) * voxel_m_))) continue;
        for (int z = box_.begin.z; z < end.z; ++z) states_[indexOf({x, y, z})] = kOccupied;
      }
  };
  for (const common::Disc& disc : request.discs) {
    const Vector2d reach_m = Vector2d::Constant(disc.radius_m);
    occupy(disc.center_map_m - reach_m, disc.center_map_m + reach_m,
           [&](const Vector2d& place_m) { return disc.covers(place_m); });
  }
  if (!request.keep_out) return;
  for (const common::Polygon& zone : *request.keep_out)
    occupy(zone.min_map_m(), zone.max_map_m(), [&](const Vector2d& place_m) { return zone.contains(place_m); });
}

/// Blocks that stay as they are keep their identity, by which the clearance knows what to compute again.
void FlightSpace::writeBlocks() {
  constexpr std::array<std::int8_t, 3> kEvidence{VoxelBlock::kUnknown, -kMostEvidence, kMostEvidence};
  constexpr int kSide = VoxelBlock::kSide;
  for (int z = 0; z < box_.size.z; z += kSide)
    for (int y = 0; y < box_.size.y; y += kSide)
      for (int x = 0; x < box_.size.x; x += kSide) {
        const VoxelIndex first{box_.begin.x + x, box_.begin.y + y, box_.begin.z + z};
        VoxelBlock block;
        for (int dz = 0; dz < kSide; ++dz)
          for (int dy = 0; dy < kSide; ++dy) {
            const std::size_t from = indexOf({first.x, first.y + dy, first.z + dz});
            for (int dx = 0; dx < kSide; ++dx)
              block.evidence[static_cast<std::size_t>((dz * kSide + dy) * kSide + dx)] =
                  kEvidence[states_[from + static_cast<std::size_t>(dx)]];
          }
        const VoxelIndex index = VoxelMap::blockOf(first);
        const VoxelBlock* before = voxels_->block(index);
        if (before == nullptr || before->evidence != block.evidence) voxels_->mutableBlock(index) = block;
      }
}

planning::HullSpace FlightSpace::hull(const planning::Footprint& footprint) const {
  return {*clearance_, middle_m(), footprint.hull_radius_m + 0.5 * footprint.clearance_m};
}

FlightSpace::State FlightSpace::stateAt(const VoxelIndex& voxel) const {
  return box_.contains(voxel) ? states_[indexOf(voxel)] : kUnknown;
}

common::OccupancyGrid FlightSpace::gridAt(double height_m, const Vector2d& around_map_m, double resolution_m) const {
  common::OccupancyGrid grid = common::makeOccupancyGrid(resolution_m);
  const double half_m = 0.5 * hull_height_m_ + kHullSways_m;
  const int low = voxelAt({0.0, 0.0, std::max(height_m - half_m, kFloorVoxels_m)}).z,
            high = voxelAt({0.0, 0.0, height_m + half_m}).z;
  const common::CellIndex center = grid.cellAt(around_map_m);
  const int reach = static_cast<int>(kGridReach_m / resolution_m);
  for (int y = center.y - reach; y <= center.y + reach; ++y)
    for (int x = center.x - reach; x <= center.x + reach; ++x) {
      const Vector2d place_m = grid.centerOf({x, y});
      VoxelIndex voxel = voxelAt({place_m.x(), place_m.y(), 0.0});
      bool free = true, occupied = false;
      for (voxel.z = low; voxel.z <= high; ++voxel.z) {
        const State state = stateAt(voxel);
        free = free && state == kFree;
        occupied = occupied || state == kOccupied;
      }
      if (free || occupied) grid.set({x, y}, occupied ? common::occupancy::kMaxSteps : kSurelyFreeCell);
    }
  return grid;
}

}  // namespace swiftlet::autonomy
