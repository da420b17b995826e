#include "apps/map3d_files.hpp"

#include "common/world/map3d_layer.hpp"
#include "interfaces/files/octomap.hpp"
#include "interfaces/files/point_cloud.hpp"
#include "mapping3d/cloud/cloud.hpp"
#include "mapping3d/model/submap_fusion.hpp"

namespace swiftlet::apps {

namespace {

interfaces::Map3dFiles octreesOf(const common::VoxelMap& fused, common::Time stamp) {
  interfaces::Map3dFiles files;
  files.octree_stamp = stamp;
  files.map_bt = interfaces::toOctree(fused, interfaces::OctreeFormat::kBinary);
  files.map_ot = interfaces::toOctree(fused, interfaces::OctreeFormat::kLogOdds);
  return files;
}

interfaces::Map3dFiles cloudFileOf(const common::Map3dLayer& layer, const mapping3d::CloudConfig& config) {
  interfaces::Map3dFiles files;
  if (!layer.submaps->empty())
    files.cloud_ply =
        interfaces::toCloud(mapping3d::cloudOf(*layer.submaps, *layer.keys, config), interfaces::CloudFormat::kPly);
  return files;
}

}  // namespace

interfaces::Map3dFiles octreeFiles(const common::Map3dLayer& layer, common::Time now) {
  if (layer.submaps->empty()) return {};
  const double resolution_m = layer.submaps->front().voxels->resolution_m();
  return octreesOf(mapping3d::fuse(*layer.submaps, *layer.keys, resolution_m), now);
}

interfaces::Map3dFiles cloudFile(const common::Map3dLayer& layer) { return cloudFileOf(layer, {}); }

interfaces::Map3dFiles octreeFilesInFlight(const common::Map3dLayer& layer, common::Time now) {
  if (layer.submaps->empty() || !layer.fused) return octreeFiles(layer, now);
  return octreesOf(*layer.fused, layer.fused_stamp);
}

interfaces::Map3dFiles cloudFileInFlight(const common::Map3dLayer& layer) {
  mapping3d::CloudConfig quick;
  quick.neighbours = 0;
  return cloudFileOf(layer, quick);
}

}  // namespace swiftlet::apps
