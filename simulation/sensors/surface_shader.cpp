#include "simulation/sensors/surface_shader.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/appearance/covering.hpp"

namespace swiftlet::simulation {
namespace {

Color sky(const Eigen::Vector3f& direction_world) {
  const float up = std::clamp(0.5F + 0.5F * direction_world.z(), 0.0F, 1.0F);
  return Color(0.75F, 0.8F, 0.86F) * (1.0F - up) + Color(0.45F, 0.6F, 0.85F) * up;
}

}  // namespace

SurfaceShader::SurfaceShader(const WorldModel& world) {
  for (const Shape& shape : world.shapes) {
    const Covering covering = coveringOf(shape);
    Surfaces surfaces;
    surfaces.color = shape.color;
    surfaces.R_shape_world = shape.T_world_shape.rotation.toRotationMatrix().transpose().cast<float>();
    surfaces.origin_world_m = shape.T_world_shape.position_m.cast<float>();
    surfaces.textures = {textureOf(covering.down, covering.variant), textureOf(covering.side, covering.variant),
                         textureOf(covering.up, covering.variant)};
    surfaces.colors = shape.colors;
    surfaces.color_of_triangle = shape.color_of_triangle;
    surfaces_.push_back(std::move(surfaces));
  }
}

const Texture* SurfaceShader::textureOf(Pattern pattern, std::uint64_t variant) {
  if (pattern == Pattern::kBlank) return nullptr;
  auto& texture = textures_[{pattern, variant}];
  if (!texture) texture = std::make_unique<const Texture>(makePattern(pattern, variant));
  return texture.get();
}

// The texture is laid onto the plane across the axis that the surface faces most.
Color SurfaceShader::colorAt(const Surfaces& surfaces, const Ray& ray, const Hit& hit, float pixel_rad) const {
  const Color& color = surfaces.color_of_triangle.empty()
                           ? surfaces.color
                           : surfaces.colors[surfaces.color_of_triangle[static_cast<std::size_t>(hit.triangle)]];
  const Eigen::Vector3f normal = surfaces.R_shape_world * hit.normal_world;
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const Texture* texture = surfaces.textures[axis < 2 ? 1 : (normal.z() < 0.0F ? 0 : 2)];
  if (texture == nullptr) return color;
  constexpr auto kPerMetre = static_cast<float>(1.0 / kPatternSide_m);
  const auto distance_m = static_cast<float>(hit.distance_m);
  const Eigen::Vector3f at =
      kPerMetre *
      (surfaces.R_shape_world * (ray.origin_world_m - surfaces.origin_world_m + distance_m * ray.direction_world));
  const float u = axis == 0 ? at.y() : at.x(), v = axis == 2 ? at.y() : -at.z();
  return texture->on(color, u, v, kPerMetre * pixel_rad * distance_m);
}

// Lambert twice: a lamp on the vehicle and a soft light from above, so that the walls of a corner differ.
SeenSurface SurfaceShader::see(const Ray& ray, const Hit& hit, float pixel_rad, std::span<const Actor> actors) const {
  if (!hit) return {sky(ray.direction_world)};
  static const Eigen::Vector3f kLight = Eigen::Vector3f(0.35F, 0.55F, 0.76F).normalized();
  const auto shape = static_cast<std::size_t>(hit.shape);
  const Color color = shape < surfaces_.size() ? colorAt(surfaces_[shape], ray, hit, pixel_rad)
                                               : actors[shape - surfaces_.size()].color;
  const float lamp = std::max(0.0F, -hit.normal_world.dot(ray.direction_world));
  const float light = 0.5F + 0.5F * hit.normal_world.dot(kLight);
  const float fade = 1.0F / (1.0F + 0.004F * static_cast<float>(hit.distance_m * hit.distance_m));
  return {color * (0.3F + 0.4F * light + 0.4F * lamp * fade), color.mean(), lamp};
}

}  // namespace swiftlet::simulation
