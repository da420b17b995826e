#include "perception/fusion/state_history.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/check.hpp"
#include "common/square.hpp"
#include "perception/fusion/pose_history.hpp"

namespace swiftlet::perception::fusion {

using common::Duration;
using common::Time;

namespace {

/// Greatest delay with which a measurement may come.
constexpr double kHistory_s = 1.0;

/// Beyond the newest sample a pose is extrapolated for up to four periods of the autopilot's IMU (200 Hz).
constexpr double kMaxExtrapolation_s = 0.02;
/// A measurement farther ahead of the IMU has a wrong stamp: no sensor of the field arrives half a second before it.
constexpr double kMaxAhead_s = 0.5;
/// IMU rate that the history has room for; a faster IMU shortens the history.
constexpr double kRingRate_hz = 256.0;
/// Room for the measurements within the history: 25 for each scan of a 40 Hz laser in the default history of 1 s.
constexpr std::size_t kMeasurementCapacity = 1024;

/// Extrapolates forwards or backwards with the velocity and angular velocity of the slot.
common::Pose3 extrapolated(const Slot& slot, Time time) {
  const FilterState& state = slot.state;
  const double ahead_s = (time - state.stamp).seconds();
  const Eigen::Vector3d turn_body_rad = ahead_s * (slot.imu.angular_velocity_body_rad_s - state.gyroscope_bias_rad_s);
  return common::Pose3{state.rotation_odom_body * common::expSO3(turn_body_rad),
                       state.position_odom_m + ahead_s * state.velocity_odom_m_s};
}

}  // namespace

StateHistory::StateHistory(const FusionConfig& config)
    : step_(config),
      length_(Duration::fromSeconds(kHistory_s)),
      attitude_period_s_(1.0 / config.attitude_rate_hz),
      ring_(static_cast<std::size_t>(std::ceil(kHistory_s * kRingRate_hz)) + 2),
      measurements_(kMeasurementCapacity) {}

void StateHistory::start(const Slot& first) {
  oldest_ = 0;
  count_ = 1;
  dirty_from_ = 1;
  ring_[0] = first;
  measurements_.clear();
  last_attitude_ = first.imu.stamp;
  diverged_ = false;
}

void StateHistory::push(const common::ImuSample& sample, bool at_rest, bool predicted) {
  const Time now = sample.stamps.measured;
  replay(count_);  // The oldest state must be up to date before it may be dropped.
  if (count_ == ring_.size()) dropOldest();
  // Samples older than the configured length are dropped even if the ring has room, so that the greatest delay does not
  // depend on the IMU's rate.
  while (count_ > 2 && now - slot(1).imu.stamp > length_ && dirty_from_ > 1) dropOldest();
  measurements_.dropUntil(slot(0).imu.stamp);
  Slot& s = slot(count_);
  s.imu = {now, sample.angular_velocity_body_rad_s, sample.specific_force_body_m_s2};
  if (!predicted && !slot(count_ - 1).predicted) measureNoise(slot(count_ - 1).imu, s.imu);
  s.accelerometer_noise_m_s2_rthz = std::sqrt(accelerometer_noise2_m2_s3_);
  s.at_rest = at_rest;
  s.predicted = predicted;
  s.up_body = sample.rotation_ahrs_body.conjugate() * Eigen::Vector3d::UnitZ();
  s.ahrs_yaw_rad = common::yawOf(sample.rotation_ahrs_body);
  s.attitude_due = (now - last_attitude_).seconds() >= attitude_period_s_ - 1e-6;
  if (s.attitude_due) last_attitude_ = now;
  dirty_from_ = std::min(dirty_from_, count_);
  ++count_;
  replay(count_);
}

/// The vehicle's own motion changes little from one sample to the next, so the differences between them are noise: the
/// variance of a difference is twice that of a sample.
void StateHistory::measureNoise(const ImuValue& before, const ImuValue& now) {
  // The noise is averaged over 100 samples of the autopilot's IMU. A longer step is a gap, whose difference is motion.
  constexpr double kMean_s = 0.5, kLongestStep_s = 0.05;
  const double step_s = (now.stamp - before.stamp).seconds();
  if (!(step_s > 0.0) || step_s > kLongestStep_s) return;
  const double variance_m2_s4 = (now.specific_force_body_m_s2 - before.specific_force_body_m_s2).squaredNorm() / 6.0;
  accelerometer_noise2_m2_s3_ +=
      std::min(1.0, step_s / kMean_s) * (variance_m2_s4 * step_s - accelerometer_noise2_m2_s3_);
}

void StateHistory::dropOldest() {
  SWIFTLET_CHECK(dirty_from_ > 0, dirty_from_);
  oldest_ = (oldest_ + 1) % ring_.size();
  --count_;
  --dirty_from_;
}

Insertion StateHistory::insert(const Measurement& measurement) {
  if (count_ == 0 || measurement.stamp <= slot(0).imu.stamp) return Insertion::kTooOld;
  if ((measurement.stamp - newestStamp()).seconds() > kMaxAhead_s) return Insertion::kTooNew;
  if (!measurements_.insert(measurement)) return Insertion::kTooOld;
  std::size_t first = count_;
  while (first > 1 && slot(first - 1).imu.stamp >= measurement.stamp) --first;
  dirty_from_ = std::min(dirty_from_, first);
  return Insertion::kTaken;
}

void StateHistory::replay(std::size_t until) {
  if (dirty_from_ >= until) return;
  SWIFTLET_CHECK(dirty_from_ > 0, until);
  replays_ += std::min(until, count_ - 1) - dirty_from_;
  for (std::size_t i = dirty_from_; i < until; ++i) {
    const Slot& before = slot(i - 1);
    Slot& now = slot(i);
    step_.advance(before, measurements_.within(before.imu.stamp, now.imu.stamp), now);
  }
  dirty_from_ = until;
  diverged_ = diverged_ || slot(until - 1).state.diverged;
}

const Slot& StateHistory::newest() {
  replay(count_);
  return slot(count_ - 1);
}

bool StateHistory::holdsClone(Time time) const {
  return count_ > 0 && (measurements_.holdsClone(time) || slot(count_ - 1).state.cloneAt(time) >= 0);
}

std::optional<common::Pose3> StateHistory::poseAt(Time time) {
  if (count_ == 0 || time < slot(0).imu.stamp) return std::nullopt;
  if (time >= newestStamp()) {
    const Slot& last = newest();
    if ((time - last.imu.stamp).seconds() > kMaxExtrapolation_s) return std::nullopt;
    return extrapolated(last, time);
  }
  std::size_t low = 0, high = count_ - 1;  // slot(low).stamp <= time < slot(high).stamp
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (slot(middle).imu.stamp <= time ? low : high) = middle;
  }
  replay(high + 1);
  const FilterState& a = slot(low).state;
  const FilterState& b = slot(high).state;
  const common::Pose3 begin{a.rotation_odom_body, a.position_odom_m}, end{b.rotation_odom_body, b.position_odom_m};
  // A measurement between the two samples makes the estimate jump. Before the jump the pose is extrapolated from the
  // earlier state, after it from the later one.
  const auto measured = measurements_.within(a.stamp, b.stamp);
  if (measured.empty()) return common::blended(begin, end, (time - a.stamp).seconds() / (b.stamp - a.stamp).seconds());
  return extrapolated(slot(time < measured.front().stamp ? low : high), time);
}

