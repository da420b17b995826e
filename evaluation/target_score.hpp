// The targets of a trial, which a flight is to find.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"

namespace swiftlet::evaluation {

/// A model of the world that the flight is to find.
struct TrialTarget {
  std::string model = {};
  std::string name = {};

  void describe(common::config::Fields& fields);
  std::vector<common::Problem> validate() const;
};

struct TrueTarget {
  std::string name;
  Eigen::Vector3d middle_world_m = Eigen::Vector3d::Zero();
};

/// Farther from every true target of its name, a reported one is no target.
inline constexpr double kTargetMatch_m = 0.5;

}  // namespace swiftlet::evaluation
