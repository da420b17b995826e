// The estimator's height: the slopes of the ground that the camera sees, and what a scan tells of the height.
#include "autonomy/estimator.hpp"

#include <fmt/format.h>

namespace swiftlet::autonomy {

using common::Severity;
using common::Time;

namespace {

/// Period of the images from which slopes of the ground are taken.
constexpr double kGroundPeriod_s = 0.2;
/// A match no older than this tells the place of an image.
constexpr double kMatched_s = 0.15;
/// What the camera measures is not used for so long after the beams down contradicted it, or corrected the height: two
/// windows of HeightDrift, and longer than the filter resists a correction.
constexpr double kCameraDoubted_s = 1.0;

}  // namespace

/// The poses at the time of the frame are known when it arrives. A few images a second show each place several times.
void Estimator::lookAtGround(const common::RgbdFrame& frame) {
  const common::CameraEstimate camera = rgbd_->camera();
  const Time time = frame.stamps.measured - common::Duration::fromSeconds(camera.clock_offset_s);
  if (!filter_.initialized() || (time - ground_seen_).seconds() < kGroundPeriod_s) return;
  const std::optional<common::KeyRelativePose> at_key = atKey(time);
  if (!at_key || (frame.stamps.arrived - map_seen_).seconds() >= kMatched_s) return;
  ground_seen_ = time;
  const auto keys = map_.keyPoses();
  altitude_.follow(*keys, at_key->key);
  altitude_.lookAtGround(frame.depth, frame.camera, keys->inMap(*at_key) * camera.T_body_camera);
}

bool Estimator::isCameraDoubted(Time now) const {
  return camera_doubted_ && (now - *camera_doubted_).seconds() < kCameraDoubted_s;
}

/// The camera is the only sensor beside the beams that measures the height. Where it takes a climb for rest, the levels
/// below agree with nothing, and the height would follow the camera up to the ceiling.
void Estimator::correctClimb(const perception::HeightDriftRate& drift, Time stamp) {
  const auto vertical = filter_.verticalAt(stamp);
  if (!rgbd_ || !vertical) return;
  if (!isCameraDoubted(stamp))
    say(stamp, Severity::kWarning, "altitude", "the beams down contradict the height",
        fmt::format("over one place the distance down grows by {:+.2f} m/s more than the height; the camera is not "
                    "used for {:.0f} s",
                    drift.speed_m_s, kCameraDoubted_s));
  camera_doubted_ = stamp;
  tell(perception::TapedClimb{stamp, vertical->velocity_m_s + drift.speed_m_s, drift.variance_m2_s2});
}

void Estimator::fuse(const AltitudeStep& step, Time stamp) {
  if (step.drift) correctClimb(*step.drift, stamp);
  if (const auto& m = step.measurement) {
    tell(perception::TapedHeight{m->stamp, m->height_m, m->variance_m2, m->level_variance_m2});
    if (m->speed) tell(perception::TapedClimb{m->stamp, m->speed->up_m_s, m->speed->variance_m2_s2});
  }
  if (step.doubt_m_s)
    say(stamp, Severity::kWarning, "altitude", "height doubtful: the ground may slope",
        fmt::format(
            "what is below was taken for level, and the vertical speed corrected by {:+.2f} m/s in flight; on a "
            "ramp the height is then wrong by what it rises",
            *step.doubt_m_s));
  if (step.slope_began) say(stamp, Severity::kInfo, "altitude", "the ground slopes", "as the camera saw it");
  if (step.slope_ended_rise_m)
    say(stamp, Severity::kInfo, "altitude", "the slope has ended",
        fmt::format("the ground is {:+.2f} m where it is level again", *step.slope_ended_rise_m));
  if (step.floor_regained_m) {
    camera_doubted_ = stamp;
    say(stamp, Severity::kWarning, "altitude", "the floor is below again",
        fmt::format("what was taken for a level covers the floor that was seen before: the height is corrected by "
                    "{:+.2f} m",
                    *step.floor_regained_m));
  }
  if (step.levels_joined > 0)
    say(stamp, Severity::kInfo, "altitude", fmt::format("{} levels joined", step.levels_joined));
}

}  // namespace swiftlet::autonomy
