// links: simulation common
// What the simulator costs: items per second are simulated seconds per second, to be read as "times real time".
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "common/config.hpp"
#include "common/gravity.hpp"
#include "simulation/nature.hpp"
#include "simulation/sensors/rgbd_camera.hpp"
#include "simulation/simulated_vehicle.hpp"

namespace swiftlet::simulation {
namespace {

/// Hovers in the shipped world with the 1081-beam laser at 40 Hz, everything collected, with or without the camera, by
/// the plant of a nature.
void simulatedSecond(benchmark::State& state, bool camera, bool walkers, const char* nature) {
  const WorldModel world = loadWorld(SWIFTLET_SOURCE_DIR "/worlds/unb_case1.sdf");
  Scenario scenario;
  scenario.laser = common::config::readFile<common::LaserConfig>(SWIFTLET_SOURCE_DIR "/config/sensors/utm_30lx.yaml");
  scenario.nature = std::make_shared<const Nature>(
      Nature::load(std::string(SWIFTLET_SOURCE_DIR "/config/nature/") + nature + ".yaml"));
  if (walkers) scenario.walkers.push_back({WalkerMode::kPath, {0.5, 8.0, 8.0, 8.0}, WalkerEnd::kReturn});
  SimulatedVehicle vehicle(world, scenario);
  vehicle.setCameraConsumer(camera);
  std::vector<common::SensorEvent> events;
  for (auto _ : state) {
    events.clear();
    for (int tick = 0; tick < 100; ++tick) {
      const Truth& truth = vehicle.truth();
      const Eigen::Vector3d error = vehicle.T_world_map() * Eigen::Vector3d(0, 0, 1) - truth.T_world_body.position_m;
      const Eigen::Vector3d acceleration = 2.0 * (1.2 * error - truth.velocity_world_m_s);
      vehicle.apply({vehicle.now(), true, -acceleration.y() / common::kGravity_m_s2,
                     acceleration.x() / common::kGravity_m_s2, 0.0,
                     scenario.vehicle.mass_kg * (common::kGravity_m_s2 + 2.0 * acceleration.z()) /
                         scenario.vehicle.max_thrust_n});
      if (!vehicle.advanceTo(vehicle.now() + common::Duration::fromMilliseconds(10), events)) {
        state.SkipWithError(vehicle.stopReason().c_str());
        return;
      }
    }
    benchmark::DoNotOptimize(events.data());
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()));
}

BENCHMARK_CAPTURE(simulatedSecond, headless, false, false, "calm")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulatedSecond, real, false, false, "real")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulatedSecond, walker, false, true, "calm")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulatedSecond, camera, true, false, "calm")->Unit(benchmark::kMillisecond);

/// One sweep's rays alone.
void castScan(benchmark::State& state) {
  const WorldModel world = loadWorld(SWIFTLET_SOURCE_DIR "/worlds/unb_case1.sdf");
  const RayCaster rays(world);
  std::vector<Ray> fan;
  for (int i = 0; i < 1081; ++i) {
    const double angle_rad = i * 0.25 * std::numbers::pi / 180.0;
    fan.push_back(
        {{2.0F, 6.5F, 1.0F}, {static_cast<float>(std::cos(angle_rad)), static_cast<float>(std::sin(angle_rad)), 0.0F}});
  }
  std::vector<float> distances(fan.size());
  for (auto _ : state) {
    rays.castAll(fan, 30.0, {}, distances);
    benchmark::DoNotOptimize(distances.data());
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * fan.size()));
}
BENCHMARK(castScan)->Unit(benchmark::kMicrosecond);

/// One frame of the RGB-D camera at 320x240, colour and depth with noise: without the errors of a nature, or with all
/// of them while it turns at 60 deg/s, as fast as the default profile does.
void renderRgbd(benchmark::State& state, bool errors) {
  const WorldModel world = loadWorld(SWIFTLET_SOURCE_DIR "/worlds/unb_map3d.sdf");
  const RayCaster rays(world);
  RgbdErrorsConfig of_nature;
  if (errors) {
    of_nature.dark_range_m = 3.0;
    of_nature.glancing_deg = 80.0;
    of_nature.edge_hole_rate = 0.3;
    of_nature.exposure_s = 0.008;
    of_nature.exposure_lag_s = 0.4;
  }
  RgbdCamera camera(
      common::config::readFile<common::RgbdCameraConfig>(SWIFTLET_SOURCE_DIR "/config/sensors/xtion.yaml"), of_nature,
      world, 1);
  std::vector<Moment> track;
  for (int ms = 0; ms <= 40; ++ms) {
    const double yaw_rad = 0.5 + (errors ? 1e-3 * ms * std::numbers::pi / 3.0 : 0.0);
    track.push_back({common::Time() + common::Duration::fromMilliseconds(ms),
                     {common::quaternionFrom({0.0, 0.0, yaw_rad}), {4.5, 3.0, 1.0}},
                     {}});
  }
  std::uint64_t number = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(camera.frame(number++, common::Time::fromSeconds(0.02), track, rays).depth.depth_m.data());
}
BENCHMARK_CAPTURE(renderRgbd, data_sheet, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(renderRgbd, nature, true)->Unit(benchmark::kMillisecond);

/// One hull sweep with the clearance capped at a metre, as at 100 Hz in flight.
void sweepHull(benchmark::State& state) {
  const WorldModel world = loadWorld(SWIFTLET_SOURCE_DIR "/worlds/unb_case1.sdf");
  const RayCaster rays(world);
  for (auto _ : state) benchmark::DoNotOptimize(rays.sweep({}, {2.0, 6.5, 1.0}, {2.01, 6.5, 1.0}, 1.0));
}
BENCHMARK(sweepHull)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace swiftlet::simulation
