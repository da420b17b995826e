// All inputs of a fusion filter, in order: a listener gets them in flight, and another filter with the same inputs has
// the same state. By this the noise parameters are learned from recorded flights (Bachrach 2009, 5.2).
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "common/geometry.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"
#include "perception/fusion/error_state_filter.hpp"

namespace swiftlet::perception {

struct TapedStart {
  double height_m = 0.0;
};
struct TapedRest {
  bool at_rest = false;
};
struct TapedPredicted {
  bool predicted = false;
};
struct TapedClone {
  common::Time time;
};
/// Of the laser, relative to the clone at `from`; see ErrorStateFilter::addRelativePose.
struct TapedRelativePose {
  common::Time from, to;
  common::Pose2 T_from_to;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();   ///< Of (x_m, y_m, yaw_rad) in the frame at `from`.
  std::optional<Eigen::Vector2d> unobservable_direction;  ///< Direction without information, in the frame at `from`.
};
/// Of a camera, in space, relative to the clone at `from`; see ErrorStateFilter::addRelativePose3.
struct TapedRelativePose3 {
  common::Time from, to;
  common::Pose3 T_from_to;
  /// Of the error (position, rotation vector) in the axes of the body at `to`.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};
struct TapedHeight {
  common::Time time;
  double height_m = 0.0, variance_m2 = 0.0, common_variance_m2 = 0.0;
};
struct TapedClimb {
  common::Time time;
  double speed_m_s = 0.0, variance_m2_s2 = 0.0;
};
using FilterInput = std::variant<common::ImuSample, TapedStart, TapedRest, TapedPredicted, TapedClone,
                                 TapedRelativePose, TapedRelativePose3, TapedHeight, TapedClimb>;

class FilterListener {
 public:
  virtual ~FilterListener() = default;
  /// Called in the filter's thread, before the filter gets the input.
  virtual void heard(const FilterInput& input) = 0;
};

/// Gives the input to the filter. Returns what became of a measurement or a clone, and kTaken for other inputs; the
/// reason if the filter was to start and did not.
tl::expected<Insertion, std::string> tell(ErrorStateFilter& filter, const FilterInput& input);

/// One line with its newline: a word that names the input, and its numbers, times in nanoseconds.
std::string toLine(const FilterInput& input);
/// The input of a line; none if it is not one.
std::optional<FilterInput> filterInputOf(const std::vector<std::string_view>& words);

}  // namespace swiftlet::perception
