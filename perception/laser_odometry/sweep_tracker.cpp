#include "perception/laser_odometry/sweep_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swiftlet::perception {
namespace {

using common::Pose2;

constexpr std::size_t kAhead = 2;      ///< Sweeps that are fitted before one is taken.
constexpr std::size_t kReference = 6;  ///< Taken sweeps that others are fitted to.
constexpr int kFirstRounds = 4;        ///< Rounds in which the first sweeps are fitted to each other.
/// Turn rates that are tried differ by this, and by as much as this from the expected one.
constexpr double kRateStep_rad_s = 0.2, kRateChange_rad_s = 4.0, kFirstRate_rad_s = 3.0;
/// What a change of the turn rate must gain in fit, per rad/s.
constexpr double kRatePenalty_s = 0.02;
/// The track is lost at a sweep that fits worse. Those of the recorded logs fit by 0.98 and more, and by 0.5
/// and less from where it is lost.
constexpr double kLeastFit = 0.8;
/// After a pause longer than this many sweeps, the velocity before it says nothing of the velocity after it.
constexpr double kLongestPause = 3.0;

Pose2 moved(const Pose2& pose, const Eigen::Vector3d& velocity, double seconds) {
  return {pose.x_m + velocity.x() * seconds, pose.y_m + velocity.y() * seconds, pose.yaw_rad + velocity.z() * seconds};
}

}  // namespace

void SweepTracker::add(std::vector<SweptPoint> points, common::Time start, double duration_s) {
  Timed timed{{std::move(points), duration_s, uniformMotion({}, Eigen::Vector3d::Zero(), duration_s)}, start};
  sweeps_.push_back(std::move(timed));
  if (begun_) {
    follow();
    loseUnlessFitting(sweeps_.size() - 1);
  } else if (sweeps_.size() > kAhead)
    begin();
}

void SweepTracker::finish() {
  if (!begun_ && !sweeps_.empty()) begin();
  finished_ = true;
}

bool SweepTracker::hasNext() const {
  return lost_ > 0 || (begun_ && taken_ < sweeps_.size() && (finished_ || sweeps_.size() - taken_ > kAhead));
}

std::optional<SweepMotion> SweepTracker::take() {
  if (lost_ > 0) {
    --lost_;
    return std::nullopt;
  }
  const SweepMotion motion = sweeps_[taken_].sweep.motion;
  ++taken_;
  while (taken_ > kReference) {
    sweeps_.pop_front();
    --taken_;
  }
  return motion;
}

double SweepTracker::fitOfNext() const {
  if (lost_ > 0) return 0.0;
  const Sweep& sweep = sweeps_[taken_].sweep;
  return fitOf(referenceWithout(taken_), sweep, sweep.motion);
}

/// Looks at the sweeps from `first` on.
void SweepTracker::loseUnlessFitting(std::size_t first) {
  for (std::size_t i = first; i < sweeps_.size(); ++i) {
    const Sweep& sweep = sweeps_[i].sweep;
    if (sweep.points.empty() || fitOf(referenceWithout(i), sweep, sweep.motion) >= kLeastFit) continue;
    lost_ += sweeps_.size() - taken_;
    sweeps_.clear();
    taken_ = 0;
    begun_ = false;
    return;
  }
}

OrientedPoints SweepTracker::referenceWithout(std::size_t index) const {
  OrientedPoints reference;
  for (std::size_t i = 0; i < sweeps_.size(); ++i)
    if (i != index) addSweep(sweeps_[i].sweep, reference);
  reference.sort();
  return reference;
}

/// What the previous sweep says of the beginning of this one.
std::optional<SweepEnd> SweepTracker::before(std::size_t index) const {
  if (index == 0) return std::nullopt;
  const Timed &last = sweeps_[index - 1], &now = sweeps_[index];
  const double duration_s = last.sweep.duration_s;
  const double pause_s = std::clamp((now.start - last.start).seconds() - duration_s, 0.0, kLongestPause * duration_s);
  const Eigen::Vector3d velocity = last.sweep.lastVelocity();
  return SweepEnd{moved(last.sweep.motion.knots.back(), velocity, pause_s), velocity};
}

