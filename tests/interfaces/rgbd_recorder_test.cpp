// What an RGB-D recorder writes is what the reader of such folders reads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "common/random.hpp"
#include "interfaces/rgbd/list_rgbd.hpp"
#include "interfaces/rgbd/rgbd_folder.hpp"
#include "interfaces/rgbd/rgbd_recorder.hpp"
#include "tests/support/problem_matchers.hpp"
#include "tests/support/scratch.hpp"

namespace swiftlet::interfaces {
namespace {

namespace fs = std::filesystem;

common::RgbdFrame frameAt(double stamp_s) {
  const int width_px = 40, height_px = 30;
  common::RandomStream random(static_cast<std::uint64_t>(100.0 * stamp_s), "frame");
  common::RgbdFrame frame;
  frame.stamps.measured = common::Time::fromSeconds(stamp_s);
  frame.camera = {width_px, height_px, 30.0, 31.0, 19.25, 14.75};
  frame.color = {width_px, height_px, {}};
  frame.depth = {width_px, height_px, {}};
  for (int i = 0; i < width_px * height_px; ++i) {
    for (int c = 0; c < 3; ++c) frame.color.rgb.push_back(static_cast<std::uint8_t>(random.uniform(0.0, 256.0)));
    frame.depth.depth_m.push_back(static_cast<float>(random.uniform(0.5, 8.0)));
  }
  return frame;
}

class RgbdRecorders : public test_support::Scratch {
 protected:
  RgbdRecorder record() const { return std::move(*RgbdRecorder::create(folder_ / "rgbd")); }
  RgbdFolder open() const { return RgbdFolder(listRgbdFolder(folder_ / "rgbd")); }
};

TEST_F(RgbdRecorders, AFrameReadsBackWithItsCameraAndItsDepth) {
  common::RgbdFrame frame = frameAt(1.25);
  frame.depth.depth_m[3] = common::DepthImage::kTooFar;
  frame.depth.depth_m[4] = common::DepthImage::kUnknown;
  frame.depth.depth_m[5] = 13.2F;  // More than 16 bits can say.
  ASSERT_TRUE(record().add(frame));
  RgbdFolder folder = open();
  const auto read = folder.next();
  ASSERT_TRUE(read);
  EXPECT_EQ(read->stamps.measured, frame.stamps.measured);
  EXPECT_EQ(read->camera, frame.camera);
  EXPECT_EQ(read->color.rgb, frame.color.rgb);
  for (const std::size_t i : {3u, 4u, 5u}) EXPECT_EQ(read->depth.depth_m[i], common::DepthImage::kUnknown);
  for (std::size_t i = 6; i < read->depth.depth_m.size(); ++i)
    ASSERT_NEAR(read->depth.depth_m[i], frame.depth.depth_m[i], 1.01e-4) << i;
}

TEST_F(RgbdRecorders, TheTruthHasTheAxesOfTheFormat) {
  RgbdRecorder recorder = record();
  ASSERT_TRUE(recorder.add(frameAt(1.0)));
  ASSERT_TRUE(recorder.addTruth(common::Time::fromSeconds(1.0), {Eigen::Quaterniond::Identity(), {1.0, 2.0, 3.0}}));
  const auto truth = readTum(folder_ / "rgbd" / "groundtruth.txt");
  ASSERT_EQ(truth.size(), 1u);
  EXPECT_EQ(truth[0].pose.position_m, Eigen::Vector3d(1.0, 2.0, 3.0));
  // The view is along z of the format, and along x of the vehicle's frame `camera`.
  EXPECT_LT((truth[0].pose.rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(), 1e-9);
  EXPECT_LT((truth[0].pose.rotation * Eigen::Vector3d::UnitY() + Eigen::Vector3d::UnitZ()).norm(), 1e-9);
}

TEST_F(RgbdRecorders, WhereNothingCanBeWrittenItSaysWhy) {
  fs::create_directories(folder_ / "rgbd");
  write("rgbd/rgb", "a file where a folder is to be");
  const auto made = RgbdRecorder::create(folder_ / "rgbd");
  ASSERT_FALSE(made);
  EXPECT_THAT(made.error().message, test_support::MessageIs("file.not-written", "rgbd/rgb: "));
}

TEST_F(RgbdRecorders, AFrameThatWasCutShortIsLeftOutAndCounted) {
  RgbdRecorder recorder = record();
  common::RgbdFrame color = frameAt(1.0), depth = frameAt(1.1);
  color.color.rgb.pop_back();
  depth.depth.depth_m.pop_back();
  for (const common::RgbdFrame& frame : {color, depth, frameAt(1.2)}) EXPECT_TRUE(recorder.add(frame));
  EXPECT_EQ(recorder.leftOut(), 2u);
  EXPECT_EQ(recorder.frames(), 1u);
  EXPECT_EQ(open().next()->stamps.measured, common::Time::fromSeconds(1.2));
}

TEST_F(RgbdRecorders, AnImageThatCannotBeWrittenIsInNoList) {
  RgbdRecorder recorder = record();
  ASSERT_TRUE(recorder.add(frameAt(1.0)));
  fs::remove_all(folder_ / "rgbd" / "depth");
  EXPECT_FALSE(recorder.add(frameAt(2.0)));
  EXPECT_EQ(recorder.frames(), 1u);
  EXPECT_EQ(open().listing().pairs.size(), 1u);
}

}  // namespace
}  // namespace swiftlet::interfaces