std::optional<VerticalState> StateHistory::verticalAt(Time time) {
  const auto pose = poseAt(time);
  if (!pose) return std::nullopt;
  std::size_t at = count_ - 1;
  while (at > 0 && slot(at).imu.stamp > time) --at;
  const FilterState& state = slot(at).state;
  VerticalState vertical{pose->position_m.z(), state.velocity_odom_m_s.z(), state.accelerometer_bias_m_s2.z(), {}};
  constexpr int kVertical[] = {kPosition + 2, kVelocity + 2, kAccelerometerBias + 2};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) vertical.covariance(i, k) = state.covariance(kVertical[i], kVertical[k]);
  return vertical;
}

std::optional<InertialClimb> StateHistory::climb(Time from, Time to) {
  if (count_ == 0 || from < slot(0).imu.stamp || (to - newestStamp()).seconds() > kMaxExtrapolation_s)
    return std::nullopt;
  replay(count_);
  InertialClimb climb;
  double noise2 = 0.0;
  Time begin = from;
  for (std::size_t i = 1; i <= count_ && begin < to; ++i) {
    const Slot& s = slot(std::min(i, count_ - 1));  // Beyond the newest sample it is taken to go on.
    const Time end = i < count_ ? std::min(s.imu.stamp, to) : to;
    if (end <= begin) continue;
    const double dt_s = (end - begin).seconds();
    const Eigen::Vector3d up_body = s.state.rotation_odom_body.conjugate() * Eigen::Vector3d::UnitZ();
    Eigen::Vector3d force_m_s2 = s.imu.specific_force_body_m_s2;
    force_m_s2.head<2>() -= s.state.accelerometer_bias_m_s2.head<2>();
    const double up_m_s2 = up_body.dot(force_m_s2) - step_.gravity_m_s2();
    climb.height_m += dt_s * (climb.velocity_m_s + 0.5 * dt_s * up_m_s2);
    climb.velocity_m_s += dt_s * up_m_s2;
    noise2 += dt_s * common::square(step_.accelerometerNoise_m_s2_rthz(s));
    begin = end;
  }
  if (to > from) climb.noise_m_s2_rthz = std::sqrt(noise2 / (to - from).seconds());
  return climb;
}

PoseHistory StateHistory::motion(Time from, Time to) {
  std::vector<common::StampedPose> poses;
  std::vector<Eigen::Vector3d> velocities_m_s;
  if (count_ == 0) return {};
  replay(count_);
  for (std::size_t i = 0; i < count_; ++i) {
    const FilterState& s = slot(i).state;
    const bool ends_before = i + 1 < count_ && slot(i + 1).state.stamp <= from;
    if (ends_before) continue;
    poses.push_back({s.stamp, {s.rotation_odom_body, s.position_odom_m}});
    velocities_m_s.push_back(s.velocity_odom_m_s);
    if (s.stamp >= to) break;
  }
  for (std::size_t i = poses.size(); i-- > 1;) {
    const Eigen::Vector3d mean_m_s = 0.5 * (velocities_m_s[i - 1] + velocities_m_s[i]);
    poses[i - 1].pose.position_m =
        poses[i].pose.position_m - (poses[i].stamp - poses[i - 1].stamp).seconds() * mean_m_s;
  }
  if (!poses.empty() && poses.back().stamp < to) {
    const Time end = std::min(to, poses.back().stamp + Duration::fromSeconds(kMaxExtrapolation_s));
    if (const auto pose = poseAt(end)) poses.push_back({end, *pose});
  }
  return PoseHistory(std::move(poses));
}

}  // namespace swiftlet::perception::fusion
