#include "autonomy/estimation/rgbd_pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "autonomy/arrivals/stamp_check.hpp"
#include "common/blank_picture.hpp"
#include "common/vehicle_config.hpp"
#include "common/whole_frame.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Duration;
using common::Severity;
using common::Time;

constexpr const char* kMapping3d = "mapping3d";

const char* pictureFault(const common::Image& picture) {
  switch (common::blankOf(picture)) {
    case common::Blank::kBlack:
      return "its picture is black";
    case common::Blank::kWhite:
      return "its picture is white";
    case common::Blank::kNo:
      break;
  }
  return nullptr;
}

/// The noise of the depths makes each frame differ from the one before, unless nothing was measured. Bytes are
/// compared, because some drivers write NaN for a hole.
bool repeats(const common::DepthImage& depth, const common::DepthImage& last) {
  const std::vector<float>&a = depth.depth_m, &b = last.depth_m;
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0 &&
         std::any_of(a.begin(), a.end(), common::isMeasured);
}

}  // namespace

RgbdPipeline::RgbdPipeline(const RgbdPipelineConfig& config, const common::RgbdCameraConfig& camera,
                           common::JobRunner& jobs)
    : config_(config),
      calibration_(config.calibration, camera.mount.pose()),
      has_noise_(camera.inverse_depth_noise_1_m > 0.0),
      silence_("camera", "frame", config.silent_s),
      jobs_(jobs),
      mapper_(std::make_shared<mapping3d::Mapper3d>(config.mapper)),
      publisher_(config.publisher, config.mapper.voxels.resolution_m, jobs) {
  if (config.radio.isUsed()) radio_.emplace(config.radio);
}

bool RgbdPipeline::add(std::shared_ptr<const common::RgbdFrame> frame) {
  const Time arrived = frame->stamps.arrived;
  if (const char* fault = faultOf(*frame)) {
    silence_.unusableArrived(arrived, fault);
    skip(fault, arrived);
    return false;
  }
  keep(silence_.usableArrived(arrived));
  ++counts_.frames;
  last_ = frame;
  if (radio_)
    radio_->offer(std::move(frame));
  else
    waiting_ = std::move(frame);
  return true;
}

/// Null for a frame that can be used.
const char* RgbdPipeline::faultOf(const common::RgbdFrame& frame) {
  if (const char* fault = stampFault(frame.stamps, last_ ? std::optional(last_->stamps.measured) : std::nullopt))
    return fault;
  if (!isWhole(frame)) return "its images do not have the size of the camera";
  if (const char* fault = pictureFault(frame.color)) {
    ++counts_.blank;
    return fault;
  }
  if (has_noise_ && last_ && repeats(frame.depth, last_->depth)) return "it repeats the last picture with a new stamp";
  return nullptr;
}

void RgbdPipeline::skip(const char* fault, Time now) {
  ++counts_.skipped;
  if (!faults_said_.insert(fault).second) return;
  say(now, Severity::kWarning, "a frame cannot be used", std::string(fault) + "; further ones are only counted");
}

/// By the flight's clock. The time of a rolling shutter's middle row is used for all rows.
Time RgbdPipeline::timeOf(const common::RgbdFrame& frame) const {
  return frame.stamps.measured + frame.row_time * (frame.camera.height_px / 2) -
         Duration::fromSeconds(calibration_.clockOffset_s());
}

std::optional<Time> RgbdPipeline::next() const {
  if (!waiting_ || !jobs_.idle(kMapping3d)) return std::nullopt;
  return timeOf(*waiting_);
}

