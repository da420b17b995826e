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

/// For commands whose profile names the vehicle.
inline constexpr const char* kSystemOfVehicle = "a --system whose vehicle is";

/// The vehicle that is asked for, and what chooses it, for hints: "--vehicle".
struct FlownVehicle {
  common::VehicleConfig sheet;
  std::string option;
};

/// The same flight again would count as new evidence. Throws common::InputError that names `argument`.
void refuseRunsGivenTwice(const std::vector<std::string>& runs, const std::string& argument);

/// Throws common::InputError that says what to do: for a folder that is no run, a run without control.tsv or with rows
/// of another rate, one of another vehicle, and one without the truth where it is needed.
std::vector<interfaces::ControlRow> readControlRows(const std::string& run, const FlownVehicle& vehicle, Truth truth);

/// The inputs of that run's filter. Throws common::InputError with file and line.
std::vector<perception::FilterInput> readFilterTape(const std::string& run);

/// The inputs of the filter, and the truth while the vehicle flew. Throws common::InputError, also for a flight that
/// took less than `least_s`.
perception::TapedFlight readTapedFlight(const std::string& run, const FlownVehicle& vehicle, double least_s);

}  // namespace swiftlet::apps
