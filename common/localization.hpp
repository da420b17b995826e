// The localization of the vehicle in a given map: its state and the pose.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/pose2.hpp"
#include "common/time.hpp"

namespace swiftlet::common {

enum class LocalizationState {
  kGlobal,     ///< The vehicle may be anywhere in the map.
  kAmbiguous,  ///< Several places explain the scans, or a single one has not yet been confirmed for long enough.
  kLocalized,
  kLost,  ///< It was localized, and the pose was found to be wrong.
};
const char* toString(LocalizationState state);

/// A pose where the vehicle may be.
struct PlaceCandidate {
  Pose2 T_given_body;
  double weight = 0.0;  ///< Its probability among the places that explain the scans.
};

/// `given` is the frame of the given map's file. T_given_odom would be constant without errors of the odometry and of
/// the map. The frame `map` belongs to the map that the flight itself makes, and differs from `given`.
struct Localization {
  LocalizationState state = LocalizationState::kGlobal;
  Time stamp;                                            ///< Stamp of the last scan used.
  Pose2 T_given_odom;                                    ///< Valid only when localized; may jump.
  Pose2 T_given_body;                                    ///< At `stamp`; valid only when localized; may jump.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of T_given_body: (x_m, y_m, yaw_rad), axes of `given`.
  double explained = 0.0;  ///< Share of the scan's beams that the map explains from T_given_body, while localized.
  bool refuted = false;    ///< No place has stood out for so long that the map must be of another place.
  int places = 0;          ///< Number of places that explain the scans; 1 when localized.
  /// The likeliest of these places, by their weight, as of the last scan; empty when localized, and when nothing fits.
  std::vector<PlaceCandidate> candidates;

  bool localized() const { return state == LocalizationState::kLocalized; }
};

}  // namespace swiftlet::common
