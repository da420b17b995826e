// Keeps a plan as long as it is valid. When it is older than 500 ms, it is compared with a new one (Grzonka 2012,
// section IV-E). It is replaced only by a clearly cheaper one, so that the vehicle does not alternate between two paths
// of equal length.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/time.hpp"
#include "planning/clearance/hull_space.hpp"
#include "planning/search/planner.hpp"

namespace swiftlet::planning {

/// The cost maps by which a plan is judged.
struct PlanMaps {
  const CostMap& costs;              ///< Of the height of flight.
  const HullSpace* space = nullptr;  ///< Judges plans in space; null: such plans are not offered.

  // Implicit, as most plans are flown at one height.
  PlanMaps(const CostMap& map, const HullSpace* hull_space = nullptr) : costs(map), space(hull_space) {}
};

/// Not thread-safe. Usage in each tick:
/// `if (keeper.check(now, map, position).replan) keeper.offer(planner.plan(...), ...)`
class PlanKeeper {
 public:
  struct Check {
    bool valid = false;   ///< The plan may be flown on.
    bool replan = false;  ///< Ask the planner: there is no valid plan, or it is old.
    std::string reason;   ///< Why it is not valid.
  };

  /// Checks the rest of the plan on the present map (with the discs of dynamic obstacles), and records how far along it
  /// the vehicle is. It may be off the plan by its braking distance more, as a plan may begin with a turn.
  Check check(common::Time now, const PlanMaps& maps, const Eigen::Vector2d& position_map_m, double braking_m = 0.0);

  /// Offers a new plan. Returns true when it is taken: there was no plan, the old one is invalid or for another goal,
  /// or the new one is cheaper by more than a tenth. A valid plan is left within its next kSoon_m at most once in
  /// kSteady_s. In any case the age of the kept plan counts from `now`.
  bool offer(const Path& path, common::Time now, const PlanMaps& maps, const Eigen::Vector2d& position_map_m);

  static constexpr double kSoon_m = 2.0, kSteady_s = 5.0;

  void clear();
  /// The plan as it was offered; null without one.
  const Path* plan() const { return path_ ? &*path_ : nullptr; }
  /// The rest of the plan: from its point nearest to the vehicle's last position to the goal. Empty without a plan.
  std::vector<Eigen::Vector2d> remaining() const;

 private:
  /// The rest of a plan on the present maps.
  struct Rest {
    double cost_m = 0.0;
    std::optional<Eigen::Vector2d> blocked_map_m;
  };
  void advanceTo(const Eigen::Vector2d& position_map_m);
  /// The points of the escape that remaining() has after its first one.
  std::size_t remainingEscape() const;
  Rest rest(const PlanMaps& maps) const;
  Rest restInSpace(const PlanMaps& maps) const;
  bool isLeftSoonBy(const Path& path) const;

  std::optional<Path> path_;
  common::Time stamp_;
  std::size_t segment_ = 0;  ///< The vehicle is between points segment_ and segment_ + 1.
  double along_ = 0.0;       ///< Fraction of that segment.
  bool valid_ = false;
  std::optional<common::Time> left_;  ///< When a valid plan was last left soon.
};

}  // namespace swiftlet::planning
