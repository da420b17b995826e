// The 3D map of a flight as files of its run folder.
#pragma once

#include <filesystem>

#include "interfaces/run_folder.hpp"

namespace swiftlet::common {
struct Map3dLayer;
}

namespace swiftlet::flight {

/// Writes map.bt and map.ot: all submaps in the frame `map`, of the voxels as they are now. This and the functions
/// below write nothing before there are submaps, and take seconds for a long flight; safe on any thread, one at a time.
/// `now` is the time of the layer's snapshot.
interfaces::Map3dWritten writeOctrees(const std::filesystem::path& folder, const common::Map3dLayer& layer,
                                      common::Time now);
/// Writes cloud.ply: the cloud of all submaps, without specks.
interfaces::Map3dWritten writeCloud(const std::filesystem::path& folder, const common::Map3dLayer& layer);
/// The octrees, quickly: of the voxels that the flight has fused last, if it has.
interfaces::Map3dWritten writeOctreesInFlight(const std::filesystem::path& folder, const common::Map3dLayer& layer,
                                              common::Time now);
/// The cloud, quickly: with specks.
interfaces::Map3dWritten writeCloudInFlight(const std::filesystem::path& folder, const common::Map3dLayer& layer);

}  // namespace swiftlet::flight
