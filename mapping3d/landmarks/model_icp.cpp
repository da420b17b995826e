#include "mapping3d/landmarks/model_icp.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <Eigen/LU>

#include "mapping3d/odometry/found_place.hpp"
#include "optimization/bundle_adjustment.hpp"
#include "vision/point_registration.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;

/// Least number of matches of a frame that is tracked, and least share of the features near landmarks that match: in a
/// dense model a quarter of the features match at a wrong pose, too.
constexpr int kLeastMatches = 25;
constexpr double kLeastAgreement = 0.4;
/// The first frame has at least this many features.
constexpr std::size_t kLeastFeatures = 40;
/// After this many frames that do not fit, the model restarts at the seed.
constexpr int kUnfitFrames = 5;
/// Key frames that are tried for each frame while lost.
constexpr std::size_t kTriedPerFrame = 8;
/// Landmarks this far beside the picture may move into it by the alignment.
constexpr double kMargin_px = 24.0;
/// Key frames of an adjustment; the first two stay where they are.
constexpr std::size_t kAdjusted = 8, kFixed = 2;
constexpr int kIterations = 8;
/// Errors of neighbouring features are alike.
constexpr double kMotionSigmaFactor = 5.0;

bool isInMap(const std::optional<CameraSeed>& seed) { return seed && seed->is_in_map; }

bool isGood(const ModelMatch& match, const std::optional<CameraSeed>& seed) {
  if (isInMap(seed) && !agrees(match.fit.T_map_camera, *seed)) return false;
  return match.fit.points >= kLeastMatches && match.fit.agreement >= kLeastAgreement;
}

}  // namespace

void ModelIcp::moveTo(std::shared_ptr<const common::KeyPoses> scans) {
  if (scans_ && scans->version == scans_->version && !keys_.isEmpty()) return;
  const auto before = std::exchange(scans_, std::move(scans));
  keys_.moveTo(scans_);
  if (!before || !last_) return;
  const auto moved = [&](int scan) { return scans_->T_map_level(scan) * before->T_map_level(scan).inverse(); };
  model_.moveTo(*before, *scans_);
  for (Adjusted& key : adjusted_) {
    key.T_map_key = moved(key.scan) * key.T_map_key;
    if (isInMap(key.seed)) key.seed->T_map_camera = moved(key.seed->scan) * key.seed->T_map_camera;
  }
  last_->T_map_camera = moved(last_->scan) * last_->T_map_camera;
  if (isInMap(last_->seed)) last_->seed->T_map_camera = moved(last_->scan) * last_->seed->T_map_camera;
}

void ModelIcp::hang(std::size_t key, int scan) {
  keys_.hang(key, scan);
  model_.hangOn(scan, frames_);
  adjusted_.back().scan = last_->scan = scan;
}

/// Its landmarks are corners, whose depth is taken as it is.
RgbdPose ModelIcp::process(const common::RgbdFrame& frame, const std::optional<CameraSeed>& seed,
                           common::Duration /*depth_later*/) {
  ++frames_;
  pyramid_ = makePyramid(frame);
  const FramePyramid& pyramid = pyramid_;
  const PyramidLevel& finest = pyramid.front();
  Features features = vision::findFeatures(finest.gray, finest.depth, finest.camera, features_);  // Line 1.
  RgbdPose pose;
  pose.stamp = frame.stamps.measured;
  pose.scan = seed ? seed->scan : last_ ? last_->scan : 0;
  if (!last_) {
    if (seed) pose.T_map_camera = seed->T_map_camera;
    if (features.size() >= kLeastFeatures) begin(pose, std::move(features), pyramid, seed);
    return pose;
  }
  const PosePrior prior = predicted(pose.stamp, seed);  // Line 2.
  pose.T_map_camera = prior.T_map_camera;
  if (const auto fit = findPose(features, pyramid, pose.stamp, prior, seed)) {  // Line 3.
    take(*fit, pose, std::move(features), pyramid, seed);
    return pose;
  }
  ++unfit_frames_;
  if (!isInMap(seed)) return pose;
  pose.T_map_camera = seed->T_map_camera;
  if (unfit_frames_ > kUnfitFrames && features.size() >= kLeastFeatures)
    begin(pose, std::move(features), pyramid, seed);
  return pose;
}

// ------------------------------------------------------------------------------------------- the pose of a frame

