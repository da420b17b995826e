// What is drawn above the grid: one function for each layer, in the order of drawing.
#pragma once

#include <vector>

#include "rendering/canvas.hpp"
#include "rendering/map_picture.hpp"
#include "rendering/theme.hpp"
#include "rendering/viewport.hpp"

namespace swiftlet::rendering {

/// The surface and the scale on which a layer is drawn.
struct Layer {
  Canvas& canvas;
  const Viewport& viewport;
  Scheme scheme;
  double scale;  ///< Scale of lines and text: 1 for a picture 640 pixels wide.

  const Theme& theme() const { return themeOf(scheme); }
};

void drawMetreLines(Layer& layer, const ShownFrame& shown);
void drawLevels(Layer& layer, const common::LevelMap& levels);
void drawFrontiers(Layer& layer, const std::vector<common::Frontier>& frontiers, double resolution_m);
void drawScan(Layer& layer, const std::vector<Eigen::Vector2f>& points_map_m);
void drawLine(Layer& layer, const MapLine& line);
void drawMark(Layer& layer, const MapMark& mark);
/// Scale bar at the lower left, axes at the lower right, with their name if they are not those of `map`.
void drawLegend(Layer& layer, const ShownFrame& shown);

}  // namespace swiftlet::rendering
