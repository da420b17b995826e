#include "autonomy/estimation/recognition_pipeline.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "common/check.hpp"
#include "perception/recognition/walls_beside_scan.hpp"
#include "vision/gray_image.hpp"
#include "vision/stereo_matcher.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Duration;
using common::Time;

constexpr const char* kRecognition = "recognition";
/// Least time from one frame that is looked at to the next: at 1 m/s a look from another place (0.2 m) each time.
constexpr double kRecognizeEvery_s = 0.2;
/// Declared time for one frame (see common/jobs.hpp): openings take 15 ms, a house 65 ms, a pattern up to
/// 71 ms at 752 x 480 (docs/recognition.md).
constexpr double kRecognizeLatency_s = 0.15;
/// A scan that is farther from a frame in time does not show what the frame shows: two scans of a laser at 10 Hz.
constexpr double kScanNear_s = 0.1;
/// Scans that are kept: as many as a laser at 40 Hz takes in the 400 ms that a late picture needs.
constexpr std::size_t kScansKept = 16;

/// Noise and steps of the disparity together; steps are uniform. That of a stereo camera is its matcher's.
double inverseDepthSigma_1_m(const common::RgbdCameraConfig& camera) {
  if (camera.isStereo()) return vision::StereoMatcher(camera).noise().sigma_per_m2;
  return std::hypot(camera.inverse_depth_noise_1_m, camera.inverse_depth_step_1_m / std::sqrt(12.0));
}

std::shared_ptr<perception::KnownObjects> knownObjects(const std::vector<perception::KnownObjectConfig>& objects,
                                                       const common::RgbdCameraConfig& camera) {
  perception::OpeningConfig openings;
  openings.inverse_depth_sigma_1_m = inverseDepthSigma_1_m(camera);
  openings.range_max_m = camera.range_max_m;
  auto known = perception::KnownObjects::create(objects, openings);
  SWIFTLET_CHECK(known.has_value());
  return std::make_shared<perception::KnownObjects>(*std::move(known));
}

/// "0.90 x 1.10 m, open".
std::string looksLike(const common::RecognizedObject& object) {
  std::string text = fmt::format("{:.2f} x {:.2f} m", object.size_m.x(), object.size_m.y());
  if (object.passage != common::Passage::kNone) text += std::string(", ") + toString(object.passage);
  return text;
}

}  // namespace

RecognitionPipeline::RecognitionPipeline(const std::vector<perception::KnownObjectConfig>& objects,
                                         const common::RgbdCameraConfig& camera, const common::LaserConfig& laser,
                                         common::JobRunner& jobs, common::EventLog& log)
    : jobs_(jobs), laser_(laser), known_(knownObjects(objects, camera)), frames_(kRecognizeEvery_s), log_(log) {}

void RecognitionPipeline::add(const common::LaserScan& scan) {
  auto level = std::make_shared<common::LaserScan>(scan);
  for (std::size_t i = 0; i < level->ranges_m.size(); ++i)
    if (laser_.isMirrorBeam(static_cast<int>(i))) level->ranges_m[i] = std::numeric_limits<float>::quiet_NaN();
  scans_.push_back(std::move(level));
  if (scans_.size() > kScansKept) scans_.pop_front();
}

std::optional<Time> RecognitionPipeline::next(double clock_offset_s) const {
  return jobs_.idle(kRecognition) ? frames_.next(clock_offset_s) : std::nullopt;
}

Time RecognitionPipeline::middleOf(const common::LaserScan& scan) const {
  return scan.stamps.measured + scan.time_increment * static_cast<std::int64_t>(scan.ranges_m.size() / 2);
}

std::optional<RecognitionPipeline::PlacedScan> RecognitionPipeline::scanAt(const PlacedFrame& placed, Time time,
                                                                           const Context& context) const {
  std::shared_ptr<const common::LaserScan> nearest;
  double apart_s = kScanNear_s;
  for (const auto& scan : scans_) {
    const double off_s = std::abs((middleOf(*scan) - time).seconds());
    if (off_s > apart_s) continue;
    nearest = scan;
    apart_s = off_s;
  }
  const auto at_key = nearest ? context.poses.atKey(middleOf(*nearest)) : std::nullopt;
  if (!at_key || at_key->key != placed.key) return std::nullopt;
  const common::Pose3 T_key_laser = at_key->T_key_body * laser_.mount.pose();
  return PlacedScan{nearest, placed.T_key_camera.inverse() * T_key_laser,
                    placed.keys->T_map_level(placed.key) * T_key_laser, context.grid};
}

std::vector<perception::Recognized> RecognitionPipeline::recognize(perception::KnownObjects& known,
                                                                   const PlacedFrame& placed,
                                                                   const std::optional<PlacedScan>& scan) {
  perception::Observation observation;
  perception::CameraPicture picture;
  if (known.needsPicture()) {
    picture = {placed.frame->camera, vision::grayOf(placed.frame->color)};
    observation.picture = &picture;
  }
  observation.frame = placed.frame.get();
  observation.R_level_camera = placed.keys->T_map_level(placed.key).rotation * placed.T_key_camera.rotation;
  std::vector<Eigen::Vector3d> seen_before_m;
  if (scan) {
    observation.scan = scan->scan.get();
    observation.T_camera_laser = scan->T_camera_laser;
    if (known.needsDepths())
      for (const Eigen::Vector3d& wall : perception::wallsBesideScan(*scan->scan, scan->T_map_laser, *scan->grid))
        seen_before_m.push_back(scan->T_camera_laser * wall);
    observation.seen_before_m = &seen_before_m;
  }
  return known.recognize(observation);
}

void RecognitionPipeline::look(const FrameSituation& situation, const common::Pose3& T_body_camera, Time time,
                               const Context& context, Time now) {
  auto placed = frames_.take(situation, T_body_camera, context.drift_m);
  if (!placed) return;
  const auto scan = scanAt(*placed, time, context);
  jobs_.submit(kRecognition, now, Duration::fromSeconds(kRecognizeLatency_s),
               [this, known = known_, placed = *std::move(placed), scan, time]() -> common::JobRunner::Deliver {
                 return [this, placed, time, recognized = recognize(*known, placed, scan)](Time) {
                   tracker_.add(recognized, {placed.key, placed.T_key_camera, placed.position_sigma_m,
                                             placed.turn_rate_rad_s, time, *placed.keys});
                 };
               });
}

std::shared_ptr<const common::ObjectsLayer> RecognitionPipeline::layer(const common::KeyPoses& keys) const {
  return std::make_shared<const common::ObjectsLayer>(common::ObjectsLayer{tracker_.objects(keys)});
}

void RecognitionPipeline::report(const common::KeyPoses& keys, const common::PlaceNames& names, Time now) {
  for (const common::RecognizedObject& object : tracker_.objects(keys)) {
    if (!object.confirmed) continue;
    const Said next{object.what, object.passage};
    const auto before = said_.find(object.id);
    if (before != said_.end() && before->second == next) continue;
    log_.info(now, kRecognition,
              fmt::format("{} {}", labelOf(object), before == said_.end() ? "recognized" : "is seen otherwise now"),
              fmt::format("{} at {} +- {:.2f} m, seen from {} places", looksLike(object),
                          names.of(object.T_map_object.position_m), object.sigma_m(), object.looks));
    said_[object.id] = next;
  }
}

}  // namespace swiftlet::autonomy
