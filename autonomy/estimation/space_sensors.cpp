#include "autonomy/estimation/space_sensors.hpp"

#include <algorithm>
#include <utility>

namespace swiftlet::autonomy {

using common::Time;

namespace {

/// Scans of this age have arrived from most lasers and are in the map.
constexpr double kLookBack_s = 0.05;

bool looksForOpenings(const std::vector<perception::KnownObjectConfig>& objects) {
  return std::any_of(objects.begin(), objects.end(), [](const auto& object) { return !object.isPattern(); });
}

/// A frame that shows nothing: the time at which a vehicle without a camera looks at its scan.
std::shared_ptr<const common::RgbdFrame> emptyFrame(Time now) {
  auto frame = std::make_shared<common::RgbdFrame>();
  frame->stamps = {now - common::Duration::fromSeconds(kLookBack_s), now};
  return frame;
}

}  // namespace

SpaceSensors::SpaceSensors(const Config& config, const common::RgbdCameraConfig* camera,
                           const common::LaserConfig* vertical_laser, common::JobRunner& jobs, common::EventLog& log)
    : rgbd_(camera && !camera->isStereo() ? std::make_unique<RgbdPipeline>(config.rgbd, *camera, jobs, log) : nullptr),
      stereo_(camera && camera->isStereo() ? std::make_unique<StereoPipeline>(*camera, jobs, log) : nullptr),
      stereo_map_(stereo_ ? std::make_unique<StereoMap>(config.rgbd, *camera, stereo_->noise(), jobs) : nullptr),
      vertical_laser_(vertical_laser && !camera
                          ? std::make_unique<VerticalLaserPipeline>(config.vertical_laser, *vertical_laser, jobs, log)
                          : nullptr),
      targets_(rgbd_ && !config.targets.classes.empty()
                   ? std::make_unique<TargetPipeline>(config.targets, jobs, camera->range_max_m, log)
                   : nullptr),
      recognition_((camera && !config.recognition.empty()) || looksForOpenings(config.recognition)
                       ? std::make_unique<RecognitionPipeline>(
                             config.recognition, camera ? *camera : common::RgbdCameraConfig(), config.laser, jobs, log)
                       : nullptr) {}

bool SpaceSensors::add(std::shared_ptr<const common::RgbdFrame> frame) {
  if (stereo_) stereo_->add(frame, frame->stamps.arrived);
  if (!rgbd_ || !rgbd_->add(frame)) return false;
  if (recognition_) recognition_->add(frame);
  if (targets_) targets_->add(std::move(frame));
  return true;
}

void SpaceSensors::add(std::shared_ptr<const common::VerticalScan> sweep) {
  if (vertical_laser_) vertical_laser_->add(std::move(sweep));
}

std::optional<CameraStep> SpaceSensors::takeStep(const std::shared_ptr<const common::KeyPoses>& keys, Time now) {
  if (stereo_) {
    stereo_->watch(now);
    stereo_map_->watch(keys, now);
    if (auto frame = stereo_->takeFrame()) {
      if (recognition_) recognition_->add(frame);
      stereo_map_->add(std::move(frame));
    }
    return stereo_->take();
  }
  if (!rgbd_) return std::nullopt;
  rgbd_->watch(keys, now);
  return rgbd_->steps().take();
}

void SpaceSensors::forgetClone() {
  if (stereo_) stereo_->forgetClones();
  if (rgbd_) rgbd_->steps().forgetClone();
}

void SpaceSensors::map(const MapSituation& situation, Time now) {
  if (rgbd_) mapFrame(situation, now);
  if (stereo_map_) mapPair(situation, now);
  if (targets_) lookForTargets(situation, now);
  if (recognition_) recognize(situation, now);
  if (vertical_laser_) mapSweeps(situation, now);
}

FrameSituation SpaceSensors::situationAt(Time time, const MapSituation& situation, Time now) {
  FrameSituation at;
  at.at_key = situation.poses.atKey(time);
  at.body = situation.poses.bodyAt(time);
  at.supported = situation.poses.isSupported(now);
  at.keys = situation.keys;
  at.people = situation.people.expectedAt(time);
  return at;
}

void SpaceSensors::mapFrame(const MapSituation& situation, Time now) {
  const auto time = rgbd_->next();
  if (time && situation.poses.isKnown(*time, now, rgbd_->waitUntil()))
    rgbd_->map(situationAt(*time, situation, now), now);
}

/// Where the filter knows the position by the camera, no scan needs to have matched.
void SpaceSensors::mapPair(const MapSituation& situation, Time now) {
  const auto time = stereo_map_->next();
  if (!time || !situation.poses.isKnown(*time, now, stereo_map_->waitUntil())) return;
  FrameSituation at = situationAt(*time, situation, now);
  at.supported = at.supported || isPlacedByStereo(now);
  stereo_map_->map(at, now);
}

void SpaceSensors::lookForTargets(const MapSituation& situation, Time now) {
  targets_->reportFound(situation.names);
  const common::CameraEstimate camera = rgbd_->camera();
  const auto time = targets_->next(camera.clock_offset_s);
  if (time && situation.poses.isKnown(*time, now, targets_->waitUntil()))
    targets_->look(situationAt(*time, situation, now), camera, situation.drift_m, now);
}

common::CameraEstimate SpaceSensors::anyCamera() const {
  if (rgbd_) return rgbd_->camera();
  return stereo_ ? common::CameraEstimate{stereo_->T_body_camera()} : common::CameraEstimate{};
}

void SpaceSensors::recognize(const MapSituation& situation, Time now) {
  recognition_->report(*situation.keys, situation.names, now);
  if (!hasCamera() && !recognition_->next(0.0)) recognition_->add(emptyFrame(now));
  const common::CameraEstimate camera = anyCamera();
  const auto time = recognition_->next(camera.clock_offset_s);
  if (!time || !situation.poses.isKnown(*time, now, recognition_->waitUntil())) return;
  FrameSituation at = situationAt(*time, situation, now);
  // Where the laser is blind, the stereo camera that shows the frame has measured its place.
  at.supported = at.supported || isPlacedByStereo(now);
  recognition_->look(at, camera.T_body_camera, *time, {situation.poses, situation.grid, situation.drift_m}, now);
}

void SpaceSensors::mapSweeps(const MapSituation& situation, Time now) {
  for (auto times = vertical_laser_->next();
       times && situation.poses.isKnown(times->end, now, vertical_laser_->waitUntil());
       times = vertical_laser_->next()) {
    auto sweep = situation.poses.during(*times, now);
    if (sweep) sweep->people = situation.people.expectedAt(times->begin);
    vertical_laser_->place(sweep);
  }
  vertical_laser_->draw(situation.keys, now);
}

std::shared_ptr<const common::Map3dLayer> SpaceSensors::layer(const std::shared_ptr<const common::KeyPoses>& keys) {
  if (vertical_laser_) return vertical_laser_->layer(keys);
  if (stereo_map_) return stereo_map_->layer(keys);
  return rgbd_ ? rgbd_->layer(keys) : nullptr;
}

std::vector<common::Target> SpaceSensors::targets(const common::KeyPoses& keys) const {
  return targets_ ? targets_->targets(keys) : std::vector<common::Target>();
}

std::shared_ptr<const common::ObjectsLayer> SpaceSensors::objects(const common::KeyPoses& keys) const {
  return recognition_ ? recognition_->layer(keys) : nullptr;
}

}  // namespace swiftlet::autonomy
