// Which pattern covers the surfaces of a shape.
#pragma once

#include <cstdint>

#include "simulation/appearance/patterns.hpp"

namespace swiftlet::simulation {

struct Shape;

/// By where a surface faces: up, sideways or down.
struct Covering {
  Pattern up = Pattern::kBlank;
  Pattern side = Pattern::kBlank;
  Pattern down = Pattern::kBlank;
  std::uint64_t variant = 0;  ///< For makePattern.
};

/// The pattern that the shape's material names covers it all. Otherwise its size tells a floor, a wall or furniture,
/// and its name draws one of the patterns that such a thing has; every fourth wall and most ceilings are blank. The
/// same shape always gets the same covering.
Covering coveringOf(const Shape& shape);

}  // namespace swiftlet::simulation
