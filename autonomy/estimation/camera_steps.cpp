#include "autonomy/estimation/camera_steps.hpp"

namespace swiftlet::autonomy {

void CameraSteps::add(common::Time time, const mapping3d::MovingBody& body, const mapping3d::MappedFrame& mapped,
                      const common::KeyPoses& keys, const mapping3d::CameraCalibration& calibration) {
  const mapping3d::RgbdPose& pose = mapped.pose;
  CameraStep step;
  if (reference_ && pose.measured) {
    const common::Pose3 T_map_reference = keys.T_map_level(reference_->scan) * reference_->T_scan_camera;
    mapping3d::CameraMotion motion;
    motion.T_from_to_camera = T_map_reference.inverse() * pose.measured->T_map_camera;
    motion.covariance = pose.measured->covariance;
    motion.T_from_to_body = calibration.bodyMotion(motion.T_from_to_camera);
    motion.from = reference_->motion;
    motion.to = body;
    step.measurement = perception::measuredRelativePose3(reference_->time, time, motion.T_from_to_body,
                                                         calibration.bodyCovariance(motion));
  }
  if (pose.became_key_frame || !reference_) {
    step.clone_after = time;
    reference_ = Reference{time, pose.scan, mapped.T_scan_camera, body};
  }
  step_ = step;
}

}  // namespace swiftlet::autonomy
