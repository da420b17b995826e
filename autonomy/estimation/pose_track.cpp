#include "autonomy/estimation/pose_track.hpp"

#include "common/geometry.hpp"

namespace swiftlet::autonomy {

using common::Pose3;
using common::Time;

namespace {

/// The place in the map counts as measured for this long after a scan that matched: six scans of a laser with 40 Hz,
/// and more than one of the slowest, 10 Hz, even if it is late.
constexpr double kSupported_s = 0.15;
/// Velocities are differences over two samples of the IMU to each side: shorter ones have more noise, and the vehicle's
/// turns last longer.
constexpr double kHalfDifference_s = 0.01;

}  // namespace

void PoseTrack::scanned(Time stamp, const std::optional<common::KeyRelativePose>& at_key, const Pose3& T_odom_body) {
  scanned_ = stamp;
  if (at_key) odom_at_key_ = {at_key->key, at_key->T_key_body * T_odom_body.inverse()};
}

bool PoseTrack::isKnown(Time time, Time now, Time wait_until) const {
  if (!filter_.initialized() || filter_.newest() < time) return false;
  return scanned_ >= time || now >= wait_until;
}

bool PoseTrack::isSupported(Time now) const { return (now - matched_).seconds() < kSupported_s; }

std::optional<common::KeyRelativePose> PoseTrack::atKey(Time time) const {
  const auto T_odom_body = filter_.poseAt(time);
  if (!odom_at_key_ || !T_odom_body) return std::nullopt;
  return common::KeyRelativePose{odom_at_key_->key, odom_at_key_->T_key_body * *T_odom_body};
}

std::optional<BodyAtFrame> PoseTrack::bodyAt(Time time) const {
  const common::Duration half = common::Duration::fromSeconds(kHalfDifference_s);
  const auto before = filter_.poseAt(time - half), at = filter_.poseAt(time), after = filter_.poseAt(time + half);
  if (!before || !at || !after) return std::nullopt;
  const Pose3 step = before->inverse() * *after;
  constexpr double kPer_s = 0.5 / kHalfDifference_s;
  return BodyAtFrame{at->rotation, {time, kPer_s * step.position_m, kPer_s * common::logSO3(step.rotation), 0.0}};
}

std::optional<SweepSituation> PoseTrack::during(const VerticalLaserPipeline::Interval& times, Time now) const {
  const perception::PoseHistory history = filter_.motion(times.begin, times.end);
  if (!odom_at_key_ || !isSupported(now)) return std::nullopt;
  if (!history.covers(times.begin) || !history.covers(times.end)) return std::nullopt;
  const Pose3 newest = filter_.state().T_odom_body;
  return SweepSituation{odom_at_key_->key,
                        [T_key_odom = odom_at_key_->T_key_body, history, newest](Time time) {
                          return T_key_odom * history.at(time).value_or(newest);
                        },
                        {}};
}

}  // namespace swiftlet::autonomy
