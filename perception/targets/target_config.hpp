// What targets look like, and when something counts as one.
#pragma once

#include <string>
#include <vector>

#include "common/config_fwd.hpp"

namespace swiftlet::perception {

/// Things of one colour that are looked for.
struct TargetClassConfig {
  std::string name = "target";
  double hue_deg = 0.0;
  double hue_tolerance_deg = 12.0;
  double saturation_min = 0.5;
  double value_min = 0.15;
  double diameter_m = 0.0;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

struct TargetDetectorConfig {
  static constexpr int pixels_min = 40;              ///< Least pixels of a target; smaller ones are too far away.
  static constexpr double diameter_min_m = 0.08;     ///< Least diameter of a target of unknown diameter.
  static constexpr double diameter_max_m = 0.5;      ///< Greatest diameter of a target of unknown diameter.
  static constexpr double diameter_tolerance = 0.5;  ///< Greatest difference from a known diameter, as a share of it.
  static constexpr double fill_min = 0.5;  ///< Least share of the rectangle around a target that it fills: a disc fills
                                           ///< 0.79, a strip on the slant little.
  static constexpr double relief_m =
      0.04;  ///< What is next to a target in the picture counts as behind it if it is farther by this than the target's
             ///< surface continued. On a picture of a target, no neighbour is.
  static constexpr double outline_share_min = 0.5;  ///< Least share of a target's outline with something behind it.
  static constexpr double hidden_share_max =
      0.4;  ///< Greatest share of a target's outline with something in front of it, as the floor before a target is.
};

struct TargetTrackerConfig {
  static constexpr int confirm_views = 3;         ///< Places from which a target must be seen to count as found.
  static constexpr double view_distance_m = 0.2;  ///< Least distance between two places from which a target is seen; a
                                                  ///< picture from a place before is no new measurement.
  double position_sigma_m = 0.02;  ///< Standard deviation of the vehicle's place in its map, beside its drift.
  static constexpr double attitude_sigma_deg = 0.4;  ///< Standard deviation of the vehicle's attitude.
  double mount_sigma_deg =
      0.6;  ///< Standard deviation of what is left of the camera's mount after its calibration; equal in all pictures.
  static constexpr double inverse_depth_sigma_1_m =
      0.001;  ///< Standard deviation of the camera's error of inverse depth that is equal in all pictures.
  static constexpr double time_sigma_s = 0.004;  ///< Standard deviation of the time of a picture: it matters in turns.
  static constexpr double gate_sigma = 4.0;      ///< Greatest Mahalanobis distance of a sighting from its target.
  static constexpr int misses_max =
      6;  ///< A candidate is dropped after this many pictures with a free-space violation of its place.
};

}  // namespace swiftlet::perception
