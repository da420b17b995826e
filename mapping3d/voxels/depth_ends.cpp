#include "mapping3d/voxels/depth_ends.hpp"

#include <limits>

namespace swiftlet::mapping3d {

DepthEnds::DepthEnds(const common::PinholeCamera& camera, const common::Pose3& T_map_camera, common::VoxelIndex first,
                     double resolution_m)
    : origin_((T_map_camera.position_m / resolution_m - Eigen::Vector3d(first.x, first.y, first.z)).cast<float>()) {
  const Eigen::Matrix3d per_depth = T_map_camera.rotation.toRotationMatrix() / resolution_m;
  const Eigen::Vector3d ray = camera.point_camera_m(0.0, 0.0, 1.0);
  ray_ = (per_depth * ray).cast<float>();
  per_u_ = (per_depth * (camera.point_camera_m(1.0, 0.0, 1.0) - ray)).cast<float>();
  per_v_ = (per_depth * (camera.point_camera_m(0.0, 1.0, 1.0) - ray)).cast<float>();
}

// Without a branch, so that the compiler looks at several pixels at once.
void DepthEnds::find(int u, int v, int count, const float* __restrict depth_m, const float* __restrict range_depth_m,
                     float* __restrict free_m, Chunk& chunk) const {
  constexpr float kGreatest = std::numeric_limits<float>::max();
  const Eigen::Vector3f row = ray_ + static_cast<float>(v) * per_v_;
  const float row_x = row.x(), row_y = row.y(), row_z = row.z();
  const float per_x = per_u_.x(), per_y = per_u_.y(), per_z = per_u_.z();
  const float origin_x = origin_.x(), origin_y = origin_.y(), origin_z = origin_.z();
  int* __restrict x = chunk.x.data();
  int* __restrict y = chunk.y.data();
  int* __restrict z = chunk.z.data();
  for (int i = 0; i < count; ++i) {
    const float depth = depth_m[i], range = range_depth_m[i], column = static_cast<float>(u + i);
    const bool known = depth > 0.0F, hit = known & (depth <= range) & (depth <= kGreatest);
    free_m[i] = known ? (depth < range ? depth : range) : 0.0F;
    const float along = hit ? depth : 0.0F;
    const int none = known ? Chunk::kTooFar : Chunk::kUnknown;
    x[i] = hit ? static_cast<int>(origin_x + along * (row_x + column * per_x)) : none;
    y[i] = static_cast<int>(origin_y + along * (row_y + column * per_y));
    z[i] = static_cast<int>(origin_z + along * (row_z + column * per_z));
  }
}

}  // namespace swiftlet::mapping3d
