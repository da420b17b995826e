#include "mapping3d/voxels/voxel_config.hpp"

#include <fmt/format.h>

#include "common/config_fields.hpp"
#include "common/validation.hpp"

namespace swiftlet::mapping3d {
namespace {

/// The blocks around the sensor are kept as a dense cube, of 9 MB with this reach and of 8 GB with ten times as much.
constexpr double kFarthestVoxels = 500.0;
constexpr double kRounding = 1e-9;

}  // namespace

void VoxelConfig::describe(common::config::Fields& fields) {
  fields("resolution_m", resolution_m, {0.01, 1.0}, "Side of a voxel.");
  fields("range_max_m", range_max_m, {0.5, 50.0},
         "Farther surfaces are not drawn; the ray is free up to here. At most 500 voxels.");
  fields("hit_log_odds", hit_log_odds, {0.05, 3.5}, "Log-odds added to a voxel in which rays of a frame end.");
  fields("miss_log_odds", miss_log_odds, {-3.5, -0.05}, "Log-odds added to a voxel that rays of a frame only cross.");
  fields("least_log_odds", least_log_odds, {-6.0, 0.0}, "Log odds of a voxel are not below this.");
  fields("greatest_log_odds", greatest_log_odds, {0.05, 6.0}, "Log odds of a voxel are not above this.");
  fields("blocks_max", blocks_max, {100, 10'000'000},
         "Blocks of 8 x 8 x 8 voxels that the map holds; beyond, those farthest from the sensor are forgotten.");
}

std::vector<std::string> VoxelConfig::validate() const {
  return common::Validation()
      .require(range_max_m / resolution_m <= kFarthestVoxels * (1.0 + kRounding), "range_max_m",
               fmt::format("{} is more than {} voxels of {} m, which would take too much memory; make resolution_m "
                           "greater or the range less",
                           range_max_m, kFarthestVoxels, resolution_m))
      .problems();
}

}  // namespace swiftlet::mapping3d
