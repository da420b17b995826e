// Which surfaces daylight falls on: it dazzles a laser there, and leaves rooms darker than yards for cameras.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulation/actor.hpp"
#include "simulation/ray_caster.hpp"

namespace swiftlet::simulation {

/// By ray: 1 where the surface that it hits sees the sky halfway between its normal and the zenith, or where it hits
/// nothing; 0 under a roof, and on what faces down. One direction stands for the whole sky.
std::vector<std::uint8_t> inDaylight(std::span<const Ray> rays, std::span<const Hit> hits,
                                     std::span<const Actor> actors, const RayCaster& caster);

}  // namespace swiftlet::simulation
