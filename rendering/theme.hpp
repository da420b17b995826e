// The colours of a map picture. The page's style sheet has the same values, so that a stream and the page look alike.
// Each but that of the grid has a contrast of at least 3:1 (WCAG 2.1, 1.4.11) with free space, also for the
// colour-blind; walls and free space have it with the unknown, too.
#pragma once

#include <optional>
#include <string_view>

#include "common/world/frontier.hpp"
#include "rendering/color.hpp"

namespace swiftlet::rendering {

enum class Scheme { kLight, kDark };

/// "light" or "dark".
std::optional<Scheme> schemeFrom(std::string_view word);

struct Theme {
  Color unknown;    ///< Never observed cells.
  Color free;       ///< Cells that are certainly free.
  Color wall;       ///< Cells that are certainly occupied.
  Color behind_3d;  ///< Behind all that a 3D picture shows.
  Color grid;       ///< The lines every metre.
  Color text;
  Color trail;
  Color plan;
  Color goal;
  Color home;
  Color vehicle;
  Color laser;
  Color level;  ///< Surfaces above the floor, with the height in their opacity.
};

const Theme& themeOf(Scheme scheme);

/// A bright colour for open frontiers; the colour of the others shows why they were left.
Color frontierColor(common::FrontierReason reason, Scheme scheme);

}  // namespace swiftlet::rendering
