// What a run leaves: a folder that is readable at every moment of the flight, also after the process was killed.
//
//   mission.json     outcome, times, distance, phases, frontiers with reasons, figures; "flying" until the end
//   events.jsonl     every event as it happens
//   trajectory.tum   the estimate in `map`
//   trajectory_given.tum   where it was in the map it was given, if it was given one, while it knew
//   map.pgm, map.yaml, map.png    replaced whole every few seconds and at the end
//   report.html      the same in one page
//   config.yaml      the settings in force
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/event.hpp"
#include "common/vehicle_state.hpp"
#include "interfaces/flight_summary.hpp"
#include "interfaces/report/report.hpp"

namespace swiftlet::common {
struct World;
}

namespace swiftlet::interfaces {

/// Makes a folder of its own below `parent`: STARTED-MISSION, with a number where that is taken, also by a flight that
/// starts at the same moment. Characters that are no good in file names become `-`. Throws common::InputError.
std::filesystem::path freshRunFolder(const std::filesystem::path& parent, const std::string& started,
                                     const std::string& mission);

/// How the flight ended, as the caller knows it.
struct FlightEnd {
  Outcome outcome = Outcome::kDone;
  std::string reason;
  std::optional<double> coverage;
  std::vector<Figure> figures;
  std::optional<double> wall_time_s;
};

/// Used by one thread. Nothing throws after the constructor: what cannot be written (full disk) is kept in `failure`,
/// writing stops, and the caller decides; no file is left half written.
class RunFolder {
 public:
  /// Makes the folder. One that is there must be empty or an older run, whose files are removed first; anything else
  /// is refused, also a folder that another flight writes. Throws common::InputError that says why.
  RunFolder(std::filesystem::path path, RunInfo info, std::string config_yaml);
  ~RunFolder();
  RunFolder(RunFolder&&) noexcept;
  RunFolder& operator=(RunFolder&&) noexcept;

  /// At every estimate.
  void state(const common::VehicleState& state);
  /// At every event, in order.
  void event(const common::Event& event);
  /// At every snapshot.
  void world(const common::World& world);
  /// The pictures of the next report and map.png; may be given again and again.
  void show(ReportPictures pictures);
  /// The last map, mission.json and report, safe from a cut of the power. Called once, last; tries everything even if
  /// something failed before.
  void finish(const FlightEnd& end);

  const std::filesystem::path& path() const;
  /// What is known so far; after `finish` the whole flight.
  const FlightSummary& summary() const;
  /// Why something could not be written; none while all is well.
  const std::optional<std::string>& failure() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swiftlet::interfaces
