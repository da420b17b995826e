#include "mapping3d/model/submap_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::mapping3d {

void SubmapConfig::describe(common::config::Fields& fields) {
  fields("cube_m", cube_m, {0.005, 0.5}, "A submap has one point for each cube of this size.");
  fields("point_range_m", point_range_m, {0.5, 50},
         "Farther surfaces make no points, because their noise is too great.");
  fields("reach_m", reach_m, {0.5, 20}, "A submap is left when the sensor is farther from its origin.");
  fields("points_max", points_max, {10'000, 100'000'000},
         "Points of all submaps together, at most: beyond, the oldest are thinned to cubes of twice the size.");
  fields("submaps_max", submaps_max, {2, 10'000}, "Submaps that are kept, at most: beyond, the oldest is forgotten.");
  fields("blocks_max", blocks_max, {100, 10'000'000},
         "Blocks of 8 x 8 x 8 voxels of all submaps together, half a kilobyte each: beyond, the oldest are forgotten.");
}

void ImageSubmapConfig::describe(common::config::Fields& fields) {
  SubmapConfig::describe(fields);
  fields("pixel_step", pixel_step, {1, 16}, "Every so many pixels of a row and of a column make a point.");
  fields("frame_step", frame_step, {1, 100}, "Every so many frames make points; all of them change the occupancy.");
}

}  // namespace swiftlet::mapping3d
