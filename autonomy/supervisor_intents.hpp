// The intents by which the supervisor flies the vehicle itself: hold, home, back along the trail, land.
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "autonomy/supervisor.hpp"
#include "common/intent.hpp"
#include "common/time.hpp"
#include "common/world.hpp"

namespace swiftlet::autonomy {

/// What the intents depend on, at one tick of the behaviours.
struct SupervisedFlight {
  common::Time now;
  const common::World& world;
  const common::Intent& present;       ///< The intent since the last tick.
  const common::IntentStatus& status;  ///< Of that intent.
  bool home_planned = false;           ///< Whether a path home is known.
};

/// One thread.
class SupervisorIntents {
 public:
  /// `clearance_m` is that of the flight home.
  explicit SupervisorIntents(double clearance_m) : clearance_m_(clearance_m) {}

  static common::Intent hold();
  static common::Intent land();

  /// The unknown place that the vehicle explores now; it matters to a flight back that begins later.
  void remember(const Eigen::Vector2d& wanted_to_see_map_m) { wanted_to_see_map_m_ = wanted_to_see_map_m; }
  void forget() { wanted_to_see_map_m_.reset(); }

  /// The requested flight; nullopt while the mission flies, or while it still has to release the vehicle. Tells
  /// the supervisor when a flight has ended. Call it while airborne.
  std::optional<common::Intent> flight(const Supervision& asked, const SupervisedFlight& flight,
                                       Supervisor& supervisor);

 private:
  common::Intent home(unsigned count, const SupervisedFlight& flight, Supervisor& supervisor) const;
  common::Intent back(std::uint64_t id, const SupervisedFlight& flight, Supervisor& supervisor);

  double clearance_m_;
  /// The unknown place that was explored when the supervisor began to hold the mission.
  std::optional<Eigen::Vector2d> wanted_to_see_map_m_;
  /// The newest flight back. It keeps its path: after an interruption the trail contains the flight back, too.
  common::Intent back_;
};

}  // namespace swiftlet::autonomy
