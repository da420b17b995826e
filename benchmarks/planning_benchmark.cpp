// links: planning common
// Figures of planning, on one core. The hall of the planner's figures is 20 m by 12 m at 4 cm with furniture; the way
// is 10 m (Grzonka 2012, section IV-E: 50-80 ms from scratch, below 10 ms again).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <optional>
#include <queue>
#include <vector>

#include "common/random.hpp"
#include "planning/avoidance/avoidance.hpp"
#include "planning/costs/cost_map.hpp"
#include "planning/exploration/exploration.hpp"
#include "planning/search/dstar_lite.hpp"
#include "planning/search/edge_cost.hpp"
#include "planning/search/wavefront.hpp"

namespace {

using namespace swiftlet;
using common::CellIndex;
using planning::CostMap;
using Point = Eigen::Vector2d;

void fill(common::OccupancyGrid& grid, int x0, int y0, int w, int h, common::occupancy::Cell value) {
  for (int y = y0; y < y0 + h; ++y)
    for (int x = x0; x < x0 + w; ++x) grid.set({x, y}, value);
}

/// A hall with `boxes` boxes; with walls every 5 m that leave a door.
common::OccupancyGrid hall(int width, int height, int boxes, double resolution_m, bool walls) {
  common::RandomStream random(7, "benchmark hall");
  common::OccupancyGrid grid = common::makeOccupancyGrid(resolution_m);
  fill(grid, -2, -2, width + 4, height + 4, 60);
  fill(grid, 0, 0, width, height, -60);
  const int room = static_cast<int>(5.0 / resolution_m), door = static_cast<int>(1.2 / resolution_m);
  if (walls)
    for (int x = room; x < width; x += room) {
      fill(grid, x, 0, 3, height, 60);
      fill(grid, x, static_cast<int>(random.uniform(10, height - door - 10)), 3, door, -60);
    }
  for (int i = 0; i < boxes; ++i) {
    const int w = static_cast<int>(random.uniform(0.3, 1.2) / resolution_m);
    const int h = static_cast<int>(random.uniform(0.3, 1.2) / resolution_m);
    fill(grid, static_cast<int>(random.uniform(0, width - w)), static_cast<int>(random.uniform(0, height - h)), w, h,
         60);
  }
  return grid;
}

struct Task {
  Point start;
  Point goal;
};

struct Scene {
  common::OccupancyGrid grid;
  CostMap map;
  Task task;
};

/// Ends 10 m apart, moved to free places.
Scene scene(bool cluttered, double resolution_m = 0.04) {
  common::OccupancyGrid grid = hall(static_cast<int>(20 / resolution_m), static_cast<int>(12 / resolution_m),
                                    cluttered ? 40 : 0, resolution_m, false);
  CostMap map({}, resolution_m);
  map.update(grid.snapshot(), {});
  const Task task{*planning::nearestFree(map, {4.0, 4.0}), *planning::nearestFree(map, {13.2, 8.0})};
  return {std::move(grid), std::move(map), task};
}

/// The peer of the figures: A* with the same costs and heuristic, from scratch, arrays and a binary heap.
std::optional<std::int64_t> aStar(const CostMap& map, CellIndex start, CellIndex goal) {
  struct Entry {
    std::int32_t key, index;
    bool operator<(const Entry& other) const { return key > other.key; }
  };
  std::vector<std::int32_t> cost(map.costs().size(), INT32_MAX);
  std::priority_queue<Entry> open;
  const int first = map.indexOf(start), last = map.indexOf(goal);
  const auto heuristic = [&](int index) {
    const CellIndex c = map.cellOf(index);
    const int dx = std::abs(c.x - goal.x), dy = std::abs(c.y - goal.y), d = std::min(dx, dy);
    return 2 * CostMap::kOpenCost * (17 * d + 12 * (std::max(dx, dy) - d));
  };
  cost[static_cast<std::size_t>(first)] = 0;
  open.push({heuristic(first), first});
  while (!open.empty()) {
    const Entry top = open.top();
    open.pop();
    const std::int32_t here = cost[static_cast<std::size_t>(top.index)];
    if (top.key > here + heuristic(top.index)) continue;
    if (top.index == last) return here;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0) continue;
        const std::int32_t edge = edgeCost(map, top.index, dx, dy);
        const int next = top.index + dy * map.rect().width() + dx;
        if (edge == planning::kNoEdge || here + edge >= cost[static_cast<std::size_t>(next)]) continue;
        cost[static_cast<std::size_t>(next)] = here + edge;
        open.push({here + edge + heuristic(next), next});
      }
  }
  return std::nullopt;
}

