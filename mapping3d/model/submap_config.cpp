#include "mapping3d/model/submap_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::mapping3d {

void SubmapConfig::describe(common::config::Fields& fields) {
  fields("cube_m", cube_m, {0.005, 0.5}, "A submap has one point for each cube of this size.");
}

}  // namespace swiftlet::mapping3d
