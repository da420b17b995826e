#include "mapping3d/odometry/recorded_seeds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include "common/normal_distribution.hpp"
#include "common/small_matrices.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;

/// Poses are at most so late, or so early; and the resolution of the lateness (docs/decisions/run_time.md#052).
constexpr double kLongestLateness_s = 0.3, kLatenessStep_s = 0.01;
/// Another lateness must lessen the difference from the track by this share, or it is not believed
/// (docs/decisions/run_time.md#052).
constexpr double kLatenessGain = 0.1;
/// The lateness is searched over steps of this length (docs/decisions/run_time.md#052).
constexpr double kStretch_s = 0.3;
/// The last so many tracked frames tell how good the poses are.
constexpr std::size_t kFrames = 300;
/// Before so many steps, poses are only where an alignment may begin.
constexpr std::size_t kLeastSteps = 10;
/// Standard deviations of the speed and of the angular rate that a step from pose to pose has, at least.
constexpr double kSpeedFloor_m_s = 0.03, kRateFloor_rad_s = 0.02;
/// A frame that is less certain of its pose along some direction is not compared with a seed.
constexpr double kLeastCertain_m = 0.01;
constexpr double kLeastCertain_rad = 0.005;
/// Learning after each frame would cost more than it gains.
constexpr std::uint64_t kLearnEvery = 10;

/// Errors of neighbouring points are alike, so that an alignment is less certain than independent points would make it.
constexpr double kSigmaFactor = 5.0;

constexpr double kJudgedStretch_s = 1.0;
/// Poses of other sensors may be off by this much after a stretch, and by a part of the motion.
constexpr double kTolerated_m = 0.1;
constexpr double kTolerated_rad = 0.1;
constexpr double kToleratedPart = 0.5;

/// By the frame alone, without what was known before.
bool isCertain(const Alignment& fit) {
  const Matrix6d covariance = kSigmaFactor * kSigmaFactor * fit.measured_information.inverse();
  if (!covariance.allFinite()) return false;
  const Eigen::Matrix3d shift = covariance.topLeftCorner<3, 3>(), turn = covariance.bottomRightCorner<3, 3>();
  return common::symmetricEigenvalues(shift)(2) < kLeastCertain_m * kLeastCertain_m &&
         common::symmetricEigenvalues(turn)(2) < kLeastCertain_rad * kLeastCertain_rad;
}

struct StepError {
  Eigen::Vector3d shift_m, turn_rad;  ///< In the axes of the seeds' map.
};

StepError stepError(const Pose3& tracked_from, const Pose3& tracked_to, const Pose3& seed_from, const Pose3& seed_to) {
  const Pose3 error = (seed_from.inverse() * seed_to).inverse() * (tracked_from.inverse() * tracked_to);
  return {seed_to.rotation * error.position_m, seed_to.rotation * common::logSO3(error.rotation)};
}

