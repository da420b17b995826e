// Stories of the estimator: the state, the map and the events that follow from scans and IMU samples.
#include "autonomy/estimator.hpp"

#include <gtest/gtest.h>

#include "tests/autonomy/estimator_story.hpp"
#include "tests/rgbd_odometry/textured_room.hpp"

namespace swiftlet::autonomy {
namespace {

using common::Pose2;
using common::Time;

TEST(Estimator, WaitsUntilTheVehicleStandsStill) {
  EstimatorStory moving(8.0);
  moving.skipTo(5.0);
  moving.run(7.0, [](const auto& outcome) { EXPECT_FALSE(outcome); });
  EXPECT_FALSE(moving.estimator.ready());
  EXPECT_EQ(moving.eventsThatBegin("waiting until the vehicle stands still"), 1) << "said once";

  EstimatorStory standing(2.0);
  standing.run(1.0);
  EXPECT_TRUE(standing.estimator.ready());
  EXPECT_EQ(standing.eventsThatBegin("initialized, body 0.1"), 1) << "by the mirror";
}

TEST(Estimator, MatchedScansCorrectTheStateAndDrawTheMap) {
  EstimatorStory story(12.0);
  int scans = 0, matched = 0;
  double worst_m = 0.0;
  story.run(11.5, [&](const std::optional<ScanOutcome>& outcome) {
    if (!outcome) return;
    ++scans;
    matched += outcome->matched ? 1 : 0;
    EXPECT_FALSE(outcome->interrupted);
    worst_m = std::max(worst_m, story.positionError_m());
  });
  EXPECT_GT(scans, 400);
  EXPECT_GT(matched, scans * 95 / 100);
  EXPECT_LT(worst_m, 0.08);
  EXPECT_EQ(story.estimator.health().status, perception::FusionStatus::kOk);
  const auto grid = story.estimator.maps().grid;
  EXPECT_TRUE(common::occupancy::isFree(grid->at(grid->cellAt({0.0, 0.0}))));
  EXPECT_FALSE(common::occupancy::isFree(grid->at(grid->cellAt({3.5, -1.0})))) << "a wall of the flat";
  EXPECT_EQ(story.estimator.maps().grid, grid) << "the same object until the map changes";
}

TEST(Estimator, MirrorBeamsCorrectTheHeight) {
  EstimatorStory story(12.0);
  double worst_m = 0.0;
  std::optional<control::RawHeight> raw;
  story.run(11.5, [&](const std::optional<ScanOutcome>& outcome) {
    if (!outcome) return;
    const common::VehicleState state = story.estimator.state();
    worst_m = std::max(worst_m, std::abs(state.T_odom_body.position_m.z() - story.truthAt(state.stamp).position_m.z()));
    if (outcome->raw_height) raw = outcome->raw_height;
  });
  EXPECT_LT(worst_m, 0.05);
  ASSERT_TRUE(raw);
  EXPECT_NEAR(raw->height_m, story.truthAt(raw->stamp).position_m.z(), 0.05);
  EXPECT_NEAR(story.estimator.state().height_above_ground_m, story.estimator.state().T_odom_body.position_m.z(), 0.1);
  EXPECT_FALSE(story.estimator.maps().levels->levels.empty());
}

TEST(Estimator, ScansThatAreNotMatchedStillMeasureTheHeight) {
  EstimatorConfig config = EstimatorStory::config();
  config.laser.match_rate_hz = 10.0;
  EstimatorStory story(6.0, nullptr, config);
  int scans = 0, matched = 0, heights = 0;
  story.run(6.0, [&](const std::optional<ScanOutcome>& outcome) {
    if (!outcome || outcome->scan.stamp.seconds() < 3.0) return;
    ++scans;
    matched += outcome->matched ? 1 : 0;
    heights += outcome->raw_height ? 1 : 0;
  });
  EXPECT_NEAR(matched, scans / 4, 2);
  EXPECT_EQ(heights, scans);
  EXPECT_LT(story.positionError_m(), 0.1);
}

TEST(Estimator, ReportsWhenTheLaserIsBlindAndWhenItRecovers) {
  EstimatorStory story(9.0);
  story.run(4.0);
  EXPECT_EQ(story.eventsThatBegin("estimate degraded"), 0);
  story.blind = true;
  story.run(5.0, [](const auto& outcome) {
    ASSERT_TRUE(outcome) << "a scan that does not match is an outcome, too";
    EXPECT_FALSE(outcome->matched);
  });
  EXPECT_EQ(story.eventsThatBegin("estimate degraded"), 1);
  story.blind = false;
  story.run(6.0);
  EXPECT_EQ(story.eventsThatBegin("estimate ok"), 2) << "after the start, and now";
  EXPECT_LT(story.positionError_m(), 0.3);
}

TEST(Estimator, ReportsAnInterruptionAndRestartsTheOdometry) {
  EstimatorStory story(6.0);
  story.run(4.0);
  // The room has changed completely.
  story.world = den(story.truthAt(Time::fromSeconds(4.5)).position_m.head<2>(), 1.4);
  int interruptions = 0, unmatched = 0;
  story.run(5.0, [&](const std::optional<ScanOutcome>& outcome) {
    ASSERT_TRUE(outcome);
    interruptions += outcome->interrupted ? 1 : 0;
    unmatched += outcome->matched ? 0 : 1;
  });
  EXPECT_EQ(interruptions, 1);
  EXPECT_GE(unmatched, perception::LaserOdometryConfig{}.max_failures - 1);
  EXPECT_NE(story.estimator.health().status, perception::FusionStatus::kDiverged) << "it goes on in the new place";
}

TEST(Estimator, EveryScanInTheMapHasAPoseRelativeToAKeyScan) {
  EstimatorStory story(10.0);
  int placed = 0;
  story.run(9.5, [&](const std::optional<ScanOutcome>& outcome) {
    if (!outcome || !outcome->at_key) return;
    ++placed;
    const auto keys = story.estimator.maps().key_poses;
    ASSERT_LT(outcome->at_key->key, static_cast<int>(keys->keys.size()));
    const common::Pose3 T_map_body = keys->inMap(*outcome->at_key);
    EXPECT_LT((planar(T_map_body).position_m() - outcome->T_map_body.position_m()).norm(), 0.005);
    EXPECT_NEAR(T_map_body.position_m.z(), story.truthAt(outcome->scan.stamp).position_m.z(), 0.06);
    EXPECT_NEAR(common::cosTilt(T_map_body.rotation), common::cosTilt(story.truthAt(outcome->scan.stamp).rotation),
                0.02);
  });
  EXPECT_GT(placed, 300);
  EXPECT_GT(story.estimator.maps().key_poses->keys.size(), 2u);
}

/// The map of one flight is given to the next.
TEST(Estimator, LocalizesInAGivenMapWithScansThatItDoesNotMatch) {
  EstimatorStory before(16.0);
  before.run(15.5);
  const GivenMap given{before.estimator.maps().grid, {}, 1};
  EstimatorStory story(30.0, &given);
  int withheld = 0;
  story.run(3.0);
  ASSERT_TRUE(story.estimator.maps().localization);
  EXPECT_EQ(story.estimator.maps().localization->explained, 0.0) << "it is too low to compare";
  story.feedback.at_flight_height = true;
  story.run(29.5, [&](const std::optional<ScanOutcome>& outcome) {
    if (outcome && story.estimator.maps().localization->localized() && !outcome->matched) ++withheld;
  });
  ASSERT_TRUE(story.estimator.maps().localization->localized());
  EXPECT_LT((story.estimator.maps().localization->T_given_body.position_m() -
             planar(story.truthAt(story.estimator.maps().localization->stamp)).position_m())
                .norm(),
            0.3);
  EXPECT_EQ(story.eventsThatBegin("localized at"), 1);
  EXPECT_GT(withheld, 5);
  EXPECT_LT(story.positionError_m(), 0.1) << "the others suffice";
}

/// The camera looks into a textured room, or at a bare wall alone. The laser fails; the camera holds the
/// position if there is something to hold it by, and claims nothing else.
TEST(Estimator, BeforeABareWallTheCameraMeasuresNoPositionAlongIt) {
  for (const bool bare : {false, true}) {
    common::RgbdCameraConfig camera;
    camera.mount = {};
    EstimatorStory story(13.0, nullptr, EstimatorStory::config(), &camera);
    mapping3d::TexturedRoom room;
    if (bare) room.half_size_m = {2.6, 20.0, 20.0};  // One wall fills the view.
    room.camera = {160, 120, 145.0, 145.0, 79.5, 59.5};
    int scans = 0;
    const auto look = [&](const std::optional<ScanOutcome>&) {
      const common::Time now = story.estimator.state().stamp;
      if (++scans % 8 == 0 && now.seconds() > 4.0) {
        common::RgbdFrame frame = room.seen(story.truthAt(now), now.seconds());
        if (bare) frame.color.rgb.assign(frame.color.rgb.size(), 120);
        EXPECT_TRUE(story.estimator.addFrame(std::make_shared<const common::RgbdFrame>(frame)));
      }
      story.estimator.updateMap3d(now);
    };
    story.run(5.0, look);
    story.blind = true;
    story.run(12.9, look);
    const common::VehicleState state = story.estimator.state();
    if (bare) {
      EXPECT_GT(state.horizontalAge_s(state.stamp), 0.5);
    } else {
      EXPECT_LT(state.horizontalAge_s(state.stamp), 0.5);
      EXPECT_LT(state.verticalAge_s(state.stamp), 0.5);
    }
  }
}

}  // namespace
}  // namespace swiftlet::autonomy
