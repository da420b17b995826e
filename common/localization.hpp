// Where the vehicle is in a map it was given, as all speak of it.
#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/time.hpp"

namespace swiftlet::common {

enum class LocalizationState {
  kGlobal,     ///< It may be anywhere.
  kAmbiguous,  ///< Several places explain what was seen, or one does that has not yet been held for long.
  kLocalized,
  kLost,  ///< It was localized, and the pose was wrong or became wrong.
};
const char* toString(LocalizationState state);

/// The frame `given` is that of the given map's file. It and `odom` stand still against each other but for what either
/// is wrong by; `map`, which this flight makes itself, is another.
struct Localization {
  LocalizationState state = LocalizationState::kGlobal;
  Time stamp;                                            ///< Of the scan that says so.
  Pose2 T_given_odom;                                    ///< Meaningful only when localized; may jump.
  Pose2 T_given_body;                                    ///< At the stamp; likewise.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of T_given_body: (x_m, y_m, yaw_rad), axes of `given`.
  double explained = 0.0;  ///< Share of the scan that the map explains from there, while localized.
  int places = 0;          ///< That explain what was seen; 1 when localized.

  bool localized() const { return state == LocalizationState::kLocalized; }
};

}  // namespace swiftlet::common
