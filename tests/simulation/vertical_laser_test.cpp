// A second laser whose scan plane stands upright.
#include <cmath>

#include <gtest/gtest.h>

#include "event_bytes.hpp"
#include "fixtures.hpp"

namespace swiftlet::simulation {
namespace {

using common::Time;

common::LaserConfig upright() {
  common::LaserConfig laser;
  laser.mount.pitch_deg = 90.0;
  return laser;
}

std::vector<common::SensorEvent> eventsWhileStanding(const Scenario& scenario, double seconds) {
  SimulatedVehicle vehicle(boxRoom(), scenario);
  std::vector<common::SensorEvent> events;
  EXPECT_TRUE(vehicle.advanceTo(Time::fromSeconds(seconds), events));
  return events;
}

Scenario withUprightLaser() {
  Scenario scenario;
  scenario.vertical_laser = upright();
  return scenario;
}

TEST(VerticalLaser, SweepsThePlaneAcrossTheVehicle) {
  Scenario scenario = withUprightLaser();
  scenario.vertical_laser->range_noise_m = 0.0;
  SimulatedVehicle vehicle(boxRoom(), scenario);
  std::vector<common::SensorEvent> events;
  ASSERT_TRUE(vehicle.advanceTo(Time::fromSeconds(0.1), events));
  const std::vector<Sweep> sweeps = eventsOf<Sweep>(events);
  ASSERT_FALSE(sweeps.empty());
  const common::LaserConfig& laser = *scenario.vertical_laser;
  const common::Pose3 T_world_laser = vehicle.truth().T_world_body * laser.mount.pose();
  int on_walls = 0;
  for (int beam = 0; beam < laser.beams; ++beam) {
    const auto range_m = static_cast<double>(sweeps.front()->ranges_m[static_cast<std::size_t>(beam)]);
    if (!std::isfinite(range_m) || range_m < laser.range_min_m) continue;
    const Eigen::Vector3d end_m = T_world_laser * Eigen::Vector3d(range_m * laser.direction(beam));
    const double off_m = std::min(
        {std::abs(end_m.z()), std::abs(end_m.z() - 3.0), std::abs(end_m.y() - 4.0), std::abs(end_m.y() + 4.0)});
    EXPECT_LT(off_m, 0.003) << beam;
    EXPECT_NEAR(end_m.x(), T_world_laser.position_m.x(), 0.01);
    ++on_walls;
  }
  EXPECT_GT(on_walls, 1000);
}

TEST(VerticalLaser, HasNoiseAndALinkOfItsOwn) {
  Scenario scenario;
  scenario.vertical_laser = common::LaserConfig();
  const auto events = eventsWhileStanding(scenario, 1.0);
  const std::vector<Scan> scans = eventsOf<Scan>(events);
  const std::vector<Sweep> sweeps = eventsOf<Sweep>(events);
  EXPECT_NEAR(static_cast<double>(sweeps.size()), 40.0, 1.0);
  EXPECT_NE(scans.front()->ranges_m, sweeps.front()->ranges_m) << "mounted alike, they would read alike";
  EXPECT_NE(scans.front()->stamps.arrived, sweeps.front()->stamps.arrived);
  scenario.sensors.vertical_laser_link.loss_rate = 1.0;
  EXPECT_TRUE(eventsOf<Sweep>(eventsWhileStanding(scenario, 0.5)).empty());
}

TEST(VerticalLaser, ChangesNoByteOfTheOtherSensors) {
  std::vector<common::SensorEvent> with = eventsWhileStanding(withUprightLaser(), 1.0);
  std::erase_if(with, [](const auto& event) { return std::holds_alternative<Sweep>(event); });
  EXPECT_EQ(bytesOf(with, true), bytesOf(eventsWhileStanding(Scenario(), 1.0), true));
}

TEST(VerticalLaser, FailsByItself) {
  Scenario scenario = withUprightLaser();
  scenario.faults = {{Sensor::kVerticalLaser, FaultKind::kNan, 0.5, 2.0}};
  const auto events = eventsWhileStanding(scenario, 1.0);
  for (const Sweep& sweep : eventsOf<Sweep>(events))
    EXPECT_EQ(std::isnan(sweep->ranges_m[540]), sweep->stamps.measured.seconds() >= 0.5);
  const std::vector<Scan> scans = eventsOf<Scan>(events);
  EXPECT_NEAR(static_cast<double>(scans.size()), 40.0, 1.0) << "a faulty sweep stays one of its laser";
  for (const Scan& scan : scans) EXPECT_FALSE(std::isnan(scan->ranges_m[540]));
}

}  // namespace
}  // namespace swiftlet::simulation
