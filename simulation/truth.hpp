// The true state of the vehicle. For simulation and evaluation only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/time.hpp"
#include "simulation/actor.hpp"

namespace swiftlet::simulation {

enum class Sensor;

struct Truth {
  common::Time stamp;
  common::Pose3 T_world_body;
  Eigen::Vector3d velocity_world_m_s = Eigen::Vector3d::Zero();
  bool airborne = false;
  double battery_remaining = 1.0;  ///< True charge, as a share of the full one.
  int lost_cells = 0;              ///< Of the battery.
  bool faulty = false;             ///< A fault of the scenario is active.
  /// As FaultSchedule::failedForFlight().
  std::optional<Sensor> failed_sensor;

  /// Smallest horizontal distance from the hull so far, while airborne: to the static world, to a walker, and to the
  /// hull of another vehicle. They are capped at kClearanceLimit_m.
  static constexpr double kClearanceLimit_m = 1.0;
  double min_clearance_m = kClearanceLimit_m;
  double min_walker_clearance_m = kClearanceLimit_m;
  double min_vehicle_clearance_m = kClearanceLimit_m;

  bool crashed = false;
  std::string crash_reason;  ///< For example "touched `north_wall` at (1.20, 3.40, 1.05)".
  std::string touched;       ///< Name of the model, walker or other vehicle.
  common::Time contact_time;
  bool by_walker = false;  ///< A walker was touched.
  /// The vehicle stood still (below 0.1 m/s) or moved away when the walker ran into it.
  bool yielding = false;
  /// Time from the first moment at which that walker was in the laser's field, see PeopleInField; nullopt: it never
  /// was.
  std::optional<double> walker_in_field_s;
  bool glass = false;         ///< Glass was touched.
  bool unseen_glass = false;  ///< No beam of the laser had ever returned from the pane that was touched.
  std::vector<Actor> closed_doors;
};

}  // namespace swiftlet::simulation
