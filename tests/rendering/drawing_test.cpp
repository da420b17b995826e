// The rasterizer, the grid layer and scaling against slow and simple computations.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "rendering/canvas.hpp"
#include "rendering/grid_layer.hpp"
#include "rendering/map_renderer.hpp"
#include "rendering/picture3d.hpp"
#include "rendering/resize.hpp"
#include "tests/rendering/example_flight.hpp"

namespace swiftlet::rendering {
namespace {

using Point = Canvas::Point;

common::Image black(int width_px, int height_px) {
  return {width_px, height_px, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width_px) * height_px, 0)};
}

double ink(const common::Image& image) {
  double sum = 0.0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) sum += image.rgb[i] / 255.0;
  return sum;
}

TEST(CanvasTest, CoversTheAreaOfTheShape) {
  const auto inkOf = [](const auto& draw) {
    Canvas canvas(black(200, 200));
    draw(canvas);
    return ink(canvas.take());
  };
  const Color white = rgb(0xffffff);
  EXPECT_NEAR(inkOf([&](Canvas& c) { c.disc({100.3, 99.8}, 40.0, white); }), M_PI * 1600, 20);
  EXPECT_NEAR(inkOf([&](Canvas& c) { c.ring({100.3, 99.8}, 40.0, 6.0, white); }), 2 * M_PI * 40 * 6, 20);
  EXPECT_NEAR(inkOf([&](Canvas& c) {
                c.line({20, 30}, {170, 150}, 5.0, white);
              }),
              std::hypot(150, 120) * 5 + M_PI * 6.25, 20);
  EXPECT_NEAR(inkOf([&](Canvas& c) { c.fillRect(10.25, 20.5, 60.75, 80.0, white); }), 50.5 * 59.5, 5);
  const std::vector<Point> triangle{{20, 20}, {180, 40}, {60, 170}};
  EXPECT_NEAR(inkOf([&](Canvas& c) { c.polygon(triangle, white); }), 0.5 * (160 * 150 - 40 * 20), 180);
}

TEST(CanvasTest, ATranslucentLineHasNoDarkerJoints) {
  Canvas canvas(black(100, 100));
  const std::vector<Point> line{{10, 50}, {50, 50}, {50, 50.1}, {90, 50}};
  canvas.polyline(line, 8.0, rgb(0xffffff).withAlpha(100));
  const common::Image image = canvas.take();
  for (int x = 12; x < 88; ++x) EXPECT_EQ(image.rgb[3 * static_cast<std::size_t>(50 * 100 + x)], 100) << x;
}

TEST(CanvasTest, ClipsPointsThatAreOutsideOrNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), far = 1e300;
  const bool held = rc::check("nothing is written outside", [&] {
    const auto coordinate = [&] {
      return *rc::gen::weightedOneOf<double>(
          {{6, rc::gen::map(rc::gen::inRange(-500, 500), [](int i) { return i / 3.0; })},
           {1, rc::gen::element(nan, far, -far, 1e9, -1e9)}});
    };
    Canvas canvas(black(*rc::gen::inRange(1, 40), *rc::gen::inRange(1, 40)));
    const std::vector<Point> points{
        {coordinate(), coordinate()}, {coordinate(), coordinate()}, {coordinate(), coordinate()}};
    canvas.polyline(points, 3.0, rgb(0xffffff));
    canvas.dashedPolyline(points, 3.0, 5.0, 4.0, rgb(0xffffff));
    canvas.polygon(points, rgb(0xff0000));
    canvas.discs(points, 4.0, rgb(0x00ff00));
    canvas.ring(points[0], 6.0, 2.0, rgb(0x00ff00));
    canvas.fillRect(points[0].x(), points[0].y(), points[1].x(), points[1].y(), rgb(0xffffff));
    canvas.text("x", points[0], 9.0, rgb(0xffffff), Align::kCenter, rgb(0));
  });
  EXPECT_TRUE(held);
}

