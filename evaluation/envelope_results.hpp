// The results of an envelope: one JSON file, and tables for people.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/table.hpp"
#include "evaluation/envelope.hpp"

namespace swiftlet::evaluation {

/// What was flown for one quantity beside what the natures draw for it.
struct EnvelopeEntry {
  EnvelopeFinding finding;
  std::optional<simulation::NatureRange> real;
  std::optional<simulation::NatureRange> harsh;

  /// The value farthest from the base, in the direction of the variation, that a nature draws; nullopt if it draws
  /// nothing in that direction.
  std::optional<double> worstOf(const std::optional<simulation::NatureRange>& nature) const;
  /// Distance of a value from the base, as a multiple of that of the worst value that `harsh` draws; nullopt if `harsh`
  /// draws nothing in that direction.
  std::optional<double> harshMultiple(double value) const;
};

struct EnvelopeResults {
  std::string trial;
  std::string system;
  std::string mission;
  std::string version;  ///< Version of the program.
  int first_seed = 1;
  EnvelopeConfig config;
  EnvelopeStep base;  ///< The flights without any change.
  std::vector<EnvelopeEntry> entries;

  /// The base was acceptable and the search of every quantity has ended.
  bool complete() const;
  int flights() const;
  /// The entries by reserve, the least first: those that failed, by harshMultiple() of the first
  /// failing value; those that failed and that `harsh` does not draw; those that never failed.
  std::vector<const EnvelopeEntry*> byReserve() const;
};

/// A value with the unit that ends the name of its key: ("quadrotor.motor_lag_s", 0.0412) is "41.2 ms".
std::string shownValue(const std::string& key, double value);

/// The result for one quantity: "crash: touched box_1 (seed 7)", "none of 20 failed".
std::string endingText(const EnvelopeFinding& finding);

/// envelope.json. Figures have six significant digits.
std::string toJson(const EnvelopeResults& results);

/// A row for each quantity that was begun, by reserve.
common::Table envelopeTable(const EnvelopeResults& results);

/// A row for each flight that was not acceptable, with a link to its report.
common::Table failedFlightTable(const EnvelopeResults& results);

/// Quantities with an acceptable value beyond a failing one; no rows without such a quantity.
common::Table raggedTable(const EnvelopeResults& results);

}  // namespace swiftlet::evaluation
