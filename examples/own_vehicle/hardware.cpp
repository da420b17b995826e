// The simulator in place of sensors and autopilot. Replace this file by one that talks to yours.
#include "hardware.hpp"

#include "common/config.hpp"
#include "common/data_paths.hpp"
#include "simulation/simulated_vehicle.hpp"

namespace common = swiftlet::common;
namespace simulation = swiftlet::simulation;

namespace {

template <typename Config>
Config sheet(const char* file) {
  return common::config::readFile<Config>(common::findData(file).string());
}

simulation::Scenario scenario() {
  simulation::Scenario scenario;
  scenario.vehicle = sheet<common::VehicleConfig>("config/vehicles/cobra.yaml");
  scenario.laser = sheet<common::LaserConfig>("config/sensors/utm_30lx.yaml");
  return scenario;
}

std::array<double, 3> valuesOf(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

}  // namespace

struct Hardware::Devices {
  simulation::SimulatedVehicle vehicle{simulation::loadWorld(common::findData("worlds/unb_case1.sdf").string()),
                                       scenario()};
};

Hardware::Hardware() : devices_(std::make_unique<Devices>()) {}
Hardware::~Hardware() = default;

double Hardware::now_s() const { return devices_->vehicle.now().seconds(); }

std::vector<Reading> Hardware::read(double until_s) {
  std::vector<common::SensorEvent> events;
  (void)devices_->vehicle.advanceTo(common::Time::fromSeconds(until_s), events);
  std::vector<Reading> readings;
  for (const common::SensorEvent& event : events) {
    const common::Stamps& stamps = common::stampsOf(event);
    const auto add = [&](auto value) {
      readings.push_back({stamps.measured.seconds(), stamps.arrived.seconds(), std::move(value)});
    };
    if (const auto* imu = std::get_if<common::ImuSample>(&event)) {
      const Eigen::Quaterniond& q = imu->rotation_ahrs_body;
      add(Inertial{valuesOf(imu->angular_velocity_body_rad_s),
                   valuesOf(imu->specific_force_body_m_s2),
                   {q.w(), q.x(), q.y(), q.z()}});
    }
    if (const auto* battery = std::get_if<common::BatterySample>(&event))
      add(Power{battery->voltage_v, battery->remaining, battery->current_a});
    if (const auto* scan = std::get_if<std::shared_ptr<const common::LaserScan>>(&event)) add(Sweep{(*scan)->ranges_m});
  }
  return readings;
}

void Hardware::send(const Command& command) {
  devices_->vehicle.apply({devices_->vehicle.now(), command.motors_on, command.roll_rad, command.pitch_rad,
                           command.yaw_rate_rad_s, command.thrust});
}

std::string Hardware::fault() const { return devices_->vehicle.stopReason(); }
