// The light that a camera sees from a surface, shared by the cameras of the simulator.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <span>
#include <string>
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
  /// Makes or reads the textures, which takes some milliseconds each. A picture that cannot be read is left out. The
  /// world must outlive it and stay as it is.
  explicit SurfaceShader(const WorldModel& world);

  /// What a pixel of `pixel_rad` sees along a ray; without a hit it sees the sky.
  SeenSurface see(const Ray& ray, const Hit& hit, float pixel_rad, std::span<const Actor> actors) const;
  /// Share of that light where no daylight falls.
  float indoorLight() const { return indoor_light_; }

 private:
  /// The surfaces of one shape.
  struct Surfaces {
    const Shape* shape = nullptr;
    Eigen::Matrix3f R_shape_world;
    Eigen::Vector3f origin_world_m;
    std::array<const Texture*, 3> patterns{};  ///< Of what faces down, sideways, up in its own frame; null if blank.
    const Texture* image = nullptr;            ///< Stretched over each side; null without an image.
    Eigen::Vector3f low_m, size_m;             ///< Of the box around the shape, in its own frame.
    std::vector<const Texture*> images;        ///< Of the materials; null without a picture.
  };
  const Texture* patternTexture(Pattern pattern, std::uint64_t variant);
  const Texture* imageTexture(const std::string& file);
  Color colorAt(const Surfaces& surfaces, const Ray& ray, const Hit& hit, float pixel_rad) const;

  std::map<std::pair<Pattern, std::uint64_t>, std::unique_ptr<const Texture>> patterns_;
  std::map<std::string, std::unique_ptr<const Texture>> images_;  ///< By file; null if it cannot be read.
  Color world_light_;
  float indoor_light_;
  std::vector<Surfaces> surfaces_;  ///< By shape of the world.
};

}  // namespace swiftlet::simulation
