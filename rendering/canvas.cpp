#include "rendering/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "common/check.hpp"

namespace swiftlet::rendering {
namespace {

using Point = Canvas::Point;

void blend(std::uint8_t* pixel, Color color, int alpha) {
  const Color mixed = mix({pixel[0], pixel[1], pixel[2]}, color, alpha);
  pixel[0] = mixed.red;
  pixel[1] = mixed.green;
  pixel[2] = mixed.blue;
}

int clippedPixel(double value, int limit) { return static_cast<int>(std::clamp<double>(value, 0.0, limit)); }

/// How much of each pixel a shape covers, in the part of the picture that it reaches. It is drawn at twice the
/// resolution; all arguments are in pixels of the picture.
class ShapeMask {
 public:
  /// OpenCV draws anti-aliased edges so far outside of a shape; segments and discs are made smaller here.
  static constexpr double kOutside_px = 0.3;

  ShapeMask(const common::Image& image, std::span<const Point> points, double reach_px) {
    Point low = Point::Constant(std::numeric_limits<double>::max()), high = -low;
    for (const Point& point : points) {
      if (!point.allFinite()) continue;
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    const int left = clippedPixel(low.x() - reach_px, image.width_px),
              top = clippedPixel(low.y() - reach_px, image.height_px);
    box_ = {left, top, std::max(0, clippedPixel(std::ceil(high.x() + reach_px), image.width_px) - left),
            std::max(0, clippedPixel(std::ceil(high.y() + reach_px), image.height_px) - top)};
    covered_ = cv::Mat::zeros(box_.size() * kScale, CV_8U);
  }

  void segment(const Point& a, const Point& b, double width_px) {
    if (!a.allFinite() || !b.allFinite() || box_.empty() || !isNear(a, b, width_px)) return;
    const double half = inside(0.5 * width_px) / kScale;
    const Point along = b - a;
    const Point across = half / std::max(along.norm(), 1e-9) * Point(-along.y(), along.x());
    const std::array corners{at(a + across), at(b + across), at(b - across), at(a - across)};
    cv::fillConvexPoly(covered_, corners.data(), 4, 255, cv::LINE_AA, kShift);
  }
  void disc(const Point& center, double radius_px) {
    if (!center.allFinite() || box_.empty() || !isNear(center, center, 2.0 * radius_px)) return;
    cv::circle(covered_, at(center), fixedPoint(inside(radius_px)), 255, cv::FILLED, cv::LINE_AA, kShift);
  }
  /// Fills by the even-odd rule.
  void polygons(std::initializer_list<std::span<const Point>> outlines) {
    std::vector<std::vector<cv::Point>> corners;
    for (const auto& outline : outlines) {
      corners.emplace_back();
      for (const Point& corner : outline) corners.back().push_back(at(corner));
    }
    if (!box_.empty()) cv::fillPoly(covered_, corners, 255, cv::LINE_AA, kShift);
  }
  void text(const std::string& text, const Point& baseline, double height_px, double width_px) {
    if (!baseline.allFinite() || box_.empty() || !isNear(baseline, baseline, 1e3 * height_px)) return;
    const cv::Point origin = at(baseline);
    cv::putText(covered_, text, {origin.x >> kShift, origin.y >> kShift}, kFont, fontScale(height_px), 255,
                std::max(2, static_cast<int>(std::lround(kScale * (width_px - 2.0 * kOutside_px)))), cv::LINE_AA);
  }
  static double textWidth(const std::string& text, double height_px) {
    return static_cast<double>(cv::getTextSize(text, kFont, fontScale(height_px), 1, nullptr).width) / kScale;
  }

  void paint(Color color, common::Image& image) const {
    if (box_.empty()) return;
    for (int y = 0; y < box_.height; ++y) {
      const std::uint8_t *upper = covered_.ptr(kScale * y), *lower = covered_.ptr(kScale * y + 1);
      std::uint8_t* pixel = &image.rgb[3 * (static_cast<std::size_t>(box_.y + y) * image.width_px + box_.x)];
      for (int x = 0; x < box_.width; ++x, pixel += 3, upper += kScale, lower += kScale) {
        const int cover = (upper[0] + upper[1] + lower[0] + lower[1] + 2) / 4;
        if (cover != 0) blend(pixel, color, (cover * color.alpha + 127) / 255);
      }
    }
  }

 private:
  static constexpr int kScale = 2;
  static constexpr int kShift = 4;          ///< Binary digits of a coordinate after the point.
  static constexpr double kCapital = 21.0;  ///< Height of a capital letter of the font.
  static constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;

  static double fontScale(double height_px) { return kScale * height_px / kCapital; }
  static double inside(double radius_px) { return std::max(0.05, kScale * (radius_px - kOutside_px)); }
  static int fixedPoint(double value) { return static_cast<int>(std::lround(value * (1 << kShift))); }
  /// Far points are moved nearer, so that they fit into the integers of OpenCV.
  cv::Point at(const Point& point) const {
    const auto coordinate = [](double px, int first) {
      return fixedPoint(std::clamp(kScale * (px - first) - 0.5, -1e6, 1e6));
    };
    return {coordinate(point.x(), box_.x), coordinate(point.y(), box_.y)};
  }
  bool isNear(const Point& a, const Point& b, double width_px) const {
    return std::max(a.x(), b.x()) + width_px > box_.x && std::min(a.x(), b.x()) - width_px < box_.br().x &&
           std::max(a.y(), b.y()) + width_px > box_.y && std::min(a.y(), b.y()) - width_px < box_.br().y;
  }

  cv::Rect box_;  ///< In pixels of the picture.
  cv::Mat covered_;
};

bool allFinite(std::span<const Point> points) {
  return std::all_of(points.begin(), points.end(), [](const Point& point) { return point.allFinite(); });
}

/// Whether the segments at a point hide their ends by themselves. Other corners, and ends, are rounded by a disc.
bool isSmooth(std::span<const Point> points, std::size_t i) {
  if (i == 0 || i + 1 == points.size()) return false;
  const Point in = points[i] - points[i - 1], out = points[i + 1] - points[i];
  return in.dot(out) > 0.95 * in.norm() * out.norm();
}

std::vector<Point> circleOf(const Point& center, double radius_px) {
  const int corners = std::clamp(static_cast<int>(4.0 * radius_px), 16, 256);
  std::vector<Point> circle;
  for (int i = 0; i < corners; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / corners;
    circle.push_back(center + radius_px * Point(std::cos(angle_rad), std::sin(angle_rad)));
  }
  return circle;
}

}  // namespace

Canvas::Canvas(common::Image image) : image_(std::move(image)) {
  SWIFTLET_CHECK(image_.rgb.size() == 3 * static_cast<std::size_t>(image_.width_px) * image_.height_px, image_.width_px,
                 image_.height_px, image_.rgb.size());
}

void Canvas::fillRect(double x0, double y0, double x1, double y1, Color color) {
  if (!std::isfinite(x0) || !std::isfinite(y0) || !std::isfinite(x1) || !std::isfinite(y1)) return;
  const auto overlap = [](int i, double from, double to) { return std::min(i + 1.0, to) - std::max<double>(i, from); };
  const int right = clippedPixel(std::ceil(x1), image_.width_px),
            bottom = clippedPixel(std::ceil(y1), image_.height_px);
  for (int y = clippedPixel(y0, image_.height_px); y < bottom; ++y)
    for (int x = clippedPixel(x0, image_.width_px); x < right; ++x) {
      const double coverage = overlap(y, y0, y1) * overlap(x, x0, x1);
      const std::size_t i = static_cast<std::size_t>(y) * image_.width_px + x;
      // NOLINTNEXTLINE(bugprone-incorrect-roundings)
      if (coverage > 0.0) blend(&image_.rgb[3 * i], color, static_cast<int>(coverage * color.alpha + 0.5));
    }
}

void Canvas::line(const Point& a, const Point& b, double width_px, Color color) {
  polyline(std::array{a, b}, width_px, color);
}

void Canvas::polyline(std::span<const Point> points, double width_px, Color color) {
  ShapeMask mask(image_, points, width_px);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) mask.segment(points[i - 1], points[i], width_px);
    if (!isSmooth(points, i)) mask.disc(points[i], 0.5 * width_px);
  }
  mask.paint(color, image_);
}

