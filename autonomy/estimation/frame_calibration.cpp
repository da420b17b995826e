#include "autonomy/estimation/frame_calibration.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace swiftlet::autonomy {
using common::Time;

/// Rotations are compared with those of the filter, which follow the gyroscopes. Its positions follow the camera, so
/// translations are compared with those by the 2D map.
bool FrameCalibration::add(const std::optional<BodyAtKeyFrame>& body, const mapping3d::RgbdPose& seen,
                           const common::KeyPoses& keys, Time now) {
  const auto from = std::exchange(key_frame_, body);
  if (!from || !body || !seen.motion || seen.motion->from != from->stamp) return false;
  const common::Pose3 T_map_from = keys.inMap(from->at_key), T_map_to = keys.inMap(body->at_key);
  const common::Pose3 T_from_to{from->body.R_odom_body.conjugate() * body->body.R_odom_body,
                                (T_map_from.inverse() * T_map_to).position_m};
  calibration_.add({seen.motion->T_from_to, seen.motion->covariance, T_from_to, from->body.motion, body->body.motion});
  report(now);
  return true;
}

common::CameraEstimate FrameCalibration::camera() const {
  const auto sigma = [this](int i) { return std::sqrt(calibration_.errors().covariance(i, i)); };
  return {calibration_.T_body_camera(), {sigma(3), sigma(4), sigma(5)}, calibration_.clockOffset_s(), sigma(6)};
}

void FrameCalibration::report(Time now) {
  const mapping3d::CameraErrors& errors = calibration_.errors();
  const auto sigma = [&](int i) { return std::sqrt(errors.covariance(i, i)); };
  const auto degrees = [&](int i) {
    return fmt::format("{:.2f} +- {:.2f}", errors.mean[i] / common::kRadPerDeg, sigma(i) / common::kRadPerDeg);
  };
  if (!mount_reported_ && calibration_.isKnown(3) && calibration_.isKnown(4) && calibration_.isKnown(5)) {
    mount_reported_ = true;
    log_.info(now, kMapping3d, "mount of the camera estimated",
              fmt::format("turned by {}, {}, {} deg about x, y, z of the body", degrees(3), degrees(4), degrees(5)));
  }
  if (!clock_reported_ && calibration_.isKnown(6)) {
    clock_reported_ = true;
    log_.info(now, kMapping3d, "clock of the camera estimated",
              fmt::format("{:.1f} +- {:.1f} ms late", 1e3 * errors.mean[6], 1e3 * sigma(6)));
  }
}

}  // namespace swiftlet::autonomy
