#include "perception/targets/target_config.hpp"

#include "common/config_fields.hpp"
#include "common/validation.hpp"

namespace swiftlet::perception {

void TargetClassConfig::describe(common::config::Fields& fields) {
  fields("name", name, "Name of these targets, by which missions ask for them.");
  fields("hue_deg", hue_deg, {0, 360}, "Hue of these targets: 0 is red, 120 green, 240 blue.");
  fields("hue_tolerance_deg", hue_tolerance_deg, {1, 60},
         "Greatest difference in hue. The colour of the light and the camera's white balance change the hue.");
  fields("saturation_min", saturation_min, {0, 1},
         "Least saturation, 1 - least channel / greatest channel; the brightness of the light does not change it.");
  fields("value_min", value_min, {0, 1},
         "Least greatest channel of a target's pixels: darker ones have no reliable hue.");
  fields("diameter_m", diameter_m, {0, 5}, "Diameter of these targets; 0 if it is not known.");
}

std::vector<common::Problem> TargetClassConfig::validate() const {
  return common::Validation().given(!name.empty(), "name").problems();
}

}  // namespace swiftlet::perception
