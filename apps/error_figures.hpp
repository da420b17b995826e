// Errors of a trajectory as `swiftlet evaluate` shows them: a table for people, keys for programs.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/table.hpp"
#include "evaluation/statistics.hpp"

namespace swiftlet::apps {

/// A set of errors with the unit it is shown in.
struct ErrorFigures {
  std::string name;    ///< Name in the table: "translation".
  std::string prefix;  ///< Prefix of its keys: "ate_" makes "ate_rmse_m".
  std::string unit;    ///< "m", "deg", "m2", "deg2".
  evaluation::Statistics errors;
};

/// The errors with each value multiplied, for example from radians to degrees.
evaluation::Statistics inUnit(evaluation::Statistics errors, double factor);

/// One row for each set; the figures are the columns.
common::Table tableOf(const std::string& title, const std::vector<ErrorFigures>& figures);

/// "<prefix>rmse_<unit>" and so on for mean, median, std, min and max; all null if there are no errors.
void addTo(nlohmann::json& json, const ErrorFigures& figures);

}  // namespace swiftlet::apps
