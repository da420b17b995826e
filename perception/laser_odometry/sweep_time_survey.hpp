// Tells whether scans were swept or taken at once, where the log does not say it: as a simulator takes them, or because
// a driver leaves the time of its beams out. Scans that were swept by a robot that turns fit each other only when their
// sweeps are undone.
#pragma once

#include <array>
#include <optional>

#include "perception/laser_odometry/sweep_tracker.hpp"

namespace swiftlet::perception {

/// Not thread-safe. Deterministic.
class SweepTimeSurvey {
 public:
  /// The next scan. A sweep would take `period_s`.
  void add(const common::LaserScan& scan, const common::Pose2& T_robot_laser, double period_s);
  /// nullopt while the robot has turned too little to tell.
  std::optional<bool> areSwept() const;

 private:
  /// Swept in the order of the beams, against it, and taken at once.
  struct Hypothesis {
    SweepTracker tracker;
    double fits = 0.0;  ///< Sum over the scans that count.
  };
  std::array<Hypothesis, 3> hypotheses_;
  int counted_ = 0;
};

}  // namespace swiftlet::perception
