// Localization in flight: searches as jobs, and scans that serve the odometry or the particles, never both.
#include "autonomy/estimation/flight_localizer.hpp"

#include <gtest/gtest.h>

#include "tests/localization/buildings.hpp"

namespace swiftlet::autonomy {
namespace {

using common::LocalizationState;
using common::Pose2;
using common::Time;

/// A walk through an office, 40 scans a second.
struct Story {
  explicit Story(std::uint64_t seed, int threads = 0)
      : building(test::offices(seed)),
        walks(building),
        walker(walks, seed),
        odometry(seed),
        noise(seed, "story"),
        jobs(common::makeLockstepJobs(threads)),
        localizer({std::make_shared<const common::OccupancyGrid>(test::mapOf(building)), {}, seed}, {}, *jobs, log) {}

  void step() {
    const Time now = Time::fromSeconds(time_s);
    jobs->deliverDue(now);
    const auto scan = test::levelScan(building.world, walker.pose(), now, noise);
    truth = walker.pose();
    const bool withheld = localizer.wantsScan(odometry.pose());
    EXPECT_FALSE(withheld && withheld_before) << "two in a row, at " << time_s;
    withheld_count += withheld ? 1 : 0;
    withheld_before = withheld;
    localizer.add({scan, odometry.pose(), Eigen::Matrix3d::Zero(), withheld, false}, now);
    walker.advance(0.025);
    odometry.step(between(truth, walker.pose()));
    time_s += 0.025;
  }

  const test::Building building;
  test::Walks walks;
  test::Walker walker;
  test::DriftingOdometry odometry;
  common::RandomStream noise;
  std::unique_ptr<common::JobRunner> jobs;
  common::EventLog log;
  FlightLocalizer localizer;
  Pose2 truth;
  bool withheld_before = false;
  int withheld_count = 0;
  double time_s = 0.0;
};

TEST(FlightLocalizer, LocalizesAndReportsIt) {
  Story story(1);
  for (int i = 0; i < 600; ++i) {
    story.step();
    if (!story.localizer.localization().localized()) {
      EXPECT_EQ(story.withheld_count, 0) << "a scan was kept from the odometry for nothing";
      continue;
    }
    EXPECT_LT((story.localizer.localization().T_given_body.position_m() - story.truth.position_m()).norm(), 0.3);
  }
  ASSERT_TRUE(story.localizer.localization().localized());
  EXPECT_GT(story.withheld_count, 5);
  const std::vector<common::Event> events = story.log.take();
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().source, "localization");
  EXPECT_EQ(events.back().text.substr(0, 12), "localized at");
  EXPECT_FALSE(events.back().reason.empty());
  EXPECT_TRUE(story.log.take().empty());
}

TEST(FlightLocalizer, TheResultDoesNotDependOnTheSpeedOfTheSearch) {
  Story alone(2, 0), beside(2, 1);
  for (int i = 0; i < 500; ++i) {
    alone.step();
    beside.step();
    const common::Localization &a = alone.localizer.localization(), &b = beside.localizer.localization();
    ASSERT_EQ(a.state, b.state) << i;
    ASSERT_EQ(a.T_given_body.x_m, b.T_given_body.x_m) << i;
    ASSERT_EQ(a.places, b.places) << i;
  }
}

/// The search in the first map is under way when the second one comes.
TEST(FlightLocalizer, AnotherMapBeginsAnewWithoutTheSearchesInTheFirst) {
  Story story(3);
  while (!story.localizer.localization().localized() && story.time_s < 20.0) story.step();
  ASSERT_TRUE(story.localizer.localization().localized());
  const test::Building elsewhere = test::hall(3);
  story.localizer.load({std::make_shared<const common::OccupancyGrid>(test::mapOf(elsewhere)), {}, 3});
  EXPECT_EQ(story.localizer.localization().state, LocalizationState::kGlobal);
  story.step();  // Asks for a search in the hall.
  story.localizer.load({std::make_shared<const common::OccupancyGrid>(test::mapOf(story.building)), {}, 3});
  for (int i = 0; i < 600 && !story.localizer.localization().localized(); ++i) {
    story.step();
    ASSERT_LT(story.time_s, 60.0);
  }
  ASSERT_TRUE(story.localizer.localization().localized());
  EXPECT_LT((story.localizer.localization().T_given_body.position_m() - story.truth.position_m()).norm(), 0.3);
}

TEST(FlightLocalizer, ForgetsItsPlaceAndFindsItAgain) {
  Story story(1);
  while (!story.localizer.localization().localized() && story.time_s < 20.0) story.step();
  ASSERT_TRUE(story.localizer.localization().localized());
  story.localizer.forget();
  EXPECT_FALSE(story.localizer.localization().localized());
  story.step();
  EXPECT_FALSE(story.localizer.localization().localized()) << "not by the scan before";
  for (int i = 0; i < 800 && !story.localizer.localization().localized(); ++i) story.step();
  ASSERT_TRUE(story.localizer.localization().localized());
  EXPECT_LT((story.localizer.localization().T_given_body.position_m() - story.truth.position_m()).norm(), 0.3);
}

}  // namespace
}  // namespace swiftlet::autonomy
