// Where the world of a trial's scenario lies on this machine.
#pragma once

#include "evaluation/trial.hpp"

namespace swiftlet::apps {

/// The world's files are with the software, or in an archive of the data sets that is unpacked once. Throws
/// common::InputError when they are nowhere.
void findWorld(evaluation::TrialConfig& trial);

}  // namespace swiftlet::apps
