// The horizontal reference as a smooth trajectory that a vehicle with a lagging attitude can follow without falling
// behind: "run through a linear filter that represents the quadrotor's translational dynamics to generate smooth
// reference trajectories" (Tomic 2012, "Action").
//
//   smooth = F reference, F(s) = (2 tau s + 1) / (tau s + 1)^2
//
// A lag of first order alone, 1 / (tau s + 1), would be tau times the speed behind for as long as the vehicle flies. F
// is behind only while the reference accelerates, by tau^2 times the acceleration.
#pragma once

#include <Eigen/Core>

#include "control/reference.hpp"

namespace swiftlet::control {

/// One thread. Plain data.
class SmoothedReference {
 public:
  /// The reference after one tick; position and velocity in x and y are those of the smooth trajectory. Where the
  /// reference jumps, the trajectory jumps with it.
  Reference advance(Reference reference, double lag_s, double dt_s);
  void reset() { *this = {}; }

 private:
  /// By how much the smooth trajectory is behind, in odom.
  Eigen::Vector2d behind_m_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d behind_m_s_ = Eigen::Vector2d::Zero();
};

}  // namespace swiftlet::control
