// What libsdformat would not survive, or not explain, is found before it sees a world.
#pragma once

#include <string>

#include "simulation/uri_resolver.hpp"

namespace swiftlet::simulation {

/// Throws common::InputError (file:line:column) for malformed XML, which libsdformat tells to the terminal only and
/// then takes for URDF; for a root or a version that is none of SDF; and for files that include each other in a circle,
/// which it follows until the memory is full. `text` is what stands in `file`.
void checkBeforeSdf(const std::string& file, const std::string& text, const UriResolver& resolver);

}  // namespace swiftlet::simulation
