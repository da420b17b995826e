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
  fields("resolution_m", resolution_m, {0.005, 1.0}, "Side of a voxel.");
}

std::vector<common::Problem> VoxelConfig::validate() const {
  return common::Validation()
      .require(range_max_m / resolution_m <= kFarthestVoxels * (1.0 + kRounding), "range_max_m",
               common::Message("voxels.too-many",
                               "{} is more than {} voxels of {} m, which would take too much memory; make resolution_m "
                               "greater or the range less",
                               range_max_m, kFarthestVoxels, resolution_m))
      .problems();
}

}  // namespace swiftlet::mapping3d
