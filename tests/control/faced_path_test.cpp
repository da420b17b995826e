// The planned yaws as the carrot comes by, round corners that it cuts and where the path leads back.
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "control/faced_path.hpp"

namespace swiftlet::control {
namespace {

using common::Facing;

const std::vector<Facing> kCorner{{{0, 0}, 0.0}, {{1, 0}, 0.0}, {{1, 1}, 1.0, 0.2}, {{1, 2}, 3.0}, {{1, 3}, -3.0}};

TEST(FacedPath, GoesAlongWithACarrotThatCutsTheCorner) {
  FacedPath faced;
  faced.lay(kCorner);
  faced.advance({0.5, 0.0});
  EXPECT_NEAR(faced.yaw_rad(), 0.0, 1e-9);
  EXPECT_NEAR(faced.yawAhead_rad(), 0.5, 1e-9) << "a stretch ahead, in the middle of it";
  EXPECT_NEAR(faced.turnAhead_rad_m(), 1.0, 1e-9);
  faced.advance({0.9, 0.05});
  EXPECT_NEAR(faced.yaw_rad(), 0.0, 1e-9);
  faced.advance({0.95, 0.1});
  EXPECT_NEAR(faced.yaw_rad(), 0.1, 1e-9);
  faced.advance({1.0, 1.5});
  EXPECT_NEAR(faced.yaw_rad(), 2.0, 1e-9);
  faced.advance({1.0, 2.5});
  EXPECT_NEAR(std::abs(faced.yaw_rad()), M_PI, 1e-9) << "the shorter way round";
  faced.advance({1.0, 0.2});
  EXPECT_NEAR(std::abs(faced.yaw_rad()), M_PI, 1e-9) << "never back";
  faced.advance({1.0, 9.0});
  EXPECT_NEAR(faced.yaw_rad(), -3.0, 1e-9);
  EXPECT_NEAR(faced.turnAhead_rad_m(), 0.0, 1e-9);
}

TEST(FacedPath, ACarrotThatRoundsASharpTurnGetsOn) {
  FacedPath faced;
  faced.lay({{{0, 0}, 0.0}, {{1, 0}, 1.0}, {{0.3, 0.3}, 2.0}});  // Rounded, it never comes to x = 1.
  for (const Eigen::Vector2d& carrot :
       {Eigen::Vector2d(0.8, 0.0), Eigen::Vector2d(0.85, 0.03), Eigen::Vector2d(0.8, 0.07)})
    faced.advance(carrot);
  EXPECT_GT(faced.yaw_rad(), 1.0);
}

TEST(FacedPath, BrakesInTimeForWhatIsSlow) {
  FacedPath faced;
  std::vector<Facing> straight;
  for (int i = 0; i <= 4; ++i) straight.push_back({{i, 0}, 0.0});
  straight[2].speed_m_s = 0.2;
  faced.lay(straight);
  const FacedPath::Nose nose{0.0, 1.0};
  faced.advance({0.8, 0.0});
  EXPECT_EQ(faced.allowedSpeed_m_s(0.5, nose), std::numeric_limits<double>::infinity()) << "1.2 m ahead";
  faced.advance({1.5, 0.0});
  EXPECT_NEAR(faced.allowedSpeed_m_s(0.5, nose), std::sqrt(0.2 * 0.2 + 2.0 * 0.5 * 0.5), 1e-9);
  faced.advance({2.5, 0.0});
  EXPECT_NEAR(faced.allowedSpeed_m_s(0.5, nose), 0.2, 1e-9);
}

TEST(FacedPath, WaitsForTheNoseUntilThatHasTurned) {
  FacedPath faced;
  faced.lay({{{0, 0}, 0.0}, {{0.2, 0}, 2.0}, {{0.4, 0}, 2.0}});
  const double lag_rad = 10.0 * common::kRadPerDeg;
  EXPECT_NEAR(faced.allowedSpeed_m_s(0.5, {0.0, 1.0}), 0.2 / (2.0 - lag_rad), 1e-9);
  EXPECT_NEAR(faced.allowedSpeed_m_s(0.5, {1.0, 1.0}), 0.2 / (1.0 - lag_rad), 1e-9) << "half of the turn is left";
  EXPECT_GT(faced.allowedSpeed_m_s(0.5, {1.9, 1.0}), 100.0);
  EXPECT_NEAR(faced.allowedSpeed_m_s(0.5, {-1.0, 1.0}), 0.2 / (2.0 - lag_rad), 1e-9) << "no more than was planned";
  faced.advance({0.3, 0.0});
  EXPECT_GT(faced.allowedSpeed_m_s(0.5, {0.0, 1.0}), 100.0);
}

TEST(FacedPath, MovesWithTheMap) {
  FacedPath faced;
  faced.lay({{{0, 0}, 0.0}, {{2, 0}, 1.0}});
  faced.move({5.0, 0.0, M_PI / 2.0});
  faced.advance({5.0, 1.0});
  EXPECT_NEAR(faced.yaw_rad(), M_PI / 2.0 + 0.5, 1e-9);
  faced.lay({});
  EXPECT_TRUE(faced.empty());
  faced.advance({0, 0});
}

}  // namespace
}  // namespace swiftlet::control
