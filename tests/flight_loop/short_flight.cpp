#include "tests/flight_loop/short_flight.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "behaviors/mission.hpp"
#include "common/config.hpp"

namespace swiftlet::autonomy {
namespace {

const std::string kRoot = SWIFTLET_SOURCE_DIR;

common::VehicleConfig vehicleSheet() {
  return common::config::readFile<common::VehicleConfig>(kRoot + "/config/vehicles/cobra.yaml");
}
common::LaserConfig laserSheet() {
  return common::config::readFile<common::LaserConfig>(kRoot + "/config/sensors/utm_30lx.yaml");
}

/// Compares doubles by their bits: 0 and -0 differ, and NaN equals itself.
template <typename... Values>
bool sameBits(const Values&... values) {
  const auto same = [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  const std::array<double, sizeof...(Values)> all{values...};
  for (std::size_t i = 0; i + 1 < all.size(); i += 2)
    if (!same(all[i], all[i + 1])) return false;
  return true;
}

bool same(const common::Setpoint& a, const common::Setpoint& b) {
  return a.stamp == b.stamp && a.motors_on == b.motors_on &&
         sameBits(a.roll_rad, b.roll_rad, a.pitch_rad, b.pitch_rad, a.yaw_rate_rad_s, b.yaw_rate_rad_s, a.thrust,
                  b.thrust);
}

bool same(const common::VehicleState& a, const common::VehicleState& b) {
  const auto& [pa, pb] = std::pair{a.T_odom_body.position_m, b.T_odom_body.position_m};
  const auto& [va, vb] = std::pair{a.velocity_odom_m_s, b.velocity_odom_m_s};
  return a.stamp == b.stamp && sameBits(pa.x(), pb.x(), pa.y(), pb.y(), pa.z(), pb.z()) &&
         sameBits(va.x(), vb.x(), va.y(), vb.y(), va.z(), vb.z()) &&
         sameBits(a.T_map_odom.x_m, b.T_map_odom.x_m, a.T_map_odom.y_m, b.T_map_odom.y_m, a.T_map_odom.yaw_rad,
                  b.T_map_odom.yaw_rad);
}

bool same(const common::Event& a, const common::Event& b) {
  return a.stamp == b.stamp && a.severity == b.severity && a.source == b.source && a.text == b.text &&
         a.reason == b.reason;
}

bool same(const common::OccupancyGrid& a, const common::OccupancyGrid& b) {
  bool all = a.extent() == b.extent();
  a.forEachCell([&](common::CellIndex cell, common::occupancy::Cell value) { all = all && b.at(cell) == value; });
  return all;
}

bool same(const common::LevelMap& a, const common::LevelMap& b) {
  return std::equal(a.levels.begin(), a.levels.end(), b.levels.begin(), b.levels.end(),
                    [](const common::Level& one, const common::Level& other) {
                      return one.id == other.id && one.cells == other.cells &&
                             sameBits(one.height_m, other.height_m, one.variance_m2, other.variance_m2);
                    });
}

/// The first index at which the lists differ, or at which only one of them ends; none if they are equal.
template <typename List, typename Same>
std::optional<std::size_t> firstDifference(const List& a, const List& b, Same same) {
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    if (!same(a[i], b[i])) return i;
  if (a.size() != b.size()) return std::min(a.size(), b.size());
  return std::nullopt;
}

}  // namespace

std::unique_ptr<simulation::SimulatedVehicle> makeVehicle(int seed, const common::RgbdCameraConfig* camera) {
  simulation::Scenario scenario;
  scenario.seed = seed;
  scenario.vehicle = vehicleSheet();
  scenario.laser = laserSheet();
  if (camera != nullptr) scenario.rgbd_camera = *camera;
  return std::make_unique<simulation::SimulatedVehicle>(simulation::loadWorld(kRoot + "/worlds/unb_case1.sdf"),
                                                        scenario);
}

Autonomy makeAutonomy(std::unique_ptr<common::JobRunner> jobs, const AutonomyConfig& config,
                      const VehicleMemory* memory, const common::RgbdCameraConfig* camera) {
  auto mission = behaviors::Mission::fromText(R"(<root BTCPP_format="4"><BehaviorTree ID="Short"><Sequence>
      <TakeOff height_m="1.0"/>
      <ForceSuccess><Timeout msec="13000"><Explore clearance_m="0.10"/></Timeout></ForceSuccess>
      <Land/>
    </Sequence></BehaviorTree></root>)",
                                              "short.xml");
  return Autonomy({.config = config,
                   .vehicle = vehicleSheet(),
                   .laser = laserSheet(),
                   .mission = std::move(mission),
                   .jobs = std::move(jobs),
                   .memory = memory,
                   .camera = camera});
}

Autonomy makeAutonomy(std::unique_ptr<common::JobRunner> jobs) {
  AutonomyConfig config;
  config.estimator.slam.local_sigma_m = 0.01;
  config.estimator.slam.loops.spacing_m = 0.5;
  return makeAutonomy(std::move(jobs), config);
}

bool Witness::heard(const std::string& part) const {
  return std::any_of(events.begin(), events.end(), [&](const common::Event& event) {
    return (event.source + ": " + event.text).find(part) != std::string::npos;
  });
}

std::string difference(const Witness& first, const Witness& second) {
  if (const auto i = firstDifference(first.ticks, second.ticks, [](const TickOutcome& a, const TickOutcome& b) {
        return same(a.setpoint, b.setpoint) && same(a.state, b.state);
      }))
    return "setpoint or estimate " + std::to_string(*i);
  if (const auto i = firstDifference(first.events, second.events,
                                     [](const common::Event& a, const common::Event& b) { return same(a, b); }))
    return "event " + std::to_string(*i);
  if (const auto i = firstDifference(first.results, second.results, [](const auto& a, const auto& b) {
        return a.id == b.id && a.accepted == b.accepted && a.reason == b.reason;
      }))
    return "answer " + std::to_string(*i);
  if (!same(*first.last_world->map->grid, *second.last_world->map->grid)) return "map";
  if (!same(*first.last_world->map->levels, *second.last_world->map->levels)) return "levels";
  return {};
}

}  // namespace swiftlet::autonomy
