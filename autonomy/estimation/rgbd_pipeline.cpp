#include "autonomy/estimation/rgbd_pipeline.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Duration;
using common::Time;

/// Greatest wait of a frame for a scan that is not older: two scans of a laser at 40 Hz.
constexpr Duration kWait = Duration::fromMilliseconds(50);
/// The track counts as lost when no frame has fitted for this long: two to three frames of the slowest camera.
constexpr double kLost_s = 0.5;

}  // namespace

RgbdPipeline::RgbdPipeline(const RgbdPipelineConfig& config, const common::RgbdCameraConfig& camera,
                           common::JobRunner& jobs, common::EventLog& log)
    : latency_(Duration::fromSeconds(config.latency_s)),
      log_(log),
      intake_(config.radio, camera, log),
      calibration_(config.calibration, camera.mount.pose(), log),
      jobs_(jobs),
      mapper_(std::make_shared<mapping3d::Mapper3d>(config.mapper)),
      publisher_(config.mapper.voxels.resolution_m, jobs),
      lost_(kLost_s) {}

bool RgbdPipeline::add(std::shared_ptr<const common::RgbdFrame> frame) {
  const bool usable = intake_.add(std::move(frame));
  fetch();
  return usable;
}

/// A newer frame replaces the one that waits.
void RgbdPipeline::fetch() {
  if (auto frame = intake_.take()) waiting_ = std::move(frame);
}

/// By the flight's clock. The time of a rolling shutter's middle row is used for all rows.
Time RgbdPipeline::timeOf(const common::RgbdFrame& frame) const {
  return frame.stamps.measured + frame.row_time * (frame.camera.height_px / 2) -
         Duration::fromSeconds(calibration_.calibration().clockOffset_s());
}

std::optional<Time> RgbdPipeline::next() const {
  if (!waiting_ || !jobs_.idle(kMapping3d)) return std::nullopt;
  return timeOf(*waiting_);
}

Time RgbdPipeline::waitUntil() const { return waiting_->stamps.arrived + kWait; }

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
    context.seed =
        mapping3d::CameraSeed{situation.keys->inMap(*situation.at_key) * calibration_.calibration().T_body_camera(),
                              situation.at_key->key, situation.supported};
  const bool publish = publisher_.begin(now);
  std::optional<BodyAtFrame> body = situation.body;
  if (body) body->motion.clock_offset_s = calibration_.calibration().clockOffset_s();
  jobs_.submit(kMapping3d, now, latency_,
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
  ++(tracked ? mapped_ : lost_frames_);
  reportTrack(tracked, delivered);
  if (!publisher_.hasLayer()) publisher_.change().camera.T_body_camera = calibration_.calibration().T_body_camera();
  if (tracked) {
    has_begun_ = true;
    measure(outcome, delivered);
  }
  if (outcome.submaps) publisher_.setSubmaps(std::move(*outcome.submaps));
  common::Map3dLayer& layer = publisher_.change();
  layer.frame = outcome.frame;
  layer.tracked = tracked;
  scan_ = outcome.mapped.pose.scan;
  T_scan_camera_ = outcome.mapped.T_scan_camera;
}

void RgbdPipeline::measure(const Outcome& outcome, Time now) {
  const mapping3d::RgbdPose& pose = outcome.mapped.pose;
  if (pose.became_key_frame) {
    std::optional<BodyAtKeyFrame> body;
    if (outcome.at_key && outcome.body)
      body = BodyAtKeyFrame{outcome.frame->stamps.measured, *outcome.at_key, *outcome.body};
    if (calibration_.add(body, pose, *outcome.scans, now)) publisher_.change().camera = camera();
  }
  if (outcome.body)
    steps_.add(outcome.time, outcome.body->motion, outcome.mapped, *outcome.scans, calibration_.calibration());
  else
    steps_.addUnplaced();
}

std::shared_ptr<const common::Map3dLayer> RgbdPipeline::layer(const std::shared_ptr<const common::KeyPoses>& keys) {
  if (publisher_.isStale(keys)) publisher_.change().T_map_camera = keys->T_map_level(scan_) * T_scan_camera_;
  return publisher_.layer(keys);
}

void RgbdPipeline::watch(const std::shared_ptr<const common::KeyPoses>& keys, Time now) {
  publisher_.fuse(keys, now);
  intake_.watch(now);
  fetch();
  if (waiting_ || !jobs_.idle(kMapping3d) || !publisher_.beginLate(now)) return;
  jobs_.submit(kMapping3d, now, latency_, [this, mapper = mapper_]() -> common::JobRunner::Deliver {
    return [this, submaps = mapper->submaps()](Time) { publisher_.setSubmaps(submaps); };
  });
}

RgbdCounts RgbdPipeline::counts() const {
  RgbdCounts counts = intake_.counts();
  counts.mapped = mapped_;
  counts.lost = lost_frames_;
  return counts;
}

void RgbdPipeline::reportTrack(bool tracked, Time now) {
  const common::Edge edge = lost_.update(!tracked, now);
  if (edge == common::Edge::kEntered)
    log_.warn(now, kMapping3d, "3D track lost", "frames do not fit the map, and are left out");
  if (edge == common::Edge::kLeft) log_.info(now, kMapping3d, "3D track found again");
}

}  // namespace swiftlet::autonomy
