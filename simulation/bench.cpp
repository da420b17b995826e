#include "simulation/bench.hpp"

#include "common/geometry.hpp"
#include "simulation/autopilot.hpp"
#include "simulation/sensors/inertial_unit.hpp"

namespace swiftlet::simulation {
namespace {

constexpr double kBenchStep_s = 0.001;
constexpr int kBenchStepsPerTick = 2;
constexpr double kSettle_s = 2.0, kMeasure_s = 4.0;  // The horizon of the inertial unit wanders within seconds.

}  // namespace

std::vector<BenchRow> attitudeBench(const Scenario& scenario, int axis_body, int rows) {
  const common::VehicleConfig& vehicle = scenario.vehicle;
  const Eigen::Vector3d place_world_m(0.0, 0.0, 1.0);
  Quadrotor quadrotor(vehicle, scenario.quadrotor, {Eigen::Quaterniond::Identity(), place_world_m}, 1.0);
  Autopilot autopilot(vehicle, scenario.quadrotor, scenario.autopilot);
  InertialUnit inertial(scenario.sensors.imu, vehicle, static_cast<std::uint64_t>(scenario.seed));
  std::array<double, 4> throttles{};
  std::uint64_t step = 0;
  std::vector<BenchRow> table;
  for (int row = 0; row < rows; ++row) {
    const double command_deg = vehicle.max_tilt_deg * (2.0 * row / (rows - 1) - 1.0);
    double sum_deg = 0.0;
    int count = 0;
    for (double at_s = 0.0; at_s < kSettle_s + kMeasure_s; at_s += kBenchStep_s, ++step) {
      if (step % kBenchStepsPerTick == 0) {
        const common::Time now = common::Time::fromSeconds(static_cast<double>(step) * kBenchStep_s);
        AttitudeMeasurement measured =
            inertial.attitude(step / kBenchStepsPerTick, quadrotor.state(), kBenchStepsPerTick * kBenchStep_s);
        measured.battery_voltage_v = quadrotor.battery().voltage_v();
        const double command_rad = command_deg * common::kRadPerDeg;
        autopilot.receive({now, true, axis_body == 0 ? command_rad : 0.0, axis_body == 1 ? command_rad : 0.0, 0.0, 0.5},
                          now);
        throttles = autopilot.tick(now, measured, kBenchStepsPerTick * kBenchStep_s);
        const common::RollPitchYaw angles = common::rollPitchYaw(measured.rotation_ahrs_body);
        if (at_s >= kSettle_s) {
          sum_deg += (axis_body == 0 ? angles.roll_rad : angles.pitch_rad) / common::kRadPerDeg;
          ++count;
        }
      }
      quadrotor.step(throttles, Eigen::Vector3d::Zero(), -1e9, kBenchStep_s);
      quadrotor.holdOnBench(axis_body, place_world_m);
      inertial.feel(quadrotor.state());
    }
    table.push_back({command_deg, sum_deg / count});
  }
  return table;
}

}  // namespace swiftlet::simulation