void RgbdPipeline::map(const FrameSituation& situation, Time now) {
  const std::shared_ptr<const common::RgbdFrame> frame = std::exchange(waiting_, nullptr);
  // The key frames hang on key scans, so there is no 3D map before the 2D map.
  if (situation.keys->keys.empty()) return;
  // The first frame places the 3D map in the 2D map. Without a measured pose it would lie at the origin, and all later
  // frames would be aligned to it.
  if (!has_begun_ && !(situation.at_key && situation.supported)) return;
  mapping3d::FrameContext context;
  context.scans = situation.keys;
  if (situation.at_key)
    context.seed = mapping3d::CameraSeed{situation.keys->inMap(*situation.at_key) * calibration_.T_body_camera(),
                                         situation.at_key->key, situation.supported};
  const bool publish = publisher_.begin(now);
  std::optional<BodyAtFrame> body = situation.body;
  if (body) body->motion.clock_offset_s = calibration_.clockOffset_s();
  jobs_.submit(kMapping3d, now, Duration::fromSeconds(config_.latency_s),
               [this, mapper = mapper_, frame, time = timeOf(*frame), at_key = situation.at_key, body, context,
                people = situation.people, publish]() mutable -> common::JobRunner::Deliver {
                 context.people = people;
                 Outcome outcome{frame, time, at_key, body, context.scans, mapper->add(*frame, context), {}};
                 if (publish) outcome.submaps = mapper->submaps();
                 return [this, outcome = std::move(outcome)](Time delivered) { take(outcome, delivered); };
               });
}

void RgbdPipeline::take(Outcome outcome, Time delivered) {
  const bool tracked = outcome.mapped.pose.isTracked();
  ++(tracked ? counts_.mapped : counts_.lost);
  reportTrack(tracked, delivered);
  if (!publisher_.hasLayer()) publisher_.change().camera.T_body_camera = calibration_.T_body_camera();
  if (tracked) {
    has_begun_ = true;
    calibrate(outcome, delivered);
    if (config_.measure) step_ = stepOf(outcome);
  }
  if (outcome.submaps) publisher_.setSubmaps(std::move(*outcome.submaps));
  common::Map3dLayer& layer = publisher_.change();
  layer.frame = outcome.frame;
  layer.tracked = tracked;
  scan_ = outcome.mapped.pose.scan;
  T_scan_camera_ = outcome.mapped.T_scan_camera;
}

CameraStep RgbdPipeline::stepOf(const Outcome& outcome) {
  const mapping3d::RgbdPose& pose = outcome.mapped.pose;
  CameraStep step;
  if (!outcome.body) return step;
  if (reference_ && pose.measured) {
    const common::Pose3 T_map_reference = outcome.scans->T_map_level(reference_->scan) * reference_->T_scan_camera;
    mapping3d::CameraMotion motion;
    motion.T_from_to_camera = T_map_reference.inverse() * pose.measured->T_map_camera;
    motion.covariance = pose.measured->covariance;
    motion.T_from_to_body = calibration_.bodyMotion(motion.T_from_to_camera);
    motion.from = reference_->motion;
    motion.to = outcome.body->motion;
    step.measurement = {reference_->time, outcome.time, motion.T_from_to_body, calibration_.bodyCovariance(motion)};
  }
  if (pose.became_key_frame || !reference_) {
    step.clone_after = outcome.time;
    reference_ = Reference{outcome.time, pose.scan, outcome.mapped.T_scan_camera, outcome.body->motion};
  }
  return step;
}

/// Rotations are compared with those of the filter, which follow the gyroscopes. Its positions follow the camera, so
/// translations are compared with those by the 2D map.
void RgbdPipeline::calibrate(const Outcome& outcome, Time now) {
  if (!outcome.mapped.pose.became_key_frame) return;
  const auto from = std::exchange(key_frame_, std::nullopt);
  if (!outcome.at_key || !outcome.body) return;
  key_frame_ = BodyAtKeyFrame{outcome.frame->stamps.measured, *outcome.at_key, *outcome.body};
  const auto& seen = outcome.mapped.pose.motion;
  if (!from || !seen || seen->from != from->stamp) return;
  const common::Pose3 T_map_from = outcome.scans->inMap(from->at_key), T_map_to = outcome.scans->inMap(*outcome.at_key);
  const common::Pose3 T_from_to{from->body.R_odom_body.conjugate() * outcome.body->R_odom_body,
                                (T_map_from.inverse() * T_map_to).position_m};
  calibration_.add({seen->T_from_to, seen->covariance, T_from_to, from->body.motion, outcome.body->motion});
  reportCamera(now);
}

common::CameraEstimate RgbdPipeline::camera() const {
  const auto sigma = [this](int i) { return std::sqrt(calibration_.errors().covariance(i, i)); };
  return {calibration_.T_body_camera(), {sigma(3), sigma(4), sigma(5)}, calibration_.clockOffset_s(), sigma(6)};
}

