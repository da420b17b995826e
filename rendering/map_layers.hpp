// What is drawn above the grid, one function a layer, in the order they lie.
#pragma once

#include <optional>
#include <vector>

#include "common/world.hpp"
#include "rendering/canvas.hpp"
#include "rendering/theme.hpp"
#include "rendering/viewport.hpp"

namespace swiftlet::rendering {

/// Where and with what a layer is drawn.
struct Layer {
  Canvas& canvas;
  const Viewport& viewport;
  Scheme scheme;
  double scale;  ///< Of lines and text: 1 for a picture 640 pixels wide.

  const Theme& theme() const { return themeOf(scheme); }
};

void drawMetreLines(Layer& layer);
void drawLevels(Layer& layer, const common::LevelMap& levels);
void drawFrontiers(Layer& layer, const std::vector<common::Frontier>& frontiers, double resolution_m);
void drawLaser(Layer& layer, const common::LaserPoints& laser);
/// Up to the vehicle, where there is one: the trail's last point may be older than its pose.
void drawTrail(Layer& layer, const std::vector<Eigen::Vector2d>& trail_map_m,
               const std::optional<Eigen::Vector2d>& vehicle_map_m);
void drawPlan(Layer& layer, const std::vector<Eigen::Vector2d>& plan_map_m, const Eigen::Vector2d& vehicle_map_m);
void drawHome(Layer& layer, const Eigen::Vector2d& home_map_m);
void drawGoal(Layer& layer, const Eigen::Vector2d& goal_map_m);
void drawVehicle(Layer& layer, const common::Pose2& T_map_body, double hull_diameter_m);
/// Scale bar at the lower left, axes at the lower right.
void drawLegend(Layer& layer);

}  // namespace swiftlet::rendering