TEST(CanvasTest, TextStaysWithinItsLine) {
  constexpr int kBaseline_px = 50;
  constexpr double kHeight_px = 15.0;
  for (int c = 33; c < 127; ++c) {
    Canvas canvas(black(100, 100));
    const std::string text(1, static_cast<char>(c));
    canvas.text(text, {50.0, kBaseline_px}, kHeight_px, rgb(0xffffff), Align::kCenter);
    const common::Image image = canvas.take();
    EXPECT_GT(ink(image), 0.0) << text;
    for (int y = 0; y < 100; ++y)
      for (int x = 0; x < 100; ++x)
        if (image.rgb[3 * static_cast<std::size_t>(y * 100 + x)] > 0) {
          EXPECT_LT(std::abs(x + 0.5 - 50.0), kHeight_px) << text;
          EXPECT_GT(y, kBaseline_px - 1.5 * kHeight_px) << text;
          EXPECT_LT(y, kBaseline_px + 0.6 * kHeight_px) << text;
        }
  }
  Canvas canvas(black(100, 100));
  canvas.text("\xc3\xa9", {50.0, kBaseline_px}, kHeight_px, rgb(0xffffff));
  EXPECT_GT(ink(canvas.take()), 0.0) << "what the font does not have";
}

/// The mean colour of the cells under a pixel, by many samples.
Eigen::Vector3d sampled(const common::OccupancyGrid& grid, const Viewport& viewport, int x, int y) {
  const auto colors = cellColors(themeOf(Scheme::kLight));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  constexpr int kSamples = 24;
  for (int i = 0; i < kSamples; ++i)
    for (int j = 0; j < kSamples; ++j) {
      const auto cell = grid.cellAt(viewport.toMap({x + (i + 0.5) / kSamples, y + (j + 0.5) / kSamples}));
      const Color c = colors[static_cast<std::size_t>(grid.at(cell) + 128)];
      sum += Eigen::Vector3d(c.red, c.green, c.blue);
    }
  return sum / (kSamples * kSamples);
}

/// WCAG 2.1.
double contrast(Color a, Color b) {
  const auto luminance = [](Color c) {
    const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
    return 0.05 + 0.2126 * linear(c.red / 255.0) + 0.7152 * linear(c.green / 255.0) + 0.0722 * linear(c.blue / 255.0);
  };
  return std::max(luminance(a), luminance(b)) / std::min(luminance(a), luminance(b));
}

TEST(GridLayerTest, AFreeCellCanBeToldFromTheUnknownHoweverOftenItWasSeen) {
  for (const Scheme scheme : {Scheme::kLight, Scheme::kDark}) {
    const auto colors = cellColors(themeOf(scheme));
    for (int cell = -127; cell <= 0; ++cell)
      EXPECT_GE(contrast(colors[static_cast<std::size_t>(cell + 128)], themeOf(scheme).unknown), 3.0) << cell;
  }
}

TEST(GridLayerTest, APixelIsTheMeanOfTheCellsItCovers) {
  testing::ExampleFlight flight;
  const auto world = flight.advance(3.0);
  // Many cells a pixel, about one, many pixels a cell.
  for (const double px_per_m : {3.7, 19.0, 61.3}) {
    const Viewport viewport{{1.234, 0.567}, px_per_m, 90, 70};
    common::Image image = black(90, 70);
    drawGrid(*world->map->grid, viewport, themeOf(Scheme::kLight), {0, 0, 90, 70}, image);
    for (int y = 0; y < 70; y += 3)
      for (int x = 0; x < 90; x += 3) {
        const Eigen::Vector3d wanted = sampled(*world->map->grid, viewport, x, y);
        const std::uint8_t* pixel = &image.rgb[3 * static_cast<std::size_t>(y * 90 + x)];
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(pixel[c], wanted[c], 11.0) << px_per_m << " " << x << "," << y;
      }
  }
}

TEST(GridLayerTest, DrawingInPiecesEqualsDrawingAtOnce) {
  testing::ExampleFlight flight;
  const auto world = flight.advance(2.0);
  const Viewport viewport{{0.3, 1.1}, 37.0, 120, 90};
  common::Image whole = black(120, 90), pieces = black(120, 90);
  drawGrid(*world->map->grid, viewport, themeOf(Scheme::kDark), {0, 0, 120, 90}, whole);
  for (int y = 0; y < 90; y += 17)
    for (int x = 0; x < 120; x += 23)
      drawGrid(*world->map->grid, viewport, themeOf(Scheme::kDark), {x, y, std::min(120, x + 23), std::min(90, y + 17)},
               pieces);
  EXPECT_EQ(whole.rgb, pieces.rgb);
}

TEST(ViewportTest, ConversionsBetweenScreenAndMapAreInverse) {
  const Viewport viewport{{3.0, -2.0}, 42.0, 640, 480};
  const Eigen::Vector2d p(1.25, 0.5);
  EXPECT_TRUE(viewport.toMap(viewport.toPixel(p)).isApprox(p));
  EXPECT_LT(viewport.toPixel({0, 1}).y(), viewport.toPixel({0, 0}).y());
}

