#include "mapping3d/odometry/rgbd_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/LU>

#include "common/config_fields.hpp"
#include "mapping3d/odometry/found_place.hpp"
#include "vision/point_registration.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;

/// Least part of the points, and least number of them, whose depth agrees with the key frames in a frame that is
/// tracked.
constexpr double kLeastAgreement = 0.6;
constexpr int kLeastPoints = 150;
/// Least correlation of a frame's grey values with those of the key frames, where there is texture.
constexpr double kLeastCorrelation = 0.4;
/// After this many frames that do not fit, the key frames restart at the seed.
constexpr int kUnfitFrames = 5;
/// Key frames that are tried for each frame while lost: each costs a millisecond or two.
constexpr std::size_t kTriedPerFrame = 8;
/// For this long after its last frame, a lost camera is also aligned from where it was.
constexpr double kLongestAlignedGap_s = 1.0;
/// Where the texture alone decides whether a pose is right, it must fit well: right ones correlate by 0.9 and more,
/// wrong ones by less than 0.5.
constexpr double kLeastCorrelationAlone = 0.8;
/// Errors of neighbouring points are alike, so that a motion without a prior is less certain than independent points
/// would make it. The apparent information of a bare wall along itself then counts little.
constexpr double kMotionSigmaFactor = 5.0;
bool isInMap(const std::optional<CameraSeed>& seed) { return seed && seed->is_in_map; }

std::vector<vision::Feature> featuresOf(const FramePyramid& pyramid, const vision::FeatureConfig& config) {
  return vision::findFeatures(pyramid.front().gray, pyramid.front().depth, pyramid.front().camera, config);
}

}  // namespace

void RgbdOdometryConfig::describe(common::config::Fields& fields) {
  fields.choice("method", method, {"direct", "model_icp"},
                "How the pose of a frame is found: aligned directly to key frames, or by matching its corners to "
                "landmarks (ICP), with local bundle adjustment.");
  fields.section("features", features, "Features of a picture.");
  fields.section("alignment", alignment, "Alignment of a frame to key frames.");
}

bool isGoodFit(const Alignment& fit) {
  if (fit.correlation < kLeastCorrelation) return false;
  // Nearer than its least distance the camera measures no depth, but the points of the key frames have theirs.
  if (fit.measured < kLeastPoints) return fit.textured >= kLeastPoints && fit.correlation >= kLeastCorrelationAlone;
  return fit.agreement >= kLeastAgreement && fit.points >= kLeastPoints;
}

void RgbdOdometry::moveTo(std::shared_ptr<const common::KeyPoses> scans) {
  if (scans->version == scans_version_ && !keys_.isEmpty()) return;
  scans_version_ = scans->version;
  const std::optional<Pose3> T_scan_map = last_ ? std::optional(keys_.T_map_scan(last_->scan).inverse()) : std::nullopt;
  keys_.moveTo(std::move(scans));
  if (!T_scan_map) return;
  const Pose3 moved = keys_.T_map_scan(last_->scan) * *T_scan_map;
  last_->T_map_camera = moved * last_->T_map_camera;
  if (isInMap(last_->seed)) last_->seed->T_map_camera = moved * last_->seed->T_map_camera;
}

void RgbdOdometry::hangNewestOn(int scan) {
  keys_.hangNewestOn(scan);
  last_->scan = scan;
}

RgbdPose RgbdOdometry::process(const common::RgbdFrame& frame, const std::optional<CameraSeed>& seed) {
  ++frames_;
  const FramePyramid pyramid = makePyramid(frame);
  RgbdPose pose;
  pose.stamp = frame.stamps.measured;
  pose.scan = seed ? seed->scan : last_ ? last_->scan : 0;
  if (keys_.isEmpty()) {
    if (canBegin(pyramid))
      begin(pose, pyramid, seed);
    else if (seed)
      pose.T_map_camera = seed->T_map_camera;
    return pose;
  }
  const PosePrior prior = predicted(pyramid, pose.stamp, seed);
  pose.T_map_camera = prior.T_map_camera;
  if (const auto fit = findPose(pyramid, prior, pose.stamp, seed))
    take(*fit, pose, pyramid, seed);
  else
    lose(pose, pyramid, seed);
  return pose;
}

// ------------------------------------------------------------------------------------------- the pose of a frame

std::vector<Pose3> RgbdOdometry::predictions(common::Time stamp, const std::optional<CameraSeed>& seed) const {
  std::vector<Pose3> poses;
  const double gap_s = (stamp - last_->stamp).seconds();
  if (gap_s > 0.0 && gap_s < kLongestPrediction_s) poses.push_back(last_->T_map_camera * last_->motion.over(gap_s));
  if (seed && last_->seed && !seed->rate_covariance)
    poses.push_back(last_->T_map_camera * (last_->seed->T_map_camera.inverse() * seed->T_map_camera));
  if (isInMap(seed)) poses.push_back(seed->T_map_camera);
  poses.push_back(last_->T_map_camera);
  return poses;
}

