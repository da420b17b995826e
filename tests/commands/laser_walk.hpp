// The log of a robot that moves along a room: CARMEN text.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

namespace swiftlet::commands {

/// Distance to the walls of a room of 8 m by 6 m with a niche, from (x, 0) at that angle.
inline double range_m(double x_m, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  double nearest_m = c > 0 ? (4.0 - x_m) / c : (-4.0 - x_m) / std::min(c, -1e-9);
  if (s > 0) nearest_m = std::min(nearest_m, 3.0 / s);
  if (s < 0) nearest_m = std::min(nearest_m, 3.0 / -s);
  const double niche_x_m = x_m + 2.0 / std::max(s, 1e-9) * c;
  if (s > 0 && niche_x_m > 0.5 && niche_x_m < 1.5) nearest_m = std::min(nearest_m, 2.0 / s);
  return nearest_m;
}

/// A scan from (x, 0): the laser is where the robot is.
inline std::string scan(double x_m, double stamp_s, int beams = 180, double room_size = 1.0) {
  std::string line = fmt::format("FLASER {}", beams);
  for (int i = 0; i < beams; ++i)
    line += fmt::format(" {:.2f}", room_size * range_m(x_m, -0.5 * std::numbers::pi + std::numbers::pi * i / beams));
  return line + fmt::format(" {0:.4f} 0 0 {0:.4f} 0 0 {1:.6f} host {1:.6f}\n", x_m, stamp_s);
}

inline std::string walk(int scans) {
  std::string log = "# a walk\nPARAM robot_length 0.4\n";
  for (int i = 0; i < scans; ++i) log += scan(-2.0 + 0.03 * i, 100.0 + 0.1 * i);
  return log;
}

}  // namespace swiftlet::commands
