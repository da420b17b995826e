#include "rendering/plot_svg.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "common/markup.hpp"
#include "rendering/svg.hpp"

namespace swiftlet::rendering {
namespace {

using Eigen::Vector2d;

struct Range {
  double low = INFINITY;
  double high = -INFINITY;

  void include(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// A range that is never zero, also for constant or missing data.
  void widen() {
    if (!(low <= high)) low = 0.0, high = 1.0;
    if (high - low < 1e-9 * std::max(1.0, std::abs(high))) {
      const double half = std::max(0.5, 0.05 * std::abs(high));
      low -= half;
      high += half;
    }
  }
};

/// Ticks at 1, 2 or 5 times a power of ten, about `wanted` of them.
struct Ticks {
  double step;
  int decimals;

  Ticks(const Range& range, int wanted) {
    const double rough = (range.high - range.low) / wanted, power = std::pow(10.0, std::floor(std::log10(rough)));
    const double factor = rough / power;
    step = power * (factor <= 1.0 ? 1.0 : factor <= 2.0 ? 2.0 : factor <= 5.0 ? 5.0 : 10.0);
    decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  }
  double floorOf(double value) const { return std::floor(value / step + 1e-9) * step; }
  double ceilOf(double value) const { return std::ceil(value / step - 1e-9) * step; }
  std::string label(double value) const {
    return fmt::format("{:.{}f}", std::abs(value) < 1e-3 * step ? 0.0 : value, decimals);
  }
};

/// The area of the curves with the ranges it shows.
struct Frame {
  double left, top, width, height;
  Range x, y;

  Vector2d toPixel(const Vector2d& p) const {
    return {left + (p.x() - x.low) / (x.high - x.low) * width, top + (y.high - p.y()) / (y.high - y.low) * height};
  }
};

Frame frameOf(const Plot& plot) {
  const double top = plot.title.empty() ? 12.0 : 34.0;
  Frame frame{58.0, top, plot.width_px - 74.0, plot.height_px - top - 44.0, {}, {}};
  for (const Series& series : plot.series)
    for (const Vector2d& p : series.points) {
      if (!p.allFinite()) continue;
      frame.x.include(p.x());
      frame.y.include(p.y());
    }
  if (plot.y_min) frame.y.include(*plot.y_min);
  if (plot.y_max) frame.y.include(*plot.y_max);
  frame.x.widen();
  frame.y.widen();
  const Ticks ticks(frame.y, 4);
  frame.y.low = plot.y_min.value_or(ticks.floorOf(frame.y.low));
  frame.y.high = plot.y_max.value_or(ticks.ceilOf(frame.y.high));
  frame.y.widen();
  return frame;
}

/// At most four points a pixel column: the first, the lowest, the highest and the last.
std::vector<Vector2d> thinned(const std::vector<Vector2d>& pixels) {
  std::vector<Vector2d> result;
  for (std::size_t begin = 0; begin < pixels.size();) {
    std::size_t end = begin + 1;
    const double column = std::floor(pixels[begin].x());
    while (end < pixels.size() && pixels[begin].allFinite() && pixels[end].allFinite() &&
           std::floor(pixels[end].x()) == column)
      ++end;
    if (end - begin <= 4) {
      result.insert(result.end(), pixels.begin() + static_cast<long>(begin), pixels.begin() + static_cast<long>(end));
    } else {
      const auto first = pixels.begin() + static_cast<long>(begin), last = pixels.begin() + static_cast<long>(end);
      auto [low, high] =
          std::minmax_element(first, last, [](const Vector2d& a, const Vector2d& b) { return a.y() < b.y(); });
      if (low > high) std::swap(low, high);
      result.insert(result.end(), {*first, *low, *high, *(last - 1)});
    }
    begin = end;
  }
  return result;
}

void drawAxes(const Plot& plot, const Frame& f, std::back_insert_iterator<std::string> out) {
  const double bottom = f.top + f.height, right = f.left + f.width;
  const Ticks y(f.y, 4), x(f.x, std::max(2, plot.width_px / 90));
  for (double v = y.ceilOf(f.y.low); v <= f.y.high + 1e-9 * y.step; v += y.step) {
    const double py = f.toPixel({f.x.low, v}).y();
    fmt::format_to(out, R"(<path class="rule" d="M{:.1f} {:.1f}H{:.1f}"/>)", f.left, py, right);
    fmt::format_to(out, R"(<text class="tick" x="{:.1f}" y="{:.1f}" text-anchor="end">{}</text>)", f.left - 7.0,
                   py + 4.0, y.label(v));
  }
  for (double v = x.ceilOf(f.x.low); v <= f.x.high + 1e-9 * x.step; v += x.step) {
    const double px = f.toPixel({v, f.y.low}).x();
    fmt::format_to(out, R"(<path class="axis" d="M{:.1f} {:.1f}v5"/>)", px, bottom);
    fmt::format_to(out, R"(<text class="tick" x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)", px, bottom + 18.0,
                   x.label(v));
  }
  fmt::format_to(out, R"(<path class="axis" d="M{:.1f} {:.1f}H{:.1f}"/>)", f.left, bottom, right);
  fmt::format_to(out, R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)", f.left + 0.5 * f.width,
                 bottom + 36.0, common::escaped(plot.x_label));
  fmt::format_to(out, R"x(<text transform="translate(14 {:.1f}) rotate(-90)" text-anchor="middle">{}</text>)x",
                 f.top + 0.5 * f.height, common::escaped(plot.y_label));
}

void drawSpans(const Plot& plot, const Frame& f, std::back_insert_iterator<std::string> out) {
  bool odd = true;  // Every other stretch is darker, so that its borders are visible.
  for (const Span& span : plot.spans) {
    odd = !odd;
    const double x0 = f.toPixel({std::clamp(span.begin, f.x.low, f.x.high), 0.0}).x();
    const double x1 = f.toPixel({std::clamp(span.end, f.x.low, f.x.high), 0.0}).x();
    if (!(x1 > x0)) continue;
    fmt::format_to(
        out, R"(<rect class="span{}" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}"><title>{}</title></rect>)",
        odd ? " odd" : "", x0, f.top, x1 - x0, f.height, common::escaped(span.name));
    if (x1 - x0 > 7.0 * static_cast<double>(span.name.size()))
      fmt::format_to(out, R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)", 0.5 * (x0 + x1),
                     f.top + 14.0, common::escaped(span.name));
  }
}

