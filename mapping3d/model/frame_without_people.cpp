#include "mapping3d/model/frame_without_people.hpp"

#include <algorithm>
#include <cstddef>

namespace swiftlet::mapping3d {

common::RgbdFrame withoutPeople(common::RgbdFrame frame, const common::Pose3& T_map_camera,
                                std::span<const common::Disc> people) {
  const Eigen::Matrix3d rotation = T_map_camera.rotation.toRotationMatrix();
  std::size_t pixel = 0;
  for (int v = 0; v < frame.camera.height_px; ++v)
    for (int u = 0; u < frame.camera.width_px; ++u, ++pixel) {
      float& depth_m = frame.depth.depth_m[pixel];
      if (!common::isMeasured(depth_m)) continue;
      const Eigen::Vector3d point_map_m =
          rotation * frame.camera.point_camera_m(u, v, static_cast<double>(depth_m)) + T_map_camera.position_m;
      if (std::any_of(people.begin(), people.end(),
                      [&](const common::Disc& person) { return person.covers(point_map_m.head<2>()); }))
        depth_m = common::DepthImage::kUnknown;
    }
  return frame;
}

}  // namespace swiftlet::mapping3d
