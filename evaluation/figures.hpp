// The figures of a flight, each said once: a row of flightFigures() has its name, its criteria, its statistics over all
// flights and its columns. Trial files, results.json, mission.json, the reports, the tables and the papers' page follow
// from the rows.
//
// To add a figure, add its row to figure_table.cpp and set it where it is measured, score["landing_error_m"] = ...;
// a figure that follows from others has a function in its row instead.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/config_fields.hpp"

namespace swiftlet::evaluation {

struct FlightScore;

/// What a figure tells of. Each file and table has the groups in an order of its own; within a group, figures are in
/// the order of their rows.
enum class FigureGroup {
  kVerdict,
  kCoverage,
  kGoals,
  kMission,
  kDistance,
  kFlightTime,
  kCourse,
  kSpace,
  kEstimate,
  kMap3d,
  kCamera,
  kVisualOdometry,
  kLocalization,
  kClearance,
  kWalkers,
  kConduct,
  kLatency,
  kBehaviors,
  kHomeEnergy,
  kRawFrame,
  kSpeed,
  kMachine
};

/// A bound of a figure that a trial file may have.
struct Criterion {
  enum class Bound { kAtMost, kAtLeast };
  /// Of which flights it is asked: of those that did their mission, or of every one where the trial has no verdicts; of
  /// these and of others that have the figure; of those that have the figure alone; of every one; of those that did not
  /// do their mission. Over all flights, one that lacks the figure is ignored with kIfMeasured, and otherwise worse
  /// than any that has it.
  enum class Asked { kOfMission, kIfMeasured, kOfMeasured, kAlways, kOfUndone };

  const char* key = nullptr;       ///< In the trial file; null: the figure has no criterion.
  const char* label = nullptr;     ///< For people: "goal error, m".
  const char* sentence = nullptr;  ///< What the bound is, for the reference page.
  Bound bound = Bound::kAtMost;
  Asked asked = Asked::kOfMission;
  common::config::Bounds values = common::config::kPositive;  ///< What the bound may be.
  const char* why_lacking = "";  ///< Why there is no figure, where that has one reason only.

  /// The bound that asks for nothing: infinite, or 0 where the figure must be at least the bound.
  double unasked() const;
  bool asks(double limit) const;
  bool met(double value, double limit) const { return bound == Bound::kAtMost ? value <= limit : value >= limit; }
  /// Why a bound is missed, in words; empty if it holds or asks for nothing. A figure that is lacking or not a number
  /// misses it; `problem` says why there is none, if it is not why_lacking.
  std::string failure(const std::optional<double>& value, double limit, const std::string& problem = {}) const;
};

/// How a table shows a figure: multiplied by a factor, with a unit behind it.
struct FigureColumn {
  const char* title = nullptr;  ///< Null: in no table.
  int decimals = 3;
  double factor = 1.0;
  const char* unit = "";
  bool always = false;  ///< Of the summary: in that of every trial.

  /// "-" without a value.
  std::string shown(const std::optional<double>& value) const;
};

/// A figure over all flights of a trial: of those that have the figure of each flight.
struct TrialFigure {
  enum class Statistic { kMin, kMedian, kMax, kMean };

  const char* name = nullptr;  ///< In results.json: "goal_error_max_m".
  Statistic statistic = Statistic::kMax;
  FigureColumn column = {};      ///< Of the summary, where a trial has its criterion or its paper has the figure.
  Criterion criterion = {};      ///< Over all flights.
  const char* figure = nullptr;  ///< Of each flight; flightFigures() sets it.

  /// nullopt if no flight has the figure.
  std::optional<double> of(const std::vector<FlightScore>& flights) const;
  /// Why the criterion over all flights is missed, in words; empty if it is not.
  std::string failure(const std::vector<FlightScore>& flights, double limit) const;
  /// The criterion that its column of the summary shows: a least or a greatest figure has that of each flight.
  const Criterion& judgedBy() const;
};

/// A figure of one flight.
struct FlightFigure {
  /// How results.json has it: null where it was not measured, or 0 there; as a whole number; as yes or no; not at all.
  enum class InResults { kOrNull, kOrZero, kCount, kFlag, kNot };

  const char* name = nullptr;  ///< In results.json and mission.json; it ends in the unit.
  FigureGroup group = FigureGroup::kGoals;
  const char* key = nullptr;  ///< In its group's object in results.json; null: it stands in the flight itself.
  InResults in_results = InResults::kOrNull;
  FigureColumn column = {};  ///< Of the tables with a row for each flight.
  Criterion criterion = {};
  std::vector<TrialFigure> over_flights = {};
  std::optional<double> (*of)(const FlightScore&) = nullptr;  ///< Of a figure that follows from others.

  bool isNumber() const { return in_results == InResults::kOrNull || in_results == InResults::kOrZero; }
  /// As results.json and the tables have it.
  std::optional<double> written(const FlightScore& flight) const;
};

/// In the order in which results.json has the figures over all flights.
const std::vector<FlightFigure>& flightFigures();
std::vector<const FlightFigure*> figuresOf(std::initializer_list<FigureGroup> groups);
/// By its name, which must exist.
const FlightFigure& flightFigure(std::string_view name);

/// In the order of results.json.
const std::vector<const TrialFigure*>& trialFigures();
/// By its name, which must exist.
const TrialFigure& trialFigure(std::string_view name);
/// Null without one of that name.
const TrialFigure* findTrialFigure(std::string_view name);
/// Why there is no figure over all flights of that name, with the most similar one; empty if there is.
std::optional<common::Problem> trialFigureProblem(const std::string& name);

}  // namespace swiftlet::evaluation
