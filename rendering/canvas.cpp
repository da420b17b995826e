#include "rendering/canvas.hpp"

#include <algorithm>
#include <cmath>

#include "common/check.hpp"
#include "rendering/stroke_font.hpp"

namespace swiftlet::rendering {
namespace {

void blend(std::uint8_t* pixel, Color color, int alpha) {
  const auto channel = [alpha](int under, int over) {
    return static_cast<std::uint8_t>((under * (255 - alpha) + over * alpha + 127) / 255);
  };
  pixel[0] = channel(pixel[0], color.red);
  pixel[1] = channel(pixel[1], color.green);
  pixel[2] = channel(pixel[2], color.blue);
}

}  // namespace

Canvas::Canvas(common::Image image)
    : image_(std::move(image)),
      cover_(static_cast<std::size_t>(image_.width_px) * image_.height_px, 0),
      touched_{image_.width_px, image_.height_px, 0, 0} {
  SWIFTLET_CHECK(image_.rgb.size() == 3 * cover_.size(), image_.width_px, image_.height_px, image_.rgb.size());
}

Canvas::Box Canvas::clipped(double x0, double y0, double x1, double y1) const {
  if (!std::isfinite(x0) || !std::isfinite(y0) || !std::isfinite(x1) || !std::isfinite(y1)) return {0, 0, 0, 0};
  const auto clip = [](double value, int limit) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
  };
  return {clip(std::floor(x0), image_.width_px), clip(std::floor(y0), image_.height_px),
          clip(std::ceil(x1), image_.width_px), clip(std::ceil(y1), image_.height_px)};
}

void Canvas::touch(const Box& box) {
  if (box.empty()) return;
  touched_ = {std::min(touched_.x0, box.x0), std::min(touched_.y0, box.y0), std::max(touched_.x1, box.x1),
              std::max(touched_.y1, box.y1)};
}

void Canvas::cover(int x, int y, double coverage) {
  if (coverage <= 0.0) return;
  std::uint8_t& cell = cover_[static_cast<std::size_t>(y) * image_.width_px + x];
  // NOLINTNEXTLINE(bugprone-incorrect-roundings): never negative, and done for every pixel.
  cell = std::max(cell, static_cast<std::uint8_t>(std::min(1.0, coverage) * 255.0 + 0.5));
}

void Canvas::paint(Color color) {
  for (int y = touched_.y0; y < touched_.y1; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * image_.width_px;
    for (int x = touched_.x0; x < touched_.x1; ++x) {
      std::uint8_t& cell = cover_[row + x];
      if (cell == 0) continue;
      blend(&image_.rgb[3 * (row + x)], color, (cell * color.alpha + 127) / 255);
      cell = 0;
    }
  }
  touched_ = {image_.width_px, image_.height_px, 0, 0};
}

void Canvas::coverSegment(const Point& a, const Point& b, double radius_px) {
  const double reach = radius_px + 0.5;
  const Box box = clipped(std::min(a.x(), b.x()) - reach, std::min(a.y(), b.y()) - reach,
                          std::max(a.x(), b.x()) + reach, std::max(a.y(), b.y()) + reach);
  if (box.empty()) return;
  touch(box);
  const Point along = b - a;
  const double length2 = along.squaredNorm();
  for (int y = box.y0; y < box.y1; ++y) {
    // Only the part of the segment near this row can cover it. Without this bound a long diagonal would visit its whole
    // box.
    int x0 = box.x0, x1 = box.x1;
    if (std::abs(along.y()) > 1e-9) {
      const double t0 = std::clamp((y + 0.5 - reach - 0.5 - a.y()) / along.y(), 0.0, 1.0);
      const double t1 = std::clamp((y + 0.5 + reach + 0.5 - a.y()) / along.y(), 0.0, 1.0);
      const double near = a.x() + std::min(t0 * along.x(), t1 * along.x()) - reach - 1.0;
      const double far = a.x() + std::max(t0 * along.x(), t1 * along.x()) + reach + 1.0;
      // Not std::clamp: points may be so far away that their differences are not finite.
      const auto column = [&](double x) {
        return static_cast<int>(std::min<double>(image_.width_px, std::max(0.0, x)));
      };
      x0 = std::max(x0, column(near));
      x1 = std::min(x1, column(far + 1.0));
    }
    for (int x = x0; x < x1; ++x) {
      const Point from_a = Point(x + 0.5, y + 0.5) - a;
      const double t = length2 > 0.0 ? std::clamp(from_a.dot(along) / length2, 0.0, 1.0) : 0.0;
      const double distance2 = (from_a - t * along).squaredNorm();
      if (distance2 < reach * reach) cover(x, y, reach - std::sqrt(distance2));
    }
  }
}

void Canvas::coverDisc(const Point& center, double radius_px) { coverSegment(center, center, radius_px); }

