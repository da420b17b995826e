#include "flatland.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planning/search/wavefront.hpp"
#include "tests/support/observed_cell.hpp"

namespace swiftlet::planning::test {
namespace {

using common::CellIndex;
using common::Pose2;
using Point = Eigen::Vector2d;

constexpr double kRes = Flatland::kResolution_m;

int cells(double m) { return static_cast<int>(std::lround(m / kRes)); }

/// Cells the hull's centre can reach from the start, in truth.
std::vector<bool> reachable(const Flatland& world, double radius_m) {
  const int reach = static_cast<int>(std::ceil(radius_m / kRes));
  const auto clear = [&](int x, int y) {
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx)
        if (std::hypot(dx, dy) * kRes < radius_m && world.occupied(x + dx, y + dy)) return false;
    return true;
  };
  std::vector<bool> result(world.walls.size(), false);
  std::vector<CellIndex> open{world.start};
  while (!open.empty()) {
    const CellIndex c = open.back();
    open.pop_back();
    if (c.x < 0 || c.y < 0 || c.x >= world.width || c.y >= world.height) continue;
    const std::size_t i = static_cast<std::size_t>(c.y) * world.width + c.x;
    if (result[i] || !clear(c.x, c.y)) continue;
    result[i] = true;
    for (const CellIndex n : {CellIndex{c.x + 1, c.y}, {c.x - 1, c.y}, {c.x, c.y + 1}, {c.x, c.y - 1}})
      open.push_back(n);
  }
  return result;
}

double coverageOf(const Flatland& world, const common::OccupancyGrid& grid, double radius_m) {
  const std::vector<bool> centers = reachable(world, radius_m);
  const int reach = static_cast<int>(radius_m / kRes);
  std::vector<bool> counted(world.walls.size(), false);
  for (int y = 0; y < world.height; ++y)
    for (int x = 0; x < world.width; ++x) {
      if (!centers[static_cast<std::size_t>(y) * world.width + x]) continue;
      for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx)
          if (std::hypot(dx, dy) * kRes < radius_m && !world.occupied(x + dx, y + dy))
            counted[static_cast<std::size_t>(y + dy) * world.width + (x + dx)] = true;
    }
  int all = 0, known = 0;
  for (int y = 0; y < world.height; ++y)
    for (int x = 0; x < world.width; ++x) {
      if (!counted[static_cast<std::size_t>(y) * world.width + x]) continue;
      ++all;
      known += !common::occupancy::isUnknown(grid.at(world.toMap({x, y})));
    }
  return all == 0 ? 0.0 : static_cast<double>(known) / all;
}

/// One sweep into the map; beams that fall out leave nothing.
void scan(const Flatland& world, const Pose2& pose, const FlightConfig& config, common::RandomStream& random,
          common::OccupancyGrid& grid) {
  const double half_rad = 0.75 * std::numbers::pi;
  for (int beam = 0; beam < config.beams; ++beam) {
    if (random.chance(config.dropout_rate)) continue;
    const double angle_rad = pose.yaw_rad - half_rad + 2.0 * half_rad * beam / (config.beams - 1);
    const Point direction(std::cos(angle_rad), std::sin(angle_rad));
    std::vector<CellIndex> passed;
    bool lost = false;
    for (double r = 0.0; r < config.range_m; r += 0.4 * kRes) {
      const Point point_m = pose.position_m() + r * direction;
      const CellIndex cell = grid.cellAt(point_m);
      if (!passed.empty() && cell == passed.back()) continue;
      passed.push_back(cell);
      if (!world.occupiedAt(point_m)) continue;
      const CellIndex truth{cell.x + world.start.x, cell.y + world.start.y};
      for (const common::CellRect& black : world.black) lost |= black.contains(truth);
      if (!lost) grid.set(cell, test_support::observed(grid.at(cell), 17));
      passed.pop_back();
      break;
    }
    if (lost) continue;
    for (const CellIndex cell : passed) grid.set(cell, test_support::observed(grid.at(cell), -8));
  }
}

