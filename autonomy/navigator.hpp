// Flies an intent: planning and maneuvers at the behaviours' rate, braking and retreat at the laser's under every
// intent, the controller at each tick.
//
//   Percept --> Reactive --speed limit, retreat--+
//                                                v
//   Intent --> Executor --path, velocity--> FlightController --> Setpoint
//                     PilotAssist ---------------^
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "autonomy/camera_obstacles.hpp"
#include "autonomy/decision.hpp"
#include "autonomy/executor.hpp"
#include "autonomy/feedback.hpp"
#include "autonomy/percept.hpp"
#include "autonomy/pilot_assist.hpp"
#include "autonomy/reactive.hpp"
#include "autonomy/readiness.hpp"
#include "autonomy/requests/keep_out_zones.hpp"
#include "autonomy/vehicle_memory.hpp"
#include "common/event_log.hpp"
#include "common/hysteresis.hpp"
#include "common/rgbd_camera_config.hpp"
#include "common/time.hpp"
#include "common/vehicle.hpp"
#include "common/vehicle_config.hpp"
#include "common/world/vehicle_layer.hpp"
#include "control/flight_controller.hpp"

namespace swiftlet::autonomy {

struct AutonomyConfig;
struct AutonomySetup;

/// One thread. Outlives the jobs it submits.
class Navigator {
 public:
  Navigator(const AutonomyConfig& config, const AutonomySetup& setup, common::EventLog& log);

  void pilotArrived(const common::PilotSample& sample) { assist_.pilotArrived(sample); }
  /// Fails, with the reason, for a controller that there is not, or that lacks its model.
  tl::expected<void, std::string> switchController(std::string_view name);

  /// Brakes and retreats by the scans of this tick. To be called before `fly`.
  void react(const Percept& percept, const KeepOutZones& keep_out);
  /// The setpoint of this tick.
  common::Setpoint fly(const Decision& decision, const Percept& percept, const KeepOutZones& keep_out);
  /// What the last tick has flown; before the first one the vehicle stands.
  const Feedback& feedback() const { return flown_; }

  const Executor& executor() const { return executor_; }
  const control::FlightController& controller() const { return controller_; }
  const planning::AvoidanceDecision& avoidance() const { return reactive_.decision(); }
  /// The end points of the last scan; null before it.
  const std::shared_ptr<const common::LaserPoints>& laserPoints() const { return laser_points_; }
  /// The mission may begin: the vehicle knows its height and position.
  bool prepared() const { return readiness_.prepared(); }
  /// False before there is a map.
  bool knowsWallsAround(const common::VehicleState& state) const;
  /// The reference of the controller; nullopt unless the vehicle flies.
  std::optional<Eigen::Vector3d> reference_odom_m() const;
  /// Height over the take-off floor of the slice of the map that is shown.
  double mapHeight_m() const { return map_height_m_; }

 private:
  /// A take-off right after a landing should not find the motors off.
  static constexpr double kUntilRest_s = 1.0;
  void carryOut(const Decision& decision, const Percept& percept, const KeepOutZones& keep_out);
  void updateCameraObstacles(const Percept& percept);
  const CameraObstacles& obstaclesOfCamera() const {
    return executor_.dip_m() != 0.0 ? obstacles_here_ : camera_obstacles_;
  }
  void restMotors(const Decision& decision, common::Time now);
  control::FlightTick flightTick(const Decision& decision, const Percept& percept) const;
  void assistPilot(const Decision& decision, control::FlightTick& flight);
  void followMapHeight(double height_m);
  InertialContext inertialContext(const control::FlightTick& flight, const common::Setpoint& setpoint) const;

  std::optional<common::RgbdCameraConfig> camera_;  ///< nullopt without a camera.
  control::FlightController controller_;
  Executor executor_;
  Reactive reactive_;
  CameraObstacles camera_obstacles_;
  CameraObstacles obstacles_here_;  ///< At the height of the vehicle while that is not the height of flight.
  PilotAssist assist_;
  bool assisted_ = false;  ///< At the last tick.
  Readiness readiness_;
  common::Hysteresis rests_{kUntilRest_s};  ///< Standing with the motors on, and no take-off wanted.
  double map_height_m_ = 0.0;
  std::shared_ptr<const common::LaserPoints> laser_points_;
  Feedback flown_;  ///< Of the last tick.
};

}  // namespace swiftlet::autonomy
