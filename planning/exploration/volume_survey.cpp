#include "planning/exploration/volume_survey.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/geometry.hpp"

namespace swiftlet::planning {
namespace {

using common::CellIndex;
using common::VoxelBlock;
using common::VoxelIndex;
using common::VoxelMap;

constexpr double kCube_m = 0.2;
constexpr double kCube_m3 = kCube_m * kCube_m * kCube_m;
/// Between places to look from.
constexpr double kLattice_m = 0.5;
/// Places that are evaluated in one call, from the nearest on.
constexpr std::size_t kMostPlaces = 400;
constexpr std::uint32_t kKnownCube = std::numeric_limits<std::uint32_t>::max();

VoxelIndex cubeAt(const Eigen::Vector3d& point_m) {
  const Eigen::Vector3d index = (point_m / kCube_m).array().floor();
  return {static_cast<int>(index.x()), static_cast<int>(index.y()), static_cast<int>(index.z())};
}

/// Whether the map knows anything in the cube.
bool isKnownCube(const VoxelMap& voxels, const Eigen::Vector3d& center_m) {
  if (voxels.isKnown(voxels.voxelAt(center_m))) return true;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner((i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2) - 0.5);
    if (voxels.isKnown(voxels.voxelAt(center_m + 0.5 * kCube_m * corner))) return true;
  }
  return false;
}

/// Directions around a place, every 4 degrees.
constexpr int kHeadings = 90;
double headingOf(int column) { return common::wrapAngle(2.0 * std::numbers::pi * column / kHeadings); }
int columnOf(double yaw_rad) {
  const auto column = static_cast<int>(std::lround(yaw_rad / (2.0 * std::numbers::pi) * kHeadings));
  return (column % kHeadings + kHeadings) % kHeadings;
}

std::vector<int> columnsAround(int middle, int half) {
  std::vector<int> columns;
  for (int i = middle - half; i <= middle + half; ++i) columns.push_back((i + kHeadings) % kHeadings);
  return columns;
}

}  // namespace

VolumeSurvey::VolumeSurvey(const ExplorationInput& input, const CostMap& map, const CostField& field,
                           const CameraFrustum& frustum)
    : input_(input), map_(map), field_(field), frustum_(frustum) {
  half_columns_ = static_cast<int>(std::atan(frustum.tangent_across) / (2.0 * std::numbers::pi) * kColumns);
  writeOffAttempts();
  if (input.current && input.current->gain_m3 > 0.0) current_ = lookAgain(*input.current);
}

/// What should have been seen from where it has looked, and was not, cannot be seen from there.
void VolumeSurvey::writeOffAttempts() {
  for (const ExplorationAttempt& attempt : input_.attempts) {
    if (!attempt.by_camera) continue;
    const Eigen::Vector2d ahead_m = attempt.target_map_m - attempt.place_map_m;
    const double yaw_rad = std::atan2(ahead_m.y(), ahead_m.x());
    mark(pictureAt(attempt.place_map_m, yaw_rad), yaw_rad);
  }
}

std::optional<CameraLook> VolumeSurvey::lookAgain(const Viewpoint& viewpoint) {
  const Eigen::Vector2d place_map_m = viewpoint.pose_map.position_m();
  const CellIndex place = map_.cellAt(place_map_m);
  if (!map_.rect().contains(place) || !field_.reached(map_.indexOf(place))) return std::nullopt;
  const double yaw_rad = viewpoint.pose_map.yaw_rad;
  const CameraLook look{place, field_.cost_m(map_.indexOf(place), map_.resolution_m()), yaw_rad,
                        gainOf_m3(pictureAt(place_map_m, yaw_rad), yaw_rad)};
  return look.gain_m3 < kMinGain_m3 ? std::nullopt : std::optional(look);
}

std::vector<CameraLook> VolumeSurvey::cover(std::size_t most) {
  const std::vector<Panorama> places = panoramas(most);
  std::vector<CameraLook> looks;
  if (current_) {
    looks.push_back(*current_);
    mark(pictureAt(map_.centerOf(current_->place), current_->yaw_map_rad), current_->yaw_map_rad);
  }
  while (looks.size() < most) {
    const Panorama* from = nullptr;
    CameraLook best;
    for (const Panorama& place : places)
      if (const CameraLook look = bestLook(place); look.gain_m3 > best.gain_m3) {
        best = look;
        from = &place;
      }
    if (from == nullptr || best.gain_m3 < kMinGain_m3) break;
    looks.push_back(best);
    mark(*from, best.yaw_map_rad);
  }
  return looks;
}

/// From the nearest place on, until as many have something to be seen as a tour has stops.
std::vector<VolumeSurvey::Panorama> VolumeSurvey::panoramas(std::size_t most) {
  const int step = std::max(1, static_cast<int>(std::lround(kLattice_m / map_.resolution_m())));
  std::vector<Panorama> places;
  for (int index = 0; index < static_cast<int>(map_.costs().size()); ++index) {
    const CellIndex cell = map_.cellOf(index);
    if (cell.x % step != 0 || cell.y % step != 0 || !field_.reached(index) || !hasRoomToStop(map_, cell)) continue;
    if (input_.bounds && !input_.bounds->contains(map_.centerOf(cell))) continue;
    places.push_back({cell, field_.cost_m(index, map_.resolution_m()), {}});
  }
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.path_m < b.path_m; });
  std::vector<Panorama> chosen;
  for (std::size_t i = 0; i < std::min(places.size(), kMostPlaces) && chosen.size() < 2 * most; ++i) {
    for (int column = 0; column < kColumns; ++column)
      places[i].columns[static_cast<std::size_t>(column)] = columnAt(map_.centerOf(places[i].place), column);
    if (bestLook(places[i]).gain_m3 >= kMinGain_m3) chosen.push_back(std::move(places[i]));
  }
  return chosen;
}

