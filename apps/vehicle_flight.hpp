// One vehicle of a simulated flight, from its first tick to its last file: the vehicle in the arena, its autonomy, the
// loop between them and the sinks beside it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/flight_setup.hpp"
#include "apps/memory_watch.hpp"
#include "apps/timed_jobs.hpp"
#include "apps/vehicle_flight_record.hpp"
#include "autonomy/autonomy.hpp"
#include "autonomy/loop/flight_loop.hpp"
#include "common/mailbox.hpp"

namespace swiftlet::simulation {
class Arena;
}

namespace swiftlet::apps {

class WebChannel;

/// One thread. Refers to the setup and the hooks, which must outlive it.
class VehicleFlight {
 public:
  /// Vehicle number `number` of the arena, whose run lies in `folder`. Throws common::InputError for a folder that
  /// cannot be used.
  VehicleFlight(const FlightSetup& setup, const FlightHooks& hooks, const std::shared_ptr<simulation::Arena>& arena,
                std::size_t number, FlightMission mission, const std::filesystem::path& folder);
  ~VehicleFlight();
  VehicleFlight(const VehicleFlight&) = delete;
  VehicleFlight& operator=(const VehicleFlight&) = delete;

  /// Reports what was skipped or replaced in the world, to every sink.
  void reportWarnings();
  void step(common::Time now);
  /// Its mission has ended, it has crashed, or something ends it from outside.
  bool over();
  /// Writes the last files and leaves the arena, where the vehicle stays as it is; once, when it is over.
  void finish(double wall_s, MemoryWatch& memory);
  bool finished() const { return vehicle_ == nullptr; }

  std::shared_ptr<const common::World> world() const { return autonomy_.world(); }
  /// After finish().
  VehicleResult result() const;

 private:
  VehicleFlightRecord::Observers observers(std::size_t number);
  void tell(common::Severity severity, std::string source, std::string text, std::string reason,
            common::Concern concern = common::Concern::kNone);
  common::LosslessQueue<common::OperatorCommand>& commands();
  void landIfAsked();
  void warnOfUnwrittenFiles();
  common::MachineUse machineUse(MemoryWatch& memory) const;
  bool cameToRest();
  bool end(interfaces::Outcome outcome, std::string reason);
  void showEnd() const;

  const FlightSetup& setup_;
  const FlightHooks& hooks_;
  WebChannel* web_;  ///< Null without a page.
  std::unique_ptr<simulation::SimulatedVehicle> vehicle_;
  evaluation::OperatorScript script_;
  std::shared_ptr<JobMeter> job_meter_ = std::make_shared<JobMeter>();
  autonomy::Autonomy autonomy_;
  VehicleFlightRecord record_;
  common::LosslessQueue<common::OperatorCommand> own_commands_;  ///< Where there is no page.
  autonomy::FlightLoop loop_;
  std::optional<common::Time> motors_off_since_;  ///< When the autonomy was found to have finished.
  bool asked_to_land_ = false;
  bool warned_of_unwritten_files_ = false;
  interfaces::FlightEnd end_;
};

}  // namespace swiftlet::apps
