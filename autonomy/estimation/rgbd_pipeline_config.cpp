#include "autonomy/estimation/rgbd_pipeline_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {

void RgbdPipelineConfig::describe(common::config::Fields& fields) {
  fields.section("mapper", mapper, "The 3D map.");
  fields.section("radio", radio, "The radio on which frames come, if the computer that maps is not on board.");
  fields("latency_s", latency_s, {0.001, 2}, "Declared time for mapping one frame.");
}

}  // namespace swiftlet::autonomy
