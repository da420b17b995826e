// The 3D map of a flight as files.
#pragma once

#include "interfaces/run_folder.hpp"

namespace swiftlet::common {
struct Map3dLayer;
}

namespace swiftlet::apps {

/// The cloud, and the voxels of all submaps in the frame `map`. A pure function, which takes seconds for a long flight.
interfaces::Map3dFiles map3dFiles(const common::Map3dLayer& layer);

}  // namespace swiftlet::apps
