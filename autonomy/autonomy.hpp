// The whole autonomy: takes one stamped input at a time and returns setpoints. It is the data flow of
// docs/architecture.md in code.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/arrivals/scan_queue.hpp"
#include "autonomy/arrivals/scan_watch.hpp"
#include "autonomy/arrivals/stamp_check.hpp"
#include "autonomy/camera_obstacles.hpp"
#include "autonomy/energy/energy_monitor.hpp"
#include "autonomy/estimator.hpp"
#include "autonomy/executor.hpp"
#include "autonomy/given_map/given_map_overlay.hpp"
#include "autonomy/inertial/inertial_input.hpp"
#include "autonomy/input.hpp"
#include "autonomy/map_shelf.hpp"
#include "autonomy/mission_desk.hpp"
#include "autonomy/pilot_assist.hpp"
#include "autonomy/reactive.hpp"
#include "autonomy/requests/flight_requests.hpp"
#include "autonomy/supervisor.hpp"
#include "autonomy/supervisor_intents.hpp"
#include "autonomy/vehicle_memory.hpp"
#include "autonomy/world_builder.hpp"
#include "behaviors/mission.hpp"
#include "common/command.hpp"
#include "common/config_fwd.hpp"
#include "common/event.hpp"
#include "common/jobs.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/sensor_event.hpp"
#include "common/vehicle.hpp"
#include "common/vehicle_config.hpp"
#include "common/world.hpp"
#include "control/flight_controller.hpp"

namespace swiftlet::autonomy {

/// All settings of the autonomy, read from a system profile (config/systems).
struct AutonomyConfig {
  EstimatorConfig estimator;
  ReactiveConfig reactive;
  ExecutorConfig execution;
  control::FlightController::Config control;
  SupervisorConfig supervisor;
  EnergyConfig energy;
  static constexpr double behavior_rate_hz = 20.0;  ///< Ticks of the mission's tree a second.
  ScanQueueConfig scans;
  InertialInputConfig inertial;  ///< Its sections are on the level of these.
  PilotAssistConfig assist;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
  /// Lowers the fields of view and ranges that avoidance and exploration use to those of the laser.
  void limitTo(const common::LaserConfig& laser);
  /// Why the reactive layer would stop the vehicle, or make it retreat, on a path planned at this clearance; empty if
  /// it would not.
  std::vector<std::string> problemsWith(double clearance_m) const;
};

/// What an autonomy is made of. Whatever the pointers name is read only while the autonomy is made, and may go then.
struct AutonomySetup {
  AutonomyConfig config = {};
  common::VehicleConfig vehicle;  ///< Data sheet of the vehicle, as its owner believes it to be.
  common::LaserConfig laser;      ///< Data sheet of the level laser.
  behaviors::Mission mission;     ///< The first one; the operator may start others in its place.
  /// Never null. Who runs the jobs, and with that the clock by which they are delivered (common/jobs.hpp).
  std::unique_ptr<common::JobRunner> jobs;
  const GivenMap* given = nullptr;  ///< A map to localize in; null: none is given.
  /// Appears in the snapshots and in the events of the loop; empty if there is only one vehicle.
  std::string vehicle_name = {};
  const VehicleMemory* memory = nullptr;  ///< What earlier flights of the vehicle have learned; null: nothing.
  const common::RgbdCameraConfig* camera = nullptr;  ///< Data sheet of an RGB-D camera; null without one.
  const control::VehicleModel* model = nullptr;      ///< What was identified of the vehicle; null: nothing was.
  /// Data sheet of a second laser, whose scan plane stands upright; null without one.
  const common::LaserConfig* vertical_laser = nullptr;
};

/// One thread. The outputs depend only on the inputs and their order. The time of an input is never before that of the
/// previous one.
class Autonomy {
 public:
  explicit Autonomy(AutonomySetup setup);
  ~Autonomy();

  /// The mission begins when the operator starts it, or another one. Call it before the first input.
  void waitForStart() { missions_.waitForStart(); }

  /// The maps that the first mission may load; every other one brings its own. Call it before the first input.
  void offerMaps(std::vector<OfferedMap> maps) { map_shelf_.offer(std::move(maps)); }

  /// Returns a setpoint for a tick, and nothing for any other input. The delivered job must be outstanding (awaits).
  std::optional<common::Setpoint> process(const Input& input);

  /// The next job that is due at or before `now`, if there is one. Call it before each input with that time.
  std::optional<common::JobDelivery> dueDelivery(common::Time now) const { return jobs_->nextDue(now); }
  /// False if the job was never submitted or has been delivered already. Then the inputs are not those of a flight of
  /// this autonomy.
  bool awaits(const common::JobDelivery& delivery) const { return jobs_->awaits(delivery); }
  std::vector<common::JobTimes> jobTimes() const { return jobs_->times(); }

