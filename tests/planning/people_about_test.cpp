// The probability of meeting a person on a course, and where the vehicle looks while people are about.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "planning/avoidance/contact_risk.hpp"
#include "planning/avoidance/lookout.hpp"
#include "planning/avoidance/retreat.hpp"

namespace swiftlet::planning {
namespace {

using Eigen::Vector2d;

constexpr double kRadius_m = 0.275;

ContactRisk::Course standing() { return courseOf({0, 0}, {0, 0}, 0.0, 0.1, 1.0); }

double riskOf(const NearPerson& person, const ContactRisk::Course& course) {
  return ContactRisk(kRadius_m, std::vector{person}).of(course);
}

TEST(ContactRisk, NobodyIsMetWhereNobodyWalks) {
  EXPECT_FALSE(ContactRisk(kRadius_m, {}).anybody());
  EXPECT_EQ(ContactRisk(kRadius_m, {}).of(standing()), 0.0);
}

TEST(ContactRisk, WhoComesStraightOnIsLikelyMetAndSteppingAsideLowersIt) {
  const NearPerson person{{2.0, 0.0}, {-1.0, 0.0}, 0.25, 0.0};
  const double stands = riskOf(person, standing());
  EXPECT_GT(stands, 0.15);
  EXPECT_LT(riskOf(person, courseOf({0, 0}, {0, 1.0}, 0.9, 0.1, 2.0)), 0.6 * stands);
  EXPECT_GT(riskOf(person, courseOf({0, 0}, {0.5, 0.0}, 0.9, 0.1, 2.0)), stands);
}

TEST(ContactRisk, WhoWalksAwayIsHardlyMetAndWhoPassesMayTurn) {
  EXPECT_LT(riskOf({{2.0, 0.0}, {1.0, 0.0}, 0.25, 0.0}, standing()), 0.01);
  const double passes = riskOf({{1.5, 1.0}, {-1.0, 0.0}, 0.25, 0.0}, standing());
  EXPECT_GT(passes, 0.02);
  EXPECT_LT(passes, 0.15);
}

TEST(ContactRisk, OutOfSightThePlaceSpreads) {
  const Vector2d place(0.0, 1.0), velocity(0.0, 0.6);
  EXPECT_GT(riskOf({place, velocity, 0.25, 1.0}, standing()), riskOf({place, velocity, 0.25, 0.0}, standing()));
}

/// Who was coming when last seen is probably still coming, and who walked away may have turned round.
TEST(ContactRisk, WhoIsOutOfSightIsNotGone) {
  const NearPerson seen{{1.5, 0.0}, {-1.0, 0.0}, 0.25, 0.0}, unseen{{1.5, 0.0}, {-1.0, 0.0}, 0.25, 2.0};
  EXPECT_GT(riskOf(unseen, standing()), 0.25 * riskOf(seen, standing()));
  EXPECT_GT(riskOf(unseen, standing()), 0.06) << "a reason to leave";
  const NearPerson away{{3.5, 0.0}, {1.0, 0.0}, 0.25, 2.0};
  EXPECT_GT(riskOf(away, standing()), 0.01);
}

TEST(ContactRisk, TwoPeopleAreMoreThanOne) {
  const std::vector<NearPerson> people{{{2.0, 0.0}, {-1.0, 0.0}, 0.25, 0.0}, {{-2.0, 0.0}, {1.0, 0.0}, 0.25, 0.0}};
  const ContactRisk risk(kRadius_m, people);
  EXPECT_GT(risk.of(standing()), risk.of(standing(), 0));
  EXPECT_LE(risk.of(standing()), 1.0);
}

/// Turns as told, 60 deg/s, for that long.
double headingAfter(Lookout& lookout, const std::vector<NearPerson>& people_map, double yaw_rad, double seconds) {
  for (double t = 0.0; t < seconds; t += 0.025) {
    std::vector<NearPerson> people = people_map;
    for (NearPerson& person : people) {
      person.place_m = Eigen::Rotation2Dd(-yaw_rad) * person.place_m;
      person.velocity_m_s = Eigen::Rotation2Dd(-yaw_rad) * person.velocity_m_s;
    }
    const double turn_rad =
        lookout.turn_rad({common::Time::fromSeconds(1.0 + t), {0.0, 0.0, yaw_rad}, nullptr, people, {0, 0}});
    yaw_rad += std::clamp(turn_rad, -0.026, 0.026);
  }
  return yaw_rad;
}

TEST(Lookout, KeepsAPersonInViewWhoWasBehind) {
  const NearPerson person{{-1.5, 0.1}, {0.0, 0.0}, 0.25, 0.0};
  for (double seconds = 2.5; seconds < 10.0; seconds += 0.5) {
    Lookout fresh(270.0, kRadius_m);
    const double yaw_rad = headingAfter(fresh, {person}, 0.0, seconds);
    const double bearing_rad = common::wrapAngle(std::atan2(person.place_m.y(), person.place_m.x()) - yaw_rad);
    EXPECT_LT(std::abs(bearing_rad), 135.0 * common::kRadPerDeg) << seconds;
  }
}

TEST(Lookout, LooksRoundWhereNobodyIsSeen) {
  Lookout lookout(270.0, kRadius_m);
  double least_rad = 0.0, greatest_rad = 0.0, yaw_rad = 0.0;
  for (int i = 0; i < 40; ++i) {
    common::Pose2 pose{0.0, 0.0, yaw_rad};
    for (int k = 0; k < 10; ++k) {
      pose.yaw_rad +=
          std::clamp(lookout.turn_rad({common::Time::fromSeconds(0.25 * i + 0.025 * k), pose, nullptr, {}, {0, 0}}),
                     -0.026, 0.026);
    }
    yaw_rad = pose.yaw_rad;
    least_rad = std::min(least_rad, yaw_rad);
    greatest_rad = std::max(greatest_rad, yaw_rad);
  }
  EXPECT_GT(greatest_rad - least_rad, 45.0 * common::kRadPerDeg) << "the blind sector does not stay where it is";
}

}  // namespace
}  // namespace swiftlet::planning
