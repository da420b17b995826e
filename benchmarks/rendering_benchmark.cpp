// links: rendering fake_backend
// A 640 pixel view of a flat of about 250 x 190 cells, from a snapshot to bytes.
#include <algorithm>
#include <memory>

#include <benchmark/benchmark.h>

#include "common/jpeg_encoder.hpp"
#include "common/png_encoder.hpp"
#include "rendering/map3d_renderer.hpp"
#include "rendering/map_renderer.hpp"
#include "rendering/resize.hpp"
#include "tests/rendering/example_flight.hpp"

namespace swiftlet::rendering {
namespace {

/// 300 x 300 cells, all known.
test::Layers wholeMap() {
  testing::ExampleFlight flight;
  test::Layers layers(*flight.advance(30.0));
  common::OccupancyGrid grid = *layers.map.grid;
  for (int y = -80; y < 220; ++y)
    for (int x = -60; x < 240; ++x)
      if (common::occupancy::isUnknown(grid.at({x, y})))
        grid.set({x, y}, static_cast<common::occupancy::Cell>(-(x * y) % 60));
  layers.map.grid = std::make_shared<const common::OccupancyGrid>(grid.snapshot());
  return layers;
}

void fresh(benchmark::State& state) {
  const common::World world = wholeMap().world();
  MapView view;
  view.width_px = static_cast<int>(state.range(0));
  view.height_px = view.width_px * 3 / 4;
  for (auto _ : state) benchmark::DoNotOptimize(renderMap(pictureOf(world, 0.55), view));
}
BENCHMARK(fresh)->Arg(320)->Arg(640)->Arg(1280)->Unit(benchmark::kMillisecond);

void streamed(benchmark::State& state) {
  test::Layers layers = wholeMap();
  common::OccupancyGrid grid = *layers.map.grid;
  MapRenderer renderer;
  int step = 0;
  for (auto _ : state) {
    state.PauseTiming();
    grid.snapshot();
    for (int tile = 0; tile < 4; ++tile) grid.set({64 * (tile % 2) + step % 60, 64 * (tile / 2)}, 50);
    ++step;
    layers.map.grid = std::make_shared<const common::OccupancyGrid>(grid.snapshot());
    const common::World world = layers.world();
    state.ResumeTiming();
    benchmark::DoNotOptimize(renderer.render(pictureOf(world, 0.55), {}));
  }
}
BENCHMARK(streamed)->Unit(benchmark::kMillisecond);

void jpeg(benchmark::State& state) {
  const common::Image image = renderMap(pictureOf(wholeMap().world(), 0.55), {});
  common::JpegEncoder encoder;
  std::size_t bytes = 0;
  for (auto _ : state) bytes = encoder.encode(image, 85).size();
  state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(jpeg)->Unit(benchmark::kMillisecond);

void png(benchmark::State& state) {
  const common::Image image = renderMap(pictureOf(wholeMap().world(), 0.55), {});
  std::size_t bytes = 0;
  for (auto _ : state) bytes = common::encodePng(image).size();
  state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(png)->Unit(benchmark::kMillisecond);

void shrinkCamera(benchmark::State& state) {
  const common::CameraFrame frame = testing::ExampleFlight::cameraFrame(1.0, 1280, 720);
  for (auto _ : state) benchmark::DoNotOptimize(shrinkToWidth(frame.image, 480));
}
BENCHMARK(shrinkCamera)->Unit(benchmark::kMillisecond);

/// The whole flat from one of many directions: 500,000 points, 640 x 480.
void map3d(benchmark::State& state) {
  Picture3d picture;
  auto points = testing::ExampleFlight::room().surface(0.024);
  points.resize(std::min<std::size_t>(points.size(), 500'000));
  picture.surfaces.push_back({std::make_shared<const std::vector<common::SurfacePoint>>(std::move(points)), {}});
  Map3dView view;
  view.viewpoint.kind = static_cast<Viewpoint3d::Kind>(state.range(0));
  view.viewpoint.distance_m = 3.0;
  for (auto _ : state) {
    view.viewpoint.azimuth_rad += 0.3;
    benchmark::DoNotOptimize(renderMap3d(picture, view));
  }
}
BENCHMARK(map3d)->ArgName("view")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// A stream of a map of 500,000 points whose last submap of 20,000 grows while the viewpoint stays.
void map3dStreamed(benchmark::State& state) {
  auto points = testing::ExampleFlight::room().surface(0.024);
  points.resize(std::min<std::size_t>(points.size(), 500'000));
  Picture3d picture;
  for (std::size_t begin = 0; begin < points.size(); begin += 20'000)
    picture.surfaces.push_back(
        {std::make_shared<const std::vector<common::SurfacePoint>>(
             points.begin() + static_cast<std::ptrdiff_t>(begin),
             points.begin() + static_cast<std::ptrdiff_t>(std::min(points.size(), begin + 20'000))),
         {}});
  Map3dRenderer renderer;
  for (auto _ : state) benchmark::DoNotOptimize(renderer.render(picture, {}));
}
BENCHMARK(map3dStreamed)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace swiftlet::rendering
