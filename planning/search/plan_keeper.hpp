// A plan is kept until it is invalid or 500 ms old (Grzonka 2012, section IV-E), and is replaced only by one that is
// clearly better, so that the vehicle does not swing between two ways of equal length.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/time.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::planning {

/// One thread. Usage each tick: `if (keeper.check(now, map, position).replan) keeper.offer(planner.plan(...), ...)`.
class PlanKeeper {
 public:
  struct Config {
    double max_age_s = 0.5;
    double better_by = 0.10;
    double max_deviation_m = 0.30;

    void describe(common::config::Fields& fields);
  };

  struct Check {
    bool valid = false;   ///< The plan may be flown on.
    bool replan = false;  ///< Ask the planner: there is no valid plan, or it is old.
    std::string reason;   ///< Why it is not valid.
  };

  explicit PlanKeeper(const Config& config) : config_(config) {}

  /// Looks at what is left of the plan on the present map (with the discs of what moves) and remembers how far the
  /// vehicle has come along it.
  Check check(common::Time now, const CostMap& map, const Eigen::Vector2d& position_map_m);

  /// True when the offered plan is taken: there was none, the old is invalid or for another goal, or the new is cheaper
  /// by more than `better_by`. Either way the kept plan counts as fresh from `now`.
  bool offer(const Path& path, common::Time now, const CostMap& map, const Eigen::Vector2d& position_map_m);

  void clear();
  /// The plan as it was taken; null without one.
  const Path* plan() const { return path_ ? &*path_ : nullptr; }
  /// From the point of the plan nearest to where the vehicle was last seen, to the goal.
  std::vector<Eigen::Vector2d> remaining() const;

 private:
  void advanceTo(const Eigen::Vector2d& position_map_m);

  Config config_;
  std::optional<Path> path_;
  common::Time stamp_;
  std::size_t segment_ = 0;  ///< The vehicle is between points segment_ and segment_ + 1.
  double along_ = 0.0;       ///< Fraction of that segment.
  bool valid_ = false;
};

}  // namespace swiftlet::planning
