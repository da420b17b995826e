// Takes down a simulated flight, tick by tick: what really happened beside what the autonomy believed. The autonomy
// never sees any of it.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/intent.hpp"
#include "common/localization.hpp"
#include "common/occupancy_grid.hpp"
#include "common/trajectory.hpp"
#include "common/vehicle_state.hpp"
#include "common/world/mission_status.hpp"
#include "simulation/truth.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::evaluation {

/// An estimate beside the truth of its own stamp, seen from above.
struct ComparedEstimate {
  common::Pose2 T_map_body;   ///< As believed,
  common::Pose2 T_odom_body;  ///< and before the map corrected it.
  common::Pose2 T_map_truth;  ///< Where the vehicle really was, in the true `map` frame.
};

/// A goal the mission reported as reached, with the truth of that tick.
struct ReachedGoal {
  common::Time stamp;
  bool home = false;
  Eigen::Vector2d goal_map_m = Eigen::Vector2d::Zero();
  double error_m = 0.0;       ///< Horizontal, from the goal to where the vehicle really was.
  ComparedEstimate estimate;  ///< The newest of that tick.
};

/// How the flight found itself in the map it was given. Times are of snapshots in flight.
struct LocalizationRecord {
  /// The first time it said where it is.
  struct Found {
    common::Time stamp;
    double path_length_m = 0.0;  ///< True horizontal path until then.
    double error_m = 0.0;
    double error_rad = 0.0;
  };
  std::optional<Found> found;
  double flown_s = 0.0;
  double localized_s = 0.0;
  double wrong_s = 0.0;  ///< Localized, but farther from the truth than kWrong_m or more turned than kWrong_rad.
  int times_lost = 0;

  static constexpr double kWrong_m = 0.5;
  static constexpr double kWrong_rad = 10.0 * common::kRadPerDeg;
};

/// A whole flight.
struct FlightRecord {
  common::Pose3 T_world_map;
  std::optional<LocalizationRecord> localization;  ///< None: no map was given, or where it lies is not known.
  std::vector<ReachedGoal> goals;
  /// While airborne, at the times of the estimates: errors of the estimate.
  std::vector<double> horizontal_errors_m;
  std::vector<double> spatial_errors_m;
  std::vector<double> yaw_errors_rad;
  double true_distance_m = 0.0;        ///< Horizontal path, airborne,
  double true_speed_max_m_s = 0.0;     ///< and the greatest speed along it.
  double cruise_height_world_m = 0.0;  ///< Median height of the body while airborne.
  common::MissionState mission = common::MissionState::kReady;
  std::string mission_reason;
  double mission_time_s = 0.0;    ///< From the first tick of the mission to its end, or to the end of the flight.
  double flight_time_s = 0.0;     ///< Simulated, from the first tick to the last.
  double explored_area_m2 = 0.0;  ///< 0: nothing was explored.
  int interruptions = 0;          ///< How often something the mission was doing was suspended.
  int resumed = 0;                ///< How many of those went on later.
  simulation::Truth last_truth;
  std::shared_ptr<const common::OccupancyGrid> map;  ///< The last one; null when there was none.
  common::Trajectory truth_map;                      ///< In the `map` frame, 20 Hz while airborne, for pictures.
};

/// Fed by the loop that flies; cheap enough for every tick. Calls come in the order of time.
class FlightRecorder {
 public:
  /// The true pose of the `map` frame: the take-off place on its floor. `T_world_given`: that of the map the flight was
  /// given, if it was given one and that is known.
  explicit FlightRecorder(const common::Pose3& T_world_map,
                          const std::optional<common::Pose2>& T_world_given = std::nullopt);

  /// At every control tick. The estimate is compared with the truth of its own stamp, wherever that lies in the last
  /// second.
  void tick(const simulation::Truth& truth, const common::VehicleState& estimate);
  /// At every tick of the mission's tree: the intent it emitted and the status it saw.
  void intent(common::Time now, const common::Intent& intent, const common::IntentStatus& status);
  /// At every snapshot.
  void world(const common::World& world);

  /// What was taken down so far; cruise_height_world_m is missing.
  const FlightRecord& record() const { return record_; }
  FlightRecord finish() const;

 private:
  std::optional<common::Pose3> truthAt(common::Time stamp) const;
  void compare(const common::VehicleState& estimate, const common::Pose3& T_world_body);
  ComparedEstimate compared(const common::VehicleState& estimate, const common::Pose3& T_world_body) const;
  void followTree(const common::TreeView& tree);
  void followLocalization(const common::World& world);

  FlightRecord record_;
  common::Pose2 T_world_given_;
  common::LocalizationState localization_ = common::LocalizationState::kGlobal;
  std::optional<common::Time> last_flown_;
  std::deque<simulation::Truth> history_;
  std::deque<common::VehicleState> pending_;  ///< Estimates of times the truth has not come to.
  ComparedEstimate newest_;
  std::optional<common::Time> first_tick_, last_estimate_, mission_begin_, next_trajectory_;
  std::vector<double> heights_world_m_;
  Eigen::Vector2d home_map_m_ = Eigen::Vector2d::Zero();
  std::uint64_t counted_intent_ = 0;
  std::set<int> suspended_;  ///< Nodes of the tree that are suspended while their parent is not.
};

}  // namespace swiftlet::evaluation
