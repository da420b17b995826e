// Follow: a person who walks, stops, turns a corner, is hidden, and meets another one; a vehicle too near to a wall.
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "autonomy/maneuvers/person_watch.hpp"
#include "tests/autonomy/maneuver_story.hpp"

namespace swiftlet::autonomy {
namespace {

using testing::StartsWith;

common::DynamicObstacle person(int id, double x_m, double y_m, common::Time seen,
                               const Eigen::Vector2d& velocity = {0, 0}) {
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
  PersonWatch watch{PersonWatchConfig{}};
  const std::vector around{person(1, 1.0, 0.0, seenAt(1)), person(2, 3.0, 0.0, seenAt(1), {0.5, 0}),
                           person(3, 2.0, 1.0, seenAt(1), {0.5, 0})};
  watch.choose(around, {0, 0});
  ASSERT_TRUE(watch.known());
  EXPECT_EQ(watch.place_map_m(seenAt(1)), Eigen::Vector2d(2.0, 1.0));
}

/// What a laser with a beam a degree sees all around.
perception::SeenPoints seenFrom(const common::OccupancyGrid& grid, const Eigen::Vector2d& from_map_m) {
  perception::SeenPoints seen{from_map_m, {}, {}};
  for (int degree = 0; degree < 360; ++degree) {
    const double angle_rad = (degree + 0.5) * common::kRadPerDeg - std::numbers::pi;
    const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
    double range_m = 0.1;
    while (common::occupancy::isFree(grid.at(grid.cellAt(from_map_m + range_m * along)))) range_m += 0.02;
    seen.points_map_m.emplace_back((from_map_m + range_m * along).cast<float>());
  }
  return seen;
}

/// A free hall of 10 x 10 m, seen from its middle all around.
class PersonInAHall : public testing::Test {
 protected:
  void wall(const common::CellRect& cells) { planning::test::fill(grid_, cells, planning::test::kWallCell); }
  Sight sight() {
    seen_ = seenFrom(grid_, from_map_m_);
    return {std::make_shared<common::OccupancyGrid>(grid_.snapshot()), &seen_};
  }
  void stepUnseen(PersonWatch& watch, double from_s, double to_s) {
    const Sight now = sight();
    for (double t_s = from_s; t_s <= to_s + 1e-9; t_s += 0.05) watch.update({}, now, seenAt(t_s));
  }

  common::OccupancyGrid grid_ = hall();
  Eigen::Vector2d from_map_m_{5.0, 5.0};
  perception::SeenPoints seen_;

