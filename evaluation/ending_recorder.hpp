// Records what led to the end of a flight: where the vehicle was and its charge when its mission last ran,
// which sensor failed around then, and who ordered it down. The verdict is judged from it.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/intent.hpp"
#include "common/time.hpp"
#include "simulation/truth.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::evaluation {

struct EndingRecord {
  bool flew = false;
  /// At the last tick in the air at which the mission ran; of a vehicle that never flew with its mission, the last tick
  /// of all.
  simulation::Truth then;
  double position_error_m = 0.0;               ///< Horizontal error of the estimate then.
  std::vector<Eigen::Vector3d> trail_world_m;  ///< True positions in the kTrail_s until then, kTrailPeriod_s apart.
  std::string faulty_sensor;                   ///< IMU or laser, if it failed within kAround_s of then; else empty.
  std::string order;                           ///< The order to end the flight that came around then; empty: no order.
  std::optional<Eigen::Vector2d> failed_goal_map_m;     ///< The goal that the mission asked for last, if it failed.
  std::vector<simulation::Actor> doors_at_failed_goal;  ///< The doors that were closed then.
  double charge_at_take_off = 1.0;
  double airborne_until_then_s = 0.0;

  /// docs/decisions/simulation.md#031.
  static constexpr double kTrail_s = 30.0;
  static constexpr double kTrailPeriod_s = 0.5;
  static constexpr double kAround_s = 5.0;  ///< Longer than any fault takes to end a mission.
};

/// Called by the FlightRecorder, whose functions have the same names. Calls come in the order of time.
class EndingRecorder {
 public:
  /// `position_error_m` is that of the newest estimate that was compared.
  void tick(const simulation::Truth& truth, double position_error_m);
  void intent(const common::Intent& intent, const common::IntentStatus& status);
  void world(const common::World& world);
  /// The operator or the pilot ends the flight.
  void order(common::Time now, std::string text);

  EndingRecord finish() const;

 private:
  void followTrail(const simulation::Truth& truth);

  EndingRecord record_;
  bool runs_ = false;  ///< By the last snapshot the mission runs, in flight.
  bool has_run_ = false;
  double airborne_s_ = 0.0;
  std::optional<simulation::Truth> last_;
  std::deque<std::pair<common::Time, Eigen::Vector3d>> trail_;
  std::optional<common::Time> faulty_at_, ordered_at_;
};

}  // namespace swiftlet::evaluation