/// The ideal vehicle on a path: a speed with an acceleration limit, slowing for the end, the nose along the path.
struct Flyer {
  Pose2 pose;
  double speed_m_s = 0.0;
  std::size_t next = 1;

  void step(const Viewpoint& viewpoint, const Path& path, const FlightConfig& config, double dt_s,
            FlightReport& report) {
    const auto& points = path.points_map_m;
    double left_m = 0.0;
    Point at = pose.position_m();
    for (std::size_t i = next; i < points.size(); ++i) {
      left_m += (points[i] - at).norm();
      at = points[i];
    }
    const double a = config.acceleration_m_s2;
    speed_m_s = std::min({config.speed_m_s, speed_m_s + a * dt_s, std::sqrt(2.0 * a * left_m) + 0.02});
    double budget_m = std::min(speed_m_s * dt_s, left_m);
    report.length_m += budget_m;
    Point heading = Point::Zero();
    while (budget_m > 0.0 && next < points.size()) {
      const Point step = points[next] - pose.position_m();
      const double length_m = step.norm();
      if (length_m > 1e-9) heading = step / length_m;
      const double go_m = std::min(budget_m, length_m);
      const Point to = length_m > 1e-9 ? Point(pose.position_m() + step * (go_m / length_m)) : points[next];
      pose.x_m = to.x();
      pose.y_m = to.y();
      budget_m -= go_m;
      if (go_m >= length_m - 1e-9) ++next;
    }
    const bool near = left_m < 0.6 || heading.isZero();
    const double wanted_rad = near ? viewpoint.pose_map.yaw_rad : std::atan2(heading.y(), heading.x());
    const double turn_rad = common::wrapAngle(wanted_rad - pose.yaw_rad), most_rad = config.yaw_rate_rad_s * dt_s;
    pose.yaw_rad = common::wrapAngle(pose.yaw_rad + std::clamp(turn_rad, -most_rad, most_rad));
  }

  bool arrived(const Viewpoint& viewpoint) const {
    return (pose.position_m() - viewpoint.pose_map.position_m()).norm() < 0.05 &&
           std::abs(common::wrapAngle(pose.yaw_rad - viewpoint.pose_map.yaw_rad)) < 0.1;
  }
};

}  // namespace

bool Flatland::occupiedAt(const Point& point_map_m) const {
  return occupied(static_cast<int>(std::floor(point_map_m.x() / kRes)) + start.x,
                  static_cast<int>(std::floor(point_map_m.y() / kRes)) + start.y);
}

void Flatland::block(int x0, int y0, int w, int h) {
  for (int y = std::max(0, y0); y < std::min(height, y0 + h); ++y)
    for (int x = std::max(0, x0); x < std::min(width, x0 + w); ++x)
      walls[static_cast<std::size_t>(y) * width + x] = true;
}

void Flatland::open(int x0, int y0, int w, int h) {
  for (int y = std::max(2, y0); y < std::min(height - 2, y0 + h); ++y)
    for (int x = std::max(2, x0); x < std::min(width - 2, x0 + w); ++x)
      walls[static_cast<std::size_t>(y) * width + x] = false;
}

