// One vehicle's flight from its first tick to its last file: its autonomy, the loop between both, the run folder and
// its observers. Whether the vehicle is real or simulated, and how fast its time passes, is up to the caller.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "autonomy/autonomy.hpp"
#include "autonomy/loop/flight_loop.hpp"
#include "common/mailbox.hpp"
#include "flight/flight_setup.hpp"
#include "flight/memory_watch.hpp"
#include "flight/run_record.hpp"
#include "flight/timed_jobs.hpp"

namespace swiftlet::flight {

class GrootLink;
class MotionReference;
class WebChannel;

/// A vehicle, and what belongs to it alone.
struct FlownVehicle {
  common::Vehicle& vehicle;
  std::filesystem::path folder;  ///< Of its run.
  /// Name of the vehicle, seed (also of the particles in the given map), world and nature; the flight adds the rest.
  interfaces::RunInfo info = {};
  WebChannel* web = nullptr;                      ///< Null without a page.
  GrootLink* groot = nullptr;                     ///< Null without Groot.
  std::vector<autonomy::FlightSink*> sinks = {};  ///< They hear of everything before the run folder does.
  const MotionReference* reference = nullptr;     ///< Null where it is not known how the vehicle really moves.
  /// What it means that the vehicle sends nothing more.
  interfaces::Outcome when_silent = interfaces::Outcome::kFailed;
};

/// One thread. Refers to the setup, the hooks and what `flown` points to; the vehicle and the reference may end once
/// the flight is finished.
class VehicleFlight {
 public:
  /// Throws common::InputError for a folder that cannot be used.
  VehicleFlight(const FlightSetup& setup, const FlightHooks& hooks, FlownVehicle flown, FlightMission mission,
                std::unique_ptr<common::JobRunner> jobs);
  ~VehicleFlight();
  VehicleFlight(const VehicleFlight&) = delete;
  VehicleFlight& operator=(const VehicleFlight&) = delete;

  /// An event of the program around the flight, for every sink.
  void tell(common::Severity severity, std::string source, std::string text, std::string reason,
            common::Concern concern = common::Concern::kNone);
  /// The operator's, from the page or elsewhere. Any thread may push.
  common::LosslessQueue<common::OperatorCommand>& commands();

  /// Tells what the flight starts from; once, before the first step.
  void begin();
  /// See FlightLoop::step.
  void step(common::Time now);
  /// The time of the last step.
  common::Time now() const { return loop_.now(); }
  /// Ends it from outside, unless it is over.
  void end(interfaces::Outcome outcome, std::string reason);
  /// The autonomy has switched the motors off for good.
  bool finished() const { return autonomy_.finished(); }
  /// Its mission has ended and it is at rest, it sends nothing more, or something ends it from outside.
  bool over();
  /// Writes the last files and shows the end on the page; once, when it is over. `add` may add to the end before.
  void finish(double wall_s, MemoryWatch& memory, const std::function<void(interfaces::FlightEnd&)>& add = {});

  std::shared_ptr<const common::World> world() const { return autonomy_.world(); }
  /// After finish().
  VehicleResult result() const;

 private:
  std::vector<autonomy::FlightSink*> sinks();
  void landIfAsked();
  void warnOfUnwrittenFiles();
  common::MachineUse machineUse(MemoryWatch& memory) const;
  bool cameToRest();
  void showEnd() const;

  const FlightSetup& setup_;
  const FlightHooks& hooks_;
  FlownVehicle flown_;
  std::shared_ptr<JobMeter> job_meter_ = std::make_shared<JobMeter>();
  autonomy::Autonomy autonomy_;
  RunRecord record_;
  std::vector<std::unique_ptr<autonomy::FlightSink>> watchers_;
  common::LosslessQueue<common::OperatorCommand> own_commands_;  ///< Where there is no page.
  autonomy::FlightLoop loop_;
  common::Time begin_;
  std::optional<common::Time> motors_off_since_;  ///< When the autonomy was found to have finished.
  bool asked_to_land_ = false;
  bool warned_of_unwritten_files_ = false;
  interfaces::FlightEnd end_;
};

}  // namespace swiftlet::flight
