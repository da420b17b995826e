// The light that a camera sees from a surface, shared by the cameras of the simulator.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "simulation/appearance/patterns.hpp"
#include "simulation/appearance/texture.hpp"
#include "simulation/ray_caster.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {

/// Farther surfaces are not drawn.
inline constexpr double kSight_m = 60.0;

struct SeenSurface {
  Color light = Color::Zero();  ///< White under the lamp is about 1.
  float reflectance = 1.0F;     ///< Mean of the surface's colour.
  float cos_incidence = 1.0F;   ///< Of the angle between the ray and the surface's normal.
};

/// Const calls are safe from several threads.
class SurfaceShader {
 public:
  /// Makes the textures, which takes some milliseconds each.
  explicit SurfaceShader(const WorldModel& world);

  /// What a pixel of `pixel_rad` sees along a ray; without a hit it sees the sky.
  SeenSurface see(const Ray& ray, const Hit& hit, float pixel_rad, std::span<const Actor> actors) const;

 private:
  /// The surfaces of one shape, by where they face in the shape's own frame.
  struct Surfaces {
    Color color;
    Eigen::Matrix3f R_shape_world;
    Eigen::Vector3f origin_world_m;
    std::array<const Texture*, 3> textures{};  ///< Facing down, sideways, up; null if blank.
    std::vector<Color> colors;                 ///< Of a mesh with several materials.
    std::vector<std::uint16_t> color_of_triangle;
  };
  const Texture* textureOf(Pattern pattern, std::uint64_t variant);
  Color colorAt(const Surfaces& surfaces, const Ray& ray, const Hit& hit, float pixel_rad) const;

  std::map<std::pair<Pattern, std::uint64_t>, std::unique_ptr<const Texture>> textures_;
  std::vector<Surfaces> surfaces_;  ///< By shape of the world.
};

}  // namespace swiftlet::simulation