void DStarFresh(benchmark::State& state) {
  const Scene s = scene(state.range(0) != 0);
  planning::DStarLite planner;
  bool flip = false;
  for (auto _ : state) {
    // Another goal cell each time: nothing is kept.
    flip = !flip;
    auto path = planner.plan(s.map, s.task.start, s.task.goal + Point(0.0, flip ? 0.05 : 0.0));
    if (!path) state.SkipWithError(path.error().text.c_str());
    benchmark::DoNotOptimize(path);
  }
  state.counters["expansions"] = planner.expansions();
}
BENCHMARK(DStarFresh)->ArgName("cluttered")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// A disc of 0.4 m appears 2 m ahead on the plan, and goes again.
void DStarRepair(benchmark::State& state) {
  Scene s = scene(state.range(0) != 0);
  planning::DStarLite planner;
  const auto plain = planner.plan(s.map, s.task.start, s.task.goal);
  Point ahead = plain->points_map_m.back();
  double left_m = 2.0;
  for (std::size_t i = 1; i < plain->points_map_m.size(); ++i) {
    const Point step = plain->points_map_m[i] - plain->points_map_m[i - 1];
    if (step.norm() >= left_m) {
      ahead = plain->points_map_m[i - 1] + step.normalized() * left_m;
      break;
    }
    left_m -= step.norm();
  }
  CostMap blocked = s.map;
  const std::vector<common::Disc> discs{{ahead, 0.2}};
  blocked.update(s.grid.snapshot(), {}, {discs, nullptr});
  for (auto _ : state) {
    auto path = planner.plan(blocked, s.task.start, s.task.goal);
    if (!path) state.SkipWithError(path.error().text.c_str());
    benchmark::DoNotOptimize(path);
    state.PauseTiming();
    state.counters["expansions"] = planner.expansions();
    (void)planner.plan(s.map, s.task.start, s.task.goal);
    state.ResumeTiming();
  }
}
BENCHMARK(DStarRepair)->ArgName("cluttered")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// A flight through a floor of 350,000 cells to its far end: each scan turns cells at six places within 4.5 m of the
/// vehicle, three that become occupied and three that are free again after a second. Only the repair is timed, in
/// processor time.
void DStarScans(benchmark::State& state) {
  constexpr double kResolution_m = 0.05, kScan_s = 0.1, kSpeed_m_s = 0.7;
  std::vector<double> times_ms;
  for (auto _ : state) {
    common::OccupancyGrid grid = hall(700, 500, 120, kResolution_m, true);
    CostMap map({}, kResolution_m);
    map.update(grid.snapshot(), {});
    common::RandomStream random(11, "benchmark scans");
    planning::DStarLite planner;
    const Point goal = *planning::nearestFree(map, {33.0, 12.0});
    Point at = *planning::nearestFree(map, {2.0, 12.0});
    auto path = planner.plan(map, at, goal);
    std::vector<CellIndex> occupied;
    for (int scan = 0; path && (goal - at).norm() > 1.0 && scan < 600; ++scan) {
      while (occupied.size() > 30) {
        grid.set(occupied.front(), -60);
        occupied.erase(occupied.begin());
      }
      for (int i = 0; i < 3; ++i) {
        const CellIndex cell = grid.cellAt(at + Point(random.uniform(-4.5, 4.5), random.uniform(-4.5, 4.5)));
        if (grid.at(cell) >= 0 || (grid.centerOf(cell) - at).norm() < 1.0) continue;
        grid.set(cell, 60);
        occupied.push_back(cell);
      }
      map.update(grid.snapshot(), {});
      const std::clock_t before = std::clock();
      auto next = planner.plan(map, at, goal);
      times_ms.push_back(1e3 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
      if (!next) continue;
      path = std::move(next);
      const Point step = path->points_map_m[1] - at;
      at += step.norm() > kSpeed_m_s * kScan_s ? Point(step.normalized() * kSpeed_m_s * kScan_s) : step;
    }
  }
  std::sort(times_ms.begin(), times_ms.end());
  const auto quantile = [&](double share) { return times_ms[static_cast<std::size_t>(share * (times_ms.size() - 1))]; };
  state.counters["repairs"] = static_cast<double>(times_ms.size());
  state.counters["median_ms"] = quantile(0.5);
  state.counters["p99_ms"] = quantile(0.99);
  state.counters["greatest_ms"] = times_ms.back();
}
BENCHMARK(DStarScans)->Iterations(1)->Unit(benchmark::kMillisecond);

/// The vehicle flies on, nothing changes: what each tick of replanning costs.
void DStarMoved(benchmark::State& state) {
  const Scene s = scene(true);
  planning::DStarLite planner;
  const auto plain = planner.plan(s.map, s.task.start, s.task.goal);
  const Point step = (plain->points_map_m[1] - plain->points_map_m[0]).normalized() * 0.04;
  int i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(planner.plan(s.map, s.task.start + step * (++i % 20), s.task.goal));
}
BENCHMARK(DStarMoved)->Unit(benchmark::kMillisecond);

void AStarFresh(benchmark::State& state) {
  const Scene s = scene(state.range(0) != 0);
  for (auto _ : state) benchmark::DoNotOptimize(aStar(s.map, s.map.cellAt(s.task.start), s.map.cellAt(s.task.goal)));
}
BENCHMARK(AStarFresh)->ArgName("cluttered")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void WavefrontPlan(benchmark::State& state) {
  const Scene s = scene(true);
  planning::Wavefront planner;
  for (auto _ : state) benchmark::DoNotOptimize(planner.plan(s.map, s.task.start, s.task.goal));
}
BENCHMARK(WavefrontPlan)->Unit(benchmark::kMillisecond);

void CostMapFresh(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  common::OccupancyGrid grid = hall(cells, cells, cells * cells / 6000, 0.05, true);
  const common::OccupancyGrid snapshot = grid.snapshot();
  for (auto _ : state) {
    CostMap map({}, 0.05);
    map.update(snapshot, {});
    benchmark::DoNotOptimize(map);
  }
}
BENCHMARK(CostMapFresh)->Arg(200)->Arg(500)->Unit(benchmark::kMillisecond);

/// A scan touches every tile in sight but changes the state of a few cells.
void CostMapUpdate(benchmark::State& state) {
  common::OccupancyGrid grid = hall(500, 500, 40, 0.05, true);
  CostMap map({}, 0.05);
  map.update(grid.snapshot(), {});
  bool on = false;
  for (auto _ : state) {
    state.PauseTiming();
    on = !on;
    for (int y = 0; y < 500; y += 20)
      for (int x = 0; x < 500; x += 20)
        grid.mutableAt({x, y}) = grid.at({x, y}) < 0 ? (on ? -59 : -60) : grid.at({x, y});
    fill(grid, 240, 240, 4, 4, on ? 60 : -60);
    const common::OccupancyGrid snapshot = grid.snapshot();
    state.ResumeTiming();
    map.update(snapshot, {});
  }
}
BENCHMARK(CostMapUpdate)->Unit(benchmark::kMillisecond);

/// Half of the building known, open frontiers all along.
void Explore(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  common::OccupancyGrid grid = hall(cells, cells, cells * cells / 6000, 0.05, true);
  common::RandomStream random(3, "benchmark explore");
  for (int i = 0; i < cells / 8; ++i)
    fill(grid, static_cast<int>(random.uniform(0, cells - 20)), static_cast<int>(random.uniform(0, cells - 20)), 20, 12,
         common::occupancy::kUnknown);
  fill(grid, cells / 2, 0, cells / 2 + 2, cells / 2, common::occupancy::kUnknown);
  auto map = std::make_shared<CostMap>(CostMap::Config{}, 0.05);
  map->update(grid.snapshot(), {});
  const Point start = *planning::nearestFree(*map, {cells * 0.0125, cells * 0.025});
  planning::ExplorationInput input;
  input.cost_map = map;
  input.pose_map = {start.x(), start.y(), 0.0};
  planning::ExplorationResult result;
  for (auto _ : state) {
    result = planning::exploreByUtility(input, {});
    benchmark::DoNotOptimize(result);
  }
  state.counters["frontiers"] = static_cast<double>(result.frontiers.size());
  state.counters["open"] =
      static_cast<double>(std::count_if(result.frontiers.begin(), result.frontiers.end(),
                                        [](const auto& f) { return f.reason == common::FrontierReason::kOpen; }));
}
BENCHMARK(Explore)->Arg(200)->Arg(350)->Arg(500)->Unit(benchmark::kMillisecond);

void AvoidanceTick(benchmark::State& state) {
  common::OccupancyGrid grid = hall(200, 160, 0, 0.05, false);
  CostMap map({}, 0.05);
  map.update(grid.snapshot(), {});
  std::vector<Eigen::Vector2f> points;
  for (int i = 0; i < 1081; ++i) {
    const double a = (i * 0.25 - 135.0) * M_PI / 180.0;
    const double r = std::abs(a) < 0.1 ? 0.6
                                       : std::min(5.0 / std::max(0.01, std::abs(std::cos(a))),
                                                  4.0 / std::max(0.01, std::abs(std::sin(a))));
    points.push_back({static_cast<float>(r * std::cos(a)), static_cast<float>(r * std::sin(a))});
  }
  planning::Avoidance avoidance({}, 0.275);
  common::DynamicObstacle person;
  person.center_map_m = {6.5, 4.0};
  person.radius_m = 0.25;
  person.velocity_map_m_s = {-1.0, 0.0};
  person.moving = true;
  const std::vector people{person};
  for (auto _ : state)
    benchmark::DoNotOptimize(
        avoidance.update({{}, points, {0.5, 0}, {0.5, 0}, {5.0, 4.0, 0.0}, &map.clearance(), people}));
}
BENCHMARK(AvoidanceTick)->Unit(benchmark::kMicrosecond);

}  // namespace
