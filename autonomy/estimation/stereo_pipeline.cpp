#include "autonomy/estimation/stereo_pipeline.hpp"

#include <string>

#include "autonomy/arrivals/stamp_check.hpp"
#include "vision/stereo_matcher.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Duration;
using common::Message;
using common::Time;

/// Declared time for a pair: four times what one of 376 x 240 takes (docs/decisions/cameras_and_lasers.md#119).
constexpr Duration kStereoLatency = Duration::fromMilliseconds(50);
/// A camera that sends no usable pair for this long is silent: four pairs at 3 Hz, the slowest that is flown.
constexpr double kPairsSilent_s = 1.5;
/// Visual odometry counts as unavailable, and as available again, when it has been for two pairs at 3 Hz.
constexpr double kBlind_s = 0.5;

}  // namespace

/// What a job works with.
struct StereoPipeline::Job {
  explicit Job(const common::RgbdCameraConfig& camera)
      : matcher(camera), odometry(matcher.noise()), T_body_camera(camera.mount.pose()) {}

  Outcome work(const common::RgbdFrame& pair, bool forget) {
    if (forget) odometry.forget();
    auto matched = matcher.match(pair);
    if (!matched) return {matched.error(), {}, {}, nullptr};
    const auto frame = std::make_shared<const common::RgbdFrame>(*std::move(matched));
    return {{}, odometry.add(*frame), pointsBelow_body_m(*frame, T_body_camera), frame};
  }

  vision::StereoMatcher matcher;
  perception::VisualOdometry odometry;
  common::Pose3 T_body_camera;
};

StereoPipeline::StereoPipeline(const common::RgbdCameraConfig& camera, common::JobRunner& jobs, common::EventLog& log)
    : log_(log),
      jobs_(jobs),
      T_body_camera_(camera.mount.pose()),
      job_(std::make_shared<Job>(camera)),
      noise_(job_->matcher.noise()),
      silence_("stereo camera", "pair", kPairsSilent_s, log),
      blind_(kBlind_s, kBlind_s),
      scale_(T_body_camera_) {}

StereoPipeline::~StereoPipeline() = default;

void StereoPipeline::add(std::shared_ptr<const common::RgbdFrame> pair, Time now) {
  if (const char* fault = stampFault(pair->stamps, last_measured_)) {
    silence_.unusableArrived(now, fault);
    return;
  }
  last_measured_ = pair->stamps.measured;
  waiting_ = std::move(pair);
}

void StereoPipeline::watch(Time now) {
  silence_.watch(now);
  if (!waiting_ || !jobs_.idle(kStereo)) return;
  jobs_.submit(kStereo, now, kStereoLatency,
               [this, job = job_, pair = std::exchange(waiting_, nullptr),
                forget = std::exchange(forget_, false)]() -> common::JobRunner::Deliver {
                 return [this, outcome = job->work(*pair, forget)](Time delivered) { take(outcome, delivered); };
               });
}

/// What a pair of before the clones were forgotten measures starts from one of them.
void StereoPipeline::take(const Outcome& outcome, Time delivered) {
  CameraStep step;
  const perception::VisualStep& seen = outcome.step;
  const Message missing = missingOf(outcome, delivered);
  if (seen.motion && missing.name().empty() && !forget_)
    step.measurement = bodyMeasurement(*seen.motion, T_body_camera_);
  if (seen.became_key_frame && !forget_) step.clone_after = seen.stamp;
  report(missing, delivered);
  step_ = step;
  frame_ = scale_.contradiction() ? nullptr : outcome.frame;
}

/// Why the pair measures no motion. One whose depths are scaled measures a scaled motion.
Message StereoPipeline::missingOf(const Outcome& outcome, Time delivered) {
  if (!outcome.fault.name().empty()) {
    silence_.unusableArrived(delivered, "it cannot be used");
    warnOnce("a pair cannot be used", outcome.fault, delivered);
    return outcome.fault;
  }
  silence_.usableArrived(delivered);
  scale_.addPair(outcome.step.stamp, outcome.below_body_m);
  const auto contradiction = scale_.contradiction();
  if (!contradiction) return outcome.step.missing;
  warnOnce("pairs are not used", *contradiction, delivered);
  return *contradiction;
}

void StereoPipeline::warnOnce(const char* what, const Message& fault, Time now) {
  if (faults_.insert(std::string(fault.name())).second)
    log_.warn(now, kStereo, what, fault.text() + "; it is said once");
}

void StereoPipeline::report(const Message& missing, Time now) {
  const common::Edge edge = blind_.update(!missing.name().empty(), now);
  if (edge == common::Edge::kEntered) log_.info(now, kStereo, "visual odometry unavailable", missing.text());
  if (edge == common::Edge::kLeft) log_.info(now, kStereo, "visual odometry available");
}

/// A small motion of the camera in its own axes is one of the body in the body's axes by the adjoint of the mount.
perception::Measurement bodyMeasurement(const perception::VisualMotion& motion, const common::Pose3& T_body_camera) {
  const Eigen::Matrix3d R = T_body_camera.rotation.toRotationMatrix();
  Eigen::Matrix<double, 6, 6> adjoint = Eigen::Matrix<double, 6, 6>::Zero();
  adjoint.topLeftCorner<3, 3>() = adjoint.bottomRightCorner<3, 3>() = R;
  adjoint.topRightCorner<3, 3>() = common::skew(T_body_camera.position_m) * R;
  const Eigen::Matrix<double, 6, 6> covariance = adjoint * motion.covariance * adjoint.transpose();
  return perception::measuredRelativePose3(motion.from, motion.to,
                                           T_body_camera * motion.T_from_to * T_body_camera.inverse(),
                                           0.5 * (covariance + covariance.transpose()));
}

}  // namespace swiftlet::autonomy
