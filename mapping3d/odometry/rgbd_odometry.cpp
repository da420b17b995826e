#include "mapping3d/odometry/rgbd_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/LU>

#include "common/config_fields.hpp"
#include "mapping3d/odometry/depth_time.hpp"
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
/// After this many tracked frames in a row that only their own fits support, the next one must be confirmed: along a
/// wall without texture each of them may have slid.
constexpr int kUnconfirmedFrames = 10;
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
/// Corners tell a turn to some 0.02 rad, and a hand's velocity changes by some 5 rad/s2: over longer gaps the corners
/// tell the velocity better than the motion before.
constexpr double kSlowFrames_s = 0.06;
/// Share of its depth within which a corner is expected where a constant velocity takes it.
constexpr double kExpectedShare = 0.35;
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

void RgbdOdometry::hang(std::size_t key, int scan) {
  keys_.hang(key, scan);
  last_->scan = scan;
}

void RgbdOdometry::joinTracks(int from, int into) {
  keys_.joinTracks(from, into);
  if (track_ == from) track_ = into;
}

RgbdPose RgbdOdometry::process(const common::RgbdFrame& frame, const std::optional<CameraSeed>& seed,
                               common::Duration depth_later) {
  ++frames_;
  pyramid_ = makePyramid(frame);
  SeenFrame seen{frame.stamps.measured, seed, {}};
  if (!isInMap(seed)) seen.corners = describedPoints(pyramid_.front().gray, featuresOf(pyramid_, config_.features));
  RgbdPose pose;
  pose.stamp = seen.stamp;
  pose.scan = seed ? seed->scan : last_ ? last_->scan : 0;
  if (keys_.isEmpty()) {
    if (canBegin())
      begin(pose, seen);
    else if (seed)
      pose.T_map_camera = seed->T_map_camera;
    return pose;
  }
  const std::optional<Pose3> by_corners = poseByCorners(seen);
  pose.T_color_depth = moveDepthToColor(seen, by_corners, depth_later);
  const PosePrior prior = predicted(seen);
  pose.T_map_camera = prior.T_map_camera;
  if (const auto fit = findPose(seen, prior, by_corners))
    take(*fit, pose, seen);
  else if (auto first = alignedToLostFrame(seen))
    beginPiece(std::move(*first), pose, seen);
  else
    lose(pose, seen);
  return pose;
}

// ------------------------------------------------------------------------------------------- the pose of a frame

/// By the corners that it has in common with the last frame that was placed.
std::optional<Pose3> RgbdOdometry::poseByCorners(const SeenFrame& frame) const {
  if (frame.corners.empty()) return std::nullopt;
  auto motion = vision::registerPairs(last_->corners, frame.corners, frames_);
  // Where it is expected, a corner is told from more of those that look alike.
  const double gap_s = (frame.stamp - last_->stamp).seconds();
  if (!motion && gap_s < kLongestPrediction_s)
    motion = vision::registerPairs(last_->corners, frame.corners, frames_, {},
                                   vision::Expectation{last_->motion.over(gap_s), kExpectedShare});
  return motion ? std::optional(last_->T_map_camera * motion->T_a_b) : std::nullopt;
}

/// By the motion before the last frame, or, of slow frames, by that since then.
Pose3 RgbdOdometry::moveDepthToColor(const SeenFrame& frame, const std::optional<Pose3>& by_corners,
                                     common::Duration depth_later) {
  if (depth_later == common::Duration()) return {};
  const double gap_s = (frame.stamp - last_->stamp).seconds();
  const CameraVelocity motion =
      by_corners && gap_s > kSlowFrames_s ? motionBetween(last_->T_map_camera, *by_corners, gap_s) : last_->motion;
  const Pose3 T_color_depth = motion.over(depth_later.seconds());
  moveDepth(pyramid_, T_color_depth);
  return T_color_depth;
}

