// The mount and the clock of a camera from its motions: what is found, what stays unknown, and what cannot mislead it.
#include "mapping3d/odometry/camera_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "common/random.hpp"

namespace swiftlet::mapping3d {
namespace {

using common::Pose3;
using common::Time;
using Eigen::Vector3d;

using Flight = std::function<Pose3(double time_s)>;

/// Turns to look around, flies on, tilts as it accelerates.
Pose3 exploring(double time_s) {
  return {common::quaternionFrom(
              {0.04 * std::sin(1.7 * time_s), 0.05 * std::cos(1.1 * time_s), 2.5 * std::sin(0.6 * time_s)}),
          {2.0 * std::sin(0.3 * time_s), 1.5 * std::sin(0.4 * time_s), 1.0 + 0.05 * std::sin(time_s)}};
}
Pose3 turningInPlace(double time_s) { return {common::expSO3({0, 0, 2.5 * std::sin(0.6 * time_s)}), {0, 0, 1}}; }
Pose3 hovering(double) { return {Eigen::Quaterniond::Identity(), {0, 0, 1}}; }

MovingBody bodyAt(const Flight& flight, double time_s) {
  constexpr double kHalf_s = 1e-4;
  const Pose3 step = flight(time_s - kHalf_s).inverse() * flight(time_s + kHalf_s);
  return {Time::fromSeconds(time_s), step.position_m / (2.0 * kHalf_s), common::logSO3(step.rotation) / (2.0 * kHalf_s),
          0.0};
}

/// A camera with errors, and the motions that it measures.
struct Camera {
  Pose3 sheet{common::quaternionFrom({0.0, 0.1, 0.0}), {0.1, 0.0, 0.05}};
  Vector3d shift_m{0.006, -0.008, 0.0};
  Vector3d turn_rad{0.015, -0.012, 0.01};
  double clock_offset_s = 0.004;
  double noise_m = 0.004, noise_rad = 0.002;

