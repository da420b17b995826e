// A robot on wheels that drives along a path and scans at a fixed height.
#include "simulation/survey.hpp"
#include "common/config.hpp"
#include "common/config_check.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "common/error.hpp"
#include "tests/simulation/fixtures.hpp"

namespace swiftlet::simulation {
namespace {

common::LaserConfig laser() {
  return common::config::readFile<common::LaserConfig>(SWIFTLET_SOURCE_DIR "/config/sensors/sick_lms_291.yaml");
}

struct Survey : testing::Test {
  Survey() {
    world.shapes.push_back(boxShape("desk", {3.0, -1.0, 0.0}, {4.0, 1.0, 0.72}));
    config.path_world_m = {-2.0, 0.0, 1.0, 0.0, 1.0, 2.0};
    config.speed_m_s = 0.5;
    config.turn_deg_s = 45.0;
  }
  std::vector<SurveyScan> scans() const {
    const RayCaster rays(world);
    SurveyDrive drive(config, laser(), rays);
    std::vector<SurveyScan> all;
    while (auto taken = drive.next()) all.push_back(std::move(*taken));
    return all;
  }
  WorldModel world = boxRoom();
  SurveyConfig config;
};

TEST_F(Survey, DrivesItsPathAndTurnsOnTheSpot) {
  const std::vector<SurveyScan> all = scans();
  // 3 m and 2 m at 0.5 m/s, and a quarter turn: 12 s, ten scans a second.
  ASSERT_NEAR(static_cast<double>(all.size()), 120.0, 1.0);
  EXPECT_NEAR(all[30].T_world_body.x_m, -0.5, 1e-9);
  EXPECT_NEAR(all[70].T_world_body.x_m, 1.0, 1e-9) << "it turns";
  EXPECT_NEAR(all[70].T_world_body.yaw_rad, M_PI_4, 1e-6);
  EXPECT_NEAR(all[110].T_world_body.y_m, 1.5, 1e-6);
  EXPECT_NEAR(all[30].scan.stamps.measured.seconds(), 3.0, 1e-9);
}

TEST_F(Survey, SeesObstaclesAtItsHeight) {
  const auto ahead = [&] { return static_cast<double>(scans()[0].scan.ranges_m[180]); };
  EXPECT_NEAR(ahead(), 7.0, 0.1) << "over the desk to the wall";
  config.laser_height_world_m = 0.5;
  EXPECT_NEAR(ahead(), 5.0, 0.1) << "the desk";
}

TEST_F(Survey, TheSameSeedGivesTheSameBytes) {
  const auto first = scans()[5].scan.ranges_m;
  EXPECT_EQ(scans()[5].scan.ranges_m, first);
  config.seed = 2;
  EXPECT_NE(scans()[5].scan.ranges_m, first);
}

TEST(SurveyConfig, APathHasAtLeastTwoPoints) {
  SurveyConfig config;
  EXPECT_TRUE(common::config::problemsOf(config).empty()) << "none is driven";
  config.path_world_m = {1.0, 2.0};
  EXPECT_EQ(common::config::problemsOf(config).size(), 1u);
  config.path_world_m = {1.0, 2.0, 3.0};
  EXPECT_EQ(common::config::problemsOf(config).size(), 1u);
}

}  // namespace
}  // namespace swiftlet::simulation
