#include "tests/mapping3d/rooms.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace swiftlet::mapping3d {
namespace {

/// Where the ray enters and leaves the box, in multiples of its direction; enters > leaves: it misses.
std::pair<double, double> crossing(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction) {
  double enters = -std::numeric_limits<double>::infinity(), leaves = -enters;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.min()[axis] - origin[axis]) / direction[axis];
    const double b = (box.max()[axis] - origin[axis]) / direction[axis];
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return {enters, leaves};
}

double uniform(std::mt19937& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
}

}  // namespace

common::PinholeCamera smallCamera() { return {160, 120, 131.25, 131.25, 79.5, 59.5}; }

common::PinholeCamera xtion() { return {320, 240, 288.65, 288.65, 159.5, 119.5}; }

Room randomRoom(std::mt19937& random) {
  Room room;
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d corner_m(uniform(random, -3, 4), uniform(random, -2, 3), uniform(random, 0, 2));
    room.boxes.emplace_back(corner_m, corner_m + Eigen::Vector3d(uniform(random, 0.1, 1.0), uniform(random, 0.1, 1.0),
                                                                 uniform(random, 0.1, 1.0)));
  }
  return room;
}

common::Pose3 randomView(const Room& room, std::mt19937& random) {
  common::Pose3 pose;
  const auto blocked = [&](const Eigen::AlignedBox3d& box) { return box.exteriorDistance(pose.position_m) < 0.05; };
  do {
    pose.position_m = {uniform(random, -2.5, 3.5), uniform(random, -1.5, 2.5), uniform(random, 0.3, 2.2)};
  } while (std::any_of(room.boxes.begin(), room.boxes.end(), blocked));
  pose.rotation =
      common::quaternionFrom({uniform(random, -0.3, 0.3), uniform(random, -0.6, 0.6), uniform(random, -3.1, 3.1)});
  return pose;
}

common::DepthImage depthImage(const Room& room, const common::PinholeCamera& camera, const common::Pose3& T_map_camera,
                              std::mt19937& random, double unknown_share, double too_far_share) {
  common::DepthImage image{camera.width_px, camera.height_px, {}};
  image.depth_m.reserve(static_cast<std::size_t>(camera.pixels()));
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      // The component of the direction along the view is 1, so multiples of it are depths.
      const Eigen::Vector3d direction = T_map_camera.rotation * camera.point_camera_m(u, v, 1.0);
      double depth_m = crossing(room.walls, T_map_camera.position_m, direction).second;
      for (const Eigen::AlignedBox3d& box : room.boxes) {
        const auto [enters, leaves] = crossing(box, T_map_camera.position_m, direction);
        if (enters > 0.0 && enters < leaves) depth_m = std::min(depth_m, enters);
      }
      const double chance = uniform(random, 0, 1);
      image.depth_m.push_back(chance < unknown_share                   ? common::DepthImage::kUnknown
                              : chance < unknown_share + too_far_share ? common::DepthImage::kTooFar
                                                                       : static_cast<float>(depth_m));
    }
  }
  return image;
}

std::vector<Ray> raysFrom(const Eigen::Vector3d& origin_m, const std::vector<Eigen::Vector3d>& ends_m) {
  std::vector<Ray> rays;
  for (const Eigen::Vector3d& end_m : ends_m) rays.push_back({origin_m, end_m});
  return rays;
}

}  // namespace swiftlet::mapping3d
