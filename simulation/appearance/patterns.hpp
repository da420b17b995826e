// Textures that the program makes itself: what walls, floors and furniture are covered with.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "simulation/appearance/texture.hpp"

namespace swiftlet::simulation {

enum class Pattern {
  kBlank,    ///< Nothing but the surface's colour.
  kPlaster,  ///< Faint stains and grain.
  kWood,     ///< Planks with grain.
  kBrick,    ///< A brick wall with mortar.
  kCarpet,   ///< Coarse weave with a motif.
  kTiles,    ///< Square tiles with joints.
  kPosters,  ///< Plaster with pictures and notices on it.
  kLawn,     ///< Tufts of grass and bare places.
};

/// The words of the patterns, in the order of the enumerators.
const std::vector<std::string>& patternWords();
std::optional<Pattern> patternFrom(const std::string& word);

/// Side of the square that one repetition of a pattern covers.
inline constexpr double kPatternSide_m = 2.56;

/// The texture of a pattern other than kBlank. `variant` changes its details.
Texture makePattern(Pattern pattern, std::uint64_t variant);

}  // namespace swiftlet::simulation
