// One person among tracked obstacles: chosen, kept through gaps, hidden, seen without a track, and no other one.
#include "perception/people/person_watch.hpp"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/people/seen_person.hpp"
#include "tests/planning/grid_builder.hpp"

namespace swiftlet::perception {
namespace {

using test::person;
using test::seenFrom;

common::Time seenAt(double seconds) { return common::Time::fromSeconds(seconds); }

TEST(PersonWatch, ChoosesTheNearestWhoWalks) {
  PersonWatch watch;
  const std::vector around{person(1, 1.0, 0.0, seenAt(1)), person(2, 3.0, 0.0, seenAt(1), {0.5, 0}),
                           person(3, 2.0, 1.0, seenAt(1), {0.5, 0})};
  watch.choose(around, {0, 0});
  ASSERT_TRUE(watch.known());
  EXPECT_EQ(watch.place_map_m(seenAt(1)), Eigen::Vector2d(2.0, 1.0));
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
  SeenPoints seen_;

 private:
  static common::OccupancyGrid hall() {
    common::OccupancyGrid grid = common::makeOccupancyGrid(0.05);
    planning::test::fill(grid, {{0, 0}, {199, 199}}, planning::test::kFreeCell);
    return grid;
  }
};

TEST_F(PersonInAHall, IsKeptThroughANewTrackAndPastAnotherPerson) {
  PersonWatch watch;
  watch.choose(std::vector{person(1, 7.0, 5.0, seenAt(1), {0.5, 0})}, {5, 5});
  stepUnseen(watch, 1.05, 1.3);
  // The track ended; a new one is near where the person would be, another person comes the other way.
  const std::vector next{person(7, 7.3, 5.1, seenAt(1.35), {0.5, 0}), person(8, 7.1, 5.3, seenAt(1.35), {-0.5, 0})};
  watch.update(next, sight(), seenAt(1.35));
  EXPECT_EQ(watch.place_map_m(seenAt(1.35)), Eigen::Vector2d(7.3, 5.1));
}

TEST_F(PersonInAHall, WalksOnBehindAWall) {
  wall({{120, 60}, {122, 140}});  // At 6 m; the person walks behind it, at 7 m, from the middle to its end and beyond.
  PersonWatch watch;
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
  PersonWatch watch;
  watch.choose(std::vector{person(1, 7.0, 5.0, seenAt(1), {0, 0.5})}, {5, 5});
  stepUnseen(watch, 1.05, 2.0);
  from_map_m_ = {7.0, 2.0};  // The back of the wall is in sight, its front is not.
  stepUnseen(watch, 2.05, 6.0);
  const Eigen::Vector2d place = watch.place_map_m(seenAt(6));
  EXPECT_TRUE((place - from_map_m_).norm() > 5.5 || place.x() < 6.2) << place.transpose();
}

TEST_F(PersonInAHall, StandsWhereTheMapShowsHimUntilItDoesNot) {
  PersonWatch watch;
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
  PersonWatch watch;
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

}  // namespace
}  // namespace swiftlet::perception
