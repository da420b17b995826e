// The driver of your vehicle: makes events of what its sensors measure, and commands of setpoints.
#pragma once

#include <string>
#include <vector>

#include "common/vehicle.hpp"
#include "common/vehicle_config.hpp"
#include "hardware.hpp"

class Driver final : public swiftlet::common::Vehicle {
 public:
  /// The data sheet of the laser that is on board.
  explicit Driver(const swiftlet::common::LaserConfig& laser) : laser_(laser) {}

  swiftlet::common::Time now() const override;
  bool advanceTo(swiftlet::common::Time time, std::vector<swiftlet::common::SensorEvent>& events) override;
  void apply(const swiftlet::common::Setpoint& setpoint) override;
  std::string stopReason() const override { return hardware_.fault(); }

 private:
  swiftlet::common::LaserConfig laser_;
  Hardware hardware_;
};