std::vector<Pose3> RgbdOdometry::predictions(const SeenFrame& frame) const {
  const auto& seed = frame.seed;
  std::vector<Pose3> poses;
  const double gap_s = (frame.stamp - last_->stamp).seconds();
  if (gap_s > 0.0 && gap_s < kLongestPrediction_s) poses.push_back(last_->T_map_camera * last_->motion.over(gap_s));
  if (seed && last_->seed && !seed->rate_covariance)
    poses.push_back(last_->T_map_camera * (last_->seed->T_map_camera.inverse() * seed->T_map_camera));
  if (isInMap(seed)) poses.push_back(seed->T_map_camera);
  poses.push_back(last_->T_map_camera);
  return poses;
}

Pose3 RgbdOdometry::bestOf(const std::vector<Pose3>& poses) const {
  Pose3 best = poses.front();
  if (poses.size() == 1) return best;
  double best_score = -std::numeric_limits<double>::infinity();
  for (const Pose3& pose : poses) {
    const auto views = keys_.views(keys_.overlapping(pyramid_.back().camera, pose, track()));
    if (views.empty()) continue;
    const Alignment fit =
        judgePose(pyramid_, views, pose, last_->exposure, config_.features.depth_noise, config_.alignment);
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

PosePrior RgbdOdometry::predicted(const SeenFrame& frame) const {
  const auto& seed = frame.seed;
  if (isInMap(seed) && is_lost_) return {seed->T_map_camera, seedCovariance().inverse()};
  const double gap_s = (frame.stamp - last_->stamp).seconds();
  if (isInMap(seed) && isInMap(last_->seed) && gap_s > 0.0)
    return seededPrior({last_->T_map_camera, last_->covariance, *last_->seed}, *seed, gap_s);
  const PosePrior motion = motionPrior(frame.stamp, bestOf(predictions(frame)));
  if (!seed || !last_->seed) return motion;
  return withSeedStep(motion, {last_->T_map_camera, last_->covariance, *last_->seed}, *seed, gap_s);
}

std::optional<RgbdOdometry::Fit> RgbdOdometry::findPose(const SeenFrame& frame, const PosePrior& prior,
                                                        const std::optional<Pose3>& by_corners) const {
  if (isInMap(frame.seed)) return tracked(frame, prior, std::nullopt, track());
  const bool goes_on = !is_lost_ || (frame.seed && frame.seed->rate_covariance);
  const bool is_near = !frame.seed && (frame.stamp - last_->stamp).seconds() <= kLongestAlignedGap_s;
  const auto isEnough = [&](const Fit& fit) {
    if (!goes_on) return isRecognized(fit.alignment);
    return unconfirmed_frames_ < kUnconfirmedFrames || fit.is_confirmed || isSure(fit.alignment);
  };
  if (goes_on || is_near)
    if (auto fit = goneOn(frame, prior, by_corners); fit && isEnough(*fit)) return fit;
  return recognized(frame);
}

/// Features first: an alignment that begins by the motion of matched corners, and ends there, needs no prediction.
std::optional<RgbdOdometry::Fit> RgbdOdometry::goneOn(const SeenFrame& frame, const PosePrior& prior,
                                                      const std::optional<Pose3>& by_corners) const {
  std::optional<Fit> first;
  if (by_corners) first = tracked(frame, prior, by_corners, track());
  if (first && isConfirmed(first->alignment, *by_corners)) {
    first->is_confirmed = true;
    return first;
  }
  std::vector<Pose3> starts{prior.T_map_camera};
  if (!frame.seed)
    for (const Pose3& other : predictions(frame)) starts.push_back(other);
  for (const Pose3& start : starts) {
    auto fit = tracked(frame, {start, prior.information}, std::nullopt, track());
    if (!fit) continue;
    fit->prior = prior;
    fit->is_confirmed = by_corners && isConfirmed(fit->alignment, *by_corners);
    // Corners that mislead: the alignment left them for where it comes to from elsewhere, too.
    const bool is_same = first && isConfirmed(fit->alignment, first->alignment.T_map_camera);
    if (!by_corners || fit->is_confirmed || (is_same && isSure(fit->alignment))) return fit;
  }
  return std::nullopt;
}

/// From a pose that corners gave, or from the prior's.
std::optional<RgbdOdometry::Fit> RgbdOdometry::tracked(const SeenFrame& frame, const PosePrior& prior,
                                                       const std::optional<Pose3>& by_corners,
                                                       std::optional<int> track) const {
  Fit fit;
  fit.prior = prior;
  const Pose3& start = by_corners ? *by_corners : prior.T_map_camera;
  fit.keys = keys_.overlapping(pyramid_.back().camera, start, track);
  if (fit.keys.empty()) return std::nullopt;
  fit.alignment = align(pyramid_, keys_.views(fit.keys), prior, last_->exposure, config_.features.depth_noise,
                        config_.alignment, by_corners);
  if (!isGood(fit.alignment, frame.seed)) return std::nullopt;
  if (!frame.seed && isLeap(fit.alignment, {start, prior.information})) return std::nullopt;
  return fit;
}

std::optional<RgbdOdometry::Fit> RgbdOdometry::recognized(const SeenFrame& frame) const {
  const double gap_s = (frame.stamp - last_->stamp).seconds();
  std::optional<Fit> best;
  for (const std::size_t index : keys_.similar(frame.corners, kTriedPerFrame)) {
    const auto found = vision::registerPoints(keys_.at(index).described, frame.corners, frames_);
    if (!found) continue;
    const KeyFramePlace& place = keys_.placeOf(index);
    const PosePrior prior{place.T_map_key * *found, Matrix6d::Zero()};
    // Where another piece lies is not known, and so is the way to it.
    const bool is_here = !config_.begins_pieces || place.track == track_;
    if (is_here && !isInReach(last_->T_map_camera, prior.T_map_camera, gap_s)) continue;
    const auto track = config_.begins_pieces ? std::optional(place.track) : std::nullopt;
    auto fit = tracked(frame, prior, prior.T_map_camera, track);  // The prior is what the corners say.
    if (!fit || !isRecognized(fit->alignment) || !isConfirmed(fit->alignment, prior.T_map_camera)) continue;
    fit->is_confirmed = true;
    if (!best)
      best = std::move(fit);
    else if (keys_.placeOf(best->keys.front()).track != place.track ||
             !isSamePlace(best->alignment.T_map_camera, fit->alignment.T_map_camera))
      return std::nullopt;  // Two places look alike.
  }
  return best;
}

/// In the frame of the lost one.
std::optional<RgbdOdometry::Fit> RgbdOdometry::alignedToLostFrame(const SeenFrame& frame) const {
  if (!lost_frame_) return std::nullopt;
  const auto by_corners = vision::registerPoints(lost_frame_->described, frame.corners, frames_);
  const std::vector<ReferenceView> view{{Pose3{}, &lost_frame_->levels}};
  Fit fit;
  fit.prior.T_map_camera = by_corners.value_or(Pose3{});
  fit.alignment =
      align(pyramid_, view, fit.prior, last_->exposure, config_.features.depth_noise, config_.alignment, by_corners);
  if (!isRecognized(fit.alignment)) return std::nullopt;
  if (by_corners && !isConfirmed(fit.alignment, *by_corners)) return std::nullopt;
  fit.is_confirmed = by_corners.has_value();
  return fit;
}

// ----------------------------------------------------------------------------------------------- the model grows

/// No later frame would fit a key frame with fewer points.
bool RgbdOdometry::canBegin() const {
  const auto points = referencePoints(pyramid_.front(), config_.features.depth_noise);
  return static_cast<int>(points.size()) >= kLeastPoints;
}

void RgbdOdometry::begin(RgbdPose& pose, const SeenFrame& frame) {
  pose.state = keys_.isEmpty() ? TrackState::kTracked : TrackState::kFoundAgain;
  if (frame.seed) pose.T_map_camera = frame.seed->T_map_camera;
  pose.fit.T_map_camera = pose.T_map_camera;
  if (last_) pose.fit.exposure = last_->exposure;
  track_ = tracks_++;
  KeyFramePlace place{pose.T_map_camera, pose.scan, track_, Matrix6d::Zero()};
  if (isInMap(frame.seed)) place.covariance = pose.covariance = seedCovariance();
  keys_.add(keyFrameOf(pose.stamp, pose.fit.exposure), place);
  pose.became_key_frame = true;
  is_lost_ = false;
  unfit_frames_ = 0;
  last_ = LastFrame(pose, frame.seed, last_);
  last_->corners = frame.corners;
}

/// With the lost frame as its first key frame, where the camera was before: as good as any guess.
void RgbdOdometry::beginPiece(Fit fit, RgbdPose& pose, const SeenFrame& frame) {
  const Pose3& T_map_piece = last_->T_map_camera;
  track_ = tracks_++;
  keys_.add(lost_frame_, {T_map_piece, pose.scan, track_, Matrix6d::Zero()});
  fit.keys = {keys_.size() - 1};
  for (Pose3* const inner : {&fit.alignment.T_map_camera, &fit.prior.T_map_camera}) *inner = T_map_piece * *inner;
  take(fit, pose, frame);
  pose.begins_piece = true;
}

void RgbdOdometry::take(const Fit& fit, RgbdPose& pose, const SeenFrame& frame) {
  pose.state = is_lost_ ? TrackState::kFoundAgain : TrackState::kTracked;
  is_lost_ = false;
  unfit_frames_ = 0;
  lost_frame_ = nullptr;
  const bool is_certain = fit.is_confirmed || frame.seed || isSure(fit.alignment);
  unconfirmed_frames_ = is_certain ? 0 : unconfirmed_frames_ + 1;
  pose.fit = fit.alignment;
  pose.T_map_camera = fit.alignment.T_map_camera;
  pose.covariance = fit.alignment.information.inverse();
  const double depth_m = keys_.at(fit.keys.front()).median_depth_m;
  const double noise = vision::gradientNoiseVariance(pyramid_.front().gray);
  pose.measured = withoutPrior(fit.alignment, noise, fit.prior, depth_m);
  for (const std::size_t key : fit.keys) pose.aligned_to.push_back(keys_.placeOf(key).scan);
  keys_.markUsed(fit.keys);
  const int before = std::exchange(track_, keys_.placeOf(fit.keys.front()).track);
  // Back in a piece that was left, a key frame shows how it lies to the one that was tracked in between.
  const bool is_elsewhere = config_.begins_pieces && track_ != before;
  const bool has_depth = fit.alignment.measured >= kLeastPoints;
  if (has_depth && is_certain && (is_elsewhere || keys_.needsNew(fit.keys, pose.T_map_camera, fit.alignment.overlap))) {
    const KeyFramePlace place = newPlace(fit, pose, frame.seed);
    pose.motion = motionSinceKeyFrame(fit, noise);
    pose.T_map_camera = place.T_map_key;
    keys_.add(keyFrameOf(pose.stamp, pose.fit.exposure), place);
    pose.became_key_frame = true;
  }
  last_ = LastFrame(pose, frame.seed, last_);
  last_->corners = frame.corners;
}

/// The places of several key frames follow the seeds, and with them the assumed mount. One alone does not.
/// Without texture nothing is known of the motion along a wall.
std::optional<KeyFrameMotion> RgbdOdometry::motionSinceKeyFrame(const Fit& fit, double gradient_variance) const {
  const std::size_t newest = keys_.size() - 1;
  if (std::find(fit.keys.begin(), fit.keys.end(), newest) == fit.keys.end()) return std::nullopt;
  const PosePrior start{fit.alignment.T_map_camera, Matrix6d::Zero()};
  const Alignment alone = align(pyramid_, keys_.views({newest}), start, fit.alignment.exposure,
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
void RgbdOdometry::lose(RgbdPose& pose, const SeenFrame& frame) {
  is_lost_ = true;
  ++unfit_frames_;
  pose.doubted = std::exchange(unconfirmed_frames_, 0);
  if (!isInMap(frame.seed)) {
    if (config_.begins_pieces) lost_frame_ = canBegin() ? keyFrameOf(frame.stamp, last_->exposure) : nullptr;
    return;
  }
  pose.T_map_camera = frame.seed->T_map_camera;
  if (unfit_frames_ > kUnfitFrames && canBegin()) begin(pose, frame);
}

std::shared_ptr<const KeyFrame> RgbdOdometry::keyFrameOf(common::Time stamp, const Exposure& exposure) const {
  return makeKeyFrame(stamp, pyramid_, featuresOf(pyramid_, config_.features), exposure, config_.features.depth_noise);
}

}  // namespace swiftlet::mapping3d
