// Errors of a trajectory as `swiftlet evaluate` shows them: a table for people, keys for programs.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/table.hpp"
#include "evaluation/statistics.hpp"

namespace swiftlet::apps {

/// A set of errors in the unit it is shown in.
struct ErrorFigures {
  std::string name;    ///< In the table: "translation".
  std::string prefix;  ///< Of its keys: "ate_" makes "ate_rmse_m".
  std::string unit;    ///< "m", "deg", "m2", "deg2".
  evaluation::Statistics errors;
};

/// The same errors, of which each value was multiplied, as from radians to degrees.
evaluation::Statistics inUnit(evaluation::Statistics errors, double factor);

/// One row each; the figures in columns.
common::Table tableOf(const std::string& title, const std::vector<ErrorFigures>& figures);

/// "<prefix>rmse_<unit>" and so on for mean, median, std, min and max; all null where there are no errors.
void addTo(nlohmann::json& json, const ErrorFigures& figures);

}  // namespace swiftlet::apps
