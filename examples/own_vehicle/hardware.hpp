// What the driver reads from the sensors and sends to the autopilot. hardware.cpp, where the simulator stands in for
// both, is what you replace. Frames are FLU: x forward, y left, z up.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <variant>
#include <vector>

struct Inertial {
  std::array<double, 3> rates_rad_s, forces_m_s2;  ///< At rest the force is +g upwards.
  std::array<double, 4> attitude;                  ///< Of the autopilot: w, x, y, z.
};

struct Power {
  double voltage_v, remaining, current_a;  ///< Charge in [0, 1].
};

struct Sweep {
  std::vector<float> ranges_m;  ///< From the rightmost beam counter-clockwise; infinite where nothing is hit.
};

struct Reading {
  double measured_s, arrived_s;  ///< Of a sweep, when its first beam was measured.
  std::variant<Inertial, Power, Sweep> value;
};

struct Command {
  bool motors_on;
  double roll_rad, pitch_rad, yaw_rate_rad_s, thrust;  ///< Thrust in [0, 1].
};

class Hardware {
 public:
  Hardware();
  ~Hardware();

  /// Seconds since it was switched on.
  double now_s() const;
  /// What has arrived until then since the last call, in that order.
  std::vector<Reading> read(double until_s);
  void send(const Command& command);
  /// Why nothing more will come; empty while it works.
  std::string fault() const;

 private:
  struct Devices;
  std::unique_ptr<Devices> devices_;
};
