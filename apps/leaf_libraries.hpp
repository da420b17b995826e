// --leaves: node types from shared objects (behaviors/leaf_library.hpp).
#pragma once

#include <string>
#include <vector>

#include "apps/command_line.hpp"
#include "behaviors/registry.hpp"

namespace swiftlet::apps {

void addLeavesOption(Command& command, std::vector<std::string>& files);

/// Swiftlet's node types and those of the libraries, which stay loaded until the program ends. Throws
/// common::InputError with what is wrong with a library.
behaviors::NodeTypes nodesWith(const std::vector<std::string>& libraries);

}  // namespace swiftlet::apps
