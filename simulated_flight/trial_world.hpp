// Where worlds lie on this machine.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "evaluation/trial.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulated_flight {

/// A world by its path or, as `unb_case1`, by the name of one in the folder `worlds`. Throws common::InputError, which
/// also names `beside` and what is there: the folder of a file that names the world.
std::filesystem::path findWorldFile(const std::string& name, const std::filesystem::path& beside = {});

/// A folder of models that is named at `key`, in the first of the folders `bases` that has it. Throws
/// common::InputError, with the most similar name that is there.
std::filesystem::path findModelFolder(const std::string& name, const std::string& key,
                                      const std::vector<std::filesystem::path>& bases = {""});

/// Sets the paths of a trial's worlds and models: beside the trial's file, with the software, in the working folder, or
/// in an archive of the data sets that is unpacked once. Throws common::InputError when they are nowhere.
void findWorld(evaluation::TrialConfig& trial);

/// The world that a scenario is flown in, or `file` with the scenario's models. Throws common::InputError.
simulation::WorldModel loadWorldOf(const simulation::Scenario& scenario, const std::string& file = {});

}  // namespace swiftlet::simulated_flight