TEST(ViewportTest, ADivergedEstimateKeepsTheMapInView) {
  testing::ExampleFlight flight;
  test::Layers layers(*flight.advance(1.0));
  const auto viewportOf = [](const MapPicture& picture) {
    return fitViewport(*picture.grid, picture.in_view_map_m, 640, 480);
  };
  const Viewport sound = viewportOf(pictureOf(layers.world(), 0.55));
  for (const double bad :
       {1e12, -1e30, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    layers.vehicle.state.T_odom_body.position_m.setConstant(bad);
    const MapPicture picture = pictureOf(layers.world(), 0.55);
    EXPECT_EQ(viewportOf(picture), sound);
    EXPECT_EQ(renderMap(picture, {}).width_px, 640);
  }
}

TEST(MapRendererTest, AnEmptyMapGivesAPicture) {
  MapPicture picture;
  picture.grid = std::make_shared<const common::OccupancyGrid>(common::makeOccupancyGrid(0.05));
  MapView view;
  view.width_px = 16;
  view.height_px = 16;
  EXPECT_EQ(renderMap(picture, view).rgb.size(), 768u);
}

/// A map where nothing is known, 10 px a metre, 16 m x 12 m.
struct BlankMap {
  BlankMap() {
    picture.grid = std::make_shared<const common::OccupancyGrid>(common::makeOccupancyGrid(0.05));
    view.width_px = 160;
    view.height_px = 120;
    view.viewport = Viewport{{0.0, 0.0}, 10.0, 160, 120};
  }
  /// Whether any pixel within `margin_px` of the place differs from the blank map.
  bool isInkedAt(double x_m, double y_m, int margin_px = 1) const {
    MapPicture blank;
    blank.grid = picture.grid;
    const common::Image with = renderMap(picture, view), without = renderMap(blank, view);
    const Eigen::Vector2d at = view.viewport->toPixel({x_m, y_m});
    for (int y = static_cast<int>(at.y()) - margin_px; y <= static_cast<int>(at.y()) + margin_px; ++y) {
      const auto first = 3 * (y * 160 + static_cast<int>(at.x()) - margin_px), length = 3 * (2 * margin_px + 1);
      if (!std::equal(with.rgb.begin() + first, with.rgb.begin() + first + length, without.rgb.begin() + first))
        return true;
    }
    return false;
  }

  MapPicture picture;
  MapView view;
};

TEST(MapRendererTest, DrawsEveryLineStyleInItsPlace) {
  for (const LineStyle style : {LineStyle::kTrail, LineStyle::kTrack, LineStyle::kPlan, LineStyle::kReference}) {
    BlankMap map;
    map.picture.lines = {{"", {{-3.05, 2.05}, {3.05, 2.05}}, style}};
    const auto inked = [&](int i) { return map.isInkedAt(-3.0 + 0.1 * i, 2.05, 0); };
    int count = 0;
    for (int i = 0; i <= 60; ++i) count += inked(i);
    const bool solid = style == LineStyle::kTrail || style == LineStyle::kTrack;
    EXPECT_EQ(count == 61, solid) << "style " << static_cast<int>(style) << ", inked " << count;
    EXPECT_GT(count, 30) << "style " << static_cast<int>(style);
    EXPECT_FALSE(map.isInkedAt(0.0, 0.0)) << "style " << static_cast<int>(style);
  }
}

TEST(MapRendererTest, DrawsEveryMarkInItsPlace) {
  for (const MarkStyle style : {MarkStyle::kHome, MarkStyle::kGoal, MarkStyle::kVehicle}) {
    BlankMap map;
    map.picture.marks = {{"", {2.05, 1.05, 0.5}, style, 0.6}};
    EXPECT_TRUE(map.isInkedAt(2.05, 1.05)) << "style " << static_cast<int>(style);
    EXPECT_FALSE(map.isInkedAt(-2.05, 1.05)) << "style " << static_cast<int>(style);
  }
}

TEST(MapRendererTest, ATrailWithoutItsVehicleEndsAtItsLastPoint) {
  BlankMap map;
  map.picture.lines = {{"", {{1.05, 1.05}, {1.55, 1.05}, {1.55, 2.05}}, LineStyle::kTrail}};
  EXPECT_TRUE(map.isInkedAt(1.55, 1.8));
  EXPECT_FALSE(map.isInkedAt(2.05, -1.95)) << "no line to a vehicle that is not shown";
}

TEST(MapRendererTest, MetreLinesAreThoseOfTheFrameThatIsShown) {
  BlankMap map;
  map.picture.shown = {true, {0.3, 0.2, common::kRadPerDeg * 30.0}};
  const auto isInked = [&](double x_shown_m, double y_shown_m) {
    const Eigen::Vector2d at_map_m = map.picture.shown.T_map_shown * Eigen::Vector2d(x_shown_m, y_shown_m);
    return map.isInkedAt(at_map_m.x(), at_map_m.y());
  };
  // At this scale there is one every 5 m.
  EXPECT_TRUE(isInked(0.0, 2.0) && isInked(0.0, -2.5) && isInked(2.0, 0.0) && isInked(5.0, 1.0));
  EXPECT_FALSE(isInked(2.5, 2.5) || isInked(1.5, -2.0));
}

TEST(PictureOfWorldTest, IsInTheGivenMapsFrameWhileThePlaceThereIsKnown) {
  test::Layers layers;
  EXPECT_FALSE(pictureOf(layers.world(), 0.55).shown.given);
  layers.map.T_map_given = common::Pose2{1.0, 2.0, 0.5};
  const ShownFrame shown = pictureOf(layers.world(), 0.55).shown;
  EXPECT_TRUE(shown.given);
  EXPECT_EQ(shown.T_map_shown.y_m, 2.0);
  EXPECT_EQ(picture3dOf(layers.world(), 0.55).shown.T_map_shown.yaw_rad, 0.5);
}

TEST(PictureOfWorldTest, TrailAndPlanMeetAtTheVehicle) {
  test::Layers layers;
  layers.vehicle.state.T_odom_body.position_m = {2.0, 3.0, 1.0};
  layers.vehicle.trail = common::Trail({{0.0, 0.0}, {1.0, 2.0}});
  layers.vehicle.plan_map_m = {{5.0, 3.0}, {5.0, 6.0}};
  layers.mission.goal_map_m = {5.0, 6.0};
  const MapPicture picture = pictureOf(layers.world(), 0.7);
  ASSERT_EQ(picture.lines.size(), 2u);
  EXPECT_EQ(picture.lines[0].points_map_m, (std::vector<Eigen::Vector2d>{{0.0, 0.0}, {1.0, 2.0}, {2.0, 3.0}}));
  EXPECT_EQ(picture.lines[1].points_map_m, (std::vector<Eigen::Vector2d>{{2.0, 3.0}, {5.0, 3.0}, {5.0, 6.0}}));
  ASSERT_EQ(picture.marks.size(), 3u);
  EXPECT_EQ(picture.marks[1].name, "goal");
  EXPECT_EQ(picture.marks[2].diameter_m, 0.7);
  EXPECT_EQ(picture.in_view_map_m, (std::vector<Eigen::Vector2d>{{0.0, 0.0}, {2.0, 3.0}, {5.0, 6.0}}));
}

TEST(PictureOfWorldTest, DrawsNoPlanWhenThereIsNone) {
  const MapPicture picture = pictureOf(test::Layers().world(), 0.55);
  ASSERT_EQ(picture.lines.size(), 1u);
  EXPECT_EQ(picture.lines[0].style, LineStyle::kTrail);
  EXPECT_EQ(picture.marks.size(), 2u) << "home and vehicle, no goal";
}

TEST(ResizeTest, EachPixelIsTheMeanOfItsArea) {
  common::Image image = black(12, 8);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = static_cast<std::uint8_t>(i * 37 % 251);
  const common::Image small = shrinkToWidth(image, 6);
  ASSERT_EQ(small.width_px, 6);
  ASSERT_EQ(small.height_px, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 6; ++x)
      for (int c = 0; c < 3; ++c) {
        const auto at = [&](int px, int py) { return image.rgb[static_cast<std::size_t>(3 * (py * 12 + px) + c)]; };
        const int sum = at(2 * x, 2 * y) + at(2 * x + 1, 2 * y) + at(2 * x, 2 * y + 1) + at(2 * x + 1, 2 * y + 1);
        EXPECT_EQ(small.rgb[static_cast<std::size_t>(3 * (y * 6 + x) + c)], (sum + 2) / 4);
      }
  EXPECT_EQ(shrinkToWidth(image, 12).rgb, image.rgb);
  // An even picture stays even at any ratio.
  common::Image grey = black(101, 57);
  std::fill(grey.rgb.begin(), grey.rgb.end(), std::uint8_t{77});
  for (const int width : {1, 7, 50, 100})
    for (const std::uint8_t value : shrinkToWidth(grey, width).rgb) ASSERT_EQ(value, 77);
}

}  // namespace
}  // namespace swiftlet::rendering