double medianOf(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

bool SeedDisagreement::isContradiction() const {
  return error_m > std::max(kTolerated_m, kToleratedPart * motion_m) ||
         error_rad > std::max(kTolerated_rad, kToleratedPart * motion_rad);
}

std::optional<Pose3> RecordedSeeds::poseAt(common::Time stamp, double lateness_s) const {
  return common::poseAt(poses_, stamp + common::Duration::fromSeconds(lateness_s),
                        common::Duration::fromSeconds(kLongestGap_s));
}

std::optional<CameraSeed> RecordedSeeds::at(common::Time stamp) const {
  const auto pose = poseAt(stamp, lateness_s_);
  if (!pose) return std::nullopt;
  return CameraSeed{*pose, 0, false, rate_covariance_};
}

void RecordedSeeds::compare(const RgbdPose& pose) {
  if (!pose.isTracked()) return;
  judged_.push_back({pose.stamp, pose.T_map_camera});
  if (judged_.size() > kFrames) judged_.pop_front();
  if (!pose.measured || !isCertain(pose.fit)) return;
  tracked_.push_back({pose.stamp, pose.T_map_camera});
  if (tracked_.size() > kFrames) tracked_.pop_front();
  if (++compared_ % kLearnEvery != 0) return;
  learnLateness();
  learnSpread();
}

std::vector<RecordedSeeds::Stretch> RecordedSeeds::stretches(const std::deque<Tracked>& frames, double length_s,
                                                             double lateness_s) const {
  std::vector<Stretch> found;
  std::size_t to = 0;
  for (const Tracked& from : frames) {
    while (to < frames.size() && (frames[to].stamp - from.stamp).seconds() < length_s) ++to;
    if (to == frames.size()) break;
    const auto seed_from = poseAt(from.stamp, lateness_s), seed_to = poseAt(frames[to].stamp, lateness_s);
    if (!seed_from || !seed_to) continue;
    found.push_back({from.T_map_camera.inverse() * frames[to].T_map_camera, seed_from->inverse() * *seed_to});
  }
  return found;
}

/// Mean length of the errors over stretches; a turn of one radian counts as one metre.
std::optional<double> RecordedSeeds::misfit(double lateness_s) const {
  const std::vector<Stretch> steps = stretches(tracked_, kStretch_s, lateness_s);
  if (steps.size() < kLeastSteps) return std::nullopt;
  double sum = 0.0;
  for (const Stretch& step : steps) {
    const Pose3 error = step.seed.inverse() * step.tracked;
    sum += error.position_m.norm() + common::logSO3(error.rotation).norm();
  }
  return sum / static_cast<double>(steps.size());
}

std::optional<SeedDisagreement> RecordedSeeds::disagreement() const {
  if (judged_.empty()) return std::nullopt;
  const double tracked_s = (judged_.back().stamp - judged_.front().stamp).seconds();
  const double stretch_s = std::min(kJudgedStretch_s, 0.5 * tracked_s);
  const std::vector<Stretch> steps = stretches(judged_, stretch_s, lateness_s_);
  if (steps.size() < kLeastSteps) return std::nullopt;
  std::vector<double> errors_m, errors_rad, motions_m, motions_rad;
  for (const Stretch& step : steps) {
    const Pose3 error = step.seed.inverse() * step.tracked;
    errors_m.push_back(error.position_m.norm());
    errors_rad.push_back(common::logSO3(error.rotation).norm());
    motions_m.push_back(step.tracked.position_m.norm());
    motions_rad.push_back(common::logSO3(step.tracked.rotation).norm());
  }
  return SeedDisagreement{stretch_s, medianOf(errors_m), medianOf(errors_rad), medianOf(motions_m),
                          medianOf(motions_rad)};
}

void RecordedSeeds::learnLateness() {
  const auto now = misfit(lateness_s_);
  if (!now) return;
  double least = *now, best_s = lateness_s_;
  const int half = static_cast<int>(std::lround(kLongestLateness_s / kLatenessStep_s));
  for (int i = -half; i <= half; ++i) {
    const double lateness_s = i * kLatenessStep_s;
    const auto there = misfit(lateness_s);
    if (!there || *there >= least) continue;
    least = *there;
    best_s = lateness_s;
  }
  if (least < (1.0 - kLatenessGain) * *now) lateness_s_ = best_s;
}

void RecordedSeeds::learnSpread() {
  std::array<std::vector<double>, 6> rates;
  for (std::size_t i = 1; i < tracked_.size(); ++i) {
    const double gap_s = (tracked_[i].stamp - tracked_[i - 1].stamp).seconds();
    const auto from = poseAt(tracked_[i - 1].stamp, lateness_s_), to = poseAt(tracked_[i].stamp, lateness_s_);
    if (!from || !to || gap_s <= 0.0 || gap_s > kLongestGap_s) continue;
    const StepError error = stepError(tracked_[i - 1].T_map_camera, tracked_[i].T_map_camera, *from, *to);
    for (int axis = 0; axis < 3; ++axis) {
      rates[static_cast<std::size_t>(axis)].push_back(std::abs(error.shift_m[axis]) / gap_s);
      rates[static_cast<std::size_t>(axis + 3)].push_back(std::abs(error.turn_rad[axis]) / gap_s);
    }
  }
  if (rates.front().size() < kLeastSteps) return;
  rate_covariance_ = Matrix6d::Zero();
  for (int axis = 0; axis < 6; ++axis) {
    const double floor = axis < 3 ? kSpeedFloor_m_s : kRateFloor_rad_s;
    const double sigma = std::max(floor, common::kSigmaOfMedian * medianOf(rates[static_cast<std::size_t>(axis)]));
    (*rate_covariance_)(axis, axis) = sigma * sigma;
  }
}

}  // namespace swiftlet::mapping3d
