#include "simulation/sensors/camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/random.hpp"

namespace swiftlet::simulation {
namespace {

/// Farther surfaces are not drawn.
constexpr double kSight_m = 60.0;

Color sky(const Eigen::Vector3f& direction_world) {
  const float up = std::clamp(0.5F + 0.5F * direction_world.z(), 0.0F, 1.0F);
  return Color(0.75F, 0.8F, 0.86F) * (1.0F - up) + Color(0.45F, 0.6F, 0.85F) * up;
}

/// Grey noise, close enough to Gaussian: the sum of four bytes. One draw serves two pixels.
class PixelNoise {
 public:
  PixelNoise(double standard_deviation, common::RandomStream random)
      : scale_(static_cast<float>(standard_deviation / std::sqrt(4.0 * (256.0 * 256.0 - 1.0) / 12.0))),
        random_(random) {}

  float next() {
    if (left_ == 0) bits_ = random_.bits();
    left_ = left_ == 0 ? 1 : 0;
    int sum = 0;
    for (int byte = 0; byte < 4; ++byte, bits_ >>= 8U) sum += static_cast<int>(bits_ & 0xffU);
    return scale_ * (static_cast<float>(sum) - 510.0F);
  }

 private:
  float scale_;
  common::RandomStream random_;
  std::uint64_t bits_ = 0;
  int left_ = 0;
};

std::uint8_t toByte(float value) { return static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F)); }

}  // namespace

Camera::Camera(const CameraConfig& config, const WorldModel& world, std::uint64_t seed)
    : config_(config), seed_(seed), T_body_camera_(config.mount.pose()) {
  for (const Shape& shape : world.shapes) colors_.push_back(shape.color);
}

// Lambert twice: a lamp on the vehicle and a soft light from above, so that the walls of a corner differ.
Color Camera::shade(const Hit& hit, const Eigen::Vector3f& direction_world, std::span<const Actor> actors) const {
  if (!hit) return sky(direction_world);
  static const Eigen::Vector3f kLight = Eigen::Vector3f(0.35F, 0.55F, 0.76F).normalized();
  const auto shape = static_cast<std::size_t>(hit.shape);
  const Color color = shape < colors_.size() ? colors_[shape] : actors[shape - colors_.size()].color;
  const float lamp = std::max(0.0F, -hit.normal_world.dot(direction_world));
  const float light = 0.5F + 0.5F * hit.normal_world.dot(kLight);
  const float fade = 1.0F / (1.0F + 0.004F * static_cast<float>(hit.distance_m * hit.distance_m));
  return color * (0.3F + 0.4F * light + 0.4F * lamp * fade);
}

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
      const Color color = shade(hits[u], row[u].direction_world, actors);
      const float grey = noise.next();
      for (std::size_t channel = 0; channel < 3; ++channel)
        image.rgb[3 * (v * width + u) + channel] = toByte(255.0F * color[static_cast<int>(channel)] + grey);
    }
  }
  return image;
}

}  // namespace swiftlet::simulation
