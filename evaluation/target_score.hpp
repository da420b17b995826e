// How well a flight found and placed the targets of its trial.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "common/world/targets_layer.hpp"

namespace swiftlet::evaluation {

/// A model of the world that the flight is to find.
struct TrialTarget {
  std::string model = {};
  std::string name = {};

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
};

struct TrueTarget {
  std::string name;
  Eigen::Vector3d middle_world_m = Eigen::Vector3d::Zero();
};

/// Farther from every true target of its name, a reported one is no target.
inline constexpr double kTargetMatch_m = 0.5;

/// A target that was not found has no error.
struct TargetScore {
  double found = 0.0;  ///< Share of the true targets that were found.
  std::optional<double> error_max_m, error_median_m;
  double false_targets = 0.0;  ///< Reported ones that are no target, or that were reported before.
};

/// By the targets that are found, not by candidates. The nearest pairs belong together. nullopt without a true target.
std::optional<TargetScore> scoreTargets(const std::vector<common::Target>& reported,
                                        const std::vector<TrueTarget>& truth, const common::Pose3& T_world_map);

}  // namespace swiftlet::evaluation