void RgbdPipeline::reportCamera(Time now) {
  const mapping3d::CameraErrors& errors = calibration_.errors();
  const auto sigma = [&](int i) { return std::sqrt(errors.covariance(i, i)); };
  publisher_.change().camera = camera();
  const auto degrees = [&](int i) {
    return fmt::format("{:.2f} +- {:.2f}", errors.mean[i] / common::kRadPerDeg, sigma(i) / common::kRadPerDeg);
  };
  if (!mount_said_ && calibration_.isKnown(3) && calibration_.isKnown(4) && calibration_.isKnown(5)) {
    mount_said_ = true;
    say(now, Severity::kInfo, "mount of the camera estimated",
        fmt::format("turned by {}, {}, {} deg about x, y, z of the body", degrees(3), degrees(4), degrees(5)));
  }
  if (!clock_said_ && calibration_.isKnown(6)) {
    clock_said_ = true;
    say(now, Severity::kInfo, "clock of the camera estimated",
        fmt::format("{:.1f} +- {:.1f} ms late", 1e3 * errors.mean[6], 1e3 * sigma(6)));
  }
}

std::shared_ptr<const common::Map3dLayer> RgbdPipeline::layer(const std::shared_ptr<const common::KeyPoses>& keys) {
  if (publisher_.isStale(keys)) publisher_.change().T_map_camera = keys->T_map_level(scan_) * T_scan_camera_;
  return publisher_.layer(keys);
}

void RgbdPipeline::watch(const std::shared_ptr<const common::KeyPoses>& keys, Time now) {
  publisher_.fuse(keys, now);
  if (radio_) watchRadio(now);
  keep(silence_.watch(now));
  if (waiting_ || !jobs_.idle(kMapping3d) || !publisher_.beginLate(now)) return;
  jobs_.submit(kMapping3d, now, Duration::fromSeconds(config_.latency_s),
               [this, mapper = mapper_]() -> common::JobRunner::Deliver {
                 return [this, submaps = mapper->submaps()](Time) { publisher_.setSubmaps(submaps); };
               });
}

void RgbdPipeline::watchRadio(Time now) {
  if (!through_at_) through_at_ = silence_.since();
  while (auto frame = radio_->take(now)) {
    waiting_ = std::move(frame);
    through_at_ = now;
    if (std::exchange(stuck_said_, false)) say(now, Severity::kInfo, "frames come through the radio again");
  }
  if (const int halvings = radio_->halvings(); halvings > most_halvings_) {
    most_halvings_ = halvings;
    say(now, Severity::kWarning, "frames are sent smaller",
        fmt::format(
            "whole ones take longer over the radio than {:.2f} s; the map has 1 in {} of their pixels. A camera with "
            "fewer pixels or a faster radio loses none",
            config_.radio.oldest_s, std::int64_t{1} << 2 * halvings));
  }
  if (!through_at_ || stuck_said_ || (now - *through_at_).seconds() < config_.silent_s || silence_.isDue(now)) return;
  stuck_said_ = true;
  say(now, Severity::kWarning, "no frame comes through the radio",
      fmt::format("each takes longer than {:.2f} s, so there is no 3D map; use a faster radio or a camera with fewer "
                  "pixels, or set rgbd.radio.oldest_s",
                  config_.radio.oldest_s));
}

void RgbdPipeline::reportTrack(bool tracked, Time now) {
  if (tracked) {
    if (lost_said_) say(now, Severity::kInfo, "3D track found again");
    lost_since_.reset();
    lost_said_ = false;
    return;
  }
  if (!lost_since_) lost_since_ = now;
  if (lost_said_ || (now - *lost_since_).seconds() < config_.lost_s) return;
  lost_said_ = true;
  say(now, Severity::kWarning, "3D track lost", "frames do not fit the map, and are left out");
}

void RgbdPipeline::say(Time now, Severity severity, std::string text, std::string reason) {
  events_.push_back({now, severity, "mapping3d", std::move(text), std::move(reason)});
}

void RgbdPipeline::keep(std::optional<common::Event> event) {
  if (event) events_.push_back(std::move(*event));
}

std::vector<common::Event> RgbdPipeline::takeEvents() { return std::exchange(events_, {}); }

}  // namespace swiftlet::autonomy