void Canvas::dashedPolyline(std::span<const Point> points, double width_px, double dash_px, double gap_px,
                            Color color) {
  SWIFTLET_CHECK(dash_px > 0.0 && gap_px > 0.0, dash_px, gap_px);
  ShapeMask mask(image_, points, width_px);
  double phase = 0.0;  // Position within the current dash and gap.
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point along = points[i] - points[i - 1];
    const double length = along.norm();
    // A segment that reaches far out of the picture is drawn without dashes.
    if (!(length > 0.0) || length > 1e5) continue;
    for (double at = 0.0; at < length;) {
      const bool inked = phase < dash_px;
      const double step = std::min(length - at, inked ? dash_px - phase : dash_px + gap_px - phase);
      if (inked)
        mask.segment(points[i - 1] + along * (at / length), points[i - 1] + along * ((at + step) / length), width_px);
      at += std::max(step, 1e-6);
      phase += step;
      if (phase >= dash_px + gap_px - 1e-9) phase = 0.0;
    }
  }
  mask.paint(color, image_);
}

void Canvas::disc(const Point& center, double radius_px, Color color) {
  discs(std::span(&center, 1), radius_px, color);
}

void Canvas::discs(std::span<const Point> centers, double radius_px, Color color) {
  ShapeMask mask(image_, centers, radius_px + 1.0);
  for (const Point& center : centers) mask.disc(center, radius_px);
  mask.paint(color, image_);
}

void Canvas::ring(const Point& center, double radius_px, double width_px, Color color) {
  if (!center.allFinite()) return;
  ShapeMask mask(image_, std::span(&center, 1), radius_px + width_px);
  const double inner_px = radius_px - 0.5 * width_px, outer_px = radius_px + 0.5 * width_px;
  mask.polygons({circleOf(center, outer_px - ShapeMask::kOutside_px),
                 circleOf(center, std::max(0.0, inner_px + ShapeMask::kOutside_px))});
  mask.paint(color, image_);
}

void Canvas::polygon(std::span<const Point> corners, Color color) {
  if (!allFinite(corners)) return;
  ShapeMask mask(image_, corners, 1.0);
  mask.polygons({corners});
  mask.paint(color, image_);
}

void Canvas::text(std::string_view text, const Point& baseline, double height_px, Color color, Align align,
                  Color halo) {
  const std::string letters(text);
  const double length_px = ShapeMask::textWidth(letters, height_px);
  const Point origin = baseline - Point(align == Align::kCenter ? 0.5 * length_px : 0.0, 0.0);
  const double width_px = std::max(0.9, 0.13 * height_px);
  const auto draw = [&](double stroke_px, Color ink) {
    ShapeMask mask(image_, std::array{origin, Point(origin + Point(length_px, 0.0))}, 1.5 * height_px + stroke_px);
    mask.text(letters, origin, height_px, stroke_px);
    mask.paint(ink, image_);
  };
  if (halo.alpha > 0) draw(width_px + 4.0, halo);
  draw(width_px, color);
}

}  // namespace swiftlet::rendering
