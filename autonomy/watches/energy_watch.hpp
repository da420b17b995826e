// Watches charge and thrust: reports 30 and 20 %, turns back while the charge suffices for the flight home, and lands
// before charge or thrust are too low. Before the take-off it refuses flights that would end so at once.
#pragma once

#include <optional>
#include <string>

#include "autonomy/watches/supervisor_config.hpp"
#include "autonomy/watches/watch_request.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

/// One thread. On the ground it requests nothing.
class EnergyWatch {
 public:
  explicit EnergyWatch(const SupervisorConfig& config) : config_(config) {}

  /// It requests a flight home at one tick only, and only once.
  WatchRequest watch(common::Time now, const VehicleCondition& condition);
  /// Why the vehicle must not take off, with the figure; empty if it may.
  std::string takeOffRefusal(const common::EnergyLayer& energy) const;

 private:
  void tellGauge(common::Time now, const std::string& counted_on, WatchRequest& request);
  void tellCharge(common::Time now, const common::EnergyLayer& energy, WatchRequest& request);
  void watchHome(common::Time now, const common::EnergyLayer& energy, WatchRequest& request);
  void watchReach(common::Time now, const common::EnergyLayer& energy, WatchRequest& request);
  void watchThrust(common::Time now, const VehicleCondition& condition, WatchRequest& request);

  SupervisorConfig config_;
  double charge_said_ = 1.0;                ///< The charge in the last event of this flight.
  std::optional<common::Time> weak_since_;  ///< Since when the thrust margin has been too small.
  bool counted_on_said_ = false;
  bool turned_back_ = false;
  bool out_of_reach_said_ = false;
};

}  // namespace swiftlet::autonomy
