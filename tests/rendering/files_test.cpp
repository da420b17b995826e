// The drawings in SVG.
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rendering/map_renderer.hpp"
#include "rendering/map_svg.hpp"
#include "rendering/plot_svg.hpp"
#include "rendering/thinned_curve.hpp"
#include "tests/rendering/example_flight.hpp"

namespace swiftlet::rendering {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

int countOf(const std::string& text, const std::string& what) {
  int count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

Plot altitudePlot() {
  Plot plot{"Altitude",
            "time (s)",
            "height (m)",
            {{"estimate", {}, false}, {"truth & more", {}, true}},
            {{0, 4, "taking off"}, {60, 70, "hold"}},
            {},
            {},
            720,
            260};
  for (int i = 0; i < 9000; ++i) {
    const double t = 0.01 * i;
    const double z = std::min(1.0, 0.3 * t);
    plot.series[0].points.emplace_back(t, i == 4321 ? 1.9 : z + 0.03 * std::sin(9 * t) + 0.01 * std::sin(77 * t));
    plot.series[1].points.emplace_back(t, z);
  }
  return plot;
}

TEST(PlotSvgTest, ThinningKeepsPeaks) {
  const std::string svg = plotSvg(altitudePlot());
  EXPECT_LT(svg.size(), 80'000u);
  EXPECT_THAT(svg, HasSubstr("prefers-color-scheme:dark"));
  EXPECT_THAT(svg, HasSubstr("truth &amp; more"));
  EXPECT_THAT(svg, HasSubstr(">time (s)<"));
  // The one sample at 1.9 m of an axis up to 2 m: 5 % below the top of the frame of 182 px that starts at 34.
  EXPECT_THAT(svg, HasSubstr(",43.1"));
  std::ofstream(std::string(SWIFTLET_BINARY_DIR) + "/plot.svg") << svg;
}

TEST(PlotSvgTest, BreaksTheLineAtNanAndAcceptsNoData) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Plot plot{"t", "x", "y", {{"a", {{0, 1}, {1, 2}, {2, nan}, {3, 1}, {4, 1}}, false}}, {}, {}, {}, 400, 200};
  EXPECT_EQ(countOf(plotSvg(plot), "<polyline"), 2);
  plot.series = {{"flat", {{0, 5}, {1, 5}}, false}, {"empty", {}, false}, {"none", {{nan, nan}}, false}};
  EXPECT_THAT(plotSvg(plot), Not(HasSubstr("nan")));
  plot.series.clear();
  EXPECT_THAT(plotSvg(plot), Not(HasSubstr("nan")));
  plot.series = {{"<script>", {{0, 1e300}, {1, -1e300}}, false}};
  EXPECT_THAT(plotSvg(plot), Not(HasSubstr("<script>")));
}

TEST(MapSvgTest, ContainsPictureLinesAndMarks) {
  testing::ExampleFlight flight;
  const auto world = flight.advance(6.0);
  MapPicture picture = pictureOf(*world, 0.55);
  const auto trail_map_m = world->vehicle->trail.points_map_m();
  picture.lines = {{"estimate", {trail_map_m.begin(), trail_map_m.end()}, LineStyle::kTrail},
                   {"truth", {{0, 0}, {1.8, 1}}, LineStyle::kReference}};
  picture.marks = {{"home", {0, 0, 0}, MarkStyle::kHome}, {"goal", {1.8, 3.2, 0}, MarkStyle::kGoal}};
  const std::string svg = mapSvg(picture);
  EXPECT_THAT(svg, HasSubstr("data:image/png;base64,iVBOR"));
  EXPECT_EQ(countOf(svg, "<polyline"), 2);
  EXPECT_EQ(countOf(svg, "<circle"), 2);
  std::ofstream(std::string(SWIFTLET_BINARY_DIR) + "/map.svg") << svg;
}

TEST(MapSvgTest, LinesOfTheSameNameShareColourAndLegendEntry) {
  testing::ExampleFlight flight;
  MapPicture picture = pictureOf(*flight.advance(1.0), 0.55);
  picture.lines = {{"trajectory", {{0, 0}, {1, 1}}, LineStyle::kTrail}};
  for (int i = 0; i < 20; ++i)
    picture.lines.push_back({"loop closures", {{0, 0}, {1, 0.1 * i}}, LineStyle::kReference});
  picture.lines.push_back({"", {{0, 0}, {0, 1}}, LineStyle::kTrail});
  picture.marks.clear();
  const std::string svg = mapSvg(picture);
  EXPECT_EQ(countOf(svg, "<polyline class=\"s s1\""), 1);
  EXPECT_EQ(countOf(svg, "<polyline class=\"s s2 dash\""), 20);
  EXPECT_EQ(countOf(svg, "<polyline class=\"s s3\""), 1);
  EXPECT_EQ(countOf(svg, "<text class=\"name\""), 2) << "what has no name is not in the legend";
  EXPECT_EQ(countOf(svg, ">loop closures<"), 1);
}

TEST(ThinnedCurveTest, KeepsTheGreatestValue) {
  for (const int values : {1, 2000, 2001, 4000, 4001, 12345}) {
    for (const int peak : {0, 1, 999, 1999, 2000, 2001, 3999, 4000, 4001, 8000, 12344}) {
      if (peak >= values) continue;
      ThinnedCurve curve;
      for (int i = 0; i < values; ++i) curve.add(i, i == peak ? 5.0 : 1.0);
      EXPECT_LE(curve.points().size(), ThinnedCurve::kPoints);
      int seen = 0;
      for (const Eigen::Vector2d& p : curve.points()) {
        if (p.y() != 5.0) continue;
        ++seen;
        EXPECT_LE(p.x(), peak);
        EXPECT_GT(p.x() + 16.0, peak) << "at its place";
      }
      EXPECT_EQ(seen, 1) << peak << " of " << values;
    }
  }
}

}  // namespace
}  // namespace swiftlet::rendering