std::optional<SweepEnd> SweepTracker::after(std::size_t index) const {
  if (index + 1 >= sweeps_.size()) return std::nullopt;
  const Timed &now = sweeps_[index], &next = sweeps_[index + 1];
  const double duration_s = now.sweep.duration_s;
  const double pause_s = std::clamp((next.start - now.start).seconds() - duration_s, 0.0, kLongestPause * duration_s);
  const Eigen::Vector3d velocity = next.sweep.firstVelocity();
  return SweepEnd{moved(next.sweep.motion.knots.front(), velocity, -pause_s), velocity};
}

void SweepTracker::refit(std::size_t index, bool with_next) {
  Sweep& sweep = sweeps_[index].sweep;
  const std::optional<SweepEnd> next = with_next ? after(index) : std::nullopt;
  // No sweep precedes the first one, which defines the frame: its own first pose and mean velocity stand in.
  const SweepEnd last = before(index).value_or(SweepEnd{sweep.motion.knots.front(), sweep.meanVelocity()});
  fitSweep(referenceWithout(index), last, next, sweep);
}

/// The first sweeps: the constant turn rate at which the second fits the first best, then all are fitted to each other.
void SweepTracker::begin() {
  begun_ = true;
  if (sweeps_.size() < 2) return;
  Sweep &first = sweeps_[0].sweep, &second = sweeps_[1].sweep;
  const double apart_s = first.duration_s;
  double best_fit = -INFINITY;
  SweepMotion best_first, best_second;
  const int steps = static_cast<int>(kFirstRate_rad_s / kRateStep_rad_s);
  for (int i = -steps; i <= steps; ++i) {
    Eigen::Vector3d velocity(0.0, 0.0, i * kRateStep_rad_s);
    OrientedPoints reference;
    first.motion = uniformMotion({}, velocity, first.duration_s);
    addSweep(first, reference);
    reference.sort();
    const SweepMotion motion = uniformMotion(moved({}, velocity, apart_s), velocity, second.duration_s);
    const double fit = fitOf(reference, second, motion);
    if (fit <= best_fit) continue;
    best_fit = fit;
    best_first = first.motion;
    best_second = motion;
  }
  first.motion = best_first;
  second.motion = best_second;
  for (std::size_t i = 2; i < sweeps_.size(); ++i) {
    const SweepEnd last = *before(i);
    sweeps_[i].sweep.motion = uniformMotion(last.pose, last.velocity, sweeps_[i].sweep.duration_s);
  }
  for (int round = 0; round < kFirstRounds; ++round) {
    for (std::size_t i = 1; i < sweeps_.size(); ++i) refit(i, round > 0);
    refit(0, true);
  }
  loseUnlessFitting(0);
}

void SweepTracker::follow() {
  const std::size_t newest = sweeps_.size() - 1;
  Sweep& sweep = sweeps_[newest].sweep;
  const SweepEnd last = *before(newest);
  const OrientedPoints reference = referenceWithout(newest);
  double best_fit = -INFINITY;
  const int steps = static_cast<int>(kRateChange_rad_s / kRateStep_rad_s);
  for (int i = -steps; i <= steps; ++i) {
    Eigen::Vector3d velocity = last.velocity;
    velocity.z() += i * kRateStep_rad_s;
    const SweepMotion motion = uniformMotion(last.pose, velocity, sweep.duration_s);
    const double fit = fitOf(reference, sweep, motion) - kRatePenalty_s * std::abs(i * kRateStep_rad_s);
    if (fit <= best_fit) continue;
    best_fit = fit;
    sweep.motion = motion;
  }
  fitSweep(reference, last, std::nullopt, sweep);
  for (std::size_t i = newest; i-- > std::max<std::size_t>(taken_, 1);) refit(i, true);
}

}  // namespace swiftlet::perception
