// Records the first contact that a flight did not mean: the hull with anything, or the feet with a floor while the
// vehicle, as its autonomy published, was flying. The verdict is judged from it.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/intent.hpp"
#include "common/time.hpp"
#include "common/world/flight_state.hpp"
#include "evaluation/contact_replay.hpp"
#include "simulation/truth.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::evaluation {

struct ContactRecord {
  std::string what;                           ///< In words.
  simulation::Truth truth;                    ///< At its first instant.
  common::FlightState flight = {};            ///< As the autonomy had published last.
  bool motors_off = false;                    ///< By the last setpoint.
  double charge_before = 1.0;                 ///< kLanding_s before it, or at the take-off if that was later.
  int lost_cells_before = 0;                  ///< At the same time.
  double take_off_height_m = 0.0;             ///< Of the body over the floor, as last requested; 0: no take-off was.
  Eigen::Vector3d stood_world_m = {0, 0, 0};  ///< The body, where the vehicle last stood as it meant to.
  ContactReplay replay;                       ///< Of the kBefore_s before it.
  double floor_s = 0.0;                       ///< How long it stood with motors on where it had meant to fly.

  static constexpr double kLanding_s =
      10.0;  ///< A descent from two metres, and the time to begin it; docs/decisions/simulation.md#031.
};

/// Called by the FlightRecorder, whose functions have the same names. Calls come in the order of time.
class ContactRecorder {
 public:
  /// Call before tick(): whether the setpoint has the motors on.
  void motors(bool on) { motors_on_ = on; }
  /// Call before tick(): the true places of the people, the same people at each tick.
  void people(std::vector<Eigen::Vector2d> people_world_m) { people_world_m_ = std::move(people_world_m); }
  void tick(const simulation::Truth& truth);
  void intent(const common::Intent& intent);
  void world(const common::World& world);

  /// The motors are off, or a pilot has them.
  bool motorsOff() const { return !motors_on_ || piloted_; }
  std::optional<ContactRecord> finish() const;

 private:
  bool mayStand() const;
  void followCharge(const simulation::Truth& truth);
  void followMotion(const simulation::Truth& truth);
  void begin(const simulation::Truth& truth, std::string what);

  ContactRecord next_;  ///< What a contact at the next tick takes over.
  std::optional<ContactRecord> contact_;
  common::FlightState flight_ = common::FlightState::kPreparation;
  bool motors_on_ = false;
  bool piloted_ = false;   ///< A pilot may stand wherever the sticks say.
  bool lifted_ = false;    ///< It has left the floor since it last stood as it meant to.
  bool on_floor_ = false;  ///< It came to stand where it meant to fly, and its motors are on since.
  struct Charge {
    common::Time stamp;
    double remaining;
    int lost_cells;
  };
  std::deque<Charge> charges_;     ///< Of the last kLanding_s in the air.
  std::deque<ReplayTick> motion_;  ///< Of the last ContactReplay::kBefore_s.
  std::vector<Eigen::Vector2d> people_world_m_;
  common::Time last_tick_;
};

}  // namespace swiftlet::evaluation