Pose3 RgbdOdometry::bestOf(const std::vector<Pose3>& poses, const FramePyramid& pyramid) const {
  Pose3 best = poses.front();
  if (poses.size() == 1) return best;
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

bool RgbdOdometry::isGood(const Alignment& fit, const std::optional<CameraSeed>& seed) const {
  if (isInMap(seed) && !agrees(fit.T_map_camera, *seed)) return false;
  return isGoodFit(fit);
}

PosePrior RgbdOdometry::motionPrior(common::Time stamp, const Pose3& predicted) const {
  PosePrior prior{predicted, Matrix6d::Zero()};
  const double gap_s = (stamp - last_->stamp).seconds();
  if (gap_s > 0.0) prior.information = motionInformation(gap_s);
  return prior;
}

PosePrior RgbdOdometry::predicted(const FramePyramid& pyramid, common::Time stamp,
                                  const std::optional<CameraSeed>& seed) const {
  if (isInMap(seed) && is_lost_) return {seed->T_map_camera, seedCovariance().inverse()};
  const double gap_s = (stamp - last_->stamp).seconds();
  if (isInMap(seed) && isInMap(last_->seed) && gap_s > 0.0)
    return seededPrior({last_->T_map_camera, last_->covariance, *last_->seed}, *seed, gap_s);
  const PosePrior motion = motionPrior(stamp, bestOf(predictions(stamp, seed), pyramid));
  if (!seed || !last_->seed) return motion;
  return withSeedStep(motion, {last_->T_map_camera, last_->covariance, *last_->seed}, *seed, gap_s);
}

std::optional<RgbdOdometry::Fit> RgbdOdometry::findPose(const FramePyramid& pyramid, const PosePrior& prior,
                                                        common::Time stamp, const std::optional<CameraSeed>& seed) {
  if (isInMap(seed)) return tracked(pyramid, prior, seed);
  if (!is_lost_ || (seed && seed->rate_covariance))
    if (auto fit = tracked(pyramid, prior, seed)) return fit;
  if (is_lost_ && !seed && (stamp - last_->stamp).seconds() <= kLongestAlignedGap_s)
    if (auto fit = tracked(pyramid, prior, seed); fit && isRecognized(fit->alignment, kLeastPoints)) return fit;
  return recognized(pyramid, stamp, seed);
}

std::optional<RgbdOdometry::Fit> RgbdOdometry::tracked(const FramePyramid& pyramid, const PosePrior& prior,
                                                       const std::optional<CameraSeed>& seed) const {
  Fit fit;
  fit.prior = prior;
  fit.keys = keys_.overlapping(pyramid.back().camera, prior.T_map_camera);
  if (fit.keys.empty()) return std::nullopt;
  fit.alignment =
      align(pyramid, keys_.views(fit.keys), prior, last_->exposure, config_.features.depth_noise, config_.alignment);
  if (!isGood(fit.alignment, seed)) return std::nullopt;
  if (!seed && isLeap(fit.alignment, prior)) return std::nullopt;
  return fit;
}

std::optional<RgbdOdometry::Fit> RgbdOdometry::recognized(const FramePyramid& pyramid, common::Time stamp,
                                                          const std::optional<CameraSeed>& seed) {
  const auto points = describedPoints(pyramid.front().gray, featuresOf(pyramid, config_.features));
  const double gap_s = (stamp - last_->stamp).seconds();
  std::optional<Fit> best;
  for (const std::size_t index : keys_.similar(points, kTriedPerFrame)) {
    const auto found = registerPoints(keys_.at(index).described, points, frames_);
    if (!found) continue;
    const PosePrior prior{keys_.placeOf(index).T_map_key * *found, Matrix6d::Zero()};
    if (!isInReach(last_->T_map_camera, prior.T_map_camera, gap_s)) continue;
    auto fit = tracked(pyramid, prior, seed);
    if (!fit || !isRecognized(fit->alignment, kLeastPoints)) continue;
    if (!best)
      best = std::move(fit);
    else if (!isSamePlace(best->alignment.T_map_camera, fit->alignment.T_map_camera))
      return std::nullopt;  // Two places look alike.
  }
  return best;
}

// ----------------------------------------------------------------------------------------------- the model grows

/// No later frame would fit a key frame with fewer points.
bool RgbdOdometry::canBegin(const FramePyramid& pyramid) const {
  const auto points = referencePoints(pyramid.front(), config_.features.depth_noise);
  return static_cast<int>(points.size()) >= kLeastPoints;
}

void RgbdOdometry::begin(RgbdPose& pose, const FramePyramid& pyramid, const std::optional<CameraSeed>& seed) {
  pose.state = keys_.isEmpty() ? TrackState::kTracked : TrackState::kFoundAgain;
  if (seed) pose.T_map_camera = seed->T_map_camera;
  pose.fit.T_map_camera = pose.T_map_camera;
  if (last_) pose.fit.exposure = last_->exposure;
  KeyFramePlace place{pose.T_map_camera, pose.scan, tracks_++, Matrix6d::Zero()};
  if (isInMap(seed)) place.covariance = pose.covariance = seedCovariance();
  addKeyFrame(pose, place, pyramid);
  pose.became_key_frame = true;
  is_lost_ = false;
  unfit_frames_ = 0;
  last_ = LastFrame(pose, seed, last_);
}

void RgbdOdometry::take(const Fit& fit, RgbdPose& pose, const FramePyramid& pyramid,
                        const std::optional<CameraSeed>& seed) {
  pose.state = is_lost_ ? TrackState::kFoundAgain : TrackState::kTracked;
  is_lost_ = false;
  unfit_frames_ = 0;
  pose.fit = fit.alignment;
  pose.T_map_camera = fit.alignment.T_map_camera;
  pose.covariance = fit.alignment.information.inverse();
  const double depth_m = keys_.at(fit.keys.front()).median_depth_m;
  const double noise = vision::gradientNoiseVariance(pyramid.front().gray);
  pose.measured = withoutPrior(fit.alignment, noise, fit.prior, depth_m);
  for (const std::size_t key : fit.keys) pose.aligned_to.push_back(keys_.placeOf(key).scan);
  keys_.markUsed(fit.keys);
  const bool has_depth = fit.alignment.measured >= kLeastPoints;
  if (has_depth && keys_.needsNew(fit.keys, pose.T_map_camera, fit.alignment.overlap)) {
    const KeyFramePlace place = newPlace(fit, pose, seed);
    pose.motion = motionSinceKeyFrame(fit, pyramid, noise);
    pose.T_map_camera = place.T_map_key;
    addKeyFrame(pose, place, pyramid);
    pose.became_key_frame = true;
  }
  last_ = LastFrame(pose, seed, last_);
}

/// The places of several key frames follow the seeds, and with them the assumed mount. One alone does not.
/// Without texture nothing is known of the motion along a wall.
std::optional<KeyFrameMotion> RgbdOdometry::motionSinceKeyFrame(const Fit& fit, const FramePyramid& pyramid,
                                                                double gradient_variance) const {
  const std::size_t newest = keys_.size() - 1;
  if (std::find(fit.keys.begin(), fit.keys.end(), newest) == fit.keys.end()) return std::nullopt;
  const PosePrior start{fit.alignment.T_map_camera, Matrix6d::Zero()};
  const Alignment alone = align(pyramid, keys_.views({newest}), start, fit.alignment.exposure,
                                config_.features.depth_noise, config_.alignment);
  if (!isGood(alone, std::nullopt) || alone.textured < kLeastPoints) return std::nullopt;
  constexpr double kEveryDirection = 0.0;
  const MeasuredPose measured = withoutPrior(alone, gradient_variance, start, keys_.at(newest).median_depth_m,
                                             kEveryDirection, kMotionSigmaFactor);
  return KeyFrameMotion{keys_.at(newest).stamp, keys_.placeOf(newest).T_map_key.inverse() * measured.T_map_camera,
                        measured.covariance};
}

KeyFramePlace RgbdOdometry::newPlace(const Fit& fit, const RgbdPose& pose,
                                     const std::optional<CameraSeed>& seed) const {
  const KeyFramePlace& from = keys_.placeOf(fit.keys.front());
  if (!isInMap(seed)) return {pose.T_map_camera, pose.scan, from.track, Matrix6d::Zero()};
  return placeOfNew(from, fit.alignment, *seed);
}

/// Where the seed gives the place, a part of the map that has changed must not keep the camera lost forever.
void RgbdOdometry::lose(RgbdPose& pose, const FramePyramid& pyramid, const std::optional<CameraSeed>& seed) {
  is_lost_ = true;
  ++unfit_frames_;
  if (!isInMap(seed)) return;
  pose.T_map_camera = seed->T_map_camera;
  if (unfit_frames_ > kUnfitFrames && canBegin(pyramid)) begin(pose, pyramid, seed);
}

void RgbdOdometry::addKeyFrame(const RgbdPose& pose, const KeyFramePlace& place, const FramePyramid& pyramid) {
  keys_.add(makeKeyFrame(pose.stamp, pyramid, featuresOf(pyramid, config_.features), pose.fit.exposure,
                         config_.features.depth_noise),
            place);
}

}  // namespace swiftlet::mapping3d
