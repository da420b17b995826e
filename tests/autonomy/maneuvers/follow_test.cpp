// Follow: a person who walks, stops, turns a corner, is hidden, and meets another one; a vehicle too near to a wall.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/autonomy/maneuver_story.hpp"
#include "tests/people/seen_person.hpp"

namespace swiftlet::autonomy {
namespace {

using perception::test::person;
using perception::test::seenFrom;
using testing::StartsWith;

class FollowInFlight : public ManeuverInFlight {
 protected:
  /// The person walks to that place at that speed; the distances that the vehicle kept meanwhile.
  void walk(double x_m, double y_m, double speed_m_s) {
    const Eigen::Vector2d to(x_m, y_m);
    while ((to - place_).norm() > 0.02) {
      const Eigen::Vector2d left_m = to - place_;
      place_ += left_m.normalized() * std::min(left_m.norm(), 0.05 * speed_m_s);
      show(left_m.normalized() * speed_m_s);
    }
  }
  void stand(double seconds) {
    for (int i = 0; i < std::lround(seconds / 0.05); ++i) show({0, 0});
  }
  void look() { seen_ = seenFrom(grid_, position_m()); }
  /// Time passes in which nobody is tracked.
  void runUnseen(double seconds) {
    for (int i = 0; i < std::lround(seconds / 0.1); ++i) {
      look();
      run(0.1);
    }
  }
  void show(const Eigen::Vector2d& velocity) {
    people_ = {person(1, place_.x(), place_.y(), now_, velocity)};
    people_[0].moving = true;
    discs_ = {{place_, 0.25}};
    look();
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
  EXPECT_EQ(executor_.aim().person_map_m.has_value(), true);
  const Eigen::Vector2d look = place_ - position_m();
  EXPECT_NEAR(state_.T_map_body_planar().yaw_rad, std::atan2(look.y(), look.x()), 0.1);
}

TEST_F(FollowInFlight, GivesWayWhenThePersonComesBack) {
  want(common::FollowIntent{});
  walk(6.5, 2.0, 0.5);
  nearest_m_ = 1e9;
  walk(5.3, 2.0, 0.2);
  stand(6.0);
  EXPECT_GT(distanceTo_m(place_), 1.6);
}

/// The person stands at the right distance; the map has the wall nearer than it had before.
TEST_F(FollowInFlight, LeavesAWallAlsoWhereItsDistanceIsRight) {
  want(to(2.0, 0.5));
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  planning::test::fill(grid_, {{0, 0}, {159, 3}}, planning::test::kWallCell);
  place_ = {4.0, 0.9};
  want(common::FollowIntent{});
  stand(6.0);
  EXPECT_GT(position_m().y(), 0.175 + 0.365) << "the wall, and the hull with its clearance";
  EXPECT_NEAR(distanceTo_m(place_), 2.0, 0.3);
}

TEST_F(FollowInFlight, FliesAsFastAsItsModeAllows) {
  common::FollowIntent intent;
  intent.mode = common::FlightMode::kBrisk;
  want(intent);
  const Eigen::Vector2d walk_m(4.0, 0.0);
  double fastest_m_s = 0.0;
  for (int i = 0; i < 80; ++i) {
    place_ += walk_m / 80.0;
    show(walk_m / 4.0);
    fastest_m_s = std::max(fastest_m_s, state_.velocity_odom_m_s.head<2>().norm());
  }
  EXPECT_GT(fastest_m_s, 1.05) << "faster than mode fast";
  EXPECT_LT(farthest_m_, 3.3);
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
  runUnseen(0.1);
  planning::test::fill(grid_, {{117, 38}, {122, 43}}, planning::test::kWallCell);
  runUnseen(8.0);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning);
  EXPECT_THAT(executor_.status().reason, StartsWith("following, "));
  planning::test::fill(grid_, {{117, 38}, {122, 43}}, planning::test::kFreeCell);
  look();
  EXPECT_EQ(runToTheEnd(8.0), IntentState::kFailed) << "the person left unseen";
}

TEST_F(FollowInFlight, LooksAroundForSomebodyAndGivesUp) {
  common::FollowIntent intent;
  intent.lost_s = 12.0;
  const double yaw_rad = state_.T_map_body_planar().yaw_rad;
  want(intent);
  run(7.0);
  EXPECT_LT(std::abs(common::wrapAngle(state_.T_map_body_planar().yaw_rad - yaw_rad)), 0.1);
  run(3.0);
  EXPECT_GT(std::abs(common::wrapAngle(state_.T_map_body_planar().yaw_rad - yaw_rad)), 0.2);
  EXPECT_EQ(executor_.status().reason, "waits for a walking person");
  EXPECT_EQ(runToTheEnd(4.0), IntentState::kFailed);
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

/// An interruption, such as a retreat from somebody else, ends the maneuver; another person is nearer then.
TEST_F(FollowInFlight, GoesOnWithTheSamePersonAfterAnInterruption) {
  want(common::FollowIntent{});
  walk(6.0, 2.0, 0.5);
  want(common::AvoidIntent{});
  run(0.5);
  want(common::FollowIntent{});
  for (int i = 0; i < 40; ++i) {
    place_.x() += 0.05 * 0.3;
    people_ = {person(1, place_.x(), place_.y(), now_, {0.3, 0.0}), person(2, 3.5, 2.5, now_, {0.3, 0.0})};
    look();
    run(0.05);
  }
  ASSERT_TRUE(executor_.aim().person_map_m.has_value());
  EXPECT_LT((*executor_.aim().person_map_m - place_).norm(), 0.5);
}

TEST_F(FollowInFlight, CannotReturnToNobody) {
  common::FollowIntent back;
  back.until_near = true;
  want(back);
  EXPECT_EQ(runToTheEnd(1.0), IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason, "no person was followed or seen walking before");
}

/// The person walked through the room while the vehicle did something else, stands since, and is in the map by now.
TEST_F(FollowInFlight, ReturnsToWhereSomebodyWasLastSeenWalking) {
  want(to(1.0, 1.0));
  walk(6.0, 2.4, 0.8);
  people_.clear();
  discs_.clear();
  planning::test::fill(grid_, {{118, 46}, {122, 50}}, planning::test::kWallCell);
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  common::FollowIntent back;
  back.until_near = true;
  want(back);
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_LT(distanceTo_m({6.0, 2.4}), 2.6);
  EXPECT_GT(distanceTo_m({6.0, 2.4}), 1.5);
}

/// The time of a long flight does not count as time in which the person was not seen.
TEST_F(FollowInFlight, DoesNotMissAPersonWhoIsFarAway) {
  want(to(0.8, 0.8));
  walk(7.4, 0.9, 1.5);
  people_.clear();
  discs_.clear();
  ASSERT_EQ(runToTheEnd(20.0), IntentState::kSucceeded);
  common::FollowIntent back;
  back.until_near = true;
  back.lost_s = 3.0;
  back.mode = common::FlightMode::kAccurate;
  want(back);
  run(1.0);
  follows_ = false;
  run(4.0);
  EXPECT_EQ(executor_.status().state, IntentState::kRunning) << "6.6 m away";
  follows_ = true;
  EXPECT_EQ(runToTheEnd(40.0), IntentState::kFailed) << "nobody is seen from near";
  EXPECT_THAT(executor_.status().reason, StartsWith("the person was not seen for 3 s"));
}

}  // namespace
}  // namespace swiftlet::autonomy
