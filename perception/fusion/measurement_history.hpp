// The measurements of the fusion filter's history in the order in which they are applied, whatever order they came in.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/time.hpp"

namespace swiftlet::perception::fusion {

/// The order at equal times is that of the kinds: a pose is cloned after everything known about it.
enum class MeasurementKind : std::uint8_t { kHeight, kVerticalSpeed, kRelativePose, kAbsolutePose, kClone };

struct Measurement {
  common::Time stamp;
  MeasurementKind kind = MeasurementKind::kClone;
  common::Time from;                                ///< kRelativePose: when the reference was cloned.
  common::Pose2 pose;                               ///< kRelativePose, kAbsolutePose.
  std::optional<Eigen::Vector2d> unseen_direction;  ///< kRelativePose: in the level frame at `from`.
  double value = 0;                                 ///< kHeight: m; kVerticalSpeed: m/s.
  double common_variance_m2 = 0.0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< kHeight, kVerticalSpeed: only (0, 0).
};

/// Two measurements of one kind and time are put in the order of their values, so that not even they depend on arrival.
class MeasurementHistory {
 public:
  explicit MeasurementHistory(std::size_t capacity);

  void clear() { measurements_.clear(); }
  /// False when full; then nothing changed.
  bool insert(const Measurement& measurement);
  void dropUntil(common::Time time);                                                  ///< Those at or before.
  std::span<const Measurement> within(common::Time after, common::Time until) const;  ///< after < stamp <= until.
  bool holdsClone(common::Time time) const;

 private:
  std::vector<Measurement> measurements_;
  std::size_t capacity_;
};

}  // namespace swiftlet::perception::fusion
