// The measurements in the history of the fusion filter, in the order in which they are applied, which does not depend
// on the order of arrival.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/time.hpp"

namespace swiftlet::perception::fusion {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// At equal times, measurements are applied in the order of their kinds: a pose is cloned after all measurements of it.
enum class MeasurementKind : std::uint8_t {
  kHeight,
  kVerticalSpeed,
  kRelativePose,
  kRelativePose3,
  kAbsolutePose,
  kClone
};

struct Measurement {
  common::Time stamp;
  MeasurementKind kind = MeasurementKind::kClone;
  common::Time from;                                      ///< Of a relative pose: time of the cloned reference.
  common::Pose2 pose;                                     ///< kRelativePose, kAbsolutePose.
  std::optional<Eigen::Vector2d> unobservable_direction;  ///< kRelativePose: in the level frame at `from`.
  double value = 0;                                       ///< kHeight: m; kVerticalSpeed: m/s.
  double common_variance_m2 = 0.0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< kHeight, kVerticalSpeed: only (0, 0).
  common::Pose3 pose3;                                   ///< kRelativePose3.
  Matrix6d covariance6 = Matrix6d::Zero();               ///< kRelativePose3.
};

/// Measurements of the same kind and time are ordered by their values, so that their order does not depend on arrival
/// either.
class MeasurementHistory {
 public:
  explicit MeasurementHistory(std::size_t capacity);

  void clear() { measurements_.clear(); }
  /// False if the history is full; nothing changes then.
  bool insert(const Measurement& measurement);
  /// Drops measurements at or before `time`. Up to 31 of them may stay until a later call.
  void dropUntil(common::Time time);
  /// The measurements with after < stamp <= until.
  std::span<const Measurement> within(common::Time after, common::Time until) const;
  bool holdsClone(common::Time time) const;

 private:
  std::vector<Measurement> measurements_;
  std::size_t capacity_;
};

}  // namespace swiftlet::perception::fusion
