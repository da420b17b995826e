// The 3D map of a flight as files.
#pragma once

#include "interfaces/run_folder.hpp"

namespace swiftlet::common {
struct Map3dLayer;
}

namespace swiftlet::apps {

/// The octrees of all submaps in the frame `map`, of the voxels as they are now; nothing before there are submaps. A
/// pure function, as are those below; each takes seconds for a long flight. `now` is the time of the layer's snapshot.
interfaces::Map3dFiles octreeFiles(const common::Map3dLayer& layer, common::Time now);
/// The cloud of all submaps, without specks.
interfaces::Map3dFiles cloudFile(const common::Map3dLayer& layer);
/// The octrees, quickly: of the voxels that the flight has fused last, if it has.
interfaces::Map3dFiles octreeFilesInFlight(const common::Map3dLayer& layer, common::Time now);
/// The cloud, quickly: with specks.
interfaces::Map3dFiles cloudFileInFlight(const common::Map3dLayer& layer);

}  // namespace swiftlet::apps
