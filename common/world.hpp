// The world as the autonomy knows it at one instant: an immutable snapshot that behaviours, the page and the files
// read. Grids share their tiles between snapshots. Safe to read from any thread.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/intent.hpp"
#include "common/level_map.hpp"
#include "common/localization.hpp"
#include "common/occupancy_grid.hpp"
#include "common/vehicle_state.hpp"

namespace swiftlet::common {

/// Table 1 and Fig. 3 of Tomic 2012.
enum class FlightState { kPreparation, kPoweredOff, kLanded, kTakingOff, kFlying, kLanding, kEmergencyLanding };
const char* toString(FlightState state);

/// Why a frontier is not (yet) explored.
enum class FrontierReason { kOpen, kTooSmall, kUnreachable, kOutOfBounds, kBlacklisted };
const char* toString(FrontierReason reason);

/// A connected run of free cells that touch unknown ones.
struct Frontier {
  std::vector<CellIndex> cells;
  Eigen::Vector2d centroid_map_m = Eigen::Vector2d::Zero();
  double length_m = 0.0;
  double score = 0.0;  ///< Higher is better; only for open ones.
  FrontierReason reason = FrontierReason::kOpen;
  int attempts = 0;         ///< How often it was tried.
  std::string explanation;  ///< "unreachable at clearance 0.10 m", for people.
};

struct VehicleStatus {
  FlightState flight_state = FlightState::kPreparation;
  double battery_voltage_v = 0.0;
  double battery_remaining = 1.0;  ///< In [0, 1].
  double distance_flown_m = 0.0;   ///< By the estimate.
};

/// The reactive layer, which acts at the laser rate below every intent.
struct AvoidanceStatus {
  bool braking = false;     ///< It asks for less than the speed that is flown or wanted.
  bool retreating = false;  ///< It moves the vehicle away from something unmapped or closing.
  std::string reason;
  double nearest_m = 0.0;  ///< From the hull to the nearest return; infinity when there is none.
};

/// One node of the mission tree, for the page.
struct TreeNodeView {
  int id = 0;
  int parent = -1;  ///< -1 for the root.
  std::string name;
  std::string status;  ///< IDLE, RUNNING, SUCCESS, FAILURE, SKIPPED, SUSPENDED.
};
using TreeView = std::vector<TreeNodeView>;

/// kStopped: landed by the operator before its end.
enum class MissionState { kReady, kRunning, kHeld, kDone, kFailed, kStopped };
const char* toString(MissionState state);
bool isOver(MissionState state);

struct MissionStatus {
  MissionState state = MissionState::kReady;
  std::string phase;   ///< The intent in words.
  std::string reason;  ///< Why it failed or holds.
  bool accepts_goals = true;
  TreeView tree;
};

/// How a flight ended, in words: "done".
struct FlightEnding {
  std::string outcome;
  std::string reason;
};

/// The end points of the last scan.
struct LaserPoints {
  std::vector<Eigen::Vector2f> points_map_m;
};

struct World {
  Time stamp;
  VehicleState state;
  VehicleStatus status;
  AvoidanceStatus avoidance;
  std::shared_ptr<const OccupancyGrid> grid;                        ///< Never null.
  std::shared_ptr<const LevelMap> levels;                           ///< Never null.
  std::shared_ptr<const std::vector<Frontier>> frontiers;           ///< Never null.
  std::vector<Eigen::Vector2d> plan_map_m;                          ///< What is left of the path being flown.
  std::shared_ptr<const std::vector<Eigen::Vector2d>> trail_map_m;  ///< Never null; where it has been, thinned.
  std::optional<Eigen::Vector2d> goal_map_m;
  Pose2 home_map;                 ///< The take-off pose; the identity, as that is where `map` begins.
  double explored_area_m2 = 0.0;  ///< Of known free cells, when Explore looked last; 0: it never did.
  IntentStatus intent;
  MissionStatus mission;
  std::shared_ptr<const LaserPoints> laser;  ///< May be null: the last projected scan.
  std::optional<Localization> localization;  ///< None: the flight was given no map.
  std::optional<FlightEnding> ending;        ///< Of the last one.
};

}  // namespace swiftlet::common
