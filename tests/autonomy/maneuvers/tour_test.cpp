// Survey and Inspect: lanes and orbits in a room that is drawn by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "common/rgbd_frame.hpp"
#include "tests/autonomy/maneuver_story.hpp"

namespace swiftlet::autonomy {
namespace {

using planning::test::fill;
using planning::test::kWallCell;
using testing::HasSubstr;
using testing::StartsWith;

const common::Polygon kArea{{{1.0, 0.5}, {7.0, 0.5}, {7.0, 3.5}, {1.0, 3.5}}};

class TourInFlight : public ManeuverInFlight {
 protected:
  /// The greatest distance of a place of the area from where the vehicle came by, but for those nearer than `margin_m`
  /// to the walls; runs the intent to its end.
  double farthestUnvisited_m(double limit_s) {
    std::vector<Eigen::Vector2d> flown;
    runUntil(
        [&] {
          flown.push_back(position_m());
          return ended();
        },
        limit_s);
    double farthest_m = 0.0;
    for (double x = 1.0; x <= 7.0; x += 0.1)
      for (double y = 0.5; y <= 3.5; y += 0.1) {
        double nearest_m = 1e9;
        for (const auto& place : flown) nearest_m = std::min(nearest_m, (place - Eigen::Vector2d(x, y)).norm());
        farthest_m = std::max(farthest_m, nearest_m);
      }
    return farthest_m;
  }
};

TEST_F(TourInFlight, ASurveyComesByEverywhere) {
  want(common::SurveyIntent{kArea, 1.0, std::nullopt, 0.10, common::FlightMode::kFast});
  const double farthest_m = farthestUnvisited_m(120.0);
  EXPECT_EQ(executor_.status().state, IntentState::kSucceeded);
  EXPECT_THAT(executor_.status().reason, StartsWith("48 of 48 places"));
  EXPECT_LT(farthest_m, 0.5 * std::sqrt(2.0) + 0.1) << "half a lane, at the corners";
}

TEST_F(TourInFlight, ASurveyGoesAroundAPillarAndLeavesOutWhatItStandsOn) {
  fill(grid_, {{70, 30}, {90, 50}}, kWallCell);  // 1 m by 1 m about (4, 2), where the middle lane is.
  want(common::SurveyIntent{kArea, 1.0, std::nullopt, 0.10, common::FlightMode::kFast});
  double least_m = 1e9;
  runUntil(
      [&] {
        least_m = std::min(least_m, std::max(std::abs(position_m().x() - 4.0), std::abs(position_m().y() - 2.0)) - 0.5);
        return ended();
      },
      120.0);
  EXPECT_EQ(executor_.status().state, IntentState::kSucceeded);
  EXPECT_GT(least_m, 0.25);
  EXPECT_EQ(executor_.status().reason.find("48 of 48"), std::string::npos);
  EXPECT_THAT(executor_.status().reason, HasSubstr(" of 48 places"));
}

TEST_F(TourInFlight, ASurveyStopsWhereItHasRoom) {
  fill(grid_, {{70, 30}, {90, 50}}, kWallCell);
  want(common::SurveyIntent{kArea, 1.0, std::nullopt, 0.10, common::FlightMode::kFast});
  double least_m = 1e9;
  int stops = 0;
  runUntil(
      [&] {
        const Eigen::Vector2d beside = (position_m() - Eigen::Vector2d(4.0, 2.0)).cwiseAbs().array() - 0.5;
        if (controller_.follower().finished() && executor_.status().reason.starts_with("surveying")) {
          ++stops;
          least_m = std::min(least_m, beside.cwiseMax(0.0).norm());
        }
        return ended();
      },
      120.0);
  EXPECT_EQ(executor_.status().state, IntentState::kSucceeded);
  EXPECT_GT(stops, 0);
  EXPECT_GT(least_m, executor_.costMapHere()->footprint().stopRadius_m() - 0.05) << "but for a cell";
}

TEST_F(TourInFlight, ASurveyThatWasInterruptedGoesOn) {
  const common::SurveyIntent survey{kArea, 1.0, std::nullopt, 0.10, common::FlightMode::kFast};
  want(survey);
  run(20.0);
  int passed = 0;
  ASSERT_EQ(std::sscanf(executor_.status().reason.c_str(), "surveying, %d of 48 places", &passed), 1);
  ASSERT_GT(passed, 5);
  const std::uint64_t first = executor_.status().id;
  want(common::HoldIntent{});
  run(2.0);
  wantAgain(survey, first);
  run(0.1);
  int passed_again = 0;
  ASSERT_EQ(std::sscanf(executor_.status().reason.c_str(), "surveying, %d of 48 places", &passed_again), 1);
  EXPECT_GE(passed_again, passed);
  EXPECT_LE(passed_again, passed + 3) << "those that it passed while it stopped";
  const std::uint64_t second = executor_.status().id;
  want(common::AvoidIntent{});
  run(1.0);
  wantAgain(survey, second);
  run(0.1);
  ASSERT_EQ(std::sscanf(executor_.status().reason.c_str(), "surveying, %d of 48 places", &passed_again), 1);
  EXPECT_GE(passed_again, passed);
  EXPECT_EQ(runToTheEnd(120.0), IntentState::kSucceeded);
  want(survey);
  run(0.1);
  ASSERT_EQ(std::sscanf(executor_.status().reason.c_str(), "surveying, %d of 48 places", &passed_again), 1);
  EXPECT_LT(passed_again, 4) << "one that resumes none begins anew";
}

TEST_F(TourInFlight, ASurveyWithoutAFreePlaceFails) {
  want(common::SurveyIntent{{{{20, 0.5}, {22, 0.5}, {22, 3.5}}}, 1.0, std::nullopt, 0.10, common::FlightMode::kFast});
  EXPECT_EQ(runToTheEnd(5.0), IntentState::kFailed);
  EXPECT_EQ(executor_.status().reason, "none of its places is free");
}

class InspectionInFlight : public TourInFlight {
 protected:
  /// Orbits (4, 2) once. The greatest angle between the heading plus `camera_yaw_rad` and the direction of the point.
  double worstAngle_rad(double camera_yaw_rad) {
    common::InspectIntent intent;
    intent.point_map_m = {4.0, 2.0};
    intent.radius_m = 1.2;
    want(intent);
    double worst_rad = 0.0, turned_rad = 0.0;
    std::optional<double> last_rad;
    runUntil(
        [&] {
          if (ended()) return true;
          const Eigen::Vector2d from = position_m() - intent.point_map_m;
          if (!executor_.status().inspecting) return false;
          const double angle_rad = std::atan2(from.y(), from.x());
          const double axis_rad = state_.T_map_body_planar().yaw_rad + camera_yaw_rad;
          worst_rad = std::max(worst_rad, std::abs(common::wrapAngle(std::atan2(-from.y(), -from.x()) - axis_rad)));
          if (last_rad) turned_rad += common::wrapAngle(angle_rad - *last_rad);
          last_rad = angle_rad;
          EXPECT_NEAR(from.norm(), 1.2, 0.1);
          return false;
        },
        90.0);
    EXPECT_EQ(executor_.status().state, IntentState::kSucceeded) << executor_.status().reason;
    EXPECT_NEAR(turned_rad, 2.0 * 3.14159, 0.5);
    return worst_rad;
  }
};

TEST_F(InspectionInFlight, OrbitsWithTheNoseOnThePoint) { EXPECT_LT(worstAngle_rad(0.0), 4.0 * common::kRadPerDeg); }

TEST_F(InspectionInFlight, OrbitsWithTheAxisOfTheCameraOnThePointAsTheFlightHasEstimatedItsMount) {
  constexpr double kYaw_rad = 10.0 * common::kRadPerDeg;
  auto layer = std::make_shared<common::Map3dLayer>();
  layer->frame = std::make_shared<common::RgbdFrame>();
  layer->camera.T_body_camera.rotation = Eigen::AngleAxisd(kYaw_rad, Eigen::Vector3d::UnitZ());
  map3d_ = layer;
  EXPECT_LT(worstAngle_rad(kYaw_rad), 4.0 * common::kRadPerDeg);
}

TEST_F(InspectionInFlight, TurnsToThePointAgainBeforeItGoesOnAfterAnInterruption) {
  common::InspectIntent intent;
  intent.point_map_m = {4.0, 2.0};
  intent.radius_m = 1.2;
  want(intent);
  int passed = 0, passed_again = 0;
  const auto count = [&](int& places) {
    return std::sscanf(executor_.status().reason.c_str(), "inspecting, %d of 25", &places) == 1;
  };
  runUntil([&] { return count(passed) && passed >= 6; }, 60.0);
  ASSERT_EQ(passed, 6);
  const std::uint64_t first = executor_.status().id;
  const auto here = state_.T_map_body_planar();
  want(common::HoldIntent{});
  run(2.0);
  follows_ = false;
  place(here.x_m, here.y_m, here.yaw_rad + 2.0);
  wantAgain(intent, first);
  run(3.0);
  ASSERT_TRUE(count(passed_again)) << executor_.status().reason;
  EXPECT_LE(passed_again, passed + 1) << "the place where it was";
  EXPECT_FALSE(executor_.status().inspecting);
  place(here.x_m, here.y_m, here.yaw_rad);
  run(0.6);
  EXPECT_TRUE(executor_.status().inspecting);
}

TEST_F(TourInFlight, APartOfTheCircleThatIsNotFreeIsLeftOut) {
  common::InspectIntent intent;
  intent.point_map_m = {4.0, 3.6};  // Its circle reaches beyond the wall at y = 4 m.
  intent.radius_m = 1.5;
  want(intent);
  ASSERT_EQ(runToTheEnd(120.0), IntentState::kSucceeded) << executor_.status().reason;
  EXPECT_THAT(executor_.status().reason, HasSubstr("the others are not free"));
}

TEST_F(TourInFlight, WhatFollowsNoLongerLooksAtThePoint) {
  common::InspectIntent intent;
  intent.point_map_m = {4.0, 2.0};
  want(intent);
  run(3.0);
  want(to(7.0, 2.0));
  run(8.0);
  EXPECT_LT(std::abs(state_.T_map_body_planar().yaw_rad), 0.6) << "along its path again";
}

}  // namespace
}  // namespace swiftlet::autonomy
