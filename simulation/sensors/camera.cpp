#include "simulation/sensors/camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/random.hpp"
#include "simulation/sensors/pixel_noise.hpp"

namespace swiftlet::simulation {
Camera::Camera(const CameraConfig& config, const WorldModel& world, std::uint64_t seed)
    : config_(config), seed_(seed), T_body_camera_(config.mount.pose()), shader_(world) {}

common::Image Camera::render(std::uint64_t frame, const common::Pose3& T_world_body, std::span<const Actor> actors,
                             const RayCaster& rays) const {
  const common::Pose3 T_world_camera = T_world_body * T_body_camera_;
  const Eigen::Matrix3f R_world_camera = T_world_camera.rotation.toRotationMatrix().cast<float>();
  const auto width = static_cast<std::size_t>(config_.width_px), height = static_cast<std::size_t>(config_.height_px);
  const float half_width = 0.5F * static_cast<float>(width), half_height = 0.5F * static_cast<float>(height);
  const float focal_px =
      half_width / static_cast<float>(std::tan(0.5 * config_.field_of_view_deg * std::numbers::pi / 180.0));
  PixelNoise noise(config_.pixel_noise, common::RandomStream(seed_, "camera", frame));

  common::Image image{config_.width_px, config_.height_px, std::vector<std::uint8_t>(3 * width * height)};
  std::vector<Ray> row(width);
  std::vector<Hit> hits(width);
  for (std::size_t v = 0; v < height; ++v) {
    for (std::size_t u = 0; u < width; ++u) {
      const Eigen::Vector3f direction_camera(focal_px, half_width - static_cast<float>(u) - 0.5F,
                                             half_height - static_cast<float>(v) - 0.5F);
      row[u] = {T_world_camera.position_m.cast<float>(), (R_world_camera * direction_camera).normalized()};
    }
    rays.castAll(row, kSight_m, actors, hits);
    for (std::size_t u = 0; u < width; ++u) {
      const Color color = shader_.see(row[u], hits[u], 1.0F / focal_px, actors).light;
      const float grey = noise.next();
      for (std::size_t channel = 0; channel < 3; ++channel)
        image.rgb[3 * (v * width + u) + channel] = toPixelByte(255.0F * color[static_cast<int>(channel)] + grey);
    }
  }
  return image;
}

}  // namespace swiftlet::simulation
