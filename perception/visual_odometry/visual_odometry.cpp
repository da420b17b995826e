#include "perception/visual_odometry/visual_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/small_matrices.hpp"
#include "vision/binary_descriptor.hpp"
#include "vision/gray_image.hpp"

namespace swiftlet::perception {
namespace {

using common::Message;
using common::Pose3;

/// Corners of a frame, at most. Twice as many cost four times the time and gain little: the floor below decides.
constexpr int kCorners = 250;
/// Corners with a place that a motion rests on, at least: as many as a consensus needs.
constexpr int kLeastPairs = 15;
/// What a motion is off by, however many corners there are: rectification, rounding, and the pixels of corners on
/// slanted surfaces.
constexpr double kFloor_m = 0.001, kFloor_rad = 0.0005;
/// And for each metre and radian of it, by errors of focal length and base of a percent.
constexpr double kShareOfMotion = 0.01;
/// A frame that shows less than this share of the corners that another frame shared with the key frame replaces it
/// soon.
constexpr double kLeastShown = 0.6;
/// A motion is continued for this long, and changes within it by less than vision::Expectation allows: at 1 m by 15 cm
/// or 9 degrees, three times what accelerations of 1 m/s^2 and 1 rad/s^2 do between two frames at 4 Hz.
constexpr double kContinued_s = 0.7;
/// Two depths of one corner differ by less than three standard deviations; each has one.
constexpr double kAgreeingSigmas = 3.0 * 1.4142;

Eigen::Matrix<double, 6, 6> withFloor(Eigen::Matrix<double, 6, 6> covariance, const Pose3& T_from_to) {
  const double position_m = kShareOfMotion * T_from_to.position_m.norm();
  const double turn_rad = kShareOfMotion * common::logSO3(T_from_to.rotation).norm();
  covariance.diagonal().head<3>().array() += kFloor_m * kFloor_m + position_m * position_m;
  covariance.diagonal().tail<3>().array() += kFloor_rad * kFloor_rad + turn_rad * turn_rad;
  return covariance;
}

}  // namespace

double deviation_m(const Eigen::Matrix<double, 6, 6>& covariance) {
  constexpr double kArm_m = 1.0;
  const Eigen::Vector3d position_m2 = common::symmetricEigenvalues(Eigen::Matrix3d(covariance.topLeftCorner<3, 3>()));
  const Eigen::Vector3d turn_rad2 = common::symmetricEigenvalues(Eigen::Matrix3d(covariance.bottomRightCorner<3, 3>()));
  return std::sqrt(position_m2[2] + kArm_m * kArm_m * turn_rad2[2]);
}

VisualOdometry::VisualOdometry(const vision::DepthNoiseConfig& noise) {
  features_.depth_noise = noise;
  features_.corners.greatest_number = kCorners;
  agreement_.slope_1_m = std::max(agreement_.slope_1_m, kAgreeingSigmas * noise.sigma_per_m2);
}

VisualOdometry::Seen VisualOdometry::look(const common::RgbdFrame& frame, Message& missing) const {
  Seen seen{frame.stamps.measured, {}, {}};
  const vision::GrayImage gray = vision::grayOf(frame.color);
  const auto features = vision::findFeatures(gray, frame.depth, frame.camera, features_);
  for (const auto& [i, descriptor] : vision::describedPatches(gray, features)) {
    seen.described.push_back({features[i].mean_camera_m, descriptor});
    seen.points.push_back({features[i].mean_camera_m, features[i].covariance_camera_m2});
  }
  if (static_cast<int>(seen.points.size()) >= kLeastPairs) return seen;
  const std::size_t corners = vision::findCorners(gray, features_.corners).size();
  if (static_cast<int>(corners) < 2 * kLeastPairs)
    missing = Message("visual-odometry.too-little-texture", "the picture has {} corners, and {} are needed", corners,
                      2 * kLeastPairs);
  else
    missing = Message("visual-odometry.no-depth",
                      "{} of {} corners have a depth, and {} are needed: what is seen is nearer than {:.2f} m, or seen "
                      "by one camera alone",
                      seen.points.size(), corners, kLeastPairs, features_.depth_noise.nearest_m);
  return seen;
}

VisualStep VisualOdometry::add(const common::RgbdFrame& frame) {
  VisualStep step;
  step.stamp = frame.stamps.measured;
  const auto seen = std::make_shared<const Seen>(look(frame, step.missing));
  if (!step.missing.name().empty()) return step;
  const Pose3 T_start_expected = track_ ? track_->at(seen->stamp) : Pose3();
  Pose3 T_start_camera = T_start_expected;
  KeyFrame* best = nullptr;
  for (KeyFrame& key : keys_) {
    auto motion = motionSince(key, *seen, T_start_expected);
    if (!motion) continue;
    key.most_pairs = std::max(key.most_pairs, motion->pairs);
    if (step.motion && deviation_m(step.motion->covariance) <= deviation_m(motion->covariance)) continue;
    step.motion = std::move(motion);
    best = &key;
    T_start_camera = key.T_start_camera * step.motion->T_from_to;
  }
  if (!step.motion && !keys_.empty())
    step.missing = Message("visual-odometry.no-overlap",
                           "of {} corners too few are those of a key frame: the view has moved on, or is blurred",
                           seen->points.size());
  step.became_key_frame = isWorthKeeping(step.motion, best);
  if (!track_) track_ = Track{seen->stamp, T_start_camera};
  track_->moveTo(T_start_camera, seen->stamp);
  if (step.became_key_frame) {
    keys_.push_back({seen, T_start_camera, 0});
    if (keys_.size() > kKeyFrames) keys_.pop_front();
  }
  return step;
}

std::optional<VisualMotion> VisualOdometry::motionSince(const KeyFrame& key, const Seen& seen,
                                                        const Pose3& T_start_camera) const {
  const auto seed = static_cast<std::uint64_t>(seen.stamp.nanoseconds());
  const vision::Expectation expectation{key.T_start_camera.inverse() * T_start_camera};
  auto found = vision::registerPairs(key.seen->described, seen.described, seed, agreement_, expectation);
  if (!found) found = vision::registerPairs(key.seen->described, seen.described, seed, agreement_);
  if (!found) return std::nullopt;
  std::vector<PointPair> pairs;
  for (const auto& [i, j] : found->pairs) pairs.push_back({key.seen->points[i], seen.points[j]});
  const auto fit = refined(pairs, found->T_a_b, kLeastPairs);
  if (!fit) return std::nullopt;
  return VisualMotion{key.seen->stamp, seen.stamp, fit->T_from_to, withFloor(fit->covariance, fit->T_from_to),
                      fit->pairs};
}

/// The view of the best key frame is being left, or none is in view.
bool VisualOdometry::isWorthKeeping(const std::optional<VisualMotion>& motion, const KeyFrame* by) const {
  return !motion || motion->pairs < kLeastShown * by->most_pairs;
}

/// After a longer gap it may have done anything, and is expected where it was.
Pose3 VisualOdometry::Track::at(common::Time time) const {
  const double gap_s = (time - stamp).seconds();
  if (gap_s > kContinued_s) return T_start_camera;
  return T_start_camera * Pose3{common::expSO3(gap_s * rate_camera_rad_s), gap_s * velocity_camera_m_s};
}

void VisualOdometry::Track::moveTo(const Pose3& T_start_now, common::Time time) {
  const double gap_s = (time - stamp).seconds();
  const Pose3 moved = T_start_camera.inverse() * T_start_now;
  const bool is_continued = gap_s > 0.0 && gap_s <= kContinued_s;
  velocity_camera_m_s = is_continued ? Eigen::Vector3d(moved.position_m / gap_s) : Eigen::Vector3d::Zero();
  rate_camera_rad_s = is_continued ? Eigen::Vector3d(common::logSO3(moved.rotation) / gap_s) : Eigen::Vector3d::Zero();
  T_start_camera = T_start_now;
  stamp = time;
}

}  // namespace swiftlet::perception