  Pose3 mount() const { return {common::expSO3(turn_rad) * sheet.rotation, sheet.position_m + shift_m}; }
  /// Between frames with these stamps.
  CameraMotion motion(const Flight& flight, double from_s, double to_s) const {
    const Pose3 from = flight(from_s - clock_offset_s) * mount(), to = flight(to_s - clock_offset_s) * mount();
    common::RandomStream random(3, "motion", static_cast<std::uint64_t>(1e3 * to_s));
    const auto draw = [&](double sigma) {
      return Vector3d(random.gaussian(sigma), random.gaussian(sigma), random.gaussian(sigma));
    };
    CameraMotion motion;
    motion.T_from_to_camera = from.inverse() * to * Pose3{common::expSO3(draw(noise_rad)), draw(noise_m)};
    motion.covariance.diagonal() << Vector3d::Constant(noise_m * noise_m), Vector3d::Constant(noise_rad * noise_rad);
    motion.T_from_to_body = flight(from_s).inverse() * flight(to_s);
    motion.from = bodyAt(flight, from_s);
    motion.to = bodyAt(flight, to_s);
    return motion;
  }
};

CameraCalibration flown(const Camera& camera, const Flight& flight, double duration_s,
                        const CameraCalibrationConfig& config = {}) {
  CameraCalibration calibration(config, camera.sheet);
  constexpr double kStep_s = 0.4;
  for (double time_s = 1.0; time_s < 1.0 + duration_s; time_s += kStep_s)
    calibration.add(camera.motion(flight, time_s, time_s + kStep_s));
  return calibration;
}

double mountError_rad(const CameraCalibration& calibration, const Camera& camera) {
  return calibration.T_body_camera().rotation.angularDistance(camera.mount().rotation);
}

constexpr double kDeg = common::kRadPerDeg;

TEST(CameraCalibration, FindsMountAndClockOfAFlight) {
  const Camera camera;
  ASSERT_GT(camera.turn_rad.norm(), 1.2 * kDeg);
  const CameraCalibration calibration = flown(camera, exploring, 60.0);
  EXPECT_LT(mountError_rad(calibration, camera), 0.25 * kDeg);
  EXPECT_NEAR(calibration.clockOffset_s(), camera.clock_offset_s, 0.0015);
  EXPECT_TRUE(calibration.T_body_camera().position_m.isApprox(camera.sheet.position_m)) << "it is not corrected";
  CameraErrors::Vector7d truth;
  truth << camera.shift_m, camera.turn_rad, camera.clock_offset_s;
  const CameraErrors& errors = calibration.errors();
  for (int i = 0; i < 7; ++i)
    EXPECT_LT(std::abs(errors.mean[i] - truth[i]), 3.5 * std::sqrt(errors.covariance(i, i))) << i;
}

TEST(CameraCalibration, ACorrectedClockIsNotCorrectedTwice) {
  const Camera camera;
  CameraCalibration calibration(CameraCalibrationConfig{}, camera.sheet);
  for (double time_s = 1.0; time_s < 60.0; time_s += 0.4) {
    const double known_s = calibration.clockOffset_s();
    CameraMotion motion = camera.motion(exploring, time_s, time_s + 0.4);
    motion.T_from_to_body = exploring(time_s - known_s).inverse() * exploring(time_s + 0.4 - known_s);
    motion.from = bodyAt(exploring, time_s - known_s);
    motion.to = bodyAt(exploring, time_s + 0.4 - known_s);
    motion.from.clock_offset_s = motion.to.clock_offset_s = known_s;
    calibration.add(motion);
  }
  EXPECT_NEAR(calibration.clockOffset_s(), camera.clock_offset_s, 0.0015);
}

TEST(CameraCalibration, TurnsInPlaceDoNotTellTheYaw) {
  const Camera camera;
  const CameraCalibration calibration = flown(camera, turningInPlace, 60.0);
  EXPECT_TRUE(calibration.isKnown(3) && calibration.isKnown(4)) << "roll and pitch";
  EXPECT_FALSE(calibration.isKnown(5)) << "yaw";
  EXPECT_FALSE(calibration.isKnown(2)) << "height";
  EXPECT_NEAR(common::rollPitchYaw(calibration.T_body_camera().rotation * camera.sheet.rotation.conjugate()).yaw_rad,
              0.0, 1e-3);
}

TEST(CameraCalibration, HoveringTellsNothing) {
  const Camera camera;
  const CameraCalibration calibration = flown(camera, hovering, 60.0);
  for (int i = 0; i < 7; ++i) EXPECT_FALSE(calibration.isKnown(i)) << i;
  EXPECT_TRUE(calibration.T_body_camera().position_m.isApprox(camera.sheet.position_m));
  EXPECT_EQ(calibration.clockOffset_s(), 0.0);
}

TEST(CameraCalibration, AMotionFarFromAllOthersIsLeftOut) {
  const Camera camera;
  CameraCalibration calibration = flown(camera, exploring, 60.0);
  const CameraErrors::Vector7d before = calibration.errors().mean;
  CameraMotion wrong = camera.motion(exploring, 70.0, 70.4);
  wrong.T_from_to_camera = wrong.T_from_to_camera * Pose3{common::expSO3({0.0, 0.0, 0.3}), {0.4, 0.0, 0.0}};
  calibration.add(wrong);
  EXPECT_TRUE(calibration.errors().mean.isApprox(before));
  wrong.T_from_to_camera.position_m.x() = std::nan("");
  calibration.add(wrong);
  EXPECT_TRUE(calibration.errors().mean.isApprox(before));
}

TEST(CameraCalibration, CorrectionsAreBounded) {
  Camera camera;
  camera.turn_rad = {0.0, 0.15, 0.0};
  CameraCalibrationConfig config;
  config.gate_sigma = 100.0;
  const CameraCalibration calibration = flown(camera, exploring, 60.0, config);
  EXPECT_GT(calibration.errors().mean[4], 0.1);
  EXPECT_LE(calibration.T_body_camera().rotation.angularDistance(camera.sheet.rotation),
            std::sqrt(3.0) * CameraCalibration::kLimitSigma * CameraCalibration::kMountSigma_rad + 1e-9);
}

TEST(CameraCalibration, AnUncertainMountMakesItsMeasurementsUncertain) {
  const Camera camera;
  const CameraMotion turn = camera.motion(turningInPlace, 1.0, 1.4);
  const CameraCalibration before(CameraCalibrationConfig{}, camera.sheet);
  const CameraCalibration after = flown(camera, exploring, 60.0);
  CameraCalibrationConfig off;
  off.enabled = false;
  const CameraCalibration sheet = flown(camera, exploring, 60.0, off);
  // About x and y: a turn about the vertical with a tilted camera seems to tilt.
  const auto tilt = [&](const CameraCalibration& calibration) {
    return calibration.bodyCovariance(turn).diagonal().segment<2>(3).sum();
  };
  EXPECT_GT(tilt(before), 2.0 * tilt(after));
  EXPECT_GT(tilt(after), tilt(sheet));
  EXPECT_TRUE(sheet.T_body_camera().rotation.isApprox(camera.sheet.rotation));
  // And the body's motion is right once the mount is.
  const Pose3 truth =
      turningInPlace(1.0 - camera.clock_offset_s).inverse() * turningInPlace(1.4 - camera.clock_offset_s);
  EXPECT_LT(after.bodyMotion(turn.T_from_to_camera).rotation.angularDistance(truth.rotation), 0.01);
}

}  // namespace
}  // namespace swiftlet::mapping3d
