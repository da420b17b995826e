#include "mapping3d/odometry/frame_odometry.hpp"

namespace swiftlet::mapping3d {

LastFrame::LastFrame(const RgbdPose& pose, const std::optional<CameraSeed>& its_seed,
                     const std::optional<LastFrame>& before)
    : stamp(pose.stamp),
      T_map_camera(pose.T_map_camera),
      covariance(pose.covariance),
      scan(pose.scan),
      seed(its_seed),
      exposure(pose.fit.exposure) {
  if (before && pose.state == TrackState::kTracked)
    motion = motionBetween(before->T_map_camera, T_map_camera, (stamp - before->stamp).seconds());
}

}  // namespace swiftlet::mapping3d
