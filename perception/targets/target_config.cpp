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

std::vector<std::string> TargetClassConfig::validate() const {
  return common::Validation().require(!name.empty(), "name", "is missing").problems();
}

void TargetDetectorConfig::describe(common::config::Fields& fields) {
  fields("pixels_min", pixels_min, {8, 1e6}, "Least pixels of a target; smaller ones are too far to be told.");
  fields("diameter_min_m", diameter_min_m, {0.01, 5}, "Least diameter of a target of unknown diameter.");
  fields("diameter_max_m", diameter_max_m, {0.01, 5}, "Greatest diameter of a target of unknown diameter.");
  fields("diameter_tolerance", diameter_tolerance, {0.05, 1},
         "Greatest difference from a known diameter, as a share of it.");
  fields("fill_min", fill_min, {0.1, 1},
         "Least share of the rectangle around a target that it fills: a disc fills 0.79, a strip on the slant little.");
  fields("relief_m", relief_m, {0.005, 1},
         "What is next to a target in the picture counts as behind it if it is so much farther than the target's "
         "surface continued. On a picture of a target, nothing is.");
  fields("outline_share_min", outline_share_min, {0, 1}, "Least share of a target's outline with something behind it.");
  fields("hidden_share_max", hidden_share_max, {0, 1},
         "Greatest share of a target's outline with something in front of it, as the floor before a target is.");
}

std::vector<std::string> TargetDetectorConfig::validate() const {
  return common::Validation().atMost("diameter_min_m", diameter_min_m, "diameter_max_m", diameter_max_m).problems();
}

void TargetTrackerConfig::describe(common::config::Fields& fields) {
  fields("confirm_views", confirm_views, {1, 100}, "Places from which a target must be seen to count as found.");
  fields("view_distance_m", view_distance_m, {0.01, 10},
         "Least distance between two places from which a target is seen; a picture from a place before is no new "
         "measurement.");
  fields("position_sigma_m", position_sigma_m, {0.001, 1},
         "Standard deviation of the vehicle's place in its map, beside its drift.");
  fields("attitude_sigma_deg", attitude_sigma_deg, {0.01, 10}, "Standard deviation of the vehicle's attitude.");
  fields("mount_sigma_deg", mount_sigma_deg, {0.01, 10},
         "Standard deviation of what is left of the camera's mount after its calibration; equal in all pictures.");
  fields("inverse_depth_sigma_1_m", inverse_depth_sigma_1_m, {0, 0.1},
         "Standard deviation of the camera's error of inverse depth that is equal in all pictures.");
  fields("time_sigma_s", time_sigma_s, {0, 0.1}, "Standard deviation of the time of a picture: it matters in turns.");
  fields("gate_sigma", gate_sigma, {1, 10}, "Greatest Mahalanobis distance of a sighting from its target.");
  fields("misses_max", misses_max, {1, 1000},
         "A candidate is dropped after so many pictures with a free-space violation of its place.");
}

}  // namespace swiftlet::perception
