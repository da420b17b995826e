// Failing sensors.
#include <gtest/gtest.h>

#include <cmath>

#include "event_bytes.hpp"
#include "fixtures.hpp"

namespace swiftlet::simulation {
namespace {

using common::Time;

std::vector<common::SensorEvent> withFault(const FaultConfig& fault) {
  Scenario scenario;
  scenario.faults.push_back(fault);
  SimulatedVehicle vehicle(boxRoom(), scenario);
  std::vector<common::SensorEvent> events;
  EXPECT_TRUE(vehicle.advanceTo(Time::fromSeconds(5.0), events));
  return events;
}

TEST(Faults, ASilentLaserSendsNothingAndOtherSensorsAreUnaffected) {
  const auto broken = withFault({Sensor::kLaser, FaultKind::kSilent, 1.0, 2.0});
  const auto sound = withFault({Sensor::kLaser, FaultKind::kSilent, 9.0, 9.0});
  EXPECT_EQ(eventsOf<Scan>(sound).size() - eventsOf<Scan>(broken).size(), 40U);
  for (const Scan& scan : eventsOf<Scan>(broken))
    EXPECT_TRUE(scan->stamps.measured.seconds() < 1.0 || scan->stamps.measured.seconds() >= 2.0);
  const auto imu_a = eventsOf<common::ImuSample>(broken), imu_b = eventsOf<common::ImuSample>(sound);
  ASSERT_EQ(imu_a.size(), imu_b.size());
  for (std::size_t i = 0; i < imu_a.size(); ++i) EXPECT_EQ(bytesOf(imu_a[i]), bytesOf(imu_b[i]));
}

TEST(Faults, NanFillsTheScan) {
  for (const Scan& scan : eventsOf<Scan>(withFault({Sensor::kLaser, FaultKind::kNan, 1.0, 2.0}))) {
    const bool in_fault = scan->stamps.measured.seconds() >= 1.0 && scan->stamps.measured.seconds() < 2.0;
    EXPECT_EQ(std::isnan(scan->ranges_m[500]), in_fault);
  }
  int nan = 0;
  for (const auto& imu : eventsOf<common::ImuSample>(withFault({Sensor::kImu, FaultKind::kNan, 1.0, 2.0})))
    nan += std::isnan(imu.specific_force_body_m_s2.x()) ? 1 : 0;
  EXPECT_EQ(nan, 200);
}

TEST(Faults, ARepeatedScanHasOldRangesAndNewStamps) {
  const auto scans = eventsOf<Scan>(withFault({Sensor::kLaser, FaultKind::kRepeat, 1.0, 2.0}));
  const std::vector<float>* last_good = nullptr;
  for (const Scan& scan : scans) {
    const double t = scan->stamps.measured.seconds();
    if (t < 1.0) last_good = &scan->ranges_m;
    if (t >= 1.0 && t < 2.0) {
      EXPECT_EQ(scan->ranges_m, *last_good);
    }
    if (t >= 2.0) {
      EXPECT_NE(scan->ranges_m, *last_good);
    }
  }
  EXPECT_EQ(scans.size(), 200U);
}

TEST(Faults, ALateScanArrivesLate) {
  int late = 0;
  for (const Scan& scan : eventsOf<Scan>(withFault({Sensor::kLaser, FaultKind::kLate, 1.0, 2.0, 0.5})))
    late += (scan->stamps.arrived - scan->stamps.measured).seconds() > 0.5 ? 1 : 0;
  EXPECT_EQ(late, 40);
}

TEST(Faults, ALossyLinkDropsItsShareOfMessages) {
  Scenario scenario;
  scenario.sensors.imu_link.loss_rate = 0.1;
  SimulatedVehicle vehicle(boxRoom(), scenario);
  std::vector<common::SensorEvent> events;
  ASSERT_TRUE(vehicle.advanceTo(Time::fromSeconds(10.0), events));
  EXPECT_NEAR(static_cast<double>(eventsOf<common::ImuSample>(events).size()), 1800, 50);
  EXPECT_EQ(eventsOf<Scan>(events).size(), 400U);
}

}  // namespace
}  // namespace swiftlet::simulation
