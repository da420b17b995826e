#include "simulation/sensors/surface_shader.hpp"

#include <algorithm>

namespace swiftlet::simulation {
namespace {

Color sky(const Eigen::Vector3f& direction_world) {
  const float up = std::clamp(0.5F + 0.5F * direction_world.z(), 0.0F, 1.0F);
  return Color(0.75F, 0.8F, 0.86F) * (1.0F - up) + Color(0.45F, 0.6F, 0.85F) * up;
}

}  // namespace

SurfaceShader::SurfaceShader(const WorldModel& world) {
  for (const Shape& shape : world.shapes) colors_.push_back(shape.color);
}

// Lambert twice: a lamp on the vehicle and a soft light from above, so that the walls of a corner differ.
Color SurfaceShader::shade(const Hit& hit, const Eigen::Vector3f& direction_world,
                           std::span<const Actor> actors) const {
  if (!hit) return sky(direction_world);
  static const Eigen::Vector3f kLight = Eigen::Vector3f(0.35F, 0.55F, 0.76F).normalized();
  const auto shape = static_cast<std::size_t>(hit.shape);
  const Color color = shape < colors_.size() ? colors_[shape] : actors[shape - colors_.size()].color;
  const float lamp = std::max(0.0F, -hit.normal_world.dot(direction_world));
  const float light = 0.5F + 0.5F * hit.normal_world.dot(kLight);
  const float fade = 1.0F / (1.0F + 0.004F * static_cast<float>(hit.distance_m * hit.distance_m));
  return color * (0.3F + 0.4F * light + 0.4F * lamp * fade);
}

}  // namespace swiftlet::simulation
