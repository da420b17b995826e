// Recorded cameras, with bounds that a regression would break. The reference of 7-Scenes was tracked by KinectFusion
// and jumps itself by up to 5 cm and 2 deg between two frames (decision 032), so its bounds are wide.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include <fmt/format.h>

#include "evaluation/trajectory_metrics.hpp"
#include "interfaces/files/archive.hpp"
#include "interfaces/files/tum.hpp"
#include "interfaces/rgbd/rgbd_folder.hpp"
#include "mapping3d/odometry/rgbd_odometry.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::mapping3d {
namespace {

namespace fs = std::filesystem;
using common::Pose3;

struct Tracked {
  common::Trajectory trajectory;  ///< Of the recorder's camera, in axes of image processing.
  int frames = 0;
};

Tracked track(const fs::path& folder, const std::optional<interfaces::RgbdCalibration>& calibration) {
  interfaces::RgbdFolder frames(folder, calibration);
  const Pose3 T_camera_recorded = interfaces::T_camera_optical() * frames.calibration().T_recorded_color().inverse();
  RgbdOdometry odometry({});
  Tracked tracked;
  while (const auto frame = frames.next()) {
    ++tracked.frames;
    const RgbdPose pose = odometry.process(*frame);
    if (pose.isTracked()) tracked.trajectory.push_back({pose.stamp, pose.T_map_camera * T_camera_recorded});
  }
  return tracked;
}

double positionError_m(const common::Trajectory& estimate, const common::Trajectory& reference) {
  const auto pairs = evaluation::associate(estimate, reference, common::Duration::fromSeconds(0.02));
  const auto error = evaluation::absoluteTrajectoryError(pairs, evaluation::Alignment::kSpatial);
  return error ? error->translation_m.rmse : 1e9;
}

/// The poses of 7-Scenes: a 4x4 matrix a frame, camera to world.
common::Trajectory sevenScenesPoses(const fs::path& folder, int last) {
  common::Trajectory poses;
  for (int i = 0; i <= last; i += 2) {
    std::ifstream file(folder / fmt::format("frame-{:06}.pose.txt", i));
    Eigen::Matrix4d matrix;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) file >> matrix(row, column);
    if (!file) continue;
    poses.push_back({common::Time::fromSeconds(i / interfaces::kSevenScenesRate_Hz),
                     {Eigen::Quaterniond(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>())).normalized(),
                      matrix.topRightCorner<3, 1>()}});
  }
  return poses;
}

class RecordedCamera : public test_support::Scratch {};

TEST_F(RecordedCamera, OfAKitchenIsNeverLost) {
  const auto archive = test_support::dataSet("03-rgbd/7scenes-redkitchen-a/redkitchen_000-598_step2.tar");
  if (!archive) return;
  const fs::path folder = interfaces::unpackInto(folder_, *archive);
  const Tracked tracked = track(folder, std::nullopt);
  EXPECT_EQ(tracked.frames, 300);
  EXPECT_EQ(tracked.trajectory.size(), 300u);
  EXPECT_LT(positionError_m(tracked.trajectory, sevenScenesPoses(folder, 598)), 0.035);  // 0.029 measured.
}

TEST_F(RecordedCamera, ThatTurnsAboutItselfIsNeverLost) {
  const auto archive = test_support::dataSet("03-rgbd/tum-fr1-rpy/tum_fr1_rpy_000-299.tar");
  if (!archive) return;
  // The lens of the benchmark's first camera.
  interfaces::RgbdCalibration calibration = interfaces::tumCalibration();
  calibration.color = {640, 480, 517.3, 516.5, 318.6, 255.3, 0.2624, -0.9531, -0.0054, 0.0026, 1.1633};
  const fs::path folder = interfaces::unpackInto(folder_, *archive) / "tum_fr1_rpy";
  const Tracked tracked = track(folder, calibration);
  EXPECT_EQ(tracked.frames, 300);
  EXPECT_EQ(tracked.trajectory.size(), 300u);
  const common::Trajectory reference =
      common::ordered(interfaces::readTum(folder / "groundtruth.txt", interfaces::StampOrder::kAny)).trajectory;
  EXPECT_LT(positionError_m(tracked.trajectory, reference), 0.03);  // 0.022 measured.
}

}  // namespace
}  // namespace swiftlet::mapping3d
