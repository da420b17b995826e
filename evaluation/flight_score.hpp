// The figures of one flight, and which of them are not good enough.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/machine_use.hpp"
#include "evaluation/flight_recorder.hpp"
#include "evaluation/marker_errors.hpp"
#include "evaluation/verdict.hpp"

namespace swiftlet::evaluation {

struct FlightScore {
  std::int64_t seed = 0;
  std::string vehicle;  ///< Name of the vehicle among several that flew together; empty: it flew alone.
  std::string folder;   ///< Of the run, relative to the trial's; set by the caller.
  std::string outcome;  ///< "done", or why not.
  bool mission_done = false;
  Verdict verdict = Verdict::kUnfinished;
  std::string verdict_reason;  ///< Reason by the truth, with figures.

  int collisions = 0;
  int avoidable_collisions = 0;  ///< Collisions that were not forced.
  int glass_contacts = 0;        ///< Collisions with glass that had never returned a beam.
  std::string collision;         ///< What was touched; empty if nothing was.
  std::string coverage_problem;  ///< Why there is no coverage: the world is not closed.
  /// Of each exploration that ended as a success: whether all that is reachable was seen, or what is left.
  std::vector<std::string> certificates;
  std::vector<MarkerVisit> visits;  ///< Every goal that was reached.
  int interruptions = 0;
  int resumed = 0;
  std::vector<PhaseScore> phases;
  std::vector<EventOrderScore> event_orders;
  std::vector<OperatorAnswer> operator_answers;
  common::MachineUse machine;

  /// Every criterion that was missed, with figure and bound. A forced collision is not among them.
  std::vector<std::string> failures;
  /// No flight passes that ended in a collision, whoever is to blame for it.
  bool passed() const { return failures.empty() && collisions == 0; }
  /// "7", or "7 beta" of several vehicles.
  std::string name() const { return std::to_string(seed) + (vehicle.empty() ? "" : " ") + vehicle; }
  /// "collision (struck): touched `walker_0`", of a flight that ended in one.
  std::string collisionText() const;

  /// Sets a figure by its name in flightFigures(), where it must exist and not follow from others.
  std::optional<double>& operator[](std::string_view name);
  /// The figure of that name, which must exist; nullopt if it was not measured: no goal was reached, for instance.
  std::optional<double> figure(std::string_view name) const;

  std::map<std::string, std::optional<double>, std::less<>> measured = {};  ///< Read them with figure().
};

/// The measured figures by their names, those of phases too, for the report of the flight; coverage is stored
/// separately there.
std::vector<std::pair<std::string, double>> reportedFigures(const FlightScore& score);

}  // namespace swiftlet::evaluation
