// Anti-aliased lines, discs, polygons and text over an RGB picture, drawn by OpenCV. Pixel coordinates:
// (0, 0) is the upper left corner, y down, pixel i covers [i, i + 1). Anything outside the picture, or not finite, is
// clipped. A shape is painted once even where it crosses itself, so that translucent lines have no darker joints.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "common/image.hpp"
#include "rendering/color.hpp"

namespace swiftlet::rendering {

enum class Align { kLeft, kCenter };

class Canvas {
 public:
  using Point = Eigen::Vector2d;

  explicit Canvas(common::Image image);

  int width_px() const { return image_.width_px; }
  int height_px() const { return image_.height_px; }

  void fillRect(double x0, double y0, double x1, double y1, Color color);
  void line(const Point& a, const Point& b, double width_px, Color color);
  void polyline(std::span<const Point> points, double width_px, Color color);
  void dashedPolyline(std::span<const Point> points, double width_px, double dash_px, double gap_px, Color color);
  void disc(const Point& center, double radius_px, Color color);
  /// Paints many discs as one shape.
  void discs(std::span<const Point> centers, double radius_px, Color color);
  void ring(const Point& center, double radius_px, double width_px, Color color);
  /// Fills by the even-odd rule.
  void polygon(std::span<const Point> corners, Color color);
  /// `baseline` is where the text starts or is centred. A visible `halo` is painted around it first. Characters beyond
  /// ASCII are drawn as question marks.
  void text(std::string_view text, const Point& baseline, double height_px, Color color, Align align = Align::kLeft,
            Color halo = {0, 0, 0, 0});

  common::Image take() { return std::move(image_); }

 private:
  common::Image image_;
};

}  // namespace swiftlet::rendering
