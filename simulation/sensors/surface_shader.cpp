#include "simulation/sensors/surface_shader.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "common/error.hpp"
#include "common/image_decoder.hpp"
#include "common/read_bytes.hpp"
#include "simulation/appearance/covering.hpp"

namespace swiftlet::simulation {
namespace {

/// A picture of 8192 pixels a side, hardly compressed.
constexpr std::size_t kMostImageBytes = std::size_t{256} << 20U;

Color sky(const Eigen::Vector3f& direction_world) {
  const float up = std::clamp(0.5F + 0.5F * direction_world.z(), 0.0F, 1.0F);
  return Color(0.75F, 0.8F, 0.86F) * (1.0F - up) + Color(0.45F, 0.6F, 0.85F) * up;
}

/// Where a hit is in the picture of its material, and how many of the picture's widths a metre of the surface is there.
struct ImagePlace {
  Eigen::Vector2f at;
  float per_metre;
};

ImagePlace imagePlace(const Shape& shape, const Hit& hit) {
  const auto& corners = shape.triangles[static_cast<std::size_t>(hit.triangle)];
  const Eigen::Vector2f a = shape.image_places[corners[0]];
  const Eigen::Vector2f ab = shape.image_places[corners[1]] - a, ac = shape.image_places[corners[2]] - a;
  const Eigen::Vector3f from_m = shape.vertices_world_m[corners[0]];
  const Eigen::Vector3f ab_m = shape.vertices_world_m[corners[1]] - from_m,
                        ac_m = shape.vertices_world_m[corners[2]] - from_m;
  const float area_m2 = ab_m.cross(ac_m).norm(), area = std::abs(ab.x() * ac.y() - ab.y() * ac.x());
  return {a + hit.corner_shares.x() * ab + hit.corner_shares.y() * ac,
          area_m2 > 0.0F ? std::sqrt(area / area_m2) : 0.0F};
}

}  // namespace

SurfaceShader::SurfaceShader(const WorldModel& world) : world_light_(world.light), indoor_light_(world.indoor_light) {
  for (const Shape& shape : world.shapes) {
    const Covering covering = coveringOf(shape);
    const common::Pose3 T_shape_world = shape.T_world_shape.inverse();
    Surfaces surfaces;
    surfaces.shape = &shape;
    surfaces.R_shape_world = T_shape_world.rotation.toRotationMatrix().cast<float>();
    surfaces.origin_world_m = shape.T_world_shape.position_m.cast<float>();
    surfaces.patterns = {patternTexture(covering.down, covering.variant),
                         patternTexture(covering.side, covering.variant),
                         patternTexture(covering.up, covering.variant)};
    surfaces.image = imageTexture(shape.image);
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& vertex : shape.vertices_world_m)
      box.extend(surfaces.R_shape_world * (vertex - surfaces.origin_world_m));
    surfaces.low_m = box.min();
    surfaces.size_m = box.sizes().cwiseMax(1e-6F);
    for (const SurfaceMaterial& material : shape.materials) surfaces.images.push_back(imageTexture(material.image));
    surfaces_.push_back(std::move(surfaces));
  }
}

const Texture* SurfaceShader::patternTexture(Pattern pattern, std::uint64_t variant) {
  if (pattern == Pattern::kBlank) return nullptr;
  auto& texture = patterns_[{pattern, variant}];
  if (!texture) texture = std::make_unique<const Texture>(makePattern(pattern, variant));
  return texture.get();
}

const Texture* SurfaceShader::imageTexture(const std::string& file) {
  if (file.empty()) return nullptr;
  const auto [entry, is_new] = images_.try_emplace(file);
  if (!is_new) return entry->second.get();
  try {
    if (const auto image = common::decodeColor(common::readBytes(file, kMostImageBytes)))
      entry->second = std::make_unique<const Texture>(Texture::of(*image));
  } catch (const common::InputError&) {
    // It was there when the world was loaded; without it the surface has its colour.
  }
  return entry->second.get();
}

// A pattern, or a picture without places of its own, is laid onto the plane across the axis that the surface faces
// most.
Color SurfaceShader::colorAt(const Surfaces& surfaces, const Ray& ray, const Hit& hit, float pixel_rad) const {
  const Shape& shape = *surfaces.shape;
  Color color = shape.color;
  const auto distance_m = static_cast<float>(hit.distance_m);
  if (!surfaces.images.empty()) {
    const std::size_t material = shape.material_of_triangle[static_cast<std::size_t>(hit.triangle)];
    color = shape.materials[material].color;
    if (const Texture* image = surfaces.images[material]) {
      const ImagePlace place = imagePlace(shape, hit);
      return image->on(color, place.at.x(), place.at.y(), place.per_metre * pixel_rad * distance_m);
    }
  }
  const Eigen::Vector3f normal = surfaces.R_shape_world * hit.normal_world;
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const Texture* pattern = surfaces.patterns[axis < 2 ? 1 : (normal.z() < 0.0F ? 0 : 2)];
  if (pattern == nullptr && surfaces.image == nullptr) return color;
  const Eigen::Vector3f at_m =
      surfaces.R_shape_world * (ray.origin_world_m - surfaces.origin_world_m + distance_m * ray.direction_world);
  const int along = axis == 0 ? 1 : 0, up = axis == 2 ? 1 : 2;
  if (surfaces.image != nullptr) {
    const Eigen::Vector3f share = (at_m - surfaces.low_m).cwiseQuotient(surfaces.size_m);
    return surfaces.image->on(color, share[along], 1.0F - share[up], pixel_rad * distance_m / surfaces.size_m[along]);
  }
  constexpr auto kPerMetre = static_cast<float>(1.0 / kPatternSide_m);
  return pattern->on(color, kPerMetre * at_m[along], (axis == 2 ? kPerMetre : -kPerMetre) * at_m[up],
                     kPerMetre * pixel_rad * distance_m);
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
  return {color.cwiseProduct(world_light_) * (0.3F + 0.4F * light + 0.4F * lamp * fade), color.mean(), lamp};
}

}  // namespace swiftlet::simulation
