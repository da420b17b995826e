// Reads an SDF file by libsdformat and sorts its messages into warnings and errors, each with file and line.
#pragma once

#include <string>
#include <vector>

#include <sdf/Root.hh>

#include "common/error.hpp"
#include "simulation/uri_resolver.hpp"

namespace swiftlet::simulation {

struct SdfFile {
  sdf::Root root;
  std::vector<common::Problem> missing;  ///< Things that it names and that were not found, and misspelt ones.
  std::vector<common::Problem> warnings;
  bool wants_ground_plane = false;  ///< It includes the well-known ground plane, which could not be found.
};

/// Throws common::InputError with everything that is wrong. Nothing is written to the terminal.
SdfFile readSdf(const std::string& file, const UriResolver& resolver);

}  // namespace swiftlet::simulation
