#include "flight/map3d_files.hpp"

#include "common/world/map3d_layer.hpp"
#include "interfaces/clouds/point_cloud.hpp"
#include "interfaces/files/octomap.hpp"
#include "mapping3d/cloud/cloud.hpp"
#include "mapping3d/model/submap_fusion.hpp"

namespace swiftlet::flight {

namespace fs = std::filesystem;
using interfaces::Map3dWritten;

namespace {

Map3dWritten writeBothOctrees(const fs::path& folder, const common::VoxelMap& fused, common::Time stamp) {
  auto written = interfaces::writeOctree(folder / "map.bt", fused);
  if (written) written = interfaces::writeOctree(folder / "map.ot", fused);
  return {written, stamp};
}

Map3dWritten writeCloudBy(const fs::path& folder, const common::Map3dLayer& layer,
                          const mapping3d::CloudConfig& config) {
  if (layer.submaps->empty()) return {};
  return {interfaces::writeCloud(folder / "cloud.ply", mapping3d::cloudOf(*layer.submaps, *layer.keys, config))};
}

}  // namespace

Map3dWritten writeOctrees(const fs::path& folder, const common::Map3dLayer& layer, common::Time now) {
  if (layer.submaps->empty()) return {};
  const double resolution_m = layer.submaps->front().voxels->resolution_m();
  return writeBothOctrees(folder, mapping3d::fuse(*layer.submaps, *layer.keys, resolution_m), now);
}

Map3dWritten writeCloud(const fs::path& folder, const common::Map3dLayer& layer) {
  return writeCloudBy(folder, layer, {});
}

Map3dWritten writeOctreesInFlight(const fs::path& folder, const common::Map3dLayer& layer, common::Time now) {
  if (layer.submaps->empty() || !layer.fused) return writeOctrees(folder, layer, now);
  return writeBothOctrees(folder, *layer.fused, layer.fused_stamp);
}

Map3dWritten writeCloudInFlight(const fs::path& folder, const common::Map3dLayer& layer) {
  mapping3d::CloudConfig quick;
  quick.neighbours = 0;
  return writeCloudBy(folder, layer, quick);
}

}  // namespace swiftlet::flight