 private:
  static common::OccupancyGrid hall() {
    common::OccupancyGrid grid = common::makeOccupancyGrid(0.05);
    planning::test::fill(grid, {{0, 0}, {199, 199}}, planning::test::kFreeCell);
    return grid;
  }
};

TEST_F(PersonInAHall, IsKeptThroughANewTrackAndPastAnotherPerson) {
  PersonWatch watch{PersonWatchConfig{}};
  watch.choose(std::vector{person(1, 7.0, 5.0, seenAt(1), {0.5, 0})}, {5, 5});
  stepUnseen(watch, 1.05, 1.3);
  // The track ended; a new one is near where the person would be, another person comes the other way.
  const std::vector next{person(7, 7.3, 5.1, seenAt(1.35), {0.5, 0}), person(8, 7.1, 5.3, seenAt(1.35), {-0.5, 0})};
  watch.update(next, sight(), seenAt(1.35));
  EXPECT_EQ(watch.place_map_m(seenAt(1.35)), Eigen::Vector2d(7.3, 5.1));
}

TEST_F(PersonInAHall, WalksOnBehindAWall) {
  wall({{120, 60}, {122, 140}});  // At 6 m; the person walks behind it, at 7 m, from the middle to its end and beyond.
  PersonWatch watch{PersonWatchConfig{}};
  watch.choose(std::vector{person(1, 7.0, 5.0, seenAt(1), {0, 0.5})}, {5, 5});
  stepUnseen(watch, 1.05, 3.0);
  EXPECT_TRUE(watch.hidden());
  EXPECT_NEAR(watch.place_map_m(seenAt(3)).y(), 6.0, 0.5);
  EXPECT_NEAR(watch.unseen_s(seenAt(3)), 2.0, 1e-9);
  watch.update(std::vector{person(9, 2.0, 3.0, seenAt(3), {0, 0.5})}, sight(), seenAt(3.0));
  EXPECT_GT(watch.place_map_m(seenAt(3)).x(), 6.0) << "nobody walks through a wall, or 5 m in two seconds";
  watch.update(std::vector{person(4, 7.1, 6.2, seenAt(3.05), {0, 0.5})}, sight(), seenAt(3.05));
  EXPECT_FALSE(watch.hidden());
}

TEST_F(PersonInAHall, IsNotWhereNobodyIsSeen) {
  wall({{120, 60}, {122, 140}});
  PersonWatch watch{PersonWatchConfig{}};
  watch.choose(std::vector{person(1, 7.0, 5.0, seenAt(1), {0, 0.5})}, {5, 5});
  stepUnseen(watch, 1.05, 2.0);
  from_map_m_ = {7.0, 2.0};  // The back of the wall is in sight, its front is not.
  stepUnseen(watch, 2.05, 6.0);
  const Eigen::Vector2d place = watch.place_map_m(seenAt(6));
  EXPECT_TRUE((place - from_map_m_).norm() > 5.5 || place.x() < 6.2) << place.transpose();
}

TEST_F(PersonInAHall, StandsWhereTheMapShowsHimUntilItDoesNot) {
  PersonWatch watch{PersonWatchConfig{}};
  watch.choose(std::vector{person(1, 7.0, 5.0, seenAt(1), {0.1, 0})}, {5, 5});
  stepUnseen(watch, 1.05, 1.05);
  wall({{138, 97}, {143, 103}});
  stepUnseen(watch, 1.1, 9.0);
  EXPECT_FALSE(watch.hidden());
  EXPECT_LT(watch.unseen_s(seenAt(9)), 0.1);
  EXPECT_NEAR((watch.place_map_m(seenAt(9)) - Eigen::Vector2d(7, 5)).norm(), 0.0, 0.3);
  planning::test::fill(grid_, {{138, 97}, {143, 103}}, planning::test::kFreeCell);
  stepUnseen(watch, 9.05, 12.0);
  EXPECT_TRUE(watch.hidden());
  EXPECT_GT(watch.unseen_s(seenAt(12)), 2.5);
}

/// The person stands until the map explains that place and the track ends; somebody else comes by; then the person sets
/// off without a track.
TEST_F(PersonInAHall, IsSeenWithoutATrackAndNotTakenForSomebodyElse) {
  PersonWatch watch{PersonWatchConfig{}};
  watch.choose(std::vector{person(1, 7.0, 5.0, seenAt(1), {0.3, 0})}, {5, 5});
  watch.update(std::vector{person(1, 7.0, 5.0, seenAt(1), {0.3, 0})}, sight(), seenAt(1));
  const auto stand = [&](double x_m) {
    planning::test::fill(grid_, {{0, 0}, {199, 199}}, planning::test::kFreeCell);
    const int at = static_cast<int>(x_m / 0.05);
    wall({{at - 3, 97}, {at + 3, 103}});
  };
  stand(7.0);
  for (double t_s = 1.4; t_s < 8.0; t_s += 0.05)
    watch.update(std::vector{person(2, 5.0 + 0.3 * (t_s - 1.4), 3.2, seenAt(t_s), {0.3, 0})}, sight(), seenAt(t_s));
  EXPECT_FALSE(watch.hidden());
  EXPECT_LT((watch.place_map_m(seenAt(8)) - Eigen::Vector2d(7.0, 5.0)).norm(), 0.4);
  for (double t_s = 8.0; t_s < 10.0; t_s += 0.05) {
    stand(7.0 + 0.4 * (t_s - 8.0));
    watch.update({}, sight(), seenAt(t_s));
  }
  EXPECT_FALSE(watch.hidden());
  EXPECT_LT((watch.place_map_m(seenAt(10)) - Eigen::Vector2d(7.8, 5.0)).norm(), 0.6);
}

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
  EXPECT_EQ(executor_.followedPerson_map_m().has_value(), true);
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
  EXPECT_EQ(executor_.status().reason, "waits for somebody who walks");
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
  ASSERT_TRUE(executor_.followedPerson_map_m().has_value());
  EXPECT_LT((*executor_.followedPerson_map_m() - place_).norm(), 0.5);
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
