#include "driver.hpp"

#include <memory>
#include <variant>

namespace common = swiftlet::common;

namespace {

Eigen::Vector3d vectorOf(const std::array<double, 3>& values) { return {values[0], values[1], values[2]}; }

common::SensorEvent eventOf(const Inertial& inertial, common::Stamps stamps) {
  const auto& [w, x, y, z] = inertial.attitude;
  return common::ImuSample{stamps, vectorOf(inertial.rates_rad_s), vectorOf(inertial.forces_m_s2),
                           Eigen::Quaterniond(w, x, y, z)};
}

common::SensorEvent eventOf(const Power& power, common::Stamps stamps) {
  return common::BatterySample{stamps, power.voltage_v, power.remaining, power.current_a};
}

common::SensorEvent eventOf(const Sweep& sweep, common::Stamps stamps, const common::LaserConfig& laser) {
  auto scan = std::make_shared<common::LaserScan>();
  scan->stamps = stamps;
  scan->angle_min_rad = laser.angleMin_rad();
  scan->angle_increment_rad = laser.angleIncrement_rad();
  scan->time_increment = common::Duration::fromSeconds(laser.sweep_s / (laser.beams - 1));
  scan->range_min_m = laser.range_min_m;
  scan->range_max_m = laser.range_max_m;
  scan->ranges_m = sweep.ranges_m;
  return std::shared_ptr<const common::LaserScan>(std::move(scan));
}

}  // namespace

common::Time Driver::now() const { return common::Time::fromSeconds(hardware_.now_s()); }

/// The flight has already waited until `time`, so nothing is waited for here.
bool Driver::advanceTo(common::Time time, std::vector<common::SensorEvent>& events) {
  for (const Reading& reading : hardware_.read(time.seconds())) {
    const common::Stamps stamps{common::Time::fromSeconds(reading.measured_s),
                                common::Time::fromSeconds(reading.arrived_s)};
    if (const auto* inertial = std::get_if<Inertial>(&reading.value)) events.push_back(eventOf(*inertial, stamps));
    if (const auto* power = std::get_if<Power>(&reading.value)) events.push_back(eventOf(*power, stamps));
    if (const auto* sweep = std::get_if<Sweep>(&reading.value)) events.push_back(eventOf(*sweep, stamps, laser_));
  }
  return hardware_.fault().empty();
}

void Driver::apply(const common::Setpoint& setpoint) {
  hardware_.send({setpoint.motors_on, setpoint.roll_rad, setpoint.pitch_rad, setpoint.yaw_rate_rad_s, setpoint.thrust});
}