Flatland randomBuilding(std::uint64_t seed, double width_m, double height_m, int rooms_x, int rooms_y, int boxes) {
  common::RandomStream random(seed, "building");
  Flatland world;
  world.width = cells(width_m);
  world.height = cells(height_m);
  world.walls.assign(static_cast<std::size_t>(world.width) * world.height, false);
  const auto whole = [&](double low, double high) { return static_cast<int>(random.uniform(low, high)); };
  world.block(0, 0, world.width, 2);
  world.block(0, world.height - 2, world.width, 2);
  world.block(0, 0, 2, world.height);
  world.block(world.width - 2, 0, 2, world.height);
  const int w = world.width / rooms_x, h = world.height / rooms_y;
  for (int i = 1; i < rooms_x; ++i) world.block(i * w, 0, 3, world.height);
  for (int j = 1; j < rooms_y; ++j) world.block(0, j * h, world.width, 3);
  for (int b = 0; b < boxes; ++b)
    world.block(whole(0, world.width), whole(0, world.height), whole(6, 26), whole(6, 26));
  for (int i = 0; i < rooms_x; ++i) {
    for (int j = 0; j < rooms_y; ++j) {
      const int door = whole(18, 24);
      // Through the wall and past any box in between.
      if (i + 1 < rooms_x && (j == 0 || random.chance(0.6)))
        world.open((i + 1) * w - 12, j * h + whole(10, h - door - 10), 27, door);
      if (j + 1 < rooms_y) world.open(i * w + whole(10, w - door - 10), (j + 1) * h - 12, door, 27);
    }
  }
  do {
    world.start = {whole(10, world.width - 10), whole(10, world.height - 10)};
  } while ([&] {
    for (int dy = -10; dy <= 10; ++dy)
      for (int dx = -10; dx <= 10; ++dx)
        if (world.occupied(world.start.x + dx, world.start.y + dy)) return true;
    return false;
  }());
  return world;
}

Flatland pocketRoom(std::uint64_t seed) {
  common::RandomStream random(seed, "pocket room");
  Flatland world = randomBuilding(seed, 12.2, 7.76, 1, 1, 0);
  const auto shift = [&] { return static_cast<int>(random.uniform(-6, 6)); };
  world.block(70 + shift(), 24 + shift(), 24, 44);
  world.block(150 + shift(), 80 + shift(), 44, 24);
  world.start = {26 + shift(), 26 + shift()};
  return world;
}

FlightReport fly(const Flatland& world, const FlightConfig& config, std::uint64_t seed) {
  constexpr double kStep_s = 0.1;
  constexpr int kTicksPerCall = 5;
  FlightReport report;
  common::RandomStream random(seed, "flight");
  CostMap map(config.cost_map, kRes);
  std::vector<ExplorationAttempt> attempts;
  Flyer flyer;
  std::optional<Viewpoint> current;
  Path path;
  Wavefront planner;
  common::OccupancyGrid& grid = report.grid;
  flyer.pose = {0.5 * kRes, 0.5 * kRes, random.uniform(-3.1, 3.1)};
  // The place below the vehicle at take-off is free.
  for (int y = -8; y <= 8; ++y)
    for (int x = -8; x <= 8; ++x)
      if (std::hypot(x, y) <= 8) grid.set({x, y}, -40);
  for (int tick = 0; report.time_s < config.limit_s; ++tick, report.time_s += kStep_s) {
    scan(world, flyer.pose, config, random, grid);
    const bool arrived = current && flyer.arrived(*current);
    if (arrived) {
      attempts.push_back(attemptFrom(*current));
      current.reset();
    }
    if (arrived || tick % kTicksPerCall == 0) {
      map.update(grid.snapshot(), config.footprint);
      const Point before = current ? current->target_map_m : Point::Zero();
      const bool flying = current.has_value();
      report.last =
          explore({std::make_shared<CostMap>(map), flyer.pose, current, attempts, std::nullopt}, config.explorer);
      ++report.calls;
      report.done = report.last.done;
      if (report.done || !report.last.next) break;
      current = report.last.next;
      const auto planned = planner.plan(map, flyer.pose.position_m(), current->pose_map.position_m());
      if (!planned) break;
      path = *planned;
      report.switches += flying && !report.last.kept_current && (current->target_map_m - before).norm() > 0.5;
      flyer.next = 1;
    }
    flyer.step(*current, path, config, kStep_s, report);
    report.trail_map_m.push_back(flyer.pose.position_m());
    for (int i = 0; i < 24; ++i) {
      const double angle_rad = i * std::numbers::pi / 12;
      report.touched |= world.occupiedAt(flyer.pose.position_m() + config.footprint.hull_radius_m *
                                                                       Point(std::cos(angle_rad), std::sin(angle_rad)));
    }
  }
  report.coverage = coverageOf(world, grid, config.footprint.radius_m());
  return report;
}

}  // namespace swiftlet::planning::test
