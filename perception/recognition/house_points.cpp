#include "perception/recognition/house_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "common/rgbd_frame.hpp"

namespace swiftlet::perception {
namespace {

constexpr int kPixelStep = 3;
/// Levels are compared in bins of this height; ground that is uneven, or seen with an attitude off by half a degree
/// from 6 m, is within two.
constexpr double kLevel_m = 0.05, kGroundWithin_m = 0.12;
/// Of the measured points; and the greatest share that lies clearly lower.
constexpr double kGroundShare = 0.02, kBelowGround = 0.01, kClearlyBelow_m = 0.3;
/// Higher above the ground than what is uneven there, and than the errors of depths.
constexpr double kStands_m = 0.35;
/// Cells that touch are one group.
constexpr double kGroupCell_m = 0.25;
/// Above the top of the chimney nothing belongs to the house.
constexpr double kAboveTop_m = 0.4;
constexpr std::size_t kLeastPoints = 150;
/// Single points above the chimney are noise.
constexpr int kRisesBy = 3;

struct GroupCell {
  std::vector<std::size_t> points = {};
  int above = 0;  ///< Points that are higher than the house.
  bool taken = false;
};
using CellKey = std::pair<int, int>;
using GroupGrid = std::map<CellKey, GroupCell>;

CellKey groupCellOf(const Eigen::Vector3d& point) {
  return {static_cast<int>(std::floor(point.x() / kGroupCell_m)),
          static_cast<int>(std::floor(point.y() / kGroupCell_m))};
}

/// The cells that are connected with `start`, which are then taken.
std::vector<HousePoint> groupAt(const CellKey& start, GroupGrid& grid, const std::vector<HousePoint>& points) {
  std::vector<HousePoint> group;
  std::vector<CellKey> open = {start};
  grid[start].taken = true;
  while (!open.empty()) {
    const CellKey at = open.back();
    open.pop_back();
    for (const std::size_t i : grid[at].points) group.push_back(points[i]);
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const auto beside = grid.find({at.first + x, at.second + y});
        if (beside == grid.end() || beside->second.taken) continue;
        beside->second.taken = true;
        open.push_back(beside->first);
      }
  }
  return group;
}

}  // namespace

std::vector<HousePoint> housePoints(const DepthView& view) {
  std::vector<HousePoint> points;
  for (int v = 0; v < view.camera.height_px; v += kPixelStep)
    for (int u = 0; u < view.camera.width_px; u += kPixelStep) {
      const float depth_m = view.depth.at(u, v);
      if (!common::isMeasured(depth_m) || static_cast<double>(depth_m) > view.range_max_m) continue;
      const Eigen::Vector3d ray = view.ray(u, v);
      const auto z = static_cast<double>(depth_m);
      points.push_back({z * ray, z * z * view.inverse_depth_sigma_1_m * ray.norm()});
    }
  return points;
}

std::optional<double> groundOf(const std::vector<HousePoint>& points) {
  std::map<int, int> levels;
  for (const HousePoint& point : points) ++levels[static_cast<int>(std::floor(point.at_m.z() / kLevel_m))];
  const auto at = [&](int level) {
    const auto found = levels.find(level);
    return found == levels.end() ? 0 : found->second;
  };
  const auto around = [&](int level) { return at(level - 1) + at(level) + at(level + 1); };
  for (const auto& [level, count] : levels) {
    if (around(level) < kGroundShare * static_cast<double>(points.size())) continue;
    if (around(level + 1) > around(level)) continue;
    const double middle_m = (level + 0.5) * kLevel_m;
    double sum_m = 0.0;
    int near = 0, below = 0;
    for (const HousePoint& point : points) {
      if (point.at_m.z() < middle_m - kClearlyBelow_m) ++below;
      if (std::abs(point.at_m.z() - middle_m) > kGroundWithin_m) continue;
      sum_m += point.at_m.z();
      ++near;
    }
    if (below > kBelowGround * static_cast<double>(points.size())) return std::nullopt;
    return sum_m / near;
  }
  return std::nullopt;
}

std::vector<std::vector<HousePoint>> standingGroups(const std::vector<HousePoint>& points, double ground_m,
                                                    const HouseModel& model) {
  GroupGrid grid;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double height_m = points[i].at_m.z() - ground_m;
    if (height_m < kStands_m) continue;
    GroupCell& cell = grid[groupCellOf(points[i].at_m)];
    if (height_m > model.chimney_top_m + kAboveTop_m) ++cell.above;
    cell.points.push_back(i);
  }
  std::erase_if(grid, [](const auto& cell) { return cell.second.above >= kRisesBy; });
  std::vector<CellKey> keys;
  for (const auto& cell : grid) keys.push_back(cell.first);
  std::vector<std::vector<HousePoint>> groups;
  for (const CellKey& key : keys) {
    if (grid[key].taken) continue;
    std::vector<HousePoint> group = groupAt(key, grid, points);
    if (group.size() >= kLeastPoints) groups.push_back(std::move(group));
  }
  std::stable_sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return groups;
}

}  // namespace swiftlet::perception
