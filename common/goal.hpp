// Whether the vehicle may be sent to a place: the one rule, for the operator's page, the behaviours, the planner and
// `swiftlet check`.
//
//   1. It is a place: its coordinates are finite, and it is no farther off than any map reaches.
//   2. Its height, where it names one, is one to fly at.
//   3. It is inside the map.
//   4. It was seen.
//   5. It is not in an obstacle.
//   6. The hull and its clearance fit there, from obstacles, from people and from space never seen.
//
// A goal that fails 3 to 6 is flown to all the same when a free place lies well within its tolerance: that place is
// flown to. Without a map, 3 to 6 are not judged. Whether a path leads there only planning tells.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "common/intent.hpp"

namespace swiftlet::common {

/// The hull is 0.25 m high and needs air under it.
inline constexpr double kLeastFlightHeight_m = 0.3;

struct Goal {
  Eigen::Vector2d place_map_m = Eigen::Vector2d::Zero();
  std::optional<double> height_m;  ///< Above the take-off floor; none: the height flown at.
  double tolerance_m = 0.0;
  double clearance_m = 0.0;  ///< Between hull and obstacle.
};
Goal goalOf(const GoToIntent& intent);

/// Above the take-off floor.
struct GoalLimits {
  double least_height_m = kLeastFlightHeight_m;
  double greatest_height_m = std::numeric_limits<double>::infinity();
};

/// What is known of a place, for a vehicle's centre at a clearance.
enum class PlaceState { kOutsideMap, kUnseen, kObstacle, kTooClose, kFree };

/// A map that goals are judged by. Constant once it is made: any thread may ask.
class GoalMap {
 public:
  virtual ~GoalMap() = default;
  virtual PlaceState stateAt(const Eigen::Vector2d& place_map_m, double clearance_m) const = 0;
  /// The free place nearest to that one, none within `reach_m`.
  virtual std::optional<Eigen::Vector2d> nearestFree(const Eigen::Vector2d& place_map_m, double reach_m,
                                                     double clearance_m) const = 0;
};

struct GoalRefusal {
  enum class Reason { kNoPlace, kHeight, kOutsideMap, kUnseen, kObstacle, kTooClose };
  Reason reason = Reason::kNoPlace;
  std::string text;  ///< For people, with values.
  /// Where the vehicle could be instead; none when there is no such place within 3 m.
  std::optional<Eigen::Vector2d> nearest_free_map_m;
};

/// The place to fly to, or why there is none. `map` may be null.
[[nodiscard]] tl::expected<Eigen::Vector2d, GoalRefusal> judgeGoal(const Goal& goal, const GoalLimits& limits,
                                                                   const GoalMap* map);

}  // namespace swiftlet::common
