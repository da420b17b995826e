// Frames on their way to recognized objects: which are looked at, where the objects are placed, and what is said.
#include "autonomy/estimation/recognition_pipeline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "perception/fusion/error_state_filter.hpp"
#include "perception/recognition/tag_recognizer.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Time;

constexpr double kBorder_m = 0.4;
/// Of the tag, seen frontally: it is in the middle of the picture, to within a pixel.
constexpr double kDistance_m = 1.6;

common::RgbdCameraConfig cameraSheet() {
  common::RgbdCameraConfig camera;
  camera.mount = {};
  return camera;
}

perception::KnownObjectConfig tag() {
  perception::KnownObjectConfig config;
  config.name = "dock";
  config.tag = 7;
  config.width_m = kBorder_m;
  return config;
}

/// A grey picture with tag 7, `kDistance_m` before the camera and `left_m` to its left.
std::shared_ptr<const common::RgbdFrame> frameAt(double time_s, double left_m = 0.0) {
  auto frame = std::make_shared<common::RgbdFrame>();
  frame->camera = cameraSheet().camera();
  const int width = frame->camera.width_px, height = frame->camera.height_px;
  frame->color = {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height), 140)};
  // Ten cells with the margin, eight of them within the border.
  const int cell_px = static_cast<int>(frame->camera.fx_px * kBorder_m / kDistance_m / 8.0);
  const vision::GrayImage drawn = perception::drawTag(7, cell_px);
  const int aside_px = static_cast<int>(std::lround(frame->camera.fx_px * left_m / kDistance_m));
  const int left = (width - drawn.width_px) / 2 - aside_px, top = (height - drawn.height_px) / 2;
  for (int v = 0; v < drawn.height_px; ++v)
    for (int u = 0; u < drawn.width_px; ++u)
      for (int channel = 0; channel < 3; ++channel)
        frame->color.rgb[static_cast<std::size_t>(3 * ((top + v) * width + left + u) + channel)] =
            static_cast<std::uint8_t>(drawn.at(u, v));
  frame->stamps.measured = frame->stamps.arrived = Time::fromSeconds(time_s);
  return frame;
}

class RecognitionStory : public testing::Test {
 protected:
  FrameSituation situationAt(const common::Pose3& at_map, bool supported) const {
    FrameSituation situation;
    situation.at_key = common::KeyRelativePose{0, at_map};
    situation.body = BodyAtFrame{at_map.rotation, {}};
    situation.supported = supported;
    situation.keys = keys_;
    return situation;
  }
  void look(const common::Pose3& at_map, double time_s, bool supported = true) {
    pipeline_.add(frameAt(time_s, -at_map.position_m.y()));
    const auto time = pipeline_.next(0.0);
    ASSERT_TRUE(time);
    pipeline_.look(situationAt(at_map, supported), {}, *time, {poses_, grid_, 0.0}, Time::fromSeconds(time_s));
    jobs_->deliverDue(Time::fromSeconds(time_s + 0.15));
  }
  std::vector<common::Event> reported() {
    pipeline_.report(*keys_, {}, Time::fromSeconds(9.0));
    return log_.take();
  }
  std::vector<common::RecognizedObject> objects() const { return pipeline_.layer(*keys_)->objects; }

  std::shared_ptr<const common::KeyPoses> keys_ =
      std::make_shared<const common::KeyPoses>(common::KeyPoses{1, {{{}, {}}}});
  std::shared_ptr<const common::OccupancyGrid> grid_ =
      std::make_shared<const common::OccupancyGrid>(common::makeOccupancyGrid(0.05));
  perception::ErrorStateFilter filter_{{}};
  PoseTrack poses_{filter_};
  std::unique_ptr<common::JobRunner> jobs_ = common::makeLockstepJobs(0);
  common::EventLog log_;
  RecognitionPipeline pipeline_{{tag()}, cameraSheet(), {}, *jobs_, log_};
};

TEST_F(RecognitionStory, APatternIsPlacedAndSaidOnceWhenItIsConfirmed) {
  look({}, 1.0);
  ASSERT_EQ(objects().size(), 1u);
  EXPECT_FALSE(objects()[0].confirmed);
  EXPECT_TRUE(reported().empty());
  look(common::lifted({0.0, 0.25, 0.0}, 0.0), 1.3);
  const auto seen = objects();
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_EQ(seen[0].what, "dock");
  EXPECT_TRUE(seen[0].confirmed);
  EXPECT_EQ(seen[0].looks, 2);
  EXPECT_NEAR(seen[0].T_map_object.position_m.x(), kDistance_m, 0.1);
  EXPECT_NEAR(seen[0].T_map_object.position_m.z(), 0.0, 0.02);
  EXPECT_EQ(seen[0].size_m, Eigen::Vector2d(kBorder_m, kBorder_m));
  EXPECT_EQ(seen[0].last_seen, Time::fromSeconds(1.3));
  const auto events = reported();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "dock 1 recognized");
  EXPECT_THAT(events[0].reason, testing::HasSubstr("seen from 2 places"));
  EXPECT_TRUE(reported().empty());
}

TEST_F(RecognitionStory, ItMovesWithTheKeyScans) {
  look({}, 1.0);
  common::KeyPoses moved = *keys_;
  moved.keys[0].T_map_key = {0.0, 1.0, 0.0};
  const Eigen::Vector3d by_m =
      pipeline_.layer(moved)->objects.at(0).T_map_object.position_m - objects().at(0).T_map_object.position_m;
  EXPECT_LT((by_m - Eigen::Vector3d(0.0, 1.0, 0.0)).norm(), 1e-9);
}

TEST_F(RecognitionStory, AFrameWhosePlaceNothingSupportsIsLeftOut) {
  look({}, 1.0, false);
  EXPECT_TRUE(objects().empty());
}

TEST_F(RecognitionStory, FramesInQuickSuccessionAreLeftOut) {
  look({}, 1.0);
  pipeline_.add(frameAt(1.1));
  EXPECT_FALSE(pipeline_.next(0.0));
}

}  // namespace
}  // namespace swiftlet::autonomy
