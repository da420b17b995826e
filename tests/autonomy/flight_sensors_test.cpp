// Which data sheets of a laser carry a flight.
#include "autonomy/flight_sensors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/config.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::autonomy {
namespace {

using common::LaserConfig;
using test_support::HasProblem;
using testing::AllOf;
using testing::IsEmpty;

LaserConfig shipped(const std::string& name) {
  return common::config::readFile<LaserConfig>(std::string(SWIFTLET_SOURCE_DIR "/config/sensors/") + name + ".yaml");
}

std::vector<common::Problem> said(const LaserConfig& laser, const common::VehicleConfig& vehicle = {}) {
  return problemsOfSensors(laser, vehicle, {});
}

TEST(FlightSensors, TheLasersOfTheShippedProfilesCarryAFlight) {
  for (const char* name : {"utm_30lx", "urg_04lx"}) EXPECT_THAT(said(shipped(name)), IsEmpty()) << name;
}

TEST(FlightSensors, WithoutAMirrorNothingMeasuresTheHeight) {
  EXPECT_THAT(said(shipped("sick_lms_291")), HasProblem("sensors.no-mirror", "laser", "mirror_first_beam"));
}

TEST(FlightSensors, AMirrorThatLooksUpOrAsideMeasuresNoHeight) {
  for (const double roll_deg : {180.0, 90.0, -60.0}) {
    LaserConfig laser = shipped("utm_30lx");
    laser.mirror_mount.roll_deg = roll_deg;
    EXPECT_THAT(said(laser), HasProblem("sensors.mirror-turned-away", "laser")) << roll_deg;
  }
  LaserConfig slanted = shipped("utm_30lx");
  slanted.mirror_mount.pitch_deg = 20.0;
  EXPECT_THAT(said(slanted), IsEmpty());
}

TEST(FlightSensors, TheBeamsDownReachTheFloorFromTheGreatestHeight) {
  LaserConfig laser = shipped("utm_30lx");
  laser.range_max_m = 1.5;
  EXPECT_THAT(said(laser), HasProblem("sensors.flies-too-high", "laser", "`max_height_m: 1.4`"));
  common::VehicleConfig low;
  low.max_height_m = 1.4;
  EXPECT_THAT(said(laser, low), IsEmpty());
  EXPECT_NEAR(measuredHeight_m(laser), 1.44, 1e-9);
}

TEST(FlightSensors, AnUprightLaserOrOneOfAFewBeamsMeasuresNoPosition) {
  LaserConfig upright = shipped("utm_30lx");
  upright.mount.pitch_deg = 90.0;
  EXPECT_THAT(said(upright), HasProblem("sensors.plane-upright", "laser"));
  LaserConfig upside_down = shipped("utm_30lx");
  upside_down.mount.roll_deg = 180.0;
  EXPECT_THAT(said(upside_down), IsEmpty()) << "it looks around all the same";
  LaserConfig ring = shipped("utm_30lx");
  ring.beams = 32;
  ring.mirror_first_beam = 24;
  ring.mirror_beams = 8;
  EXPECT_THAT(said(ring), HasProblem("sensors.too-few-beams", "laser", "24"));
}

TEST(FlightSensors, ANarrowViewLosesThePositionInTurns) {
  LaserConfig narrow = shipped("utm_30lx");
  for (const double view_deg : {15.0, 30.0, 57.0}) {
    narrow.field_of_view_deg = view_deg;
    EXPECT_THAT(said(narrow), HasProblem("sensors.view-too-narrow", "laser"));
  }
  narrow.field_of_view_deg = 90.0;
  EXPECT_THAT(said(narrow), IsEmpty());
}

TEST(FlightSensors, ScansComeBeforeTheLastOneIsTooOld) {
  LaserConfig slow = shipped("utm_30lx");
  for (const double rate_hz : {1.0, 2.0, 3.0, 3.5}) {
    slow.rate_hz = rate_hz;
    slow.sweep_s = 0.2;
    EXPECT_THAT(said(slow), HasProblem("sensors.too-seldom", "laser", "at least 3.8 scans a second")) << rate_hz;
  }
  slow.rate_hz = 3.8;
  EXPECT_THAT(said(slow), IsEmpty());
  slow.rate_hz = 5.0;
  EXPECT_THAT(said(slow), IsEmpty());
  const auto problems = problemsOfSensors(slow, {}, {.longest_silence_s = 2.0, .longest_age_s = 0.3});
  EXPECT_THAT(problems, HasProblem("sensors.too-seldom", "laser", "a position older than 0.3 s is lost"));
  EXPECT_THAT(problems, HasProblem("sensors.too-seldom", "laser", "at least 5.7 scans a second"));
}

TEST(FlightSensors, TheShortestRangeIsWithinTheHeightsOfTheVehicle) {
  LaserConfig laser = shipped("utm_30lx");
  laser.range_min_m = 3.0;
  EXPECT_THAT(said(laser), HasProblem("sensors.flies-too-low", "laser", "3.04 m (range_min_m)"));
  laser.range_min_m = 1.2;
  EXPECT_THAT(said(laser), IsEmpty()) << "that is for the mission to say";
  EXPECT_NEAR(leastMeasuredHeight_m(laser), 1.24, 1e-9);
}

TEST(FlightSensors, ATiltedScanPlaneSeesWallsAcrossARoom) {
  for (const double tilt_deg : {15.0, 20.0, 44.0, -20.0}) {
    LaserConfig laser = shipped("utm_30lx");
    laser.mount.pitch_deg = tilt_deg;
    EXPECT_THAT(said(laser), HasProblem("sensors.plane-tilted", "laser", "up to 14 deg")) << tilt_deg;
  }
  LaserConfig laser = shipped("utm_30lx");
  laser.mount.roll_deg = 10.0;
  EXPECT_THAT(said(laser), IsEmpty());
  laser.mount.roll_deg = 170.0;
  EXPECT_THAT(said(laser), IsEmpty()) << "upside down";
}

TEST(FlightSensors, ALaserBelowTheFloorOrWithoutReturnsMeasuresNothing) {
  LaserConfig below = shipped("utm_30lx");
  below.mount.z_m = -0.3;
  EXPECT_THAT(said(below), HasProblem("sensors.laser-below-floor", "laser", "z_m -0.3 is 0.17 m"));
  below.mirror_mount.z_m = -0.3;
  EXPECT_THAT(said(below), HasProblem("sensors.mirror-below-floor", "laser", "z_m -0.3"));
  LaserConfig blind = shipped("utm_30lx");
  blind.dropout_rate = 1.0;
  EXPECT_THAT(said(blind), AllOf(HasProblem("sensors.few-beams-down", "laser", "11"),
                                 HasProblem("sensors.too-few-returns", "laser")));
  blind.dropout_rate = 0.5;
  EXPECT_THAT(said(blind), IsEmpty());
}

}  // namespace
}  // namespace swiftlet::autonomy
