// Where worlds lie on this machine.
#pragma once

#include <filesystem>
#include <string>

#include "evaluation/trial.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::apps {

/// A world by its path or, as `unb_case1`, by the name of one in the folder `worlds`. Throws common::InputError, which
/// also names `beside` and what is there: the folder of a file that names the world.
std::filesystem::path findWorldFile(const std::string& name, const std::filesystem::path& beside = {});

/// Sets the paths of a trial's worlds and models: beside the trial's file, with the software, in the working folder, or
/// in an archive of the data sets that is unpacked once. Throws common::InputError when they are nowhere.
void findWorld(evaluation::TrialConfig& trial);

/// The world that a scenario is flown in, or `file` with the scenario's models. Throws common::InputError.
simulation::WorldModel loadWorldOf(const simulation::Scenario& scenario, const std::string& file = {});

}  // namespace swiftlet::apps
