// Which data sheets of a laser carry a flight.
#include "autonomy/flight_sensors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/config.hpp"

namespace swiftlet::autonomy {
namespace {

using common::LaserConfig;
using testing::AllOf;
using testing::HasSubstr;

LaserConfig shipped(const std::string& name) {
  return common::config::readFile<LaserConfig>(std::string(SWIFTLET_SOURCE_DIR "/config/sensors/") + name + ".yaml");
}

std::string said(const LaserConfig& laser, const common::VehicleConfig& vehicle = {}) {
  std::string text;
  for (const common::Problem& problem : problemsOfSensors(laser, vehicle, {})) text += toString(problem) + "\n";
  return text;
}

TEST(FlightSensors, TheLasersOfTheShippedProfilesCarryAFlight) {
  for (const char* name : {"utm_30lx", "urg_04lx"}) EXPECT_EQ(said(shipped(name)), "") << name;
}

TEST(FlightSensors, WithoutAMirrorNothingMeasuresTheHeight) {
  EXPECT_THAT(said(shipped("sick_lms_291")), AllOf(HasSubstr("laser: nothing measures the height: no beam of "
                                                             "sick_lms_291 looks down"),
                                                   HasSubstr("mirror_first_beam")));
}

TEST(FlightSensors, AMirrorThatLooksUpOrAsideMeasuresNoHeight) {
  for (const double roll_deg : {180.0, 90.0, -60.0}) {
    LaserConfig laser = shipped("utm_30lx");
    laser.mirror_mount.roll_deg = roll_deg;
    EXPECT_THAT(said(laser), HasSubstr("turns its beams away from the floor")) << roll_deg;
  }
  LaserConfig slanted = shipped("utm_30lx");
  slanted.mirror_mount.pitch_deg = 20.0;
  EXPECT_EQ(said(slanted), "");
}

TEST(FlightSensors, TheBeamsDownReachTheFloorFromTheGreatestHeight) {
  LaserConfig laser = shipped("utm_30lx");
  laser.range_max_m = 1.5;
  EXPECT_THAT(said(laser), HasSubstr("reach 1.44 m (range_max_m), and cobra may fly 2.00 m high, set "
                                     "`max_height_m: 1.4` in the vehicle's sheet"));
  common::VehicleConfig low;
  low.max_height_m = 1.4;
  EXPECT_EQ(said(laser, low), "");
  EXPECT_NEAR(measuredHeight_m(laser), 1.44, 1e-9);
}

TEST(FlightSensors, AnUprightLaserOrOneOfAFewBeamsMeasuresNoPosition) {
  LaserConfig upright = shipped("utm_30lx");
  upright.mount.pitch_deg = 90.0;
  EXPECT_THAT(said(upright), HasSubstr("nothing measures the position: the mount of utm_30lx turns its scan plane "
                                       "upright"));
  LaserConfig upside_down = shipped("utm_30lx");
  upside_down.mount.roll_deg = 180.0;
  EXPECT_EQ(said(upside_down), "") << "it looks around all the same";
  LaserConfig ring = shipped("utm_30lx");
  ring.beams = 32;
  ring.mirror_first_beam = 24;
  ring.mirror_beams = 8;
  EXPECT_THAT(said(ring), HasSubstr("24 of the beams of utm_30lx look around, and a match takes 30"));
}

TEST(FlightSensors, ANarrowViewLosesThePositionInTurns) {
  LaserConfig narrow = shipped("utm_30lx");
  for (const double view_deg : {15.0, 30.0, 57.0}) {
    narrow.field_of_view_deg = view_deg;
    EXPECT_THAT(said(narrow), HasSubstr("nothing measures the position: the beams of utm_30lx look around over"));
  }
  narrow.field_of_view_deg = 90.0;
  EXPECT_EQ(said(narrow), "");
}

TEST(FlightSensors, ScansComeBeforeTheLastOneIsTooOld) {
  LaserConfig slow = shipped("utm_30lx");
  for (const double rate_hz : {1.0, 2.0, 3.0, 3.5}) {
    slow.rate_hz = rate_hz;
    slow.sweep_s = 0.2;
    EXPECT_THAT(said(slow), AllOf(HasSubstr("utm_30lx measures too seldom"), HasSubstr("the vehicle holds"),
                                  HasSubstr("at least 3.8 scans a second")))
        << rate_hz;
  }
  slow.rate_hz = 3.8;
  EXPECT_EQ(said(slow), "");
  slow.rate_hz = 5.0;
  EXPECT_EQ(said(slow), "");
  std::string text;
  for (const auto& problem : problemsOfSensors(slow, {}, {.longest_silence_s = 2.0, .longest_age_s = 0.3}))
    text += toString(problem);
  EXPECT_THAT(text, AllOf(HasSubstr("horizontal_timeout_s"), HasSubstr("at least 5.7 scans a second")));
}

TEST(FlightSensors, TheShortestRangeIsWithinTheHeightsOfTheVehicle) {
  LaserConfig laser = shipped("utm_30lx");
  laser.range_min_m = 3.0;
  EXPECT_THAT(said(laser), HasSubstr("measure no height below 3.04 m (range_min_m), and cobra may fly 2.00 m high"));
  laser.range_min_m = 1.2;
  EXPECT_EQ(said(laser), "") << "that is for the mission to say";
  EXPECT_NEAR(leastMeasuredHeight_m(laser), 1.24, 1e-9);
}

TEST(FlightSensors, ATiltedScanPlaneSeesWallsAcrossARoom) {
  for (const double tilt_deg : {15.0, 20.0, 44.0, -20.0}) {
    LaserConfig laser = shipped("utm_30lx");
    laser.mount.pitch_deg = tilt_deg;
    EXPECT_THAT(said(laser), AllOf(HasSubstr("tilts its scan plane by"), HasSubstr("up to 14 deg"))) << tilt_deg;
  }
  LaserConfig laser = shipped("utm_30lx");
  laser.mount.roll_deg = 10.0;
  EXPECT_EQ(said(laser), "");
  laser.mount.roll_deg = 170.0;
  EXPECT_EQ(said(laser), "") << "upside down";
}

TEST(FlightSensors, ALaserBelowTheFloorOrWithoutReturnsMeasuresNothing) {
  LaserConfig below = shipped("utm_30lx");
  below.mount.z_m = -0.3;
  EXPECT_THAT(said(below), HasSubstr("the mount of utm_30lx: z_m -0.3 is 0.17 m below the floor on which cobra"));
  below.mirror_mount.z_m = -0.3;
  EXPECT_THAT(said(below), HasSubstr("nothing measures the height: the mirror_mount of utm_30lx: z_m -0.3"));
  LaserConfig blind = shipped("utm_30lx");
  blind.dropout_rate = 1.0;
  EXPECT_THAT(said(blind), AllOf(HasSubstr("of the 11 beams down of utm_30lx hardly one returns"),
                                 HasSubstr("0 of the beams of utm_30lx return, its dropout_rate is 1")));
  blind.dropout_rate = 0.5;
  EXPECT_EQ(said(blind), "");
}

}  // namespace
}  // namespace swiftlet::autonomy
