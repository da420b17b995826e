#include "mapping3d/odometry/rgbd_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/LU>

#include "common/config_fields.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;

/// A velocity is not extrapolated over a longer gap.
constexpr double kLongestPrediction_s = 0.5;
/// Key frames that are tried for each frame while lost: each costs a millisecond or two.
constexpr std::size_t kTriedPerFrame = 8;

}  // namespace

void RgbdOdometryConfig::describe(common::config::Fields& fields) {
  fields("greatest_width_px", greatest_width_px, {80, 2000}, "Wider pictures are halved until they are not.");
  fields("levels", levels, {1, 8}, "Levels of the pyramid.");
  fields("least_agreement", least_agreement, {0.1, 1.0},
         "Part of the points whose depth must agree; a frame with less is not tracked.");
  fields("least_points", least_points, {10, 100'000}, "So many points must agree.");
  fields("least_correlation", least_correlation, {-1, 1},
         "The grey values must correlate with those of the map so much, if there is texture.");
  fields("acceleration_m_s2", acceleration_m_s2, {0.1, 1000},
         "Standard deviation of the acceleration; it bounds the steps where little is seen.");
  fields("angular_acceleration_rad_s2", angular_acceleration_rad_s2, {0.1, 1000},
         "Standard deviation of the angular acceleration, the same.");
  fields.section("features", features, "Features of a picture.");
  fields.section("reference", reference, "Points of a key frame that later frames are aligned to.");
  fields.section("alignment", alignment, "Alignment of a frame to key frames.");
  fields.section("key_frames", key_frames, "Choice of key frames.");
  fields.section("recognition", recognition, "Finding the place again after the track was lost.");
}

RgbdOdometry::RgbdOdometry(const RgbdOdometryConfig& config) : config_(config), keys_(config.key_frames) {}

std::vector<Pose3> RgbdOdometry::predictions(common::Time stamp, const std::optional<Pose3>& T_seed_camera) const {
  std::vector<Pose3> poses;
  const double gap_s = (stamp - last_->stamp).seconds();
  if (gap_s > 0.0 && gap_s < kLongestPrediction_s)
    poses.push_back(last_->T_map_camera *
                    Pose3{common::expSO3(gap_s * last_->rate_camera_rad_s), gap_s * last_->velocity_camera_m_s});
  if (T_seed_camera && last_->T_seed_camera)
    poses.push_back(last_->T_map_camera * (last_->T_seed_camera->inverse() * *T_seed_camera));
  poses.push_back(last_->T_map_camera);
  return poses;
}

Pose3 RgbdOdometry::bestOf(const std::vector<Pose3>& poses, const FramePyramid& pyramid) const {
  Pose3 best = poses.front();
  double best_score = -std::numeric_limits<double>::infinity();
  for (const Pose3& pose : poses) {
    const auto views = keys_.views(keys_.overlapping(pyramid.back().camera, pose));
    if (views.empty()) continue;
    const Alignment fit =
        judgePose(pyramid, views, pose, last_->exposure, config_.features.depth_noise, config_.alignment);
    const double score = fit.overlap * fit.agreement * (1.0 + fit.correlation);
    if (score <= best_score) continue;
    best_score = score;
    best = pose;
  }
  return best;
}

bool RgbdOdometry::isGood(const Alignment& fit) const {
  return fit.agreement >= config_.least_agreement && fit.points >= config_.least_points &&
         fit.correlation >= config_.least_correlation;
}

PosePrior RgbdOdometry::motionPrior(common::Time stamp, const Pose3& predicted) const {
  PosePrior prior{predicted, Matrix6d::Zero()};
  const double gap_s = (stamp - last_->stamp).seconds();
  if (gap_s <= 0.0) return prior;
  const double sigma_m = 0.5 * config_.acceleration_m_s2 * gap_s * gap_s;
  const double sigma_rad = 0.5 * config_.angular_acceleration_rad_s2 * gap_s * gap_s;
  prior.information.diagonal().head<3>().setConstant(1.0 / (sigma_m * sigma_m));
  prior.information.diagonal().tail<3>().setConstant(1.0 / (sigma_rad * sigma_rad));
  return prior;
}

std::optional<Alignment> RgbdOdometry::tracked(const FramePyramid& pyramid, const PosePrior& prior,
                                               std::vector<std::size_t>& keys) const {
  keys = keys_.overlapping(pyramid.back().camera, prior.T_map_camera);
  if (keys.empty()) return std::nullopt;
  const Alignment fit =
      align(pyramid, keys_.views(keys), prior, last_->exposure, config_.features.depth_noise, config_.alignment);
  if (!isGood(fit)) return std::nullopt;
  return fit;
}

std::optional<Alignment> RgbdOdometry::recognized(const FramePyramid& pyramid,
                                                  const std::vector<DescribedPoint>& points,
                                                  std::vector<std::size_t>& keys) {
  // The newest first, then the others in turn, so that each is tried within some frames.
  std::vector<std::size_t> order;
  const std::size_t newest = std::min<std::size_t>(keys_.size(), kTriedPerFrame / 2);
  for (std::size_t i = 0; i < newest; ++i) order.push_back(keys_.size() - 1 - i);
  for (std::size_t i = newest; i < std::min(keys_.size(), kTriedPerFrame); ++i)
    order.push_back(next_tried_++ % (keys_.size() - newest));
  for (const std::size_t index : order) {
    const KeyFrame& key = keys_.at(index);
    const auto found = registerPoints(key.described, points, frames_, config_.recognition);
    if (!found) continue;
    const PosePrior prior{key.T_map_key * found->T_a_b, Matrix6d::Zero()};
    if (auto fit = tracked(pyramid, prior, keys)) return fit;
  }
  return std::nullopt;
}

void RgbdOdometry::addKeyFrame(const RgbdPose& pose, const FramePyramid& pyramid,
                               const std::vector<vision::Feature>& features) {
  auto key = std::make_shared<KeyFrame>();
  key->stamp = pose.stamp;
  key->T_map_key = pose.T_map_camera;
  const auto gain = static_cast<float>(pose.fit.exposure.gain), offset = static_cast<float>(pose.fit.exposure.offset);
  for (const PyramidLevel& level : pyramid) {
    key->levels.push_back(referencePoints(level, config_.features.depth_noise, config_.reference));
    for (ReferencePoint& point : key->levels.back()) point.gray = (point.gray - offset) / gain;
  }
  key->described = describedPoints(pyramid.front().gray, features);
  key->median_depth_m = medianDepth_m(key->levels.back());
  keys_.add(std::move(key));
}

void RgbdOdometry::remember(const RgbdPose& pose, const std::optional<Pose3>& T_seed_camera) {
  Last next{pose.stamp, pose.T_map_camera, T_seed_camera, pose.fit.exposure, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  if (last_ && pose.state == TrackState::kTracked) {
    const double gap_s = (pose.stamp - last_->stamp).seconds();
    const Pose3 step = last_->T_map_camera.inverse() * pose.T_map_camera;
    if (gap_s > 0.0) {
      next.velocity_camera_m_s = step.position_m / gap_s;
      next.rate_camera_rad_s = common::logSO3(step.rotation) / gap_s;
    }
  }
  last_ = next;
}

RgbdPose RgbdOdometry::process(const common::RgbdFrame& frame, const std::optional<Pose3>& T_seed_camera) {
  ++frames_;
  const FramePyramid pyramid = makePyramid(frame, config_.greatest_width_px, config_.levels);
  const auto features = [&] {
    return vision::findFeatures(pyramid.front().gray, pyramid.front().depth, pyramid.front().camera, config_.features);
  };
  RgbdPose pose;
  pose.stamp = frame.stamps.measured;
  if (keys_.isEmpty()) {
    pose.state = TrackState::kTracked;
    if (T_seed_camera) pose.T_map_camera = *T_seed_camera;
    addKeyFrame(pose, pyramid, features());
    pose.became_key_frame = true;
    remember(pose, T_seed_camera);
    return pose;
  }
  std::vector<std::size_t> keys;
  std::optional<Alignment> fit;
  const Pose3 predicted = bestOf(predictions(pose.stamp, T_seed_camera), pyramid);
  if (!is_lost_) fit = tracked(pyramid, motionPrior(pose.stamp, predicted), keys);
  if (!fit) fit = recognized(pyramid, describedPoints(pyramid.front().gray, features()), keys);
  if (!fit) {
    is_lost_ = true;
    pose.T_map_camera = predicted;
    return pose;
  }
  pose.state = is_lost_ ? TrackState::kFoundAgain : TrackState::kTracked;
  is_lost_ = false;
  pose.fit = *fit;
  pose.T_map_camera = fit->T_map_camera;
  pose.covariance = fit->information.inverse();
  keys_.markUsed(keys);
  if (keys_.needsNew(keys, pose.T_map_camera, fit->overlap)) {
    addKeyFrame(pose, pyramid, features());
    pose.became_key_frame = true;
  }
  remember(pose, T_seed_camera);
  return pose;
}

}  // namespace swiftlet::mapping3d