PosePrior ModelIcp::predicted(common::Time stamp, const std::optional<CameraSeed>& seed) const {
  const double gap_s = (stamp - last_->stamp).seconds();
  const bool is_lost = unfit_frames_ > 0;
  if (isInMap(seed) && (is_lost || !isInMap(last_->seed) || gap_s <= 0.0))
    return {seed->T_map_camera, seedCovariance().inverse()};
  const auto aligned = [&] { return AlignedFrame{last_->T_map_camera, last_->covariance, *last_->seed}; };
  if (isInMap(seed)) return seededPrior(aligned(), *seed, gap_s);
  PosePrior motion{last_->T_map_camera, Matrix6d::Zero()};
  if (gap_s <= 0.0) return motion;
  motion.information = motionInformation(gap_s);
  const bool has_step = seed && last_->seed;
  if (has_step && !seed->rate_covariance)
    motion.T_map_camera = last_->T_map_camera * (last_->seed->T_map_camera.inverse() * seed->T_map_camera);
  else if (gap_s < kLongestPrediction_s)
    motion.T_map_camera = last_->T_map_camera * last_->motion.over(gap_s);
  return has_step ? withSeedStep(motion, aligned(), *seed, gap_s) : motion;
}

ModelIcp::Fit ModelIcp::matched(const Features& features, const common::PinholeCamera& camera,
                                const PosePrior& prior) const {
  Fit fit{{}, prior, model_.inView(camera, prior.T_map_camera, kMargin_px)};
  fit.match = matchToModel(features, fit.landmarks, prior);
  return fit;
}

std::optional<ModelIcp::Fit> ModelIcp::findPose(const Features& features, const FramePyramid& pyramid,
                                                common::Time stamp, const PosePrior& prior,
                                                const std::optional<CameraSeed>& seed) const {
  const common::PinholeCamera& camera = pyramid.front().camera;
  Fit fit = matched(features, camera, prior);
  if (isGood(fit.match, seed)) return fit;
  if (isInMap(seed)) return std::nullopt;
  const auto points = describedPoints(pyramid.front().gray, features);
  const double gap_s = (stamp - last_->stamp).seconds();
  for (const std::size_t index : keys_.similar(points, kTriedPerFrame)) {
    const auto found = registerPoints(keys_.at(index).described, points, frames_);
    if (!found) continue;
    const PosePrior place{keys_.placeOf(index).T_map_key * *found, Matrix6d::Zero()};
    if (!isInReach(last_->T_map_camera, place.T_map_camera, gap_s)) continue;
    fit = matched(features, camera, place);
    if (isGood(fit.match, seed)) return fit;
  }
  return std::nullopt;
}

// ----------------------------------------------------------------------------------------------- the model grows

void ModelIcp::begin(RgbdPose& pose, Features features, const FramePyramid& pyramid,
                     const std::optional<CameraSeed>& seed) {
  pose.state = keys_.isEmpty() ? TrackState::kTracked : TrackState::kFoundAgain;
  KeyFramePlace place{pose.T_map_camera, pose.scan, tracks_++, Matrix6d::Zero()};
  if (isInMap(seed)) place.covariance = pose.covariance = seedCovariance();
  model_.clear();
  adjusted_.clear();
  Adjusted key{pose.T_map_camera, pose.scan, seed, std::move(features), {}};
  key.seen = learn({}, pose, key.features);
  addKeyFrame(pose, place, pyramid, std::move(key));
  unfit_frames_ = 0;
  last_ = LastFrame(pose, seed, last_);
}

void ModelIcp::take(const Fit& fit, RgbdPose& pose, Features features, const FramePyramid& pyramid,
                    const std::optional<CameraSeed>& seed) {
  pose.state = unfit_frames_ > 0 ? TrackState::kFoundAgain : TrackState::kTracked;
  unfit_frames_ = 0;
  pose.fit = fit.match.fit;
  pose.T_map_camera = pose.fit.T_map_camera;
  pose.covariance = pose.fit.information.inverse();
  const auto overlapping = keys_.overlapping(pyramid.back().camera, pose.T_map_camera);
  for (const std::size_t key : overlapping) pose.aligned_to.push_back(keys_.placeOf(key).scan);
  keys_.markUsed(overlapping);
  const KeyFramePlace from = keys_.placeOf(overlapping.empty() ? keys_.size() - 1 : overlapping.front());
  pose.fit.overlap =
      judgePose(pyramid, keys_.views(overlapping), pose.T_map_camera, {}, features_.depth_noise, {}).overlap;
  const double depth_m = keys_.at(keys_.size() - 1).median_depth_m;
  pose.measured = withoutPrior(pose.fit, 0.0, fit.prior, depth_m);
  const bool becomes_key = keys_.needsNew(overlapping, pose.T_map_camera, pose.fit.overlap);
  if (!becomes_key) {
    learn(fit, pose, features);
    last_ = LastFrame(pose, seed, last_);
    return;
  }
  pose.motion = motionSinceKeyFrame(features, pose.T_map_camera);
  const KeyFramePlace place = isInMap(seed) ? placeOfNew(from, pose.fit, *seed)
                                            : KeyFramePlace{pose.T_map_camera, pose.scan, from.track, Matrix6d::Zero()};
  pose.T_map_camera = place.T_map_key;
  Adjusted key{pose.T_map_camera, pose.scan, seed, std::move(features), {}};
  key.seen = learn(fit, pose, key.features);
  addKeyFrame(pose, place, pyramid, std::move(key));
  last_ = LastFrame(pose, seed, last_);
}

