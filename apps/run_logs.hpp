// The control.tsv of run folders, for the commands that learn from flights.
#pragma once

#include <string>
#include <vector>

#include "common/vehicle_config.hpp"
#include "interfaces/control_log.hpp"
#include "perception/fusion/filter_tape.hpp"
#include "perception/fusion/noise_tuning.hpp"

namespace swiftlet::apps {

enum class Truth { kUnused, kNeeded };

/// Throws common::InputError that says what to do: for a folder that is no run, a run without control.tsv, one of
/// another vehicle, and one without the truth where it is needed.
std::vector<interfaces::ControlRow> readControlRows(const std::string& run, const common::VehicleConfig& vehicle,
                                                    Truth truth);

/// What the filter of that run was told. Throws common::InputError with file and line.
std::vector<perception::FilterInput> readFilterTape(const std::string& run);

/// What the filter was told, and the truth while the vehicle flew. Throws common::InputError, also for a flight that
/// took less than `least_s`.
perception::TapedFlight readTapedFlight(const std::string& run, const common::VehicleConfig& vehicle, double least_s);

}  // namespace swiftlet::apps
