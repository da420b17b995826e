#include "simulation/sensors/rgbd_camera.hpp"

#include <cmath>
#include <vector>

#include "common/random.hpp"
#include "simulation/sensors/pixel_noise.hpp"

namespace swiftlet::simulation {
namespace {

/// Standard deviation of a pixel, in grey levels of 255.
constexpr double kPixelNoise = 2.0;

}  // namespace

RgbdCamera::RgbdCamera(const common::RgbdCameraConfig& config, const RgbdErrorsConfig& errors, const WorldModel& world,
                       std::uint64_t seed)
    : config_(config),
      errors_(errors),
      seed_(seed),
      T_body_camera_(errors.mount_error.pose() * config.mount.pose()),
      shader_(world) {}

common::Time RgbdCamera::stampOf(common::Time time) const {
  return time + common::Duration::fromSeconds(errors_.clock_offset_s + errors_.clock_drift_ppm * 1e-6 * time.seconds());
}

common::RgbdFrame RgbdCamera::frame(std::uint64_t number, common::Time time, const common::Pose3& T_world_body,
                                    std::span<const Actor> actors, const RayCaster& rays) const {
  const common::Pose3 T_world_camera = T_world_body * T_body_camera_;
  const Eigen::Matrix3f R_world_camera = T_world_camera.rotation.toRotationMatrix().cast<float>();
  common::RgbdFrame frame;
  frame.stamps.measured = stampOf(time);
  frame.row_time = common::Duration::fromSeconds(config_.row_time_s);
  frame.camera = config_.camera();
  const int width = frame.camera.width_px, height = frame.camera.height_px;
  frame.color = {width, height, {}};
  frame.depth = {width, height, {}};
  frame.color.rgb.reserve(static_cast<std::size_t>(3 * width * height));
  frame.depth.depth_m.reserve(static_cast<std::size_t>(width * height));
  const auto pixel_rad = static_cast<float>(1.0 / frame.camera.fx_px);
  PixelNoise noise(kPixelNoise, common::RandomStream(seed_, "rgbd color", number));
  std::vector<Ray> row(static_cast<std::size_t>(width));
  std::vector<Hit> hits(row.size());
  std::vector<float> cosines(row.size());
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const Eigen::Vector3f along = frame.camera.point_camera_m(u, v, 1.0).cast<float>();
      const float cosine = 1.0F / along.norm();
      cosines[static_cast<std::size_t>(u)] = cosine;
      row[static_cast<std::size_t>(u)] = {T_world_camera.position_m.cast<float>(), R_world_camera * along * cosine};
    }
    rays.castAll(row, kSight_m, actors, hits);
    for (std::size_t u = 0; u < row.size(); ++u) {
      const Color color = 255.0F * shader_.shade(row[u], hits[u], pixel_rad, actors);
      const float grey = noise.next();
      for (int channel = 0; channel < 3; ++channel) frame.color.rgb.push_back(toPixelByte(color[channel] + grey));
      frame.depth.depth_m.push_back(cosines[u] * static_cast<float>(hits[u].distance_m));
    }
  }
  measureDepths(number, frame.depth);
  return frame;
}

void RgbdCamera::measureDepths(std::uint64_t number, common::DepthImage& depth) const {
  PixelNoise noise(config_.inverse_depth_noise_1_m, common::RandomStream(seed_, "rgbd depth", number));
  const auto step_1_m = static_cast<float>(config_.inverse_depth_step_1_m),
             step_m = static_cast<float>(config_.depth_step_m);
  for (float& depth_m : depth.depth_m) {
    float inverse_1_m = 1.0F / depth_m + noise.next();
    if (step_1_m > 0.0F) inverse_1_m = step_1_m * std::round(inverse_1_m / step_1_m);
    depth_m = inverse_1_m > 0.0F ? 1.0F / inverse_1_m : common::DepthImage::kTooFar;
    if (step_m > 0.0F) depth_m = step_m * std::round(depth_m / step_m);
    if (depth_m < static_cast<float>(config_.range_min_m)) depth_m = common::DepthImage::kUnknown;
    if (depth_m > static_cast<float>(config_.range_max_m)) depth_m = common::DepthImage::kTooFar;
  }
}

}  // namespace swiftlet::simulation
