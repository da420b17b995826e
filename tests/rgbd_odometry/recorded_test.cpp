// Recorded cameras, with bounds that a regression would break. The reference of 7-Scenes was tracked by KinectFusion
// and jumps itself by up to 5 cm and 2 deg between two frames (docs/decisions/mapping3d.md#032), so its bounds are
// wide.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluation/trajectory_metrics.hpp"
#include "interfaces/files/archive.hpp"
#include "interfaces/rgbd/list_rgbd.hpp"
#include "interfaces/rgbd/rgbd_folder.hpp"
#include "mapping3d/odometry/rgbd_odometry.hpp"
#include "tests/support/datasets.hpp"
#include "tests/support/recorded_rgbd.hpp"
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
  interfaces::RgbdListing listing = interfaces::listRgbdFolder(folder);
  if (calibration) listing.calibration = *calibration;
  interfaces::RgbdFolder frames(std::move(listing));
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

class RecordedCamera : public test_support::Scratch {};

TEST_F(RecordedCamera, OfAKitchenIsNeverLost) {
  const auto archive = test_support::dataSet("03-rgbd/7scenes-redkitchen-a/redkitchen_000-598_step2.tar");
  if (!archive) return;
  const fs::path folder = interfaces::unpackInto(folder_, *archive);
  const Tracked tracked = track(folder, std::nullopt);
  EXPECT_EQ(tracked.frames, 300);
  EXPECT_EQ(tracked.trajectory.size(), 300u);
  EXPECT_LT(positionError_m(tracked.trajectory, test_support::recordedReference(folder)), 0.035);  // 0.029 measured.
}

TEST_F(RecordedCamera, ThatTurnsAboutItselfIsNeverLost) {
  const auto archive = test_support::dataSet("03-rgbd/tum-fr1-rpy/tum_fr1_rpy_000-299.tar");
  if (!archive) return;
  const fs::path folder = interfaces::unpackInto(folder_, *archive) / "tum_fr1_rpy";
  const Tracked tracked = track(folder, test_support::freiburg1Calibration());
  EXPECT_EQ(tracked.frames, 300);
  EXPECT_EQ(tracked.trajectory.size(), 300u);
  EXPECT_LT(positionError_m(tracked.trajectory, test_support::recordedReference(folder)), 0.03);  // 0.022 measured.
}

}  // namespace
}  // namespace swiftlet::mapping3d
