#include "autonomy/estimation/rgbd_pipeline_config.hpp"

#include "common/config_fields.hpp"

namespace swiftlet::autonomy {

void RgbdPipelineConfig::describe(common::config::Fields& fields) {
  fields.section("mapper", mapper, "The 3D map.");
  fields.section("radio", radio, "The radio on which frames come, if the computer that maps is not on board.");
  fields.section("calibration", calibration, "Mount and clock of the camera, estimated in flight.");
  fields("measure", measure, "Whether the poses of frames are measurements for the filter.");
  fields("latency_s", latency_s, {0.001, 2}, "Declared time for mapping one frame.");
  fields("wait_s", wait_s, {0, 1}, "Greatest wait of a frame for a scan that is not older.");
  publisher.describe(fields);
  fields("silent_s", silent_s, {0.1, 60}, "A camera that sends no usable frame for so long is silent.");
  fields("lost_s", lost_s, {0, 60}, "The track counts as lost when no frame has fitted for so long.");
}

}  // namespace swiftlet::autonomy
