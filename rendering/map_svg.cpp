#include "rendering/map_svg.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "common/base64.hpp"
#include "common/markup.hpp"
#include "common/png_encoder.hpp"
#include "rendering/map_renderer.hpp"
#include "rendering/svg.hpp"

namespace swiftlet::rendering {
namespace {

/// Aspect ratio of the known area, so that no half of the picture is empty.
int heightFor(const common::OccupancyGrid& grid, int width_px) {
  const common::CellRect known = common::knownExtent(grid);
  const double aspect = known.empty() ? 0.75 : static_cast<double>(known.height()) / known.width();
  return static_cast<int>(std::lround(width_px * std::clamp(aspect, 0.4, 1.4)));
}

/// Height of a strip below the map for scale bar, names and axes, so that they cover nothing of it.
constexpr int kLegendHeight_px = 56;

/// The known area is in the upper part of the picture, the strip of the legend below it.
Viewport viewportOf(const MapPicture& picture, const MapView& view, int strip_px) {
  Viewport viewport = fitViewport(*picture.grid, picture.in_view_map_m, view.width_px, view.height_px - strip_px);
  viewport.height_px = view.height_px;
  viewport.center_map_m.y() -= 0.5 * strip_px / viewport.px_per_m;
  return viewport;
}

/// The first line of each name, in order.
std::vector<MapLine> namedOnce(const std::vector<MapLine>& lines) {
  std::vector<MapLine> named;
  for (const MapLine& line : lines)
    if (std::none_of(named.begin(), named.end(), [&](const MapLine& other) { return other.name == line.name; }))
      named.push_back({line.name, {}, line.style});
  return named;
}

bool isDashed(LineStyle style) { return style == LineStyle::kPlan || style == LineStyle::kReference; }

/// The style classes of a line: a colour for each name, until the colours run out.
std::string classesOf(const MapLine& line, const std::vector<MapLine>& named) {
  const auto same = std::find_if(named.begin(), named.end(), [&](const MapLine& n) { return n.name == line.name; });
  return fmt::format("s s{}{}", (same - named.begin()) % 6 + 1, isDashed(line.style) ? " dash" : "");
}

/// The names side by side in the strip, between the scale bar and the axes.
void drawNames(const std::vector<MapLine>& named, int height_px, std::back_insert_iterator<std::string> out) {
  constexpr double kCharacter_px = 6.6;
  double x = 200.0;
  for (const MapLine& line : named) {
    if (line.name.empty()) continue;
    fmt::format_to(out, R"(<path class="{}" d="M{:.1f} {:.1f}h22"/><text class="name" x="{:.1f}" y="{:.1f}">{}</text>)",
                   classesOf(line, named), x, height_px - 18.0, x + 29.0, height_px - 14.0, common::escaped(line.name));
    x += 58.0 + kCharacter_px * static_cast<double>(line.name.size());
  }
}

}  // namespace

std::string mapSvg(const MapPicture& picture, int width_px) {
  MapView view;
  // The PNG has twice the pixels, for screens of high resolution.
  view.width_px = 2 * width_px;
  view.height_px = 2 * (heightFor(*picture.grid, width_px) + kLegendHeight_px);
  view.viewport = viewportOf(picture, view, 2 * kLegendHeight_px);
  MapPicture below;  // The picture below the lines and marks.
  below.grid = picture.grid;
  below.levels = picture.levels;
  below.frontiers = picture.frontiers;
  const auto toPixel = [&](const Eigen::Vector2d& p) { return Eigen::Vector2d(0.5 * view.viewport->toPixel(p)); };

  const int height_px = view.height_px / 2;
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 R"(<svg class="sw" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" )"
                 R"(style="max-width:100%;height:auto" role="img" aria-label="Map">{2})",
                 width_px, height_px, svg::style());
  fmt::format_to(out, R"(<image width="{}" height="{}" href="data:image/png;base64,{}"/>)", width_px, height_px,
                 common::base64(common::encodePng(renderMap(below, view))));
  // The picture below is always light, so the lines on it are too.
  text += R"(<g style="--c1:#1f6fe0;--c2:#d9480f;--c3:#0a8f6c;--c4:#9c36b5;--c5:#b7791f;--c6:#c2255c;--ink:#2b3947">)";
  const std::vector<MapLine> named = namedOnce(picture.lines);
  for (const MapLine& line : picture.lines) {
    std::vector<Eigen::Vector2d> pixels;
    for (const Eigen::Vector2d& p : line.points_map_m) pixels.push_back(toPixel(p));
    for (const std::string& list : svg::pointLists(pixels))
      fmt::format_to(out, R"(<polyline class="{}" points="{}"/>)", classesOf(line, named), list);
  }
  drawNames(named, height_px, out);
  for (const MapMark& mark : picture.marks) {
    const Eigen::Vector2d p = toPixel(mark.at_map.position_m());
    if (!p.allFinite()) continue;
    fmt::format_to(out,
                   R"(<circle cx="{0:.1f}" cy="{1:.1f}" r="4.5" fill="#fff" stroke="#c2255c" stroke-width="2"/>)"
                   R"(<text class="name halo" x="{2:.1f}" y="{3:.1f}">{4}</text>)",
                   p.x(), p.y(), p.x() + 9.0, p.y() + 4.0, common::escaped(mark.name));
  }
  text += "</g></svg>\n";
  return text;
}

}  // namespace swiftlet::rendering