/// Against the features of the newest key frame alone, without a prior.
std::optional<KeyFrameMotion> ModelIcp::motionSinceKeyFrame(const Features& features, const Pose3& T_map_camera) const {
  const Adjusted& newest = adjusted_.back();
  LandmarkModel alone;
  for (const vision::Feature& feature : newest.features) alone.add(feature, newest.T_map_key, 0, 0);
  const ModelMatch match = matchToModel(features, alone.all(), {T_map_camera, Matrix6d::Zero()});
  if (!isGood(match, std::nullopt)) return std::nullopt;
  const KeyFrame& key = keys_.at(keys_.size() - 1);
  constexpr double kEveryDirection = 0.0;
  const MeasuredPose measured = withoutPrior(match.fit, 0.0, {match.fit.T_map_camera, Matrix6d::Zero()},
                                             key.median_depth_m, kEveryDirection, kMotionSigmaFactor);
  return KeyFrameMotion{key.stamp, newest.T_map_key.inverse() * measured.T_map_camera, measured.covariance};
}

/// Features that match update their landmarks, the others become landmarks.
std::vector<ModelIcp::Observation> ModelIcp::learn(const Fit& fit, const RgbdPose& pose, const Features& features) {
  std::vector<Observation> seen;
  std::vector<bool> is_known(features.size(), false);
  for (const LandmarkMatch& match : fit.match.matches) {
    const std::uint64_t number = fit.landmarks[match.landmark].number;
    model_.update(number, features[match.feature], pose.T_map_camera, frames_);
    is_known[match.feature] = true;
    seen.push_back({number, match.feature});
  }
  for (std::size_t i = 0; i < features.size(); ++i)
    if (!is_known[i]) seen.push_back({model_.add(features[i], pose.T_map_camera, pose.scan, frames_), i});
  model_.shrink();
  return seen;
}

void ModelIcp::addKeyFrame(RgbdPose& pose, KeyFramePlace place, const FramePyramid& pyramid, Adjusted adjusted) {
  const auto frame = makeKeyFrame(pose.stamp, pyramid, adjusted.features, {}, features_.depth_noise);
  adjusted_.push_back(std::move(adjusted));
  if (adjusted_.size() > kAdjusted) adjusted_.pop_front();
  adjustBundle();  // Line 4.
  place.T_map_key = pose.T_map_camera = pose.fit.T_map_camera = adjusted_.back().T_map_key;
  keys_.add(frame, place);
  pose.became_key_frame = true;
}

void ModelIcp::adjustBundle() {
  if (adjusted_.size() <= kFixed) return;
  optimization::Bundle bundle;
  bundle.fixed = {0, 1};
  std::map<std::uint64_t, int> views;  // Of each landmark.
  for (const Adjusted& key : adjusted_)
    for (const Observation& seen : key.seen) ++views[seen.landmark];
  std::map<std::uint64_t, int> indices;
  for (const Adjusted& key : adjusted_) {
    const auto index = static_cast<int>(bundle.poses.size());
    bundle.poses.push_back(key.T_map_key);
    if (isInMap(key.seed)) bundle.measured.push_back({index, key.seed->T_map_camera, seedCovariance().inverse()});
    for (const Observation& seen : key.seen) {
      const Landmark* landmark = views[seen.landmark] > 1 ? model_.find(seen.landmark) : nullptr;
      if (landmark == nullptr) continue;
      const auto [known, is_new] = indices.emplace(seen.landmark, static_cast<int>(bundle.landmarks_m.size()));
      if (is_new) bundle.landmarks_m.push_back(landmark->mean_map_m);
      const vision::Feature& feature = key.features[seen.feature];
      bundle.observations.push_back({index, known->second, feature.mean_camera_m, feature.covariance_camera_m2});
    }
  }
  optimization::PoseGraphConfig config;
  config.max_iterations = kIterations;
  optimization::adjust(bundle, config);
  for (const auto& [number, index] : indices)
    model_.moveTo(number, bundle.landmarks_m[static_cast<std::size_t>(index)]);
  for (std::size_t i = 0; i < adjusted_.size(); ++i) adjusted_[i].T_map_key = bundle.poses[i];
}

}  // namespace swiftlet::mapping3d
