#include "apps/map3d_files.hpp"

#include "common/world/map3d_layer.hpp"
#include "interfaces/files/octomap.hpp"
#include "interfaces/files/point_cloud.hpp"
#include "mapping3d/cloud/cloud.hpp"
#include "mapping3d/model/submap_fusion.hpp"

namespace swiftlet::apps {

namespace {

interfaces::Map3dFiles filesOf(const common::Map3dLayer& layer, const common::VoxelMap& fused, common::Time fused_stamp,
                               const mapping3d::CloudConfig& cloud) {
  interfaces::Map3dFiles files;
  files.octree_stamp = fused_stamp;
  files.cloud_ply =
      interfaces::toCloud(mapping3d::cloudOf(*layer.submaps, *layer.keys, cloud), interfaces::CloudFormat::kPly);
  files.map_bt = interfaces::toOctree(fused, interfaces::OctreeFormat::kBinary);
  files.map_ot = interfaces::toOctree(fused, interfaces::OctreeFormat::kLogOdds);
  return files;
}

}  // namespace

interfaces::Map3dFiles map3dFiles(const common::Map3dLayer& layer, common::Time now) {
  if (layer.submaps->empty()) return {};
  const double resolution_m = layer.submaps->front().voxels->resolution_m();
  return filesOf(layer, mapping3d::fuse(*layer.submaps, *layer.keys, resolution_m), now, {});
}

interfaces::Map3dFiles map3dFilesInFlight(const common::Map3dLayer& layer, common::Time now) {
  if (!layer.fused) return map3dFiles(layer, now);
  mapping3d::CloudConfig quick;
  quick.neighbours = 0;
  return filesOf(layer, *layer.fused, layer.fused_stamp, quick);
}

}  // namespace swiftlet::apps
