// What the fusion filter has lately come through, to step back in and replay. Private to fusion.
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

/// A ring of IMU samples with their states, and the measurements between them. A late measurement makes all states
/// after it out of date; they are computed again when they are asked for, no more of them than the question needs.
class StateHistory {
 public:
  explicit StateHistory(const FusionConfig& config);

  /// Forgets all; this one is up to date.
  void start(const Slot& first);
  bool empty() const { return count_ == 0; }

  /// The next sample, after start().
  void push(const common::ImuSample& sample, bool at_rest);
  /// kTaken, kTooOld or kTooNew.
  Insertion insert(const Measurement& measurement);

  /// Up to date. Not when empty.
  const Slot& newest();
  /// Whether a pose cloned at `time` is there, or will be once all is up to date.
  bool holdsClone(common::Time time) const;

  // As ErrorStateFilter has them.
  std::optional<common::Pose3> poseAt(common::Time time);
  std::optional<VerticalState> verticalAt(common::Time time);
  PoseHistory poses(common::Time from, common::Time to);

  /// Whether a state has diverged since start(), as far as they are up to date.
  bool diverged() const { return diverged_; }
  /// Steps computed again, ever.
  std::uint64_t replays() const { return replays_; }

 private:
  Slot& slot(std::size_t age_from_oldest) { return ring_[(oldest_ + age_from_oldest) % ring_.size()]; }
  const Slot& slot(std::size_t age_from_oldest) const { return ring_[(oldest_ + age_from_oldest) % ring_.size()]; }
  common::Time newestStamp() const { return slot(count_ - 1).imu.stamp; }
  void dropOldest();
  /// Brings the first `until` slots up to date. Measurements of one scan come one after the other, at one instant: what
  /// is later is computed once, after the last of them.
  void replay(std::size_t until);

  FilterStep step_;
  common::Duration length_;
  double attitude_period_s_;
  std::vector<Slot> ring_;
  std::size_t oldest_ = 0, count_ = 0;
  MeasurementHistory measurements_;
  std::size_t dirty_from_ = 0;  ///< First slot (from the oldest) whose state must be computed again; count: none.
  common::Time last_attitude_;
  bool diverged_ = false;
  std::uint64_t replays_ = 0;
};

}  // namespace swiftlet::perception::fusion
