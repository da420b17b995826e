// The recent history of the fusion filter, which can be replayed from any time. Private to fusion.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/sensor_event.hpp"
#include "perception/fusion/filter_step.hpp"
#include "perception/fusion/fusion_config.hpp"
#include "perception/fusion/fusion_types.hpp"
#include "perception/fusion/measurement_history.hpp"
#include "perception/fusion/pose_history.hpp"

namespace swiftlet::perception::fusion {

/// A ring of IMU samples with their states, and the measurements between them. A late measurement invalidates all
/// states after it. They are recomputed when they are needed, and only as far as needed.
class StateHistory {
 public:
  explicit StateHistory(const FusionConfig& config);

  /// Discards everything and starts with this slot, which is up to date.
  void start(const Slot& first);
  bool empty() const { return count_ == 0; }

  /// Adds the next sample. Only after start().
  void push(const common::ImuSample& sample, bool at_rest, bool predicted);
  /// Returns kTaken, kTooOld (also if there is no room) or kTooNew.
  Insertion insert(const Measurement& measurement);

  /// The newest slot, brought up to date. The history must not be empty.
  const Slot& newest();
  /// Whether a clone at `time` was requested within the history or is in the newest state. True also for a requested
  /// clone that was dropped for newer ones.
  bool holdsClone(common::Time time) const;

  // As in ErrorStateFilter.
  std::optional<common::Pose3> poseAt(common::Time time);
  std::optional<VerticalState> verticalAt(common::Time time);
  std::optional<InertialClimb> climb(common::Time from, common::Time to);
  PoseHistory motion(common::Time from, common::Time to);

  /// Whether any state computed since start() has diverged.
  bool diverged() const { return diverged_; }
  /// Total number of steps recomputed.
  std::uint64_t replays() const { return replays_; }

 private:
  Slot& slot(std::size_t age_from_oldest) { return ring_[(oldest_ + age_from_oldest) % ring_.size()]; }
  const Slot& slot(std::size_t age_from_oldest) const { return ring_[(oldest_ + age_from_oldest) % ring_.size()]; }
  common::Time newestStamp() const { return slot(count_ - 1).imu.stamp; }
  void dropOldest();
  void measureNoise(const ImuValue& before, const ImuValue& now);
  /// Brings the first `until` slots up to date. Recomputing lazily pays off, because the measurements of one scan
  /// arrive together: later states are computed once, after the last of them.
  void replay(std::size_t until);

  FilterStep step_;
  common::Duration length_;
  double attitude_period_s_;
  std::vector<Slot> ring_;
  std::size_t oldest_ = 0, count_ = 0;
  MeasurementHistory measurements_;
  /// Index of the first slot whose state must be recomputed, counted from the oldest; count_ if all states are valid.
  std::size_t dirty_from_ = 0;
  common::Time last_attitude_;
  double accelerometer_noise2_m2_s3_ = 0.0;  ///< Square of the noise density that the samples show.
  bool diverged_ = false;
  std::uint64_t replays_ = 0;
};

}  // namespace swiftlet::perception::fusion
