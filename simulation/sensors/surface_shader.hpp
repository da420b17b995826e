// The light that a camera sees from a surface, shared by the cameras of the simulator.
#pragma once

#include <span>
#include <vector>

#include "simulation/ray_caster.hpp"
#include "simulation/world_model.hpp"

namespace swiftlet::simulation {

/// Farther surfaces are not drawn.
inline constexpr double kSight_m = 60.0;

class SurfaceShader {
 public:
  explicit SurfaceShader(const WorldModel& world);

  /// `direction_world` is the unit direction of the ray; a ray that hit nothing sees the sky.
  Color shade(const Hit& hit, const Eigen::Vector3f& direction_world, std::span<const Actor> actors) const;

 private:
  std::vector<Color> colors_;  ///< By shape of the world.
};

}  // namespace swiftlet::simulation
