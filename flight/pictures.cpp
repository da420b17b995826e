#include "flight/pictures.hpp"

#include <limits>
#include <string>
#include <vector>

#include "common/base64.hpp"
#include "common/jpeg_encoder.hpp"
#include "common/png_encoder.hpp"
#include "common/world.hpp"
#include "common/world/vehicle_layer.hpp"
#include "rendering/map3d_renderer.hpp"
#include "rendering/map_picture.hpp"
#include "rendering/map_renderer.hpp"
#include "rendering/map_svg.hpp"
#include "rendering/plot_svg.hpp"

namespace swiftlet::flight {
namespace {

using interfaces::FlightSample;

template <typename Value>
rendering::Series seriesOf(const std::string& name, const std::vector<FlightSample>& samples, Value value) {
  rendering::Series series;
  series.name = name;
  for (const FlightSample& sample : samples) series.points.emplace_back(sample.time_s, value(sample));
  return series;
}

std::vector<rendering::Span> spansOf(const std::vector<interfaces::Phase>& phases) {
  std::vector<rendering::Span> spans;
  for (const interfaces::Phase& phase : phases)
    spans.push_back({phase.begin.seconds(), phase.end.seconds(), phase.name});
  return spans;
}

std::string plotOf(const std::string& title, const std::string& y_label, std::vector<rendering::Series> series,
                   std::vector<rendering::Span> spans) {
  rendering::Plot plot;
  plot.title = title;
  plot.x_label = "time (s)";
  plot.y_label = y_label;
  plot.series = std::move(series);
  plot.spans = std::move(spans);
  return rendering::plotSvg(plot);
}

/// The value is zero before the first measurement; the curve starts with that measurement.
double measured(double value) { return value > 0.0 ? value : std::numeric_limits<double>::quiet_NaN(); }

std::vector<std::string> plotsOf(const interfaces::FlightSummary& summary) {
  const auto& samples = summary.samples;
  const auto spans = spansOf(summary.phases);
  std::vector<std::string> plots{
      plotOf("Height", "m",
             {seriesOf("over the take-off floor", samples, [](const FlightSample& s) { return s.position_map_m.z(); }),
              seriesOf("over what is below", samples, [](const FlightSample& s) { return s.height_above_ground_m; })},
             spans),
      plotOf("Speed", "m/s", {seriesOf("horizontal", samples, [](const FlightSample& s) { return s.speed_m_s; })},
             spans),
      plotOf("Nearest return", "m from the hull",
             {seriesOf("nearest", samples, [](const FlightSample& s) { return measured(s.nearest_m); })}, spans),
      plotOf("Battery", "V",
             {seriesOf("voltage", samples, [](const FlightSample& s) { return measured(s.battery_v); })}, spans),
  };
  if (summary.explored_area_m2)
    plots.push_back(plotOf(
        "Explored", "m²",
        {seriesOf("free area known", samples, [](const FlightSample& s) { return s.explored_area_m2; })}, spans));
  return plots;
}

std::vector<Eigen::Vector2d> planarPoints(const common::Trajectory& trajectory) {
  std::vector<Eigen::Vector2d> points;
  for (const common::StampedPose& pose : trajectory) points.emplace_back(pose.pose.position_m.head<2>());
  return points;
}

}  // namespace

interfaces::ReportPictures reportPictures(const common::World& world, const interfaces::FlightSummary& summary,
                                          const common::Trajectory& truth_map, double hull_diameter_m) {
  rendering::MapView view;
  view.width_px = 960;
  view.height_px = 720;
  rendering::MapPicture picture = rendering::pictureOf(world, hull_diameter_m);
  picture.scan_map_m.clear();
  const std::vector<std::uint8_t> png = common::encodePng(rendering::renderMap(picture, view));

  const common::VehicleLayer& vehicle = *world.vehicle;
  const auto trail_map_m = vehicle.trail.points_map_m();
  picture.lines = {{"estimate", {trail_map_m.begin(), trail_map_m.end()}, rendering::LineStyle::kTrail}};
  if (!truth_map.empty())
    picture.lines.push_back({"ground truth", planarPoints(truth_map), rendering::LineStyle::kReference});
  picture.marks = {{"home", vehicle.home_map, rendering::MarkStyle::kHome}};

  interfaces::ReportPictures pictures;
  pictures.map_png.assign(png.begin(), png.end());
  pictures.map_svg = rendering::mapSvg(picture);
  if (world.map3d) pictures.map3d_jpeg = map3dPicture(rendering::picture3dOf(world, hull_diameter_m));
  pictures.plots_svg = plotsOf(summary);
  return pictures;
}

std::string map3dPicture(const rendering::Picture3d& picture) {
  constexpr int kQuality = 85;  // As the map's stream, whose lines would blur below.
  rendering::Map3dView view;
  view.width_px = 960;
  view.height_px = 720;
  view.scheme = rendering::Scheme::kLight;
  return common::base64(common::JpegEncoder().encode(rendering::renderMap3d(picture, view), kQuality));
}

}  // namespace swiftlet::flight
