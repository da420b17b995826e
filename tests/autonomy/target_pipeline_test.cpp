// Frames on their way to targets: which are looked at, where the targets are placed, and what is said.
#include "autonomy/estimation/target_pipeline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/targets/target_scene.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Time;
using perception::testing::cube;
using perception::testing::kRed;

const Eigen::Vector3d kTarget(2.5, 0.0, -0.2);

class TargetStory : public testing::Test {
 protected:
  static TargetPipelineConfig config() {
    TargetPipelineConfig config;
    config.classes = perception::testing::redAndGreen();
    return config;
  }
  /// The frame that the camera takes from `at_map`.
  static std::shared_ptr<const common::RgbdFrame> frameFrom(const common::Pose3& at_map, double time_s) {
    common::RgbdFrame frame =
        simulation::frameOf(perception::testing::roomWith({cube(kTarget, 0.24, kRed)}),
                            perception::testing::flyingCamera(), simulation::RgbdErrorsConfig{}, at_map);
    frame.stamps.measured = frame.stamps.arrived = Time::fromSeconds(time_s);
    return std::make_shared<const common::RgbdFrame>(std::move(frame));
  }
  FrameSituation situationAt(const common::Pose3& at_map, bool supported = true) const {
    FrameSituation situation;
    situation.at_key = common::KeyRelativePose{0, at_map};
    situation.body = BodyAtFrame{at_map.rotation, {}};
    situation.supported = supported;
    situation.keys = keys_;
    return situation;
  }
  void look(const common::Pose3& at_map, double time_s, bool supported = true) {
    pipeline_.add(frameFrom(at_map, time_s));
    ASSERT_TRUE(pipeline_.next(0.0));
    pipeline_.look(situationAt(at_map, supported), {}, 0.0, Time::fromSeconds(time_s));
    jobs_->deliverDue(Time::fromSeconds(time_s + 0.1));
  }

  std::shared_ptr<const common::KeyPoses> keys_ =
      std::make_shared<const common::KeyPoses>(common::KeyPoses{1, {{{}, {}}}});
  std::unique_ptr<common::JobRunner> jobs_ = common::makeLockstepJobs(0);
  std::vector<common::Event> reported(const common::PlaceNames& names) {
    pipeline_.reportFound(names);
    return log_.take();
  }

  common::EventLog log_;
  TargetPipeline pipeline_{config(), *jobs_, 5.0, log_};
};

TEST_F(TargetStory, ATargetIsPlacedAndSaidOnceWhenItIsFound) {
  for (int i = 0; i < 5; ++i) look(common::lifted({0.1 * i, -0.4 + 0.3 * i, -0.05}, 0.0), 1.0 + 0.3 * i);
  const auto targets = pipeline_.targets(*keys_);
  ASSERT_EQ(targets.size(), 1u);
  EXPECT_LT((targets[0].position_map_m - kTarget).norm(), 0.06);
  const auto events = reported({});
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "red 1 found");
  EXPECT_THAT(events[0].reason, testing::HasSubstr("seen from 3 places"));
}

TEST_F(TargetStory, ItsPlaceIsSaidInTheGivenMap) {
  for (int i = 0; i < 5; ++i) look(common::lifted({0.1 * i, -0.4 + 0.3 * i, -0.05}, 0.0), 1.0 + 0.3 * i);
  const auto events = reported({common::Pose2{100.0, 0.0, 0.0}});
  ASSERT_EQ(events.size(), 1u);
  EXPECT_THAT(events[0].reason, testing::MatchesRegex("at \\(102\\.4.*\\) in the given map \\+- .*"));
  EXPECT_TRUE(reported({}).empty());
}

TEST_F(TargetStory, ItMovesWithTheKeyScans) {
  look({}, 1.0);
  common::KeyPoses moved = *keys_;
  moved.keys[0].T_map_key = {0.0, 1.0, 0.0};
  const Eigen::Vector3d by_m = pipeline_.targets(moved)[0].position_map_m - pipeline_.targets(*keys_)[0].position_map_m;
  EXPECT_LT((by_m - Eigen::Vector3d(0.0, 1.0, 0.0)).norm(), 1e-9);
}

TEST_F(TargetStory, AFrameWhosePlaceNothingSupportsIsLeftOut) {
  look({}, 1.0, false);
  EXPECT_TRUE(pipeline_.targets(*keys_).empty());
}

TEST_F(TargetStory, FramesInQuickSuccessionAreLeftOut) {
  look({}, 1.0);
  pipeline_.add(frameFrom({}, 1.05));
  EXPECT_FALSE(pipeline_.next(0.0));
  pipeline_.add(frameFrom({}, 1.2));
  EXPECT_EQ(pipeline_.next(0.05), Time::fromSeconds(1.15)) << "by the flight's clock";
}

}  // namespace
}  // namespace swiftlet::autonomy
