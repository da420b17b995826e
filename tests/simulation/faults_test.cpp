// Failing sensors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/config_check.hpp"
#include "event_bytes.hpp"
#include "fixtures.hpp"
#include "simulation/fault_schedule.hpp"
#include "tests/support/problem_matchers.hpp"

namespace swiftlet::simulation {
namespace {

using test_support::ProblemIs;
using testing::ElementsAre;

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

/// The samples of a fault in the second second.
template <typename Event>
std::vector<Event> inFault(const FaultConfig& fault) {
  std::vector<Event> within;
  for (const Event& event : eventsOf<Event>(withFault(fault))) {
    const double t = common::stampsOf(common::SensorEvent(event)).measured.seconds();
    if (t >= 1.0 && t < 2.0) within.push_back(event);
  }
  return within;
}

TEST(Faults, AStuckAttitudeStaysWhileTheRatesLive) {
  const auto sound = inFault<common::ImuSample>({Sensor::kImu, FaultKind::kStuck, 9.0, 9.0});
  const auto stuck = inFault<common::ImuSample>({Sensor::kImu, FaultKind::kStuck, 1.0, 2.0});
  ASSERT_EQ(stuck.size(), sound.size());
  for (std::size_t i = 0; i < stuck.size(); ++i) {
    EXPECT_EQ(stuck[i].rotation_ahrs_body.coeffs(), stuck[0].rotation_ahrs_body.coeffs());
    EXPECT_EQ(stuck[i].angular_velocity_body_rad_s, sound[i].angular_velocity_body_rad_s);
  }
  EXPECT_NE(sound.back().rotation_ahrs_body.coeffs(), sound[0].rotation_ahrs_body.coeffs());
}

TEST(Faults, ABiasShiftsEveryAxis) {
  FaultConfig fault{Sensor::kImu, FaultKind::kBias, 1.0, 2.0};
  const auto sound = inFault<common::ImuSample>(fault);
  fault.gyro_bias_deg_s = 10.0;
  fault.accel_bias_m_s2 = -0.5;
  const auto biased = inFault<common::ImuSample>(fault);
  ASSERT_EQ(biased.size(), sound.size());
  for (std::size_t i = 0; i < biased.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(biased[i].angular_velocity_body_rad_s[axis] - sound[i].angular_velocity_body_rad_s[axis],
                  10.0 * common::kRadPerDeg, 1e-9);
      EXPECT_NEAR(biased[i].specific_force_body_m_s2[axis] - sound[i].specific_force_body_m_s2[axis], -0.5, 1e-9);
    }
}

TEST(Faults, OnlyTheBeamsOfTheMirrorOrOfASectorAreLost) {
  Scenario scenario;
  scenario.laser.mirror_first_beam = 1000;
  scenario.laser.mirror_beams = 40;
  const auto lost = [&](const FaultConfig& fault) {
    scenario.faults = {fault};
    SimulatedVehicle vehicle(boxRoom(), scenario);
    std::vector<common::SensorEvent> events;
    EXPECT_TRUE(vehicle.advanceTo(Time::fromSeconds(0.5), events));
    std::vector<int> beams;
    const Scan last = eventsOf<Scan>(events).back();
    for (int beam = 0; beam < scenario.laser.beams; ++beam)
      if (last->ranges_m[static_cast<std::size_t>(beam)] == 0.0F) beams.push_back(beam);
    return beams;
  };
  scenario.laser.dropout_rate = 0.0;
  ASSERT_TRUE(lost({Sensor::kLaser, FaultKind::kMirror, 9.0, 9.0}).empty());
  const std::vector<int> mirror = lost({Sensor::kLaser, FaultKind::kMirror, 0.0, 9.0});
  ASSERT_EQ(mirror.size(), 40U);
  EXPECT_EQ(mirror.front(), 1000);
  FaultConfig blocked{Sensor::kLaser, FaultKind::kBlocked, 0.0, 9.0};
  blocked.from_deg = -10.0;
  blocked.to_deg = 10.0;
  const std::vector<int> sector = lost(blocked);
  EXPECT_NEAR(static_cast<double>(sector.size()), 81.0, 1.0);
  EXPECT_NEAR(sector.front() + sector.back(), 1080, 2) << "about straight ahead";
}

TEST(Faults, AClockThatJumpsShiftsTheStampsUntilItIsSetRight) {
  for (const double jump_s : {0.3, -0.3}) {
    FaultConfig fault{Sensor::kLaser, FaultKind::kClockJump, 1.0, 2.0};
    fault.jump_s = jump_s;
    const auto jumped = eventsOf<Scan>(withFault(fault));
    const auto sound = eventsOf<Scan>(withFault({Sensor::kLaser, FaultKind::kSilent, 9.0, 9.0}));
    ASSERT_EQ(jumped.size(), sound.size());
    for (std::size_t i = 0; i < jumped.size(); ++i) {
      const double t = sound[i]->stamps.measured.seconds();
      EXPECT_NEAR((jumped[i]->stamps.measured - sound[i]->stamps.measured).seconds(),
                  t >= 1.0 && t < 2.0 ? jump_s : 0.0, 1e-9);
      EXPECT_EQ(jumped[i]->stamps.arrived, sound[i]->stamps.arrived);
      EXPECT_EQ(jumped[i]->ranges_m, sound[i]->ranges_m);
    }
  }
}

TEST(Faults, AClockThatDriftsMovesTheStampsFromTheBeginningOfTheFaultOn) {
  FaultConfig fault{Sensor::kLaser, FaultKind::kClockDrift, 1.0, 2.0};
  fault.drift_s_s = -0.1;
  const auto drifting = eventsOf<Scan>(withFault(fault));
  const auto sound = eventsOf<Scan>(withFault({Sensor::kLaser, FaultKind::kSilent, 9.0, 9.0}));
  ASSERT_EQ(drifting.size(), sound.size());
  for (std::size_t i = 0; i < drifting.size(); ++i) {
    const double t = sound[i]->stamps.measured.seconds();
    EXPECT_NEAR((drifting[i]->stamps.measured - sound[i]->stamps.measured).seconds(),
                t >= 1.0 && t < 2.0 ? -0.1 * (t - 1.0) : 0.0, 1e-8);
    EXPECT_EQ(drifting[i]->stamps.arrived, sound[i]->stamps.arrived);
  }
}

TEST(Faults, ALostCellTakesAThirdOfTheVoltageAndStaysLost) {
  Scenario scenario;  // Three cells, by 12.6 V.
  scenario.sensors.battery_noise_v = 0.0;
  const auto samplesOf = [](const Scenario& flown) {
    SimulatedVehicle vehicle(boxRoom(), flown);
    std::vector<common::SensorEvent> events;
    EXPECT_TRUE(vehicle.advanceTo(Time::fromSeconds(4.0), events));
    EXPECT_EQ(vehicle.truth().lost_cells, static_cast<int>(flown.faults.size()));
    EXPECT_EQ(vehicle.truth().failed_sensor.has_value(), !flown.faults.empty());
    return eventsOf<common::BatterySample>(events);
  };
  const auto sound = samplesOf(scenario);
  FaultConfig fault{Sensor::kBattery, FaultKind::kLostCell, 2.0};
  scenario.faults = {fault};
  const auto broken = samplesOf(scenario);
  ASSERT_EQ(broken.size(), sound.size());
  for (std::size_t i = 0; i < broken.size(); ++i) {
    const double share = sound[i].stamps.measured.seconds() > 2.0 ? 2.0 / 3.0 : 1.0;
    EXPECT_NEAR(broken[i].voltage_v, share * sound[i].voltage_v, 0.02) << i;
    EXPECT_NEAR(broken[i].remaining, sound[i].remaining, 1e-3) << "the charge goes through all cells";
  }
  scenario.faults = {fault, fault};
  EXPECT_NEAR(samplesOf(scenario).back().voltage_v, sound.back().voltage_v / 3.0, 0.05) << "two of three";
}

TEST(Faults, ALostCellLeavesOtherFaultsOfTheBatteryAsTheyAre) {
  const FaultSchedule schedule(
      {{Sensor::kBattery, FaultKind::kLostCell, 1.0}, {Sensor::kBattery, FaultKind::kNan, 2.0, 3.0}});
  EXPECT_FALSE(schedule.of(Sensor::kBattery, Time::fromSeconds(1.5)));
  ASSERT_TRUE(schedule.of(Sensor::kBattery, Time::fromSeconds(2.5)));
  EXPECT_EQ(schedule.of(Sensor::kBattery, Time::fromSeconds(2.5))->config.kind, FaultKind::kNan);
  EXPECT_EQ(schedule.lostCells(Time::fromSeconds(0.5)), 0);
  EXPECT_EQ(schedule.lostCells(Time::fromSeconds(1e6)), 1);
}

/// The seconds in which no scan was measured.
std::vector<int> silentSeconds(const std::vector<common::SensorEvent>& events) {
  std::vector<int> silent;
  const std::vector<Scan> scans = eventsOf<Scan>(events);
  for (int second = 0; second < 5; ++second)
    if (std::none_of(scans.begin(), scans.end(), [second](const Scan& scan) {
          return static_cast<int>(scan->stamps.measured.seconds()) == second;
        }))
      silent.push_back(second);
  return silent;
}

TEST(Faults, BeginAtAPlace) {
  FaultConfig fault;
  fault.lasts_s = 2.0;
  fault.from_s = 1.0;
  Scenario scenario;
  const Eigen::Vector3d start = SimulatedVehicle(boxRoom(), scenario).truth().T_world_body.position_m;
  fault.place_world_m = {start.x() + 0.5, start.y()};
  EXPECT_EQ(silentSeconds(withFault(fault)), (std::vector<int>{1, 2})) << "not before from_s";
  fault.within_m = 0.4;
  EXPECT_TRUE(silentSeconds(withFault(fault)).empty());
}

TEST(Faults, BeginInAPhaseThatAnObserverTells) {
  FaultConfig fault;
  fault.phase = "go to";
  fault.sensor = Sensor::kImu;
  fault.lasts_s = 2.0;
  Scenario scenario;
  scenario.faults.push_back(fault);
  scenario.faults.back().sensor = Sensor::kLaser;
  scenario.faults.push_back(fault);
  SimulatedVehicle vehicle(boxRoom(), scenario);
  std::vector<common::SensorEvent> events;
  vehicle.tellPhase({"flying", "explore", "Explore"});
  EXPECT_TRUE(vehicle.advanceTo(Time::fromSeconds(1.99), events));
  EXPECT_FALSE(vehicle.truth().failed_sensor);
  vehicle.tellPhase({"flying", "go to (1.00, 2.00)"});
  EXPECT_TRUE(vehicle.advanceTo(Time::fromSeconds(2.5), events));
  EXPECT_EQ(vehicle.truth().failed_sensor, Sensor::kImu) << "without the laser it flies on for two seconds";
  vehicle.tellPhase({"flying", "hold"});
  EXPECT_TRUE(vehicle.advanceTo(Time::fromSeconds(5.0), events));
  vehicle.tellPhase({"flying", "go to (1.00, 2.00)"});
  EXPECT_TRUE(vehicle.advanceTo(Time::fromSeconds(6.0), events));
  EXPECT_EQ(silentSeconds(events), (std::vector<int>{2, 3})) << "once, and its time";
}

/// The sensor that has failed for the flight 3 s after the fault began; "" for none.
std::string failedBy(Sensor sensor, FaultKind kind, double late_s = 0.5, double width_deg = 90.0) {
  FaultConfig fault;
  fault.sensor = sensor;
  fault.kind = kind;
  fault.late_s = late_s;
  fault.from_deg = -0.5 * width_deg;
  fault.to_deg = 0.5 * width_deg;
  fault.from_s = 2.0;
  fault.to_s = 100.0;
  const FaultSchedule schedule({fault});
  EXPECT_FALSE(schedule.failedForFlight(Time::fromSeconds(1.5)));
  fault.to_s = sensor == Sensor::kLaser ? 5.0 : 2.9;
  EXPECT_FALSE(FaultSchedule({fault}).failedForFlight(Time::fromSeconds(2.5))) << "it is soon over";
  const auto failed = schedule.failedForFlight(Time::fromSeconds(5.0));
  return failed ? toString(*failed) : "";
}

TEST(Faults, FailASensorForTheFlightIfTheyTakeAwayWhatItIsFor) {
  EXPECT_EQ(failedBy(Sensor::kImu, FaultKind::kBias), "imu");
  EXPECT_EQ(failedBy(Sensor::kLaser, FaultKind::kNan), "laser");
  EXPECT_EQ(failedBy(Sensor::kBattery, FaultKind::kSilent), "battery");
  EXPECT_EQ(failedBy(Sensor::kBattery, FaultKind::kLate), "");
  EXPECT_EQ(failedBy(Sensor::kLaser, FaultKind::kLate, 0.5), "laser");
  EXPECT_EQ(failedBy(Sensor::kLaser, FaultKind::kLate, 0.05), "") << "the filter bridges it";
  EXPECT_EQ(failedBy(Sensor::kLaser, FaultKind::kBlocked, 0.0, 120.0), "laser");
  EXPECT_EQ(failedBy(Sensor::kLaser, FaultKind::kBlocked, 0.0, 1.0), "") << "one degree";
  EXPECT_EQ(failedBy(Sensor::kPilot, FaultKind::kSilent), "");
  const auto jumped = [](Sensor sensor, double jump_s) {
    FaultConfig fault{sensor, FaultKind::kClockJump, 1.0, 9.0};
    fault.jump_s = jump_s;
    return FaultSchedule({fault}).failedForFlight(Time::fromSeconds(5.0));
  };
  EXPECT_EQ(jumped(Sensor::kLaser, -0.3), Sensor::kLaser);
  EXPECT_FALSE(jumped(Sensor::kLaser, 0.02)) << "a few millimetres";
  EXPECT_FALSE(jumped(Sensor::kBattery, 5.0)) << "the charge changes slowly";
  EXPECT_EQ(FaultSchedule({{Sensor::kBattery, FaultKind::kLostCell, 1.0}}).failedForFlight(Time::fromSeconds(900.0)),
            Sensor::kBattery);
}

/// Frames of an RGB-D camera before and in a fault of the second second.
std::pair<Rgbd, Rgbd> beforeAndIn(FaultKind kind) {
  Scenario scenario;
  scenario.rgbd_camera = common::RgbdCameraConfig();
  scenario.rgbd_camera->width_px = 64;
  scenario.rgbd_camera->height_px = 48;
  scenario.rgbd_camera->range_min_m = 0.1;
  scenario.faults = {{Sensor::kRgbd, kind, 1.0, 2.0}};
  SimulatedVehicle vehicle(boxRoom(), scenario);
  std::vector<common::SensorEvent> events;
  EXPECT_TRUE(vehicle.advanceTo(Time::fromSeconds(2.0), events));
  Rgbd before, in;
  for (const Rgbd& frame : eventsOf<Rgbd>(events)) (frame->stamps.measured.seconds() < 1.0 ? before : in) = frame;
  return {before, in};
}

TEST(Faults, PicturesTurnBlackOrWhite) {
  const auto [before, black] = beforeAndIn(FaultKind::kBlack);
  EXPECT_EQ(std::count(black->color.rgb.begin(), black->color.rgb.end(), 0), 3 * 64 * 48);
  EXPECT_TRUE(common::isMeasured(black->depth.at(32, 40))) << "the pattern is its own light";
  const Rgbd white = beforeAndIn(FaultKind::kWhite).second;
  EXPECT_EQ(std::count(white->color.rgb.begin(), white->color.rgb.end(), 255), 3 * 64 * 48);
  EXPECT_EQ(std::count(white->depth.depth_m.begin(), white->depth.depth_m.end(), common::DepthImage::kUnknown),
            64 * 48);
  EXPECT_LT(std::count(before->color.rgb.begin(), before->color.rgb.end(), 0), 100);
}

TEST(Faults, PicturesAreFlippedOrOfAnotherSize) {
  const auto [before, flipped] = beforeAndIn(FaultKind::kFlipped);
  int near = 0;
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 64; ++u) {
      const auto red = [&](const Rgbd& frame, int column) {
        return static_cast<int>(frame->color.rgb[static_cast<std::size_t>(3 * (v * 64 + column))]);
      };
      near += std::abs(red(flipped, u) - red(before, 63 - u)) < 15 ? 1 : 0;
    }
  EXPECT_GT(near, 64 * 48 * 9 / 10);
  const Rgbd small = beforeAndIn(FaultKind::kOtherSize).second;
  EXPECT_EQ(small->color.width_px, 32);
  EXPECT_EQ(small->depth.height_px, 24);
  EXPECT_EQ(small->depth.depth_m.size(), 32U * 24U);
  EXPECT_EQ(small->camera.width_px, 64) << "the camera says what it always said";
}

TEST(Faults, PicturesOfAPairAreExchangedOrOneIsMissing) {
  const auto pairIn = [](FaultKind kind) {
    Scenario scenario;
    common::RgbdCameraConfig pair;
    pair.depth = common::DepthMethod::kStereo;
    pair.width_px = 64;
    pair.height_px = 48;
    scenario.rgbd_camera = pair;
    if (kind != FaultKind::kSilent) scenario.faults = {{Sensor::kRgbd, kind, 0.5, 2.0}};
    SimulatedVehicle vehicle(boxRoom(), scenario);
    std::vector<common::SensorEvent> events;
    EXPECT_TRUE(vehicle.advanceTo(Time::fromSeconds(1.0), events));
    return eventsOf<Rgbd>(events).back();
  };
  const Rgbd sound = pairIn(FaultKind::kSilent), exchanged = pairIn(FaultKind::kExchanged);
  ASSERT_EQ(sound->stamps.measured, exchanged->stamps.measured);
  EXPECT_EQ(exchanged->color.rgb, sound->right->rgb);
  EXPECT_EQ(exchanged->right->rgb, sound->color.rgb);
  const Rgbd one_sided = pairIn(FaultKind::kOneSided);
  EXPECT_EQ(one_sided->color.rgb, sound->color.rgb);
  EXPECT_EQ(one_sided->right, nullptr);
}

TEST(Faults, ARepeatedLateOrSilentRgbdFrame) {
  const auto [before, repeated] = beforeAndIn(FaultKind::kRepeat);
  EXPECT_EQ(repeated->color.rgb, before->color.rgb);
  EXPECT_EQ(repeated->depth.depth_m, before->depth.depth_m);
  EXPECT_GT(repeated->stamps.measured, before->stamps.measured);
  const Rgbd late = beforeAndIn(FaultKind::kLate).second;
  EXPECT_GT((late->stamps.arrived - late->stamps.measured).seconds(), 0.5);
  EXPECT_EQ(beforeAndIn(FaultKind::kSilent).second, nullptr);
  EXPECT_TRUE(std::isnan(beforeAndIn(FaultKind::kNan).second->depth.at(3, 3)));
}

TEST(Faults, ContradictionsAreRefused) {
  FaultConfig fault;
  fault.to_s = 1.0;
  EXPECT_TRUE(common::config::problemsOf(fault).empty());
  fault.to_s = 0.0;
  fault.phase = "explore";
  EXPECT_EQ(common::config::problemsOf(fault).size(), 1U) << "how long?";
  fault.lasts_s = 1.0;
  EXPECT_TRUE(common::config::problemsOf(fault).empty());
  fault.to_s = 3.0;
  EXPECT_EQ(common::config::problemsOf(fault).size(), 1U);
  EXPECT_EQ(common::config::problemsOf(FaultConfig{Sensor::kLaser, FaultKind::kStuck, 1.0, 2.0}).size(), 1U);
  EXPECT_EQ(common::config::problemsOf(FaultConfig{Sensor::kImu, FaultKind::kMirror, 1.0, 2.0}).size(), 1U);
  EXPECT_EQ(common::config::problemsOf(FaultConfig{Sensor::kLaser, FaultKind::kBlack, 1.0, 2.0}).size(), 1U);
  EXPECT_THAT(common::config::problemsOf(FaultConfig{Sensor::kLaser, FaultKind::kClockJump, 1.0, 2.0}),
              test_support::HasProblem("fault.no-jump", "jump_s"));
  EXPECT_THAT(common::config::problemsOf(FaultConfig{Sensor::kLaser, FaultKind::kClockDrift, 1.0, 2.0}),
              test_support::HasProblem("fault.no-drift", "drift_s_s"));
  EXPECT_TRUE(common::config::problemsOf(FaultConfig{Sensor::kBattery, FaultKind::kLostCell, 1.0}).empty());
  EXPECT_THAT(common::config::problemsOf(FaultConfig{Sensor::kBattery, FaultKind::kLostCell, 1.0, 2.0}),
              test_support::HasProblem("fault.lost-for-good", "to_s"));
  EXPECT_THAT(common::config::problemsOf(FaultConfig{Sensor::kLaser, FaultKind::kLostCell, 1.0}),
              test_support::HasProblem("fault.of-battery", "kind"));
}

TEST(Faults, OneThatNeverHappensIsRefused) {
  const auto problems = [](double from_s, double to_s) {
    return common::config::problemsOf(FaultConfig{Sensor::kLaser, FaultKind::kSilent, from_s, to_s});
  };
  EXPECT_THAT(problems(0.0, 0.0), ElementsAre(ProblemIs("fault.no-end", "to_s")));
  EXPECT_THAT(problems(2.0, 0.0), ElementsAre(ProblemIs("fault.no-end", "to_s")));
  EXPECT_THAT(problems(2.0, 2.0), ElementsAre(ProblemIs("fault.ends-early", "to_s")));
  EXPECT_THAT(problems(2.0, 1.0), ElementsAre(ProblemIs("fault.ends-early", "to_s")));
  EXPECT_TRUE(problems(0.0, 1.0).empty());
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
