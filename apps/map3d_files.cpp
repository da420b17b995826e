#include "apps/map3d_files.hpp"

#include "common/world/map3d_layer.hpp"
#include "interfaces/files/octomap.hpp"
#include "interfaces/files/point_cloud.hpp"
#include "mapping3d/cloud/cloud.hpp"
#include "mapping3d/model/submap_fusion.hpp"

namespace swiftlet::apps {

namespace {

void addOctrees(const common::VoxelMap& fused, common::Time stamp, interfaces::Map3dFiles& files) {
  files.octree_stamp = stamp;
  files.map_bt = interfaces::toOctree(fused, interfaces::OctreeFormat::kBinary);
  files.map_ot = interfaces::toOctree(fused, interfaces::OctreeFormat::kLogOdds);
}

void addCloud(const common::Map3dLayer& layer, const mapping3d::CloudConfig& config, interfaces::Map3dFiles& files) {
  files.cloud_ply =
      interfaces::toCloud(mapping3d::cloudOf(*layer.submaps, *layer.keys, config), interfaces::CloudFormat::kPly);
}

}  // namespace

interfaces::Map3dFiles map3dFiles(const common::Map3dLayer& layer, common::Time now) {
  interfaces::Map3dFiles files;
  if (layer.submaps->empty()) return files;
  // The fused voxels are gone before the cloud is made: of a large building each takes 100 MB and more.
  addOctrees(mapping3d::fuse(*layer.submaps, *layer.keys, layer.submaps->front().voxels->resolution_m()), now, files);
  addCloud(layer, {}, files);
  return files;
}

interfaces::Map3dFiles map3dFilesInFlight(const common::Map3dLayer& layer, common::Time now) {
  if (!layer.fused) return map3dFiles(layer, now);
  interfaces::Map3dFiles files;
  addOctrees(*layer.fused, layer.fused_stamp, files);
  mapping3d::CloudConfig quick;
  quick.neighbours = 0;
  addCloud(layer, quick, files);
  return files;
}

}  // namespace swiftlet::apps
