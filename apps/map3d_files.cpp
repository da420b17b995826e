#include "apps/map3d_files.hpp"

#include "common/world/map3d_layer.hpp"
#include "interfaces/files/octomap.hpp"
#include "interfaces/files/point_cloud.hpp"
#include "mapping3d/cloud/cloud.hpp"
#include "mapping3d/model/submap_fusion.hpp"

namespace swiftlet::apps {

interfaces::Map3dFiles map3dFiles(const common::Map3dLayer& layer) {
  interfaces::Map3dFiles files;
  if (layer.submaps->empty()) return files;
  files.cloud_ply = interfaces::toCloud(mapping3d::cloudOf(*layer.submaps, *layer.keys), interfaces::CloudFormat::kPly);
  const common::VoxelMap fused =
      mapping3d::fuse(*layer.submaps, *layer.keys, layer.submaps->front().voxels->resolution_m());
  files.map_bt = interfaces::toOctree(fused, interfaces::OctreeFormat::kBinary);
  files.map_ot = interfaces::toOctree(fused, interfaces::OctreeFormat::kLogOdds);
  return files;
}

}  // namespace swiftlet::apps
