// Records how a vehicle was flown: its tilts and touch-downs, its charge, its answers to faults, and the lateness of
// its laser.
#pragma once

#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "common/intent.hpp"
#include "common/sensor_event.hpp"
#include "common/time.hpp"
#include "simulation/truth.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::evaluation {

struct ConductRecord {
  /// The charge for a flight home and its landing, as shares of the full battery.
  struct HomeEnergy {
    double predicted = 0.0;  ///< By the vehicle, when the flight home began.
    double needed = 0.0;     ///< By the truth, from then until it stood again.
  };

  double airborne_s = 0.0;
  double tilted_s = 0.0;      ///< Part of airborne_s with more than kTilted_rad between the body's z axis and upright.
  double tilt_max_rad = 0.0;  ///< Greatest tilt while airborne.
  std::optional<double> touch_down_speed_m_s;  ///< Greatest speed of descent at a touch-down; nullopt without one.
  std::optional<double> charge_min;            ///< Least true charge while airborne; nullopt if it never flew.
  int lost_cells = 0;                          ///< Of the battery, while airborne.
  /// Longest time from the begin of a fault to the first snapshot in which the vehicle holds, lands or stands; nullopt
  /// without a fault, and infinite if it did none of these.
  std::optional<double> safe_action_s;
  std::optional<HomeEnergy> home_energy;  ///< Of the last flight home that arrived and ended on the ground.
  std::vector<double> laser_latencies_s;  ///< From the first beam, by the laser's stamp, to the arrival.

  /// The bound that the criterion `tilted_share_max` names.
  static constexpr double kTilted_rad = 10.0 * common::kRadPerDeg;
};

/// Called by the FlightRecorder, whose functions have the same names. Calls come in the order of time.
class ConductRecorder {
 public:
  void scan(const common::Stamps& stamps) { record_.laser_latencies_s.push_back(latency_s(stamps)); }
  void tick(const simulation::Truth& truth);
  /// `home` tells whether the intent is a flight to the take-off place.
  void intent(const common::Intent& intent, const common::IntentStatus& status, bool home);
  void world(const common::World& world);

  ConductRecord finish() const;

 private:
  static double latency_s(const common::Stamps& stamps) { return (stamps.arrived - stamps.measured).seconds(); }
  void followFault();
  void followHome(bool touched_down);

  /// A flight home under way.
  struct FlightHome {
    std::uint64_t intent = 0;
    std::optional<double> predicted;
    double charge_at_begin = 0.0;
    bool arrived = false;
  };

  ConductRecord record_;
  std::optional<simulation::Truth> last_;
  std::optional<common::Time> fault_begin_;  ///< Of the fault that is not answered yet.
  bool safe_ = false;                        ///< By the last snapshot the vehicle holds or lands.
  std::optional<double> home_share_;         ///< Of the last snapshot.
  std::optional<FlightHome> home_;
};

}  // namespace swiftlet::evaluation