  /// The newest snapshot; never null.
  std::shared_ptr<const common::World> world() const { return world_; }
  /// True when the mission has ended and the vehicle stands with its motors off.
  bool finished() const;
  const std::string& vehicleName() const { return vehicle_name_; }
  const common::MissionStatus& missionStatus() const { return mission_status_; }
  /// True if the mission ended by the operator's land command.
  bool landedByOperator() const { return supervisor_.landedByOperator(); }
  common::VehicleState state() const { return estimator_.state(); }
  /// Where the controller wants the vehicle; none unless it flies.
  std::optional<Eigen::Vector3d> reference_odom_m() const;
  /// Height over the take-off floor of the slice of the map that is shown.
  double mapHeight_m() const { return map_height_m_; }
  /// Scans that came after a later one had been used, and were left out.
  std::uint64_t lateScans() const { return scans_.lateScans(); }
  /// What is known of the vehicle now: what it was given, and what the flight has learned.
  VehicleMemory learned() const;
  /// Counts of the matches of the laser odometry and of the work of the SLAM method.
  const perception::LaserOdometryCounts& odometryCounts() const { return estimator_.odometryCounts(); }
  const perception::SlamCounts& slamCounts() const { return estimator_.slamCounts(); }
  /// Of the frames of the RGB-D camera; none without one.
  std::optional<RgbdCounts> cameraCounts() const { return estimator_.cameraCounts(); }
  /// Of the radio between camera and computer; none without one.
  std::optional<mapping3d::RadioCounts> radioCounts() const { return estimator_.radioCounts(); }
  /// The planner and the explorer in use, with the number of their results.
  const PlanningUse& planningUse() const { return executor_.desk().use(); }
  /// The intent since the last tick of the behaviours.
  const common::Intent& intent() const { return intent_; }
  /// The status of that intent.
  const common::IntentStatus& intentStatus() const { return executor_.status(); }

  std::vector<common::Event> takeEvents();
  std::vector<common::CommandResult> takeResults();
  /// What the mission asked to be written since the last call.
  std::vector<RunFile> takeFiles() { return requests_.takeFiles(); }
  /// See Estimator::setFilterListener.
  void setFilterListener(perception::FilterListener* listener) { estimator_.setFilterListener(listener); }

 private:
  void take(const common::SensorEvent& event);
  void take(const std::shared_ptr<const common::LaserScan>& scan);
  void take(const common::OperatorCommand& command, common::Time now);
  std::string resolvePlaces(common::OperatorCommand& command) const;
  std::optional<common::CommandResult> takeMission(const common::OperatorCommand& command);
  common::CommandResult switchController(std::uint64_t id, const common::ControllerCommand& command);
  void answer(const common::OperatorCommand& command, common::CommandResult result, common::Time now);
  common::Setpoint tick(common::Time now);
  void assistPilot(control::FlightTick& flight);
  void processDueScans(common::Time now);
  void processScan(const common::LaserScan& scan, common::Time now);
  void followMapHeight(double height_m);
  void tellInertialInput(const common::Setpoint& setpoint, bool thrust_applies);
  void prepare(common::Time now);
  void tellUnprepared(common::Time now);
  void restMotors(common::Time now);
  void tickBehaviors(common::Time now);
  void updateCameraObstacles();
  const CameraObstacles& obstaclesOfCamera() const {
    return executor_.dip_m() > 0.0 ? lower_obstacles_ : camera_obstacles_;
  }
  common::Intent nextIntent(common::Time now);
  common::Intent chooseIntent(const Supervision& supervision, common::Time now);
  void tellWhoFlies(const Supervision& supervision, const common::Intent& intent);
  bool waitsToTakeOff(const Supervision& supervision) const;
  void fillContext(const Supervision& supervision, common::Time now);
  void endMission(const std::string& reason, common::Time now);
  VehicleCondition condition(common::Time now) const;
  bool missionOver() const { return common::isOver(mission_status_.state); }
  void tickMission();
  void followMission();
  void takeSnapshot(common::Time now);
  void showWaiting(common::MissionLayer& layer) const;
  void collect(std::vector<common::Event> events);

  AutonomyConfig config_;
  common::VehicleConfig vehicle_;
  std::string vehicle_name_;
  std::optional<common::RgbdCameraConfig> camera_;  ///< None without one.
  // The results of jobs refer to these members. jobs_ follows them, so that it is destroyed first.
  Estimator estimator_;
  Reactive reactive_;
  control::FlightController controller_;
  Executor executor_;
  Supervisor supervisor_;
  SupervisorIntents supervisor_intents_;
  FlightRequests requests_;
  MapShelf map_shelf_;
  MissionDesk missions_;
  std::unique_ptr<common::JobRunner> jobs_;

  StampCheck stamps_;
  ScanQueue scans_;
  ScanWatch scan_watch_;
  InertialInput inertial_;
  GivenMapOverlay given_map_;
  CameraObstacles camera_obstacles_;
  CameraObstacles lower_obstacles_;  ///< At the height of the vehicle while that is below the height of flight.
  PilotAssist assist_;
  bool assisted_ = false;  ///< At the last tick.
  double last_thrust_ = 0.0;
  EnergyMonitor energy_monitor_;
  common::EnergyLayer energy_;  ///< Of the last tick of the behaviours.
  double battery_v_ = 0.0;
  std::optional<control::RawHeight> raw_height_;
  double drift_m_ = 0.0;  ///< Of the last scan.
  std::shared_ptr<const common::LaserPoints> laser_points_;

  behaviors::Context context_;
  common::Intent intent_;
  common::MissionStatus mission_status_;
  bool releasing_mission_ = false;  ///< The supervisor lands the vehicle, and the mission has not released it yet.
  bool prepared_ = false;
  std::optional<common::Time> unprepared_since_;
  bool unprepared_said_ = false;
  std::optional<common::Time> stands_since_;  ///< Since when it has stood with the motors on; none: it does not.
  double map_height_m_ = 0.0;
  std::optional<common::Time> last_behaviors_;

  WorldBuilder world_builder_;
  std::shared_ptr<const common::World> world_;
  std::vector<common::Event> events_;
  std::vector<common::CommandResult> results_;
};

}  // namespace swiftlet::autonomy
