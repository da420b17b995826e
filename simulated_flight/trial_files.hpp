// The files that trials name.
#pragma once

#include <optional>
#include <string>

#include "common/error.hpp"
#include "evaluation/trial.hpp"

namespace swiftlet::simulated_flight {

/// The problem of a file that a trial names by `key`, with that place in the trial. A file of that name beside the
/// trial is what was meant.
common::Problem inTrial(const evaluation::TrialConfig& trial, const std::string& key, const std::string& name,
                        common::Problem problem);

/// Finds a mission where data is, or beside the trial, also named without its ending, and sets `name` to its path.
/// Returns the problem of a mission that is not found, or is no mission.
std::optional<common::Problem> findMissionOf(const evaluation::TrialConfig& trial, const std::string& key,
                                             std::string& name);

/// Does the same for the system of the trial; a profile of the folder config/systems is named without its path.
std::optional<common::Problem> findSystemOf(evaluation::TrialConfig& trial);

}  // namespace swiftlet::simulated_flight
