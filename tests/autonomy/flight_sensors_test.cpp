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
  for (const common::Problem& problem : problemsOfSensors(laser, vehicle, 30)) text += toString(problem) + "\n";
  return text;
}

TEST(FlightSensors, TheLasersOfTheShippedProfilesCarryAFlight) {
  for (const char* name : {"utm_30lx", "utm_30lx_10hz", "urg_04lx"}) EXPECT_EQ(said(shipped(name)), "") << name;
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

}  // namespace
}  // namespace swiftlet::autonomy