/// Only the directions of that picture.
VolumeSurvey::Panorama VolumeSurvey::pictureAt(const Eigen::Vector2d& place_map_m, double yaw_map_rad) {
  Panorama picture;
  for (const int column : columnsAround(columnOf(yaw_map_rad), half_columns_))
    picture.columns[static_cast<std::size_t>(column)] = columnAt(place_map_m, column);
  return picture;
}

VolumeSurvey::Column VolumeSurvey::columnAt(const Eigen::Vector2d& place_map_m, int column) {
  const double yaw_rad = headingOf(column), pitch_rad = frustum_.pitch_down_rad;
  const Eigen::Vector3d from_map_m(place_map_m.x(), place_map_m.y(), input_.volume.camera_height_m);
  Column seen;
  for (int row = 0; row < kRows; ++row) {
    const double up = frustum_.tangent_up * (2.0 * (row + 0.5) / kRows - 1.0);
    const double along = std::cos(pitch_rad) + up * std::sin(pitch_rad);
    const Eigen::Vector3d ray(along * std::cos(yaw_rad), along * std::sin(yaw_rad),
                              up * std::cos(pitch_rad) - std::sin(pitch_rad));
    castRay(from_map_m, ray.normalized(), ray.norm() * frustum_.range_max_m, seen);
  }
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  return seen;
}

void VolumeSurvey::castRay(const Eigen::Vector3d& from_map_m, const Eigen::Vector3d& direction, double range_m,
                           Column& seen) {
  const VoxelMap& voxels = *input_.volume.voxels;
  const double step_m = std::min(0.5 * kCube_m, voxels.resolution_m());
  const double nearest_m = range_m * (frustum_.range_min_m / frustum_.range_max_m);
  // What neighbouring steps share is looked up once.
  std::optional<VoxelIndex> in_block, in_cube;
  const VoxelBlock* block = nullptr;
  for (double at_m = step_m; at_m < range_m; at_m += step_m) {
    const Eigen::Vector3d point_map_m = from_map_m + at_m * direction;
    const VoxelIndex voxel = voxels.voxelAt(point_map_m);
    if (const VoxelIndex index = VoxelMap::blockOf(voxel); !in_block || *in_block != index) {
      block = voxels.block(index);
      in_block = index;
    }
    const std::int8_t evidence = block == nullptr
                                     ? VoxelBlock::kUnknown
                                     : block->evidence[static_cast<std::size_t>(VoxelBlock::offsetOf(voxel))];
    if (evidence > 0) return;
    if (evidence != VoxelBlock::kUnknown) continue;
    if (map_.states().at(map_.cellAt(point_map_m.head<2>())) != CellState::kFree) return;
    const VoxelIndex cube = cubeAt(point_map_m);
    if (at_m < nearest_m || (in_cube && *in_cube == cube)) continue;
    in_cube = cube;
    if (const auto number = numberOf(cube)) seen.push_back(*number);
  }
}

/// nullopt if something in the cube is known.
std::optional<std::uint32_t> VolumeSurvey::numberOf(const VoxelIndex& cube) {
  const auto [entry, is_new] = numbers_.try_emplace(cube, kKnownCube);
  const Eigen::Vector3d center_m = kCube_m * Eigen::Vector3d(cube.x + 0.5, cube.y + 0.5, cube.z + 0.5);
  if (is_new && !isKnownCube(*input_.volume.voxels, center_m)) {
    entry->second = static_cast<std::uint32_t>(is_covered_.size());
    is_covered_.push_back(false);
  }
  return entry->second == kKnownCube ? std::nullopt : std::optional(entry->second);
}

/// The heading in which the picture has most.
CameraLook VolumeSurvey::bestLook(const Panorama& panorama) {
  std::array<std::size_t, kColumns> counts{};
  for (std::size_t i = 0; i < counts.size(); ++i)
    counts[i] = static_cast<std::size_t>(std::count_if(panorama.columns[i].begin(), panorama.columns[i].end(),
                                                       [this](std::uint32_t cube) { return !is_covered_[cube]; }));
  // A cube that two directions share counts twice here, which hardly changes where most is.
  std::size_t most = 0;
  int best = 0;
  for (int middle = 0; middle < kColumns; ++middle) {
    std::size_t count = 0;
    for (const int column : columnsAround(middle, half_columns_)) count += counts[static_cast<std::size_t>(column)];
    if (count <= most) continue;
    most = count;
    best = middle;
  }
  return {panorama.place, panorama.path_m, headingOf(best), most == 0 ? 0.0 : gainOf_m3(panorama, headingOf(best))};
}

double VolumeSurvey::gainOf_m3(const Panorama& panorama, double yaw_map_rad) {
  ++counts_;
  counted_in_.resize(is_covered_.size(), 0);
  std::size_t count = 0;
  for (const int column : columnsAround(columnOf(yaw_map_rad), half_columns_))
    for (const std::uint32_t cube : panorama.columns[static_cast<std::size_t>(column)]) {
      if (is_covered_[cube] || counted_in_[cube] == counts_) continue;
      counted_in_[cube] = counts_;
      ++count;
    }
  return static_cast<double>(count) * kCube_m3;
}

void VolumeSurvey::mark(const Panorama& panorama, double yaw_map_rad) {
  for (const int column : columnsAround(columnOf(yaw_map_rad), half_columns_))
    for (const std::uint32_t cube : panorama.columns[static_cast<std::size_t>(column)]) is_covered_[cube] = true;
}

}  // namespace swiftlet::planning
