// What the fusion filter says of itself and of what it was given.
#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>

namespace swiftlet::perception {

enum class FusionStatus { kNotInitialized, kOk, kDegraded, kDiverged };
const char* toString(FusionStatus status);

struct FusionHealth {
  FusionStatus status = FusionStatus::kNotInitialized;
  std::string reason;  ///< Empty when ok.
};

/// What became of a measurement that was handed in. Whether the gate lets it pass shows in the counts.
enum class Insertion {
  kTaken,
  kInvalid,           ///< Not finite, covariance not positive, time before the reference.
  kTooOld,            ///< Older than the history.
  kTooNew,            ///< So far ahead of the IMU that clocks must be wrong.
  kUnknownReference,  ///< The reference was never cloned, or was dropped for newer ones.
};

struct FusionCounts {
  std::uint64_t imu_dropped = 0;  ///< Non-finite, repeated or out of order.
  std::uint64_t measurements = 0;
  std::uint64_t refused = 0;  ///< Not kTaken.
  std::uint64_t replays = 0;  ///< IMU steps computed again.
  /// Along the present history: each measurement counts once however often it is replayed.
  std::uint64_t relative_poses_gated = 0;
  std::uint64_t heights_gated = 0;
  std::uint64_t recoveries = 0;
};

struct VerticalState {
  double height_m = 0.0;
  double velocity_m_s = 0.0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< Of (height_m, velocity_m_s).
};

}  // namespace swiftlet::perception