void Canvas::fillRect(double x0, double y0, double x1, double y1, Color color) {
  const Box box = clipped(x0, y0, x1, y1);
  const auto overlap = [](int i, double from, double to) { return std::min(i + 1.0, to) - std::max<double>(i, from); };
  for (int y = box.y0; y < box.y1; ++y) {
    const double rows = overlap(y, y0, y1);
    for (int x = box.x0; x < box.x1; ++x) {
      const double coverage = rows * overlap(x, x0, x1);
      const std::size_t i = static_cast<std::size_t>(y) * image_.width_px + x;
      // NOLINTNEXTLINE(bugprone-incorrect-roundings)
      if (coverage > 0.0) blend(&image_.rgb[3 * i], color, static_cast<int>(coverage * color.alpha + 0.5));
    }
  }
}

void Canvas::line(const Point& a, const Point& b, double width_px, Color color) {
  coverSegment(a, b, 0.5 * width_px);
  paint(color);
}

void Canvas::polyline(std::span<const Point> points, double width_px, Color color) {
  for (std::size_t i = 1; i < points.size(); ++i) coverSegment(points[i - 1], points[i], 0.5 * width_px);
  paint(color);
}

void Canvas::dashedPolyline(std::span<const Point> points, double width_px, double dash_px, double gap_px,
                            Color color) {
  SWIFTLET_CHECK(dash_px > 0.0 && gap_px > 0.0, dash_px, gap_px);
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
        coverSegment(points[i - 1] + along * (at / length), points[i - 1] + along * ((at + step) / length),
                     0.5 * width_px);
      at += std::max(step, 1e-6);
      phase += step;
      if (phase >= dash_px + gap_px - 1e-9) phase = 0.0;
    }
  }
  paint(color);
}

void Canvas::disc(const Point& center, double radius_px, Color color) {
  coverDisc(center, radius_px);
  paint(color);
}

void Canvas::discs(std::span<const Point> centers, double radius_px, Color color) {
  for (const Point& center : centers) coverDisc(center, radius_px);
  paint(color);
}

void Canvas::ring(const Point& center, double radius_px, double width_px, Color color) {
  const double reach = radius_px + 0.5 * width_px + 0.5;
  const Box box = clipped(center.x() - reach, center.y() - reach, center.x() + reach, center.y() + reach);
  touch(box);
  for (int y = box.y0; y < box.y1; ++y)
    for (int x = box.x0; x < box.x1; ++x)
      cover(x, y, 0.5 * width_px + 0.5 - std::abs((Point(x + 0.5, y + 0.5) - center).norm() - radius_px));
  paint(color);
}

void Canvas::polygon(std::span<const Point> corners, Color color) {
  Box box{image_.width_px, image_.height_px, 0, 0};
  for (const Point& c : corners) {
    const Box one = clipped(c.x() - 1.0, c.y() - 1.0, c.x() + 1.0, c.y() + 1.0);
    box = {std::min(box.x0, one.x0), std::min(box.y0, one.y0), std::max(box.x1, one.x1), std::max(box.y1, one.y1)};
    if (!c.allFinite()) return;
  }
  if (box.empty()) return;
  touch(box);
  constexpr int kSamples = 4;
  std::vector<double> crossings, row(static_cast<std::size_t>(image_.width_px));
  for (int y = box.y0; y < box.y1; ++y) {
    std::fill(row.begin(), row.end(), 0.0);
    for (int s = 0; s < kSamples; ++s) {
      const double level = y + (s + 0.5) / kSamples;
      crossings.clear();
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Point &a = corners[i], &b = corners[(i + 1) % corners.size()];
        if ((a.y() <= level) != (b.y() <= level))
          crossings.push_back(a.x() + (level - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
      }
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
        const Box inside = clipped(crossings[i], y, crossings[i + 1], y + 1);
        for (int x = inside.x0; x < inside.x1; ++x)
          row[static_cast<std::size_t>(x)] +=
              (std::min(x + 1.0, crossings[i + 1]) - std::max<double>(x, crossings[i])) / kSamples;
      }
    }
    for (int x = box.x0; x < box.x1; ++x) cover(x, y, row[static_cast<std::size_t>(x)]);
  }
  paint(color);
}

void Canvas::text(std::string_view text, const Point& baseline, double height_px, Color color, Align align,
                  Color halo) {
  const double shift = align == Align::kCenter ? 0.5 * textWidth(text) * height_px : 0.0;
  const Point origin(baseline.x() - shift, baseline.y());
  const auto strokes = textStrokes(text);
  const double radius_px = std::max(0.45, 0.065 * height_px);
  const auto draw = [&](double radius, Color ink) {
    for (const auto& stroke : strokes)
      for (std::size_t i = 1; i < stroke.size(); ++i)
        coverSegment(origin + height_px * Point(stroke[i - 1].x(), -stroke[i - 1].y()),
                     origin + height_px * Point(stroke[i].x(), -stroke[i].y()), radius);
    paint(ink);
  };
  if (halo.alpha > 0) draw(radius_px + 2.0, halo);
  draw(radius_px, color);
}

}  // namespace swiftlet::rendering
