// From inputs to what is known: measurements that cannot be used are left out, scans that overtook each other are put
// in order, and the estimator makes states and maps of the rest.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "autonomy/arrivals/scan_queue.hpp"
#include "autonomy/arrivals/scan_watch.hpp"
#include "autonomy/arrivals/stamp_check.hpp"
#include "autonomy/energy/battery_check.hpp"
#include "autonomy/energy/energy_monitor.hpp"
#include "autonomy/estimator.hpp"
#include "autonomy/feedback.hpp"
#include "autonomy/given_map/given_map_overlay.hpp"
#include "autonomy/inertial/inertial_input.hpp"
#include "autonomy/percept.hpp"
#include "common/event_log.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"

namespace swiftlet::autonomy {

struct AutonomyConfig;
struct AutonomySetup;

/// One thread.
class Senses {
 public:
  Senses(const AutonomyConfig& config, const AutonomySetup& setup, common::EventLog& log);

  /// The percept before the first input. `standing`: of the vehicle that has not flown.
  Percept start(const Feedback& standing);
  /// What the last tick has flown, once, before the next input.
  void hear(const Feedback& feedback);
  /// Takes a measurement. False if its stamps are wrong, so that it must not be used.
  bool sense(const common::SensorEvent& event);
  /// What is known at a tick.
  Percept sense(common::Time now);

  const Estimator& estimator() const { return estimator_; }
  /// See Estimator::setFilterListener.
  void setFilterListener(perception::FilterListener* listener) { estimator_.setFilterListener(listener); }
  /// Scans that came after a later one had been used, and were left out.
  std::uint64_t lateScans() const { return scans_.lateScans(); }

 private:
  void take(const std::shared_ptr<const common::LaserScan>& scan);
  void take(const common::BatterySample& sample);
  std::vector<SeenScan> processScans(common::Time now);
  Percept percept(common::Time now);
  Surroundings surroundings(common::Time now, const common::VehicleState& state);

  double behavior_period_s_;
  common::EventLog& log_;
  Estimator estimator_;
  StampCheck stamps_;
  ScanQueue scans_;
  ScanWatch scan_watch_;
  InertialInput inertial_;
  GivenMapOverlay given_map_;
  BatteryCheck battery_check_;
  double battery_v_ = 0.0;  ///< Of the last good sample.
  EnergyMonitor consumption_;
  bool airborne_ = false;  ///< By the last feedback, as is the thrust margin.
  double thrust_margin_ = 0.0;
  std::vector<SeenFrame> frames_;               ///< Since the last tick.
  std::optional<common::Time> last_behaviors_;  ///< The last tick with the surroundings.
};

}  // namespace swiftlet::autonomy
