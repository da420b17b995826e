#include "benchmarks/floors/floor_plan.hpp"

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "common/random.hpp"

namespace swiftlet::benchmarks {
namespace {

using Eigen::Vector2d;

constexpr double kLength_m = 120.0;
constexpr double kWidth_m = 80.0;
constexpr double kAcross_m = 48.0;  ///< Where the corridor across is.
constexpr double kHalfCorridor_m = 1.2;

/// Draws one side of a corridor: `along` runs from its beginning, `behind` away from the corridor.
class Side {
 public:
  Side(const Vector2d& from, const Vector2d& to, test::PlanarWorld& world)
      : from_(from), along_((to - from).normalized()), behind_(along_.y(), -along_.x()), world_(world) {}

  struct Point {
    double along_m;
    double behind_m;
  };
  void draw(std::initializer_list<Point> points) {
    std::vector<Vector2d> corners;
    for (const Point& point : points) corners.push_back(from_ + along_ * point.along_m + behind_ * point.behind_m);
    world_.addPolyline(corners, false);
  }

 private:
  Vector2d from_;
  Vector2d along_;
  Vector2d behind_;
  test::PlanarWorld& world_;
};

/// Whatever stands out of the wall, or is let into it, between `begin` and `end`.
void drawNiche(Side& side, double begin, double end, double depth) {
  side.draw({{begin, 0}, {begin, depth}, {end, depth}, {end, 0}});
}

void drawRoom(Side& side, double begin, double end, double free_before, common::RandomStream& random) {
  constexpr double kWall_m = 0.15;
  const double depth = random.uniform(2.5, 5.0);
  const double left = begin - std::min(random.uniform(0.4, 2.0), 0.8 * free_before);
  const double right = end + random.uniform(0.4, 1.2);
  side.draw({{begin, 0},
             {begin, kWall_m},
             {left, kWall_m},
             {left, depth},
             {right, depth},
             {right, kWall_m},
             {end, kWall_m},
             {end, 0}});
  const int furniture = 1 + static_cast<int>(random.uniform(0.0, 3.0));
  for (int i = 0; i < furniture; ++i) {
    const double x = random.uniform(left + 0.2, right - 0.7);
    const double y = random.uniform(1.2, depth - 0.6);
    const double size = random.uniform(0.2, 0.5);
    side.draw({{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}, {x, y}});
  }
}

/// The corridor lies to the left of the line from `from` to `to`.
void drawSide(const Vector2d& from, const Vector2d& to, common::RandomStream& random, test::PlanarWorld& world) {
  Side side(from, to, world);
  const double length = (to - from).norm();
  double drawn = 0.0;
  while (true) {
    const double gap = random.uniform(1.2, 7.0);
    const double begin = drawn + gap;
    if (begin + 2.5 > length) break;
    side.draw({{drawn, 0}, {begin, 0}});
    const double kind = random.uniform();
    const double door = random.uniform(0.85, 1.1);
    double end = begin + door;
    if (kind < 0.45) {
      drawNiche(side, begin, end, random.uniform(0.04, 0.18));  // A closed door, set back.
    } else if (kind < 0.6) {
      end = begin + door / 2.0;
      drawNiche(side, begin, end, -random.uniform(0.05, 0.25));  // A pillar.
    } else if (kind < 0.8) {
      drawRoom(side, begin, end, gap, random);
    } else {
      drawNiche(side, begin, end, -random.uniform(0.3, 0.5));  // A cabinet.
    }
    drawn = end;
  }
  side.draw({{drawn, 0}, {length, 0}});
}

/// All sides of a block of corners in order, the corridor to the left of each.
void drawBlock(const std::vector<Vector2d>& corners, common::RandomStream& random, test::PlanarWorld& world) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    drawSide(corners[i], corners[(i + 1) % corners.size()], random, world);
}

}  // namespace

FloorPlan makeFloorPlan(std::uint64_t seed) {
  common::RandomStream random(seed, "floor plan");
  FloorPlan plan;
  constexpr double kHalf = kHalfCorridor_m;
  drawBlock({{-kHalf, -kHalf},
             {kLength_m + kHalf, -kHalf},
             {kLength_m + kHalf, kWidth_m + kHalf},
             {-kHalf, kWidth_m + kHalf}},
            random, plan.world);
  for (const auto& [left, right] : {std::pair{0.0, kAcross_m}, std::pair{kAcross_m, kLength_m}})
    drawBlock({{left + kHalf, kHalf},
               {left + kHalf, kWidth_m - kHalf},
               {right - kHalf, kWidth_m - kHalf},
               {right - kHalf, kHalf}},
              random, plan.world);
  // Round the ring, through the corridor across, and part of the ring in the other direction.
  plan.corners_m = {{2.0, 0.0},       {kLength_m, 0.0},      {kLength_m, kWidth_m}, {0.0, kWidth_m}, {0.0, 0.0},
                    {kAcross_m, 0.0}, {kAcross_m, kWidth_m}, {kLength_m, kWidth_m}, {kLength_m, 0.0}};
  return plan;
}

}  // namespace swiftlet::benchmarks
