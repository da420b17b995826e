#include "rendering/map_layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace swiftlet::rendering {
namespace {

using Eigen::Vector2d;

/// A lower level counts as the floor.
constexpr double kFloor_m = 0.05;

void drawLevel(Layer& layer, const common::Level& level, double resolution_m) {
  const double px = layer.viewport.px_per_m * resolution_m;
  const Color color =
      layer.theme().level.withAlpha(static_cast<std::uint8_t>(std::min(170.0, 45.0 + 90.0 * std::abs(level.height_m))));
  Vector2d sum = Vector2d::Zero();
  for (const common::CellIndex& cell : level.cells) {
    const Vector2d corner = layer.viewport.toPixel(Vector2d(cell.x, cell.y + 1) * resolution_m);
    layer.canvas.fillRect(corner.x(), corner.y(), corner.x() + px, corner.y() + px, color);
    sum += Vector2d(cell.x + 0.5, cell.y + 0.5) * resolution_m;
  }
  const Vector2d middle = layer.viewport.toPixel(sum / static_cast<double>(level.cells.size()));
  const double height_px = 9.0 * layer.scale;
  layer.canvas.text(fmt::format("{:.2f} m", level.height_m), {middle.x(), middle.y() + 0.5 * height_px}, height_px,
                    layer.theme().text, Align::kCenter, layer.theme().free.withAlpha(200));
}

void drawHome(Layer& layer, const MapMark& mark) {
  const Vector2d at = layer.viewport.toPixel(mark.at_map.position_m());
  const double s = layer.scale;
  layer.canvas.disc(at, 8.5 * s, layer.theme().free.withAlpha(230));
  layer.canvas.ring(at, 8.5 * s, 1.6 * s, layer.theme().home);
  const std::array<Vector2d, 5> house{at + Vector2d(-3.6, 3.8) * s, at + Vector2d(-3.6, -0.6) * s,
                                      at + Vector2d(0.0, -4.4) * s, at + Vector2d(3.6, -0.6) * s,
                                      at + Vector2d(3.6, 3.8) * s};
  layer.canvas.polygon(house, layer.theme().home);
}

void drawGoal(Layer& layer, const MapMark& mark) {
  const Vector2d at = layer.viewport.toPixel(mark.at_map.position_m());
  const double s = layer.scale;
  layer.canvas.ring(at, 8.0 * s, 4.5 * s, layer.theme().free.withAlpha(200));
  layer.canvas.ring(at, 8.0 * s, 2.2 * s, layer.theme().goal);
  for (const Vector2d& direction : {Vector2d(1, 0), Vector2d(-1, 0), Vector2d(0, 1), Vector2d(0, -1)})
    layer.canvas.line(at + 8.0 * s * direction, at + 12.5 * s * direction, 2.2 * s, layer.theme().goal);
  layer.canvas.disc(at, 2.4 * s, layer.theme().goal);
}

/// A diamond with its name; hollow while it is only a candidate, and with an arrow at it once it is found, as Saeedi et
/// al. mark it.
void drawTarget(Layer& layer, const MapMark& mark) {
  const Vector2d at = layer.viewport.toPixel(mark.at_map.position_m());
  const double s = layer.scale;
  const auto diamond = [&](double radius) {
    return std::array<Vector2d, 4>{at + Vector2d(radius, 0.0), at + Vector2d(0.0, -radius), at - Vector2d(radius, 0.0),
                                   at + Vector2d(0.0, radius)};
  };
  layer.canvas.polygon(diamond(9.0 * s), layer.theme().free.withAlpha(230));
  layer.canvas.polygon(diamond(7.0 * s), layer.theme().goal);
  if (mark.style == MarkStyle::kCandidate) {
    layer.canvas.polygon(diamond(4.0 * s), layer.theme().free);
  } else {
    const std::array<Vector2d, 3> head{at + Vector2d(-4.5, -17.0) * s, at + Vector2d(4.5, -17.0) * s,
                                       at + Vector2d(0.0, -10.0) * s};
    layer.canvas.line(at + Vector2d(0.0, -27.0) * s, at + Vector2d(0.0, -16.0) * s, 2.4 * s, layer.theme().goal);
    layer.canvas.polygon(head, layer.theme().goal);
  }
  layer.canvas.text(mark.name, at + Vector2d(11.0, 3.5) * s, 9.0 * s, layer.theme().text, Align::kLeft,
                    layer.theme().free.withAlpha(200));
}

/// The width of a window or a door between its two sides, with its name on the side of the normal; what lets nothing
/// through is crossed out.
void drawOpening(Layer& layer, const MapMark& mark) {
  const double s = layer.scale;
  const auto place = [&](double normal_m, double along_m) {
    return layer.viewport.toPixel(mark.at_map * Vector2d(normal_m, along_m));
  };
  const double half_m = 0.5 * mark.diameter_m, side_m = 6.0 * s / layer.viewport.px_per_m;
  const Color color = layer.theme().goal, halo = layer.theme().free.withAlpha(220);
  for (const double width : {6.0 * s, 2.6 * s}) {
    const Color stroke = width > 3.0 * s ? halo : color;
    layer.canvas.line(place(0.0, -half_m), place(0.0, half_m), width, stroke);
    for (const double end_m : {-half_m, half_m})
      layer.canvas.line(place(-side_m, end_m), place(side_m, end_m), width, stroke);
    if (mark.style == MarkStyle::kClosed) {
      layer.canvas.line(place(-side_m, -half_m), place(side_m, half_m), width, stroke);
      layer.canvas.line(place(side_m, -half_m), place(-side_m, half_m), width, stroke);
    }
  }
  layer.canvas.text(mark.name, place(2.2 * side_m, 0.0) + Vector2d(0.0, 3.0 * s), 9.0 * s, layer.theme().text,
                    Align::kCenter, halo);
}

void drawVehicle(Layer& layer, const MapMark& mark) {
  const Theme& theme = layer.theme();
  const Vector2d at = layer.viewport.toPixel(mark.at_map.position_m());
  const double radius = std::max(7.0 * layer.scale, 0.5 * mark.diameter_m * layer.viewport.px_per_m);
  const double width = std::clamp(0.14 * radius, 1.4 * layer.scale, 3.0 * layer.scale);
  layer.canvas.disc(at, radius, theme.vehicle.withAlpha(70));
  layer.canvas.ring(at, radius, width, theme.vehicle);
  const auto ahead = [&](double along, double left) {
    const double c = std::cos(mark.at_map.yaw_rad), s = std::sin(mark.at_map.yaw_rad);
    return Vector2d(at + radius * Vector2d(c * along - s * left, -(s * along + c * left)));
  };
  const std::array<Vector2d, 4> arrow{ahead(0.78, 0.0), ahead(-0.52, 0.48), ahead(-0.26, 0.0), ahead(-0.52, -0.48)};
  layer.canvas.polygon(arrow, theme.vehicle);
}

/// The nearest 1, 2 or 5 times a power of ten.
double roundLength(double longest) {
  const double power = std::pow(10.0, std::floor(std::log10(longest)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= longest) return factor * power;
  return power;
}

/// Along the axes of a frame that is turned against the picture.
void drawTurnedMetreLines(Layer& layer, const common::Pose2& T_map_shown, double every_m) {
  const Viewport& v = layer.viewport;
  const common::Pose2 T_shown_map = T_map_shown.inverse();
  const Vector2d middle_m = T_shown_map * v.toMap({0.5 * v.width_px, 0.5 * v.height_px});
  const double reach_m = 0.5 * std::hypot(v.width_px, v.height_px) / v.px_per_m;
  for (const int axis : {0, 1}) {
    Vector2d from_m = middle_m.array() - reach_m, to_m = middle_m.array() + reach_m;
    const double end_m = to_m[axis];
    for (double at_m = std::ceil(from_m[axis] / every_m) * every_m; at_m <= end_m; at_m += every_m) {
      from_m[axis] = to_m[axis] = at_m;
      layer.canvas.line(v.toPixel(T_map_shown * from_m), v.toPixel(T_map_shown * to_m), 1.0, layer.theme().grid);
    }
  }
}

}  // namespace

void drawMetreLines(Layer& layer, const ShownFrame& shown) {
  const Viewport& v = layer.viewport;
  const double every_m = v.px_per_m >= 14.0 ? 1.0 : v.px_per_m >= 3.0 ? 5.0 : 20.0;
  if (shown.given) return drawTurnedMetreLines(layer, shown.T_map_shown, every_m);
  const Vector2d low = v.toMap({0.0, static_cast<double>(v.height_px)});
  const Vector2d high = v.toMap({static_cast<double>(v.width_px), 0.0});
  for (double x = std::ceil(low.x() / every_m) * every_m; x <= high.x(); x += every_m) {
    const double px = std::floor(v.toPixel({x, 0.0}).x());
    layer.canvas.fillRect(px, 0.0, px + 1.0, v.height_px, layer.theme().grid);
  }
  for (double y = std::ceil(low.y() / every_m) * every_m; y <= high.y(); y += every_m) {
    const double py = std::floor(v.toPixel({0.0, y}).y());
    layer.canvas.fillRect(0.0, py, v.width_px, py + 1.0, layer.theme().grid);
  }
}

void drawLevels(Layer& layer, const common::LevelMap& levels) {
  for (const common::Level& level : levels.levels)
    if (!level.cells.empty() && std::abs(level.height_m) > kFloor_m) drawLevel(layer, level, levels.resolution_m);
}

void drawFrontiers(Layer& layer, const std::vector<common::Frontier>& frontiers, double resolution_m) {
  const double radius_px = std::max(1.3 * layer.scale, 0.45 * resolution_m * layer.viewport.px_per_m);
  std::vector<Vector2d> centers;
  for (const common::Frontier& frontier : frontiers) {
    centers.clear();
    for (const common::CellIndex& c : frontier.cells)
      centers.push_back(layer.viewport.toPixel(Vector2d(c.x + 0.5, c.y + 0.5) * resolution_m));
    layer.canvas.discs(centers, radius_px, frontierColor(frontier.reason, layer.scheme).withAlpha(220));
  }
}

void drawScan(Layer& layer, const std::vector<Eigen::Vector2f>& points_map_m) {
  std::vector<Vector2d> centers;
  centers.reserve(points_map_m.size());
  for (const Eigen::Vector2f& point : points_map_m) centers.push_back(layer.viewport.toPixel(point.cast<double>()));
  layer.canvas.discs(centers, 0.9 * layer.scale, layer.theme().laser);
}

void drawLine(Layer& layer, const MapLine& line) {
  const double s = layer.scale;
  std::vector<Vector2d> pixels;
  pixels.reserve(line.points_map_m.size());
  for (const Vector2d& point : line.points_map_m) pixels.push_back(layer.viewport.toPixel(point));
  switch (line.style) {
    case LineStyle::kTrail:
      return layer.canvas.polyline(pixels, 2.2 * s, layer.theme().trail);
    case LineStyle::kTrack:
      return layer.canvas.polyline(pixels, 1.5 * s, layer.theme().trail);
    case LineStyle::kReference:
      return layer.canvas.dashedPolyline(pixels, 1.5 * s, 5.0 * s, 4.0 * s, layer.theme().text);
    case LineStyle::kPlan:
      layer.canvas.dashedPolyline(pixels, 2.4 * s, 7.0 * s, 5.5 * s, layer.theme().plan);
      if (!pixels.empty()) layer.canvas.disc(pixels.back(), 3.2 * s, layer.theme().plan);
  }
}

void drawMark(Layer& layer, const MapMark& mark) {
  switch (mark.style) {
    case MarkStyle::kHome:
      return drawHome(layer, mark);
    case MarkStyle::kGoal:
      return drawGoal(layer, mark);
    case MarkStyle::kTarget:
    case MarkStyle::kCandidate:
      return drawTarget(layer, mark);
    case MarkStyle::kOpen:
    case MarkStyle::kClosed:
      return drawOpening(layer, mark);
    case MarkStyle::kVehicle:
      return drawVehicle(layer, mark);
  }
}

void drawLegend(Layer& layer, const ShownFrame& shown) {
  const Theme& theme = layer.theme();
  const double s = layer.scale, bottom = layer.viewport.height_px - 14.0 * s;
  const double length_m = roundLength(110.0 * s / layer.viewport.px_per_m);
  const double x0 = 14.0 * s, x1 = x0 + length_m * layer.viewport.px_per_m;
  const Color halo = theme.unknown.withAlpha(220);
  for (const double extra : {2.0 * s, 0.0}) {
    const Color color = extra > 0.0 ? halo : theme.text;
    const std::array<Vector2d, 4> bar{Vector2d(x0, bottom - 5.0 * s), Vector2d(x0, bottom), Vector2d(x1, bottom),
                                      Vector2d(x1, bottom - 5.0 * s)};
    layer.canvas.polyline(bar, 1.5 * s + 2.0 * extra, color);
  }
  layer.canvas.text(fmt::format("{:g} m", length_m), {0.5 * (x0 + x1), bottom - 6.0 * s}, 8.5 * s, theme.text,
                    Align::kCenter, halo);

  // Turned, the arrows may point anywhere: their origin is farther from the edges then.
  const Vector2d origin(layer.viewport.width_px - 46.0 * s, bottom - (shown.given ? 40.0 * s : 0.0));
  const auto arrow = [&](const Vector2d& direction, const char* name, Color color) {
    const Vector2d tip = origin + 22.0 * s * direction, side(-direction.y(), direction.x());
    layer.canvas.line(origin, tip, 1.6 * s, color);
    const std::array<Vector2d, 3> head{tip + 5.0 * s * direction, tip + 3.4 * s * side, tip - 3.4 * s * side};
    layer.canvas.polygon(head, color);
    layer.canvas.text(name, tip + 10.0 * s * direction + Vector2d(0.0, 3.0 * s), 8.5 * s, theme.text, Align::kCenter,
                      halo);
  };
  const double cos = std::cos(shown.T_map_shown.yaw_rad), sin = std::sin(shown.T_map_shown.yaw_rad);
  arrow({cos, -sin}, "x", rgb(0xd9480f));
  arrow({-sin, -cos}, "y", rgb(0x2f9e44));
  if (shown.given)
    layer.canvas.text("given map", origin + Vector2d(0.0, 44.0 * s), 8.5 * s, theme.text, Align::kCenter, halo);
}

}  // namespace swiftlet::rendering
