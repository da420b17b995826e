// Whether the vehicle may be sent to a place: one rule for the operator's page, the behaviours, the planner and
// `swiftlet check`.
//
//   1. The coordinates of the goal are finite and within 100 km of the origin.
//   2. Its height, if it has one, is within the limits of flight.
//   3. It is inside the map.
//   4. It is in observed space.
//   5. It is not in an obstacle.
//   6. The hull and its clearance fit there, clear of mapped obstacles and unknown space. People who are tracked do
//      not count: they may go, and the planner finds no path while they stand there.
//   7. The hull and its clearance are outside every keep-out zone.
//
// If a goal fails 3 to 6, but a free place lies well within its tolerance or its shift, the vehicle flies there
// instead. Without a map, 3 to 7 are not checked. Only planning decides whether a path leads there.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "common/intent.hpp"
#include "common/place_names.hpp"

namespace swiftlet::common {

/// The hull is 0.25 m high and needs air under it.
inline constexpr double kLeastFlightHeight_m = 0.3;

struct Goal {
  Eigen::Vector2d place_map_m = Eigen::Vector2d::Zero();
  std::optional<double> height_m;  ///< Above the take-off floor; nullopt: the present flight height.
  double tolerance_m = 0.0;
  double clearance_m = 0.0;  ///< Between hull and obstacle.
  /// A free place within this distance of it is accepted too, even beyond the tolerance.
  double shift_m = 0.0;
  PlaceNames names = {};  ///< For the text of a refusal.
};
Goal goalOf(const GoToIntent& intent);
/// A place that an operator tapped on: it may be shifted by a quarter of a metre, as wide as a fingertip on a tablet
/// that shows a floor of 10 m.
Goal tappedGoalOf(const GoToIntent& intent, const PlaceNames& names = {});

/// Above the take-off floor.
struct GoalLimits {
  double least_height_m = kLeastFlightHeight_m;
  double greatest_height_m = std::numeric_limits<double>::infinity();
};

/// The state of a place for the vehicle's centre, at a clearance.
enum class PlaceState { kOutsideMap, kUnseen, kObstacle, kTooClose, kKeptOut, kFree };

/// The map by which goals are judged. Immutable; safe from any thread.
class GoalMap {
 public:
  virtual ~GoalMap() = default;
  virtual PlaceState stateAt(const Eigen::Vector2d& place_map_m, double clearance_m) const = 0;
  /// The free place nearest to `place_map_m`; nullopt if there is no free place within `reach_m`.
  virtual std::optional<Eigen::Vector2d> nearestFree(const Eigen::Vector2d& place_map_m, double reach_m,
                                                     double clearance_m) const = 0;
};

struct GoalRefusal {
  enum class Reason { kNoPlace, kHeight, kOutsideMap, kUnseen, kObstacle, kTooClose, kKeptOut };
  Reason reason = Reason::kNoPlace;
  std::string text;  ///< For people, with values.
  /// The nearest place where the vehicle could be instead; none if there is no such place within 3 m.
  std::optional<Eigen::Vector2d> nearest_free_map_m;
};

/// Share of the tolerance within which a place replaces a goal; the rest is left to the controller.
inline constexpr double kShareOfTolerance = 0.8;

/// The place to fly to, or why there is none. `map` may be null.
[[nodiscard]] tl::expected<Eigen::Vector2d, GoalRefusal> judgeGoal(const Goal& goal, const GoalLimits& limits,
                                                                   const GoalMap* map);

}  // namespace swiftlet::common
