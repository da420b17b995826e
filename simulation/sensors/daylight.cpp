#include "simulation/sensors/daylight.hpp"

#include <cmath>

namespace swiftlet::simulation {

std::vector<std::uint8_t> inDaylight(std::span<const Ray> rays, std::span<const Hit> hits,
                                     std::span<const Actor> actors, const RayCaster& caster) {
  constexpr float kOffSurface_m = 0.005F;  // Above the rounding of a hit 60 m away.
  constexpr double kHighest_m = 60.0;      // What shades from farther up is the sky's.
  std::vector<std::uint8_t> lit(hits.size(), 1);
  std::vector<Ray> up;
  std::vector<std::size_t> from;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i]) continue;
    const Eigen::Vector3f& normal = hits[i].normal_world;
    const Eigen::Vector3f towards = normal + Eigen::Vector3f::UnitZ();
    constexpr float kFacesDown = 0.5F;  // A normal that is 60 degrees and more below the horizon.
    if (towards.norm() < kFacesDown) {
      lit[i] = 0;
      continue;
    }
    const Eigen::Vector3f at_m =
        rays[i].origin_world_m + static_cast<float>(hits[i].distance_m) * rays[i].direction_world;
    up.push_back({at_m + kOffSurface_m * normal, towards.normalized()});
    from.push_back(i);
  }
  std::vector<float> shade_m(up.size());
  caster.castAll(up, kHighest_m, actors, shade_m);
  for (std::size_t i = 0; i < up.size(); ++i) lit[from[i]] = std::isinf(shade_m[i]) ? 1 : 0;
  return lit;
}

}  // namespace swiftlet::simulation
