// links: clearance common
// Figures of the clearance, on one core: a look-up, a fresh map of 1,000 x 1,000 cells, a scan's change, a space.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "common/random.hpp"
#include "planning/clearance/clearance.hpp"

namespace {

using namespace swiftlet;
using planning::Clearance;

constexpr double kCell_m = 0.05;

void fill(common::OccupancyGrid& grid, int x0, int y0, int w, int h, common::occupancy::Cell value) {
  for (int y = y0; y < y0 + h; ++y)
    for (int x = x0; x < x0 + w; ++x) grid.set({x, y}, value);
}

/// Rooms of 5 m with doors and furniture.
common::OccupancyGrid building(int cells) {
  common::RandomStream random(7, "clearance benchmark");
  common::OccupancyGrid grid = common::makeOccupancyGrid(kCell_m);
  fill(grid, 0, 0, cells, cells, -60);
  for (int line = 0; line < cells; line += 100)
    for (int room = 0; room < cells; room += 100) {
      const int door = static_cast<int>(random.uniform(10, 70));
      fill(grid, line, room, 3, 100, 60);
      fill(grid, line, room + door, 3, 20, -60);
      fill(grid, room, line, 100, 3, 60);
      fill(grid, room + door, line, 20, 3, -60);
    }
  for (int i = 0; i < cells * cells / 6000; ++i)
    fill(grid, static_cast<int>(random.uniform(0, cells - 25)), static_cast<int>(random.uniform(0, cells - 25)),
         static_cast<int>(random.uniform(4, 24)), static_cast<int>(random.uniform(4, 24)), 60);
  return grid;
}

void Fresh(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  common::OccupancyGrid grid = building(cells);
  const common::OccupancyGrid snapshot = grid.snapshot();
  for (auto _ : state) {
    Clearance clearance = Clearance::ofPlane(kCell_m);
    clearance.update(snapshot);
    benchmark::DoNotOptimize(clearance);
  }
}
BENCHMARK(Fresh)->Arg(500)->Arg(1000)->Unit(benchmark::kMillisecond);

/// Of the distances alone, without the states of the cells.
void FreshDistances(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  const common::OccupancyGrid grid = building(cells);
  std::vector<std::uint8_t> occupied(static_cast<std::size_t>(cells) * cells);
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) occupied[static_cast<std::size_t>(y) * cells + x] = grid.at({x, y}) > 0;
  const std::vector<planning::CellBox> all{{{0, 0, 0}, {cells, 1, cells}}};
  for (auto _ : state) {
    planning::DistanceField field({cells, 1, cells}, 40);
    field.update(all, [&](common::VoxelIndex first, std::span<std::uint8_t, planning::DistanceField::kRow> row) {
      for (int i = 0; i < planning::DistanceField::kRow; ++i)
        row[static_cast<std::size_t>(i)] =
            first.x + i < cells && first.z < cells
                ? occupied[static_cast<std::size_t>(first.z) * cells + static_cast<std::size_t>(first.x + i)]
                : std::uint8_t{0};
    });
    benchmark::DoNotOptimize(field);
  }
}
BENCHMARK(FreshDistances)->Arg(1000)->Unit(benchmark::kMillisecond);

/// A scan writes to every tile in sight, and turns cells at 60 places around the vehicle.
void ScansChange(benchmark::State& state) {
  common::OccupancyGrid grid = building(1000);
  Clearance clearance = Clearance::ofPlane(kCell_m);
  clearance.update(grid.snapshot());
  bool on = false;
  for (auto _ : state) {
    state.PauseTiming();
    on = !on;
    for (int i = 0; i < 60; ++i) {
      const double angle = i * 2.0 * M_PI / 60.0, range = 30.0 + 60.0 * (i % 5) / 4.0;
      const common::CellIndex cell{500 + static_cast<int>(range * std::cos(angle)),
                                   500 + static_cast<int>(range * std::sin(angle))};
      grid.set(cell, on ? 60 : -60);
    }
    const common::OccupancyGrid snapshot = grid.snapshot();
    state.ResumeTiming();
    clearance.update(snapshot);
  }
}
BENCHMARK(ScansChange)->Unit(benchmark::kMillisecond);

std::vector<Eigen::Vector3d> places(double side_m, double height_m) {
  common::RandomStream random(3, "places");
  std::vector<Eigen::Vector3d> result;
  for (int i = 0; i < 4096; ++i)
    result.emplace_back(random.uniform(0, side_m), random.uniform(0, side_m), random.uniform(0, height_m));
  return result;
}

void LookUp(benchmark::State& state) {
  common::OccupancyGrid grid = building(1000);
  Clearance clearance = Clearance::ofPlane(kCell_m);
  clearance.update(grid.snapshot());
  const auto at = places(50.0, 1.0);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(clearance.at_m(at[++i & 4095]));
}
BENCHMARK(LookUp);

/// 10 x 10 x 3 m in voxels of 5 cm with boxes.
common::VoxelMap room() {
  common::RandomStream random(5, "room");
  common::VoxelMap map(kCell_m);
  for (int z = 0; z < 60; ++z)
    for (int y = 0; y < 200; ++y)
      for (int x = 0; x < 200; ++x) map.set({x, y, z}, -40);
  for (int i = 0; i < 25; ++i) {
    const int x0 = static_cast<int>(random.uniform(0, 180)), y0 = static_cast<int>(random.uniform(0, 180)),
              z0 = static_cast<int>(random.uniform(0, 40));
    for (int z = z0; z < z0 + 15; ++z)
      for (int y = y0; y < y0 + 15; ++y)
        for (int x = x0; x < x0 + 15; ++x) map.set({x, y, z}, 70);
  }
  return map;
}

void FreshSpace(benchmark::State& state) {
  common::VoxelMap map = room();
  const common::VoxelMap snapshot = map.snapshot();
  for (auto _ : state) {
    Clearance clearance = Clearance::ofSpace(kCell_m, state.range(0) != 0 ? std::optional(0.25) : std::nullopt);
    clearance.update(snapshot);
    benchmark::DoNotOptimize(clearance);
  }
}
BENCHMARK(FreshSpace)->ArgName("hull")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void LookUpInSpace(benchmark::State& state) {
  common::VoxelMap map = room();
  Clearance clearance = Clearance::ofSpace(kCell_m);
  clearance.update(map.snapshot());
  const auto at = places(10.0, 3.0);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(clearance.at_m(at[++i & 4095]));
}
BENCHMARK(LookUpInSpace);

}  // namespace
