#include "apps/map3d_files.hpp"

#include "common/world/map3d_layer.hpp"
#include "interfaces/files/octomap.hpp"
#include "mapping3d/model/submap_fusion.hpp"

namespace swiftlet::apps {

std::vector<interfaces::ColoredPoint> cloudOf(const std::vector<common::Submap3d>& submaps,
                                              const common::KeyPoses& keys) {
  std::vector<interfaces::ColoredPoint> cloud;
  for (const common::Submap3d& submap : submaps) {
    const common::Pose3 T_map_submap = submap.T_map_submap(keys);
    const Eigen::Matrix3f rotation = T_map_submap.rotation.toRotationMatrix().cast<float>();
    const Eigen::Vector3f origin_m = T_map_submap.position_m.cast<float>();
    for (const common::SurfacePoint& point : *submap.points)
      cloud.push_back({rotation * point.position_m + origin_m, point.rgb[0], point.rgb[1], point.rgb[2]});
  }
  return cloud;
}

interfaces::Map3dFiles map3dFiles(const common::Map3dLayer& layer) {
  interfaces::Map3dFiles files;
  if (layer.submaps->empty()) return files;
  files.cloud_ply = interfaces::toPly(cloudOf(*layer.submaps, *layer.keys));
  const common::VoxelMap fused =
      mapping3d::fuse(*layer.submaps, *layer.keys, layer.submaps->front().voxels->resolution_m());
  files.map_bt = interfaces::toOctree(fused, interfaces::OctreeFormat::kBinary);
  files.map_ot = interfaces::toOctree(fused, interfaces::OctreeFormat::kLogOdds);
  return files;
}

}  // namespace swiftlet::apps
