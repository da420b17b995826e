// The 3D map of a flight as files.
#pragma once

#include "interfaces/run_folder.hpp"

namespace swiftlet::common {
struct Map3dLayer;
}

namespace swiftlet::apps {

/// The cloud and the voxels of all submaps in the frame `map`; nothing before there are submaps. Pure functions, which
/// take seconds for a long flight. The first fuses the voxels as they are now; the second takes those that the flight
/// has fused last, if it has, and leaves specks in the cloud.
/// `now` is the time of the snapshot that the layer is of.
interfaces::Map3dFiles map3dFiles(const common::Map3dLayer& layer, common::Time now);
interfaces::Map3dFiles map3dFilesInFlight(const common::Map3dLayer& layer, common::Time now);

}  // namespace swiftlet::apps
