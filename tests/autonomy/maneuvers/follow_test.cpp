// Follow: a person who walks, stops, turns a corner, is hidden, and meets another one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "autonomy/maneuvers/person_watch.hpp"
#include "tests/autonomy/maneuver_story.hpp"

namespace swiftlet::autonomy {
namespace {

using testing::StartsWith;

common::DynamicObstacle person(int id, double x_m, double y_m, common::Time seen, Eigen::Vector2d velocity = {0, 0}) {
  common::DynamicObstacle obstacle;
  obstacle.id = id;
  obstacle.center_map_m = {x_m, y_m};
  obstacle.radius_m = 0.25;
  obstacle.velocity_map_m_s = velocity;
  obstacle.moving = !velocity.isZero();
  obstacle.last_seen = seen;
  return obstacle;
}

common::Time seenAt(double seconds) { return common::Time::fromSeconds(seconds); }

TEST(PersonWatch, ChoosesTheNearestWhoWalks) {
  PersonWatch watch;
  const std::vector around{person(1, 1.0, 0.0, seenAt(1)), person(2, 3.0, 0.0, seenAt(1), {0.5, 0}),
                           person(3, 2.0, 1.0, seenAt(1), {0.5, 0})};
  watch.choose(around, {0, 0}, 6.0);
  ASSERT_TRUE(watch.known());
  EXPECT_EQ(watch.place_map_m(seenAt(1)), Eigen::Vector2d(2.0, 1.0));
}

TEST(PersonWatch, KeepsHimThroughANewTrackAndPastAnotherPerson) {
  PersonWatch watch;
  watch.choose(std::vector{person(1, 2.0, 0.0, seenAt(1), {0.5, 0})}, {0, 0}, 6.0);
  // His track ends; a new one is near where he would be, another person comes the other way.
  const std::vector next{person(7, 2.7, 0.1, seenAt(2), {0.5, 0}), person(8, 2.5, 0.3, seenAt(2), {-0.5, 0})};
  watch.update(next, seenAt(2));
  EXPECT_EQ(watch.place_map_m(seenAt(2)), Eigen::Vector2d(2.7, 0.1));
}

TEST(PersonWatch, BelievesHimWhereHeStoodWhenTheMapExplainsHim) {
  PersonWatch watch;
  watch.choose(std::vector{person(1, 2.0, 0.0, seenAt(1), {0.4, 0})}, {0, 0}, 6.0);
  watch.update({}, seenAt(6));
  EXPECT_NEAR(watch.place_map_m(seenAt(6)).x(), 2.2, 1e-9) << "half a second on";
  EXPECT_NEAR(watch.unseen_s(seenAt(6)), 5.0, 1e-9);
  watch.update(std::vector{person(4, 2.3, 0.2, seenAt(6.1), {0, 0.5})}, seenAt(6.1));
  EXPECT_NEAR(watch.unseen_s(seenAt(6.1)), 0.0, 1e-9) << "he walks on";
  watch.update(std::vector{person(9, 7.0, 3.0, seenAt(6.5), {0, 0.5})}, seenAt(7));
  EXPECT_NEAR(watch.place_map_m(seenAt(6.1)).x(), 2.3, 0.3) << "nobody jumps 5 m";
}

class FollowInFlight : public ManeuverInFlight {
 protected:
  /// He walks to that place at that speed; the distances that the vehicle kept from him meanwhile.
  void walk(double x_m, double y_m, double speed_m_s) {
    const Eigen::Vector2d to(x_m, y_m);
    while ((to - place_).norm() > 0.02) {
      const Eigen::Vector2d way = to - place_;
      place_ += way.normalized() * std::min(way.norm(), 0.05 * speed_m_s);
      show(way.normalized() * speed_m_s);
    }
  }
  void stand(double seconds) {
    for (int i = 0; i < std::lround(seconds / 0.05); ++i) show({0, 0});
  }
  void show(const Eigen::Vector2d& velocity) {
    people_ = {person(1, place_.x(), place_.y(), now_, velocity)};
    people_[0].moving = true;
    discs_ = {{place_, 0.25}};
    run(0.05);
    const double distance_m = distanceTo_m(place_);
    nearest_m_ = std::min(nearest_m_, distance_m);
    farthest_m_ = std::max(farthest_m_, distance_m);
  }
  Eigen::Vector2d place_{3.5, 2.0};
  double nearest_m_ = 1e9, farthest_m_ = 0.0;
};

TEST_F(FollowInFlight, StaysBehindHimAtItsDistance) {
  want(common::FollowIntent{});
  walk(7.0, 2.0, 0.5);
  EXPECT_GT(nearest_m_, 1.5);
  EXPECT_LT(farthest_m_, 3.0);
  stand(5.0);
  EXPECT_NEAR(distanceTo_m(place_), 2.0, 0.3);
  EXPECT_THAT(executor_.status().reason, StartsWith("following, "));
  EXPECT_EQ(executor_.followedPerson_map_m().has_value(), true);
  const Eigen::Vector2d look = place_ - position_m();
  EXPECT_NEAR(state_.T_map_body_planar().yaw_rad, std::atan2(look.y(), look.x()), 0.1);
}

TEST_F(FollowInFlight, GivesWayWhenHeComesBack) {
  want(common::FollowIntent{});
  walk(6.5, 2.0, 0.5);
  nearest_m_ = 1e9;
  walk(5.3, 2.0, 0.2);
  stand(6.0);
  EXPECT_GT(distanceTo_m(place_), 1.6);
}

TEST_F(FollowInFlight, LosesHimAndFailsInTheEnd) {
  common::FollowIntent intent;
  intent.lost_s = 6.0;
  want(intent);
  walk(6.0, 2.0, 0.5);
  people_.clear();
  discs_.clear();
  run(4.0);
  EXPECT_EQ(executor_.status().reason, "looking for the person");
  EXPECT_EQ(timesSaid("the person is out of sight"), 1);
  EXPECT_EQ(runToTheEnd(4.0), IntentState::kFailed);
  EXPECT_THAT(executor_.status().reason, StartsWith("the person was not seen for 6 s"));
}

TEST_F(FollowInFlight, BelievesHimWhereHeStandsInTheMap) {
  common::FollowIntent intent;
  intent.lost_s = 6.0;
  want(intent);
  walk(6.0, 2.0, 0.5);
  stand(1.0);
  people_.clear();
  planning::test::fill(grid_, {{117, 38}, {122, 43}}, planning::test::kWallCell);
  run(8.0);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning);
  EXPECT_THAT(executor_.status().reason, StartsWith("following, "));
  planning::test::fill(grid_, {{117, 38}, {122, 43}}, planning::test::kFreeCell);
  EXPECT_EQ(runToTheEnd(8.0), IntentState::kFailed) << "he left unseen";
}

TEST_F(FollowInFlight, WaitsForSomebodyAndGivesUp) {
  common::FollowIntent intent;
  intent.lost_s = 3.0;
  want(intent);
  run(1.0);
  EXPECT_EQ(executor_.status().reason, "waits for somebody who walks");
  EXPECT_EQ(runToTheEnd(3.0), IntentState::kFailed);
}

TEST_F(FollowInFlight, ReturnsToWhereHeWasFollowed) {
  want(common::FollowIntent{});
  walk(6.5, 2.0, 0.5);
  people_.clear();
  discs_.clear();
  want(to(1.0, 1.0));
  ASSERT_EQ(runToTheEnd(30.0), IntentState::kSucceeded);
  common::FollowIntent back;
  back.until_near = true;
  want(back);
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_LT(distanceTo_m({6.5, 2.0}), 2.6);
}

TEST_F(FollowInFlight, CannotReturnToNobody) {
  common::FollowIntent back;
  back.until_near = true;
  want(back);
  EXPECT_EQ(runToTheEnd(1.0), IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason, "nobody was followed before");
}

}  // namespace
}  // namespace swiftlet::autonomy
