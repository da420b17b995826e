#include "planning/sampling/reachable_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace swiftlet::planning {
namespace {

using common::VoxelIndex;
using Eigen::Vector3d;

constexpr std::uint8_t kNotReached = 0xFF;
constexpr std::uint8_t kFirst = 6;
constexpr std::array<std::array<int, 3>, 6> kSteps{
    {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

}  // namespace

ReachableSpace::ReachableSpace(const Clearance& clearance, const Vector3d& from_map_m, double radius_m,
                               const std::optional<Vector3d>& until_map_m)
    : clearance_(clearance) {
  const Vector3d cells =
      ((clearance.max_map_m() - clearance.min_map_m()) / clearance.resolution_m()).array().round().max(0.0);
  size_ = {static_cast<int>(cells.x()), static_cast<int>(cells.y()),
           clearance.isPlane() ? 1 : static_cast<int>(cells.z())};
  step_.assign(
      static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(size_.z),
      kNotReached);
  const auto first = indexOf(cellOf(from_map_m));
  if (!first || clearance.at_m(from_map_m) < radius_m) return;
  spread(*first, radius_m, until_map_m ? indexOf(cellOf(*until_map_m)) : std::nullopt);
}

void ReachableSpace::spread(std::size_t first, double radius_m, std::optional<std::size_t> until) {
  step_[first] = kFirst;
  reached_.push_back(first);
  const int width = size_.x, depth = size_.y;
  for (std::size_t next = 0; next < reached_.size() && reached_.back() != until; ++next) {
    const auto at = static_cast<std::ptrdiff_t>(reached_[next]);
    const VoxelIndex cell{static_cast<int>(at % width), static_cast<int>(at / width % depth),
                          static_cast<int>(at / width / depth)};
    for (std::uint8_t step = 0; step < kSteps.size(); ++step) {
      const auto& [dx, dy, dz] = kSteps[step];
      const auto index = indexOf({cell.x + dx, cell.y + dy, cell.z + dz});
      if (!index || step_[*index] != kNotReached || clearance_.at_m(centerOf(*index)) < radius_m) continue;
      step_[*index] = step;
      reached_.push_back(*index);
      if (*index == until) break;
    }
  }
}

bool ReachableSpace::reaches(const Vector3d& place_map_m) const {
  const auto index = indexOf(cellOf(place_map_m));
  return index && step_[*index] != kNotReached;
}

std::vector<Vector3d> ReachableSpace::pathTo(const Vector3d& place_map_m) const {
  std::vector<Vector3d> path;
  VoxelIndex cell = cellOf(place_map_m);
  for (auto index = indexOf(cell); index && step_[*index] != kNotReached; index = indexOf(cell)) {
    path.push_back(centerOf(*index));
    if (step_[*index] == kFirst) break;
    const auto& [dx, dy, dz] = kSteps[step_[*index]];
    cell = {cell.x - dx, cell.y - dy, cell.z - dz};
  }
  std::reverse(path.begin(), path.end());
  return path;
}

std::optional<Vector3d> ReachableSpace::nearestTo(const Vector3d& place_map_m) const {
  std::optional<Vector3d> nearest;
  double least_m2 = std::numeric_limits<double>::infinity();
  for (const std::size_t index : reached_) {
    Vector3d center_m = centerOf(index);
    if (clearance_.isPlane()) center_m.z() = place_map_m.z();
    const double squared_m2 = (center_m - place_map_m).squaredNorm();
    if (squared_m2 >= least_m2) continue;
    least_m2 = squared_m2;
    nearest = center_m;
  }
  return nearest;
}

VoxelIndex ReachableSpace::cellOf(const Vector3d& place_map_m) const {
  const Vector3d cell =
      ((place_map_m - clearance_.min_map_m()) / clearance_.resolution_m()).array().floor().max(-1.0).min(1e8);
  return {static_cast<int>(cell.x()), static_cast<int>(cell.y()),
          clearance_.isPlane() ? 0 : static_cast<int>(cell.z())};
}

Vector3d ReachableSpace::centerOf(std::size_t index) const {
  const auto at = static_cast<std::ptrdiff_t>(index);
  const Vector3d cell(static_cast<double>(at % size_.x), static_cast<double>(at / size_.x % size_.y),
                      static_cast<double>(at / size_.x / size_.y));
  return clearance_.min_map_m() + (cell + Vector3d::Constant(0.5)) * clearance_.resolution_m();
}

std::optional<std::size_t> ReachableSpace::indexOf(VoxelIndex cell) const {
  if (cell.x < 0 || cell.y < 0 || cell.z < 0 || cell.x >= size_.x || cell.y >= size_.y || cell.z >= size_.z)
    return std::nullopt;
  return (static_cast<std::size_t>(cell.z) * static_cast<std::size_t>(size_.y) + static_cast<std::size_t>(cell.y)) *
             static_cast<std::size_t>(size_.x) +
         static_cast<std::size_t>(cell.x);
}

std::optional<Vector3d> nearestFreePlace(const Clearance& clearance, const Vector3d& place_map_m, double radius_m,
                                         double within_m) {
  const double cell_m = clearance.resolution_m();
  const int reach = static_cast<int>(std::floor(within_m / cell_m));
  std::optional<Vector3d> nearest;
  double least_m = within_m;
  const int up = clearance.isPlane() ? 0 : reach;
  for (int z = -up; z <= up; ++z)
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const Vector3d place_m = place_map_m + Vector3d(x, y, z) * cell_m;
        const double distance_m = (place_m - place_map_m).norm();
        if (distance_m >= least_m || clearance.at_m(place_m) < radius_m) continue;
        least_m = distance_m;
        nearest = place_m;
      }
  return nearest;
}

}  // namespace swiftlet::planning
