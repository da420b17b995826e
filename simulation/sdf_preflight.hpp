// Finds errors that libsdformat would not survive or not explain. Call it before libsdformat reads a world.
#pragma once

#include <string>

#include "simulation/uri_resolver.hpp"

namespace swiftlet::simulation {

/// Throws common::InputError (file:line:column) for malformed XML, which libsdformat reports only on the terminal and
/// then reads as URDF; for a root element or a version that SDF does not have; and for files that include each other in
/// a circle, which libsdformat follows until the memory is full. `text` is the content of `file`.
void checkBeforeSdf(const std::string& file, const std::string& text, const UriResolver& resolver);

}  // namespace swiftlet::simulation
