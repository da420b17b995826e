// What would have been, had the vehicle stood or landed two seconds before a person touched it.
#include <gtest/gtest.h>

#include "evaluation/contact_replay.hpp"

namespace swiftlet::evaluation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Two seconds at 100 Hz: the vehicle and a person, each at a constant velocity, who meet at the origin at the end,
/// 0.5 m from centre to centre along the person's path.
std::vector<ReplayTick> meeting(const Vector2d& vehicle_m_s, const Vector2d& person_m_s, double height_m = 1.0) {
  std::vector<ReplayTick> ticks;
  for (int i = 0; i <= 200; ++i) {
    const double left_s = 2.0 - 0.01 * i;
    ReplayTick tick;
    tick.stamp = common::Time::fromSeconds(10.0 + 0.01 * i);
    tick.position_world_m << -left_s * vehicle_m_s, height_m;
    tick.velocity_world_m_s << vehicle_m_s, 0.0;
    tick.above_floor_m = height_m;
    tick.people_world_m = {Vector2d(5, 5), -0.5 * person_m_s.normalized() - left_s * person_m_s};
    ticks.push_back(tick);
  }
  return ticks;
}

TEST(ContactReplay, APersonWhoWalksIntoAVehicleThatStandsTouchesItInBoth) {
  const ContactReplay result = replay(meeting({0, 0}, {1, 0}));
  EXPECT_TRUE(result.standing);
  EXPECT_TRUE(result.landing) << "a landing from 1 m takes 2.5 s";
}

TEST(ContactReplay, AVehicleThatFlewIntoAPersonsPathWouldHaveBeenPassed) {
  const ContactReplay result = replay(meeting({0, 0.7}, {1, 0}));
  EXPECT_FALSE(result.standing);
  EXPECT_FALSE(result.landing);
}

TEST(ContactReplay, FleeingAlongThePathOfAPersonOnlyDelaysIt) {
  EXPECT_TRUE(replay(meeting({0.5, 0}, {1.2, 0})).standing);
}

TEST(ContactReplay, OneWhoFlewTowardsAPersonIsMetLaterThere) {
  EXPECT_TRUE(replay(meeting({-0.3, 0}, {1.2, 0})).standing);
}

TEST(ContactReplay, AVehicleThatWasLowWouldHaveHadItsMotorsOff) {
  const ContactReplay result = replay(meeting({0, 0}, {1, 0}, 0.5));
  EXPECT_TRUE(result.standing);
  EXPECT_FALSE(result.landing);
}

TEST(ContactReplay, OneThatStandsOnTheFloorCannotLand) {
  const ContactReplay result = replay(meeting({0, 0}, {1, 0}, 0.0));
  EXPECT_TRUE(result.standing);
  EXPECT_TRUE(result.landing);
}

TEST(ContactReplay, WithoutPeopleNothingRemains) {
  std::vector<ReplayTick> ticks = meeting({0, 0}, {1, 0});
  for (ReplayTick& tick : ticks) tick.people_world_m.clear();
  EXPECT_FALSE(replay(ticks).standing);
  EXPECT_FALSE(replay({}).standing);
}

}  // namespace
}  // namespace swiftlet::evaluation
