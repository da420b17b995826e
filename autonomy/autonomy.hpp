// The whole autonomy: takes one stamped event at a time and returns setpoints. This is the picture of
// docs/architecture.md as code.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/estimator.hpp"
#include "autonomy/executor.hpp"
#include "autonomy/reactive.hpp"
#include "autonomy/supervisor.hpp"
#include "behaviors/mission.hpp"
#include "common/command.hpp"
#include "common/config_fwd.hpp"
#include "common/event.hpp"
#include "common/jobs.hpp"
#include "common/sensor_event.hpp"
#include "common/vehicle.hpp"
#include "common/vehicle_config.hpp"
#include "common/world.hpp"
#include "control/flight_controller.hpp"

namespace swiftlet::autonomy {

/// Everything one may choose; a system profile (config/systems) is one of these.
struct AutonomyConfig {
  EstimatorConfig estimator;
  ReactiveConfig reactive;
  ExecutorConfig execution;
  control::FlightController::Config control;
  SupervisorConfig supervisor;
  double behavior_rate_hz = 20.0;
  double scan_latency_s = 0.004;
  double max_height_m = 10.0;

  void describe(common::config::Fields& fields);
  std::vector<std::string> validate() const;
  /// What would stop the vehicle, or make it retreat, on a path planned at this clearance; empty when nothing would.
  std::vector<std::string> problemsWith(double clearance_m) const;
};

/// One thread. Every call is for a time not before that of the last one.
class Autonomy {
 public:
  /// `given`: a map of the place, to find itself in; none: null. Read in the constructor alone.
  Autonomy(const AutonomyConfig& config, const common::VehicleConfig& vehicle, const common::LaserConfig& laser,
           behaviors::Mission mission, std::unique_ptr<common::JobRunner> jobs, const GivenMap* given = nullptr);
  ~Autonomy();

  void process(const common::SensorEvent& event);
  void process(const common::OperatorCommand& command, common::Time now);
  /// The 100 Hz timer: delivers what is due, ticks the behaviours when it is their time, and returns the setpoint.
  common::Setpoint tick(common::Time now);

  /// The newest snapshot; never null.
  std::shared_ptr<const common::World> world() const { return world_; }
  /// The mission has ended and the vehicle stands with its motors off.
  bool finished() const;
  const common::MissionStatus& missionStatus() const { return mission_status_; }
  /// The end came by the operator's Land, not by the mission.
  bool landedByOperator() const { return supervisor_.landedByOperator(); }
  common::VehicleState state() const { return estimator_.state(); }
  /// What is carried out since the last tick of the behaviours, and how it stands.
  const common::Intent& intent() const { return wish_; }
  const common::IntentStatus& intentStatus() const { return executor_.status(); }

  std::vector<common::Event> takeEvents();
  std::vector<common::CommandResult> takeResults();

 private:
  void processDueScans(common::Time now);
  void processScan(const common::LaserScan& scan, common::Time now);
  void prepare();
  void tickBehaviors(common::Time now);
  common::Intent wishOf(common::Time now);
  bool missionOver() const { return common::isOver(mission_status_.state); }
  void tickMission();
  void takeSnapshot(common::Time now);
  void collect(std::vector<common::Event> events);

  AutonomyConfig config_;
  common::VehicleConfig vehicle_;
  // Delivered results refer to the parts below, so the jobs go first when the autonomy ends.
  Estimator estimator_;
  Reactive reactive_;
  control::FlightController controller_;
  Executor executor_;
  Supervisor supervisor_;
  behaviors::Mission mission_;
  std::unique_ptr<common::JobRunner> jobs_;

  struct WaitingScan {
    std::shared_ptr<const common::LaserScan> scan;
    common::Time due;
  };
  std::vector<WaitingScan> scans_;
  common::VehicleStatus status_;
  std::optional<control::RawHeight> raw_height_;
  std::shared_ptr<const common::LaserPoints> laser_points_;

  behaviors::Context context_;
  common::Intent wish_;
  common::MissionStatus mission_status_;
  bool lets_go_ = false;  ///< It was landed from above, and has not stopped yet.
  bool prepared_ = false;
  std::optional<common::Time> last_behaviors_;

  std::shared_ptr<std::vector<Eigen::Vector2d>> trail_;
  std::optional<Eigen::Vector2d> last_position_odom_m_;
  std::shared_ptr<const common::World> world_;
  std::vector<common::Event> events_;
  std::vector<common::CommandResult> results_;
};

}  // namespace swiftlet::autonomy
