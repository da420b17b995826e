// Node types from shared objects (behaviors/leaf_library.hpp).
#pragma once

#include <string>
#include <vector>

#include "behaviors/registry.hpp"

namespace swiftlet::flight {

/// Swiftlet's node types and those of the libraries, which stay loaded until the program ends. Throws
/// common::InputError with what is wrong with a library.
behaviors::NodeTypes nodesWith(const std::vector<std::string>& libraries);

}  // namespace swiftlet::flight
