// Records a simulated flight, tick by tick: the truth and the estimates of the autonomy. The autonomy never sees any of
// it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "common/intent.hpp"
#include "common/occupancy_grid.hpp"
#include "common/trajectory.hpp"
#include "common/vehicle_state.hpp"
#include "evaluation/behavior_recorder.hpp"
#include "evaluation/conduct_recorder.hpp"
#include "evaluation/contact_recorder.hpp"
#include "evaluation/ending_recorder.hpp"
#include "evaluation/estimate_record.hpp"
#include "evaluation/event_order.hpp"
#include "evaluation/mission_record.hpp"
#include "evaluation/operator_script.hpp"
#include "evaluation/phase_metrics.hpp"
#include "simulation/truth.hpp"

namespace swiftlet::common {
struct Map3dLayer;
struct World;
}  // namespace swiftlet::common

namespace swiftlet::evaluation {

/// A goal that the mission reported as reached, with the truth at that tick.
struct ReachedGoal {
  common::Time stamp;
  bool home = false;
  Eigen::Vector2d goal_map_m = Eigen::Vector2d::Zero();
  double error_m = 0.0;       ///< Horizontal distance from the goal to the true position.
  ComparedEstimate estimate;  ///< The newest estimate at that tick.
  double error_raw_m = 0.0;   ///< As error_m, with the goal in FlightRecord::T_world_start.
};

/// The record of a whole flight.
struct FlightRecord {
  common::Pose3 T_world_map;    ///< The vehicle's `map` frame as it can know it; see knowableFrame().
  common::Pose3 T_world_start;  ///< The take-off place with the true heading of the body.
  /// nullopt if no map was given, or if its pose in the world is not known.
  std::optional<LocalizationRecord> localization;
  std::vector<ReachedGoal> goals;
  EstimateRecord estimate;
  double true_distance_m = 0.0;        ///< Length of the horizontal path while airborne.
  double true_speed_max_m_s = 0.0;     ///< Greatest horizontal speed while airborne.
  double cruise_height_world_m = 0.0;  ///< Median height of the body while airborne.
  MissionRecord mission;
  double flight_time_s = 0.0;     ///< Simulated time from the first tick to the last.
  double explored_area_m2 = 0.0;  ///< 0 if nothing was explored.
  ConductRecord conduct;
  BehaviorRecord behaviors;
  EndingRecord ending;
  std::optional<ContactRecord> contact;  ///< The first that it did not mean.
  bool motors_off = true;                ///< At the end; also while a pilot has them.
  std::vector<PhaseScore> phases;
  std::vector<EventOrderScore> event_orders;
  std::vector<OperatorAnswer> operator_answers;  ///< Of the trial's script; filled in by the flight.
  simulation::Truth last_truth;
  std::shared_ptr<const common::OccupancyGrid> map;     ///< The last map; null without one.
  std::shared_ptr<const common::Map3dLayer> map3d;      ///< The last 3D map; null without one.
  std::optional<VisualOdometryRecord> visual_odometry;  ///< nullopt unless the trial requires it; set by the flight.
  std::vector<common::Pose3> T_world_body_views;        ///< True poses, 5 Hz while airborne: where the camera looked.
};

/// The flight loop calls it; each call is cheap enough for every tick. Calls come in the order of time.
class FlightRecorder {
 public:
  /// `T_world_start` is the true take-off place on its floor, and `T_world_map` the vehicle's frame there.
  /// `T_world_given` is the true pose of the given map, if there is one and its pose is known.
  FlightRecorder(const common::Pose3& T_world_start, const common::Pose3& T_world_map,
                 const std::optional<common::Pose2>& T_world_given = std::nullopt);
  /// With a laser that is mounted as its data sheet says.
  explicit FlightRecorder(const common::Pose3& T_world_map,
                          const std::optional<common::Pose2>& T_world_given = std::nullopt)
      : FlightRecorder(T_world_map, T_world_map, T_world_given) {}

  /// Call before the first tick: the parts of the flight that have figures of their own.
  void watch(const std::vector<PhaseConfig>& phases);
  /// Call before the first tick: the events whose order and places matter.
  void watchEvents(const std::vector<EventOrderConfig>& orders);
  /// Call at every scan that arrives.
  void scan(const common::Stamps& stamps) { conduct_.scan(stamps); }
  /// Call before tick(): the true places of the people, the person to be followed first.
  void people(std::vector<Eigen::Vector2d> people_world_m) {
    contact_.people(people_world_m);
    behaviors_.people(std::move(people_world_m));
  }
  /// Call before tick(): whether the setpoint has the motors on.
  void motors(bool on) { contact_.motors(on); }
  /// Call at every control tick. The estimate is compared with the truth at its own stamp, which may be up to a second
  /// old. `reference_odom_m` is the reference of the controller, nullopt unless the vehicle flies.
  void tick(const simulation::Truth& truth, const common::VehicleState& estimate,
            const std::optional<Eigen::Vector3d>& reference_odom_m = std::nullopt);
  /// Call at every tick of the mission's tree, with the intent that it emitted and the status that it saw.
  void intent(common::Time now, const common::Intent& intent, const common::IntentStatus& status);
  /// Call when the operator or the pilot orders the end of the flight: landing, flying home, taking over.
  void order(common::Time now, std::string text) { ending_.order(now, std::move(text)); }
  /// Call at every event, after the tick in which it came.
  void event(const common::Event& event);
  /// Call at every snapshot.
  void world(const common::World& world);

  /// The true path so far, see EstimateRecord.
  const common::Trajectory& truth_map() const { return record_.estimate.truth_map; }
  FlightRecord finish() const;

 private:
  void tickPhases(const simulation::Truth& truth, const common::VehicleState& estimate,
                  const std::optional<Eigen::Vector3d>& reference_odom_m);
  void followPath(const simulation::Truth& truth);

  FlightRecord record_;
  ConductRecorder conduct_;
  BehaviorRecorder behaviors_;
  EndingRecorder ending_;
  ContactRecorder contact_;
  std::vector<PhaseRecorder> phases_;
  std::vector<EventOrderRecorder> event_orders_;
  std::optional<common::Time> first_tick_;
  common::Time next_view_;
  std::vector<double> heights_world_m_;
  Eigen::Vector2d home_map_m_ = Eigen::Vector2d::Zero();
  std::uint64_t counted_intent_ = 0;
};

}  // namespace swiftlet::evaluation
