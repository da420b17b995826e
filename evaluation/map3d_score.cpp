// The figures of the 3D map.
#include <cmath>

#include "common/submap3d.hpp"
#include "common/world/map3d_layer.hpp"
#include "evaluation/cloud_metrics.hpp"
#include "evaluation/figure_measures.hpp"
#include "evaluation/true_world.hpp"

namespace swiftlet::evaluation {
namespace {

Cloud cloudOf(const common::Map3dLayer& map, const common::Pose3& T_world_map) {
  std::size_t size = 0;
  for (const common::Submap3d& submap : *map.submaps) size += submap.points->size();
  Cloud cloud_world_m;
  cloud_world_m.reserve(size);  // Of a large building 100 MB; growing, it would take three times as much.
  for (const common::Submap3d& submap : *map.submaps) {
    const common::Pose3 T_world_submap = T_world_map * submap.T_map_submap(*map.keys);
    for (const common::SurfacePoint& point : *submap.points)
      cloud_world_m.push_back(T_world_submap * Eigen::Vector3d(point.position_m.cast<double>()));
  }
  return cloud_world_m;
}

/// What the flight knew at its end of the camera's mount and clock. The body has the axes of the mounted laser here, as
/// in knowableFrame().
void measureCamera(const FlightRecord& record, const TrueWorld& world, FlightScore& score) {
  const common::CameraEstimate& estimate = record.map3d->camera;
  const Eigen::Quaterniond R_known_body = record.T_world_map.rotation.conjugate() * record.T_world_start.rotation;
  const Eigen::Quaterniond truth = R_known_body * world.T_body_camera.rotation;
  score["camera_mount_error_rad"] = truth.angularDistance(estimate.T_body_camera.rotation);
  score["camera_mount_error_of_data_sheet_rad"] = truth.angularDistance(world.rgbd_camera->mount.pose().rotation);
  score["camera_clock_error_s"] = std::abs(estimate.clock_offset_s - world.camera_clock_offset_s);
}

}  // namespace

void measureMap3d(const FlightRecord& record, const TrueWorld& world, FlightScore& score) {
  if (record.map3d == nullptr) return;
  Cloud cloud = cloudOf(*record.map3d, record.T_world_map);
  if (cloud.empty()) return;
  score["map3d_points"] = static_cast<double>(cloud.size());
  const CloudError as_it_stands = cloudError(cloud, *world.rays);
  score["map3d_error_median_m"] = as_it_stands.median_m;
  score["map3d_error_p95_m"] = as_it_stands.p95_m;
  const common::Pose3 T = alignment(cloud, *world.rays);
  for (Eigen::Vector3d& point : cloud) point = T * point;
  const CloudError aligned = cloudError(cloud, *world.rays);
  score["map3d_aligned_median_m"] = aligned.median_m;
  score["map3d_aligned_p95_m"] = aligned.p95_m;
  if (!world.rgbd_camera) return;
  measureCamera(record, world, score);
  std::vector<common::Pose3> T_world_camera;
  for (const common::Pose3& T_world_body : record.T_world_body_views)
    T_world_camera.push_back(T_world_body * world.T_body_camera);
  score["map3d_coverage"] = shareCovered(surfacesInView(*world.rgbd_camera, T_world_camera, *world.rays), cloud);
}

}  // namespace swiftlet::evaluation