/// The names at the upper right in the colours of their lines, from right to left.
void drawNames(const Plot& plot, const Frame& f, std::back_insert_iterator<std::string> out) {
  double right = f.left + f.width;
  for (std::size_t i = plot.series.size(); i-- > 0;) {
    const double width = 6.4 * static_cast<double>(plot.series[i].name.size());
    fmt::format_to(out, R"(<text class="name" x="{:.1f}" y="20" text-anchor="end">{}</text>)", right,
                   common::escaped(plot.series[i].name));
    fmt::format_to(out, R"(<path class="s s{}{}" d="M{:.1f} 16h16"/>)", i % 6 + 1, plot.series[i].dashed ? " dash" : "",
                   right - width - 20.0);
    right -= width + 34.0;
  }
}

}  // namespace

std::string plotSvg(const Plot& plot) {
  const Frame frame = frameOf(plot);
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 R"(<svg class="sw" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" )"
                 R"(style="max-width:100%;height:auto" role="img" aria-label="{2}">{3})",
                 plot.width_px, plot.height_px, common::escaped(plot.title), svg::style());
  fmt::format_to(out, R"(<rect class="frame" width="{}" height="{}" rx="8"/>)", plot.width_px, plot.height_px);
  fmt::format_to(out, R"(<text class="title" x="{:.1f}" y="21">{}</text>)", 14.0, common::escaped(plot.title));
  drawSpans(plot, frame, out);
  drawAxes(plot, frame, out);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    std::vector<Vector2d> pixels;
    pixels.reserve(plot.series[i].points.size());
    for (const Vector2d& p : plot.series[i].points) {
      pixels.push_back(frame.toPixel(p));
      pixels.back().y() = std::isnan(pixels.back().y())
                              ? pixels.back().y()
                              : std::clamp(pixels.back().y(), frame.top - 1.0, frame.top + frame.height + 1.0);
    }
    for (const std::string& list : svg::pointLists(thinned(pixels)))
      fmt::format_to(out, R"(<polyline class="s s{}{}" points="{}"/>)", i % 6 + 1, plot.series[i].dashed ? " dash" : "",
                     list);
  }
  drawNames(plot, frame, out);
  text += "</svg>\n";
  return text;
}

}  // namespace swiftlet::rendering
