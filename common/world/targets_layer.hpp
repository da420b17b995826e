// The World's layer of targets: coloured things that the RGB-D camera has seen and placed in the map.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace swiftlet::common {

enum class TargetState {
  kCandidate,  ///< Seen, but from too few places to be sure of it.
  kFound,
};
inline const char* toString(TargetState state) { return state == TargetState::kFound ? "found" : "candidate"; }

struct Target {
  int id = 0;        ///< Unique in the flight; a target keeps it.
  std::string name;  ///< Of its class, as the profile names it.
  int number = 0;    ///< Among the found ones of its name, from 1; 0 for a candidate.
  /// Middle of the target; z above the take-off floor.
  Eigen::Vector3d position_map_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  ///< Of the position.
  double diameter_m = 0.0;                                  ///< As it appears.
  int views = 0;                                            ///< Places from which it was measured.
  TargetState state = TargetState::kCandidate;

  bool operator==(const Target&) const = default;
  /// Standard deviation of the position in its worst direction is at most this.
  double sigma_m() const { return std::sqrt(std::max(0.0, covariance_m2.trace())); }
};

/// "red 2"; "red ?" for a candidate.
inline std::string labelOf(const Target& target) {
  return target.name + " " + (target.number > 0 ? std::to_string(target.number) : "?");
}

struct TargetsLayer {
  std::vector<Target> targets;  ///< In the order of their ids.

  bool operator==(const TargetsLayer&) const = default;
};

}  // namespace swiftlet::common
