#include "autonomy/given_map/given_map_overlay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/occupied_near.hpp"

namespace swiftlet::autonomy {
namespace {

using common::CellIndex;
using common::OccupancyGrid;
using common::Pose2;
namespace occupancy = common::occupancy;

/// The localization is a mean of particles and varies by one to three centimetres from generation to generation.
constexpr double kSmoothing_s = 3.0;
/// The frame is moved when it is off by this much at the vehicle: less than half of the tolerance of a goal.
constexpr double kMoved_m = 0.02;
/// More than noise: the map of the flight was corrected, or the place was found again.
constexpr double kJumped_m = 0.20;
/// A turn moves what is far away: 1 deg is 9 cm at 5 m.
constexpr double kTurned_rad = 0.5 * common::kRadPerDeg;
/// The same wall in both maps differs by as much: 1 deg at 10 m is 17 cm. What the flight has seen counts, and its
/// double must not narrow a door. Less than the radius of a hull, so that nothing opens that was shut.
constexpr double kSameWall_m = 0.20;

/// The pose that lies between two, a share of the way from `a` to `b`.
Pose2 between(const Pose2& a, const Pose2& b, double share) {
  return {a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m),
          common::wrapAngle(a.yaw_rad + share * common::wrapAngle(b.yaw_rad - a.yaw_rad))};
}

/// Whether the occupied cells around this one stay connected without it (8-neighbours; Yokoi's connectivity number is
/// then 1). Of a wall in stairs of single cells each is needed.
bool isDispensable(const OccupancyGrid& grid, CellIndex cell) {
  constexpr std::array<CellIndex, 8> kRing{{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  std::array<int, 8> open{};
  for (std::size_t i = 0; i < 8; ++i)
    open[i] = occupancy::isOccupied(grid.at({cell.x + kRing[i].x, cell.y + kRing[i].y})) ? 0 : 1;
  int pieces = 0;
  for (std::size_t i = 0; i < 8; i += 2) pieces += open[i] - open[i] * open[i + 1] * open[(i + 2) % 8];
  return pieces == 1;
}

/// What the given map has at the free side of an occupied cell behind which its wall goes on for two cells: the
/// outermost cell of a thick wall, or the end of any at a door. None for any other cell, so that no wall vanishes.
std::optional<occupancy::Cell> beforeFace(const OccupancyGrid& grid, CellIndex cell) {
  constexpr std::array<CellIndex, 4> kSides{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  for (const CellIndex side : kSides) {
    const occupancy::Cell before = grid.at({cell.x + side.x, cell.y + side.y});
    if (occupancy::isFree(before) && occupancy::isOccupied(grid.at({cell.x - side.x, cell.y - side.y})) &&
        occupancy::isOccupied(grid.at({cell.x - 2 * side.x, cell.y - 2 * side.y})))
      return before;
  }
  return std::nullopt;
}

}  // namespace

GivenMapOverlay::GivenMapOverlay(const GivenMap* given, common::EventLog& log)
    : laid_(common::makeOccupancyGrid(1.0)), changes_(log) {
  if (given != nullptr) given_ = std::make_shared<const GivenMap>(*given);
}

void GivenMapOverlay::load(const GivenMap& given) {
  given_ = std::make_shared<const GivenMap>(given);
  resampled_.reset();
  smoothed_.reset();
  changes_.forget();
  if (std::exchange(T_map_given_, std::nullopt)) lay();
}

void GivenMapOverlay::update(common::Time now, const Pose2& T_map_body, const Pose2& T_map_odom,
                             const std::optional<common::Localization>& localization,
                             const std::shared_ptr<const OccupancyGrid>& flown) {
  bool changed = std::exchange(flown_, flown) != flown;
  if (localization && localization->localized()) {
    if (follow(now, T_map_body, T_map_odom * localization->T_given_odom.inverse())) {
      if (!resampled_ || resampled_->resolution_m() != flown->resolution_m())
        resampled_.emplace(*given_->grid, flown->resolution_m());
      laid_ = resampled_->drawn(*given_->grid, *T_map_given_ * given_->T_given_grid);
      changed = true;
    }
  } else {
    smoothed_.reset();
    changes_.forget();
    changed |= std::exchange(T_map_given_, std::nullopt).has_value();
  }
  updated_ = now;
  if (changed) lay();
  if (T_map_given_) changes_.update(now, *flown_, laid_, *T_map_given_);
}

/// True if the frame has moved.
bool GivenMapOverlay::follow(common::Time now, const Pose2& T_map_body, const Pose2& T_map_given) {
  const double share = smoothed_ ? std::min(1.0, (now - updated_).seconds() / kSmoothing_s) : 1.0;
  // At the vehicle, where the localization is measured: far from the origin of `given` a turn would shift it.
  const Pose2 T_given_body = T_map_given.inverse() * T_map_body;
  const Pose2 before = smoothed_.value_or(T_map_given) * T_given_body;
  const bool jumped = common::between(before, T_map_body).position_m().norm() > kJumped_m;
  smoothed_ = between(before, T_map_body, jumped ? 1.0 : share) * T_given_body.inverse();
  if (T_map_given_) {
    const Pose2 off = common::between(*T_map_given_ * T_given_body, *smoothed_ * T_given_body);
    if (off.position_m().norm() <= kMoved_m && std::abs(off.yaw_rad) <= kTurned_rad) return false;
  }
  T_map_given_ = smoothed_;
  return true;
}

void GivenMapOverlay::lay() {
  grid_ = for_paths_ = flown_;
  if (!T_map_given_) return;
  const int same_wall = static_cast<int>(std::lround(kSameWall_m / flown_->resolution_m()));
  auto both = std::make_shared<OccupancyGrid>(laid_.snapshot());
  auto for_paths = std::make_shared<OccupancyGrid>(laid_.snapshot());
  laid_.forEachCell([&](CellIndex cell, occupancy::Cell value) {
    if (!occupancy::isOccupied(value) || !occupancy::isUnknown(flown_->at(cell))) return;
    // A wall that only the given map has is known to a cell at best. Its outermost cell is not counted: at both sides
    // of a door it would shut what is open, and the flight sees the wall itself before it is there.
    const auto before = beforeFace(laid_, cell);
    if (before && isDispensable(*for_paths, cell)) for_paths->set(cell, *before);
    if (!common::occupiedNear(*flown_, cell, same_wall)) return;
    both->set(cell, 0);
    for_paths->set(cell, 0);
  });
  flown_->forEachCell([&](CellIndex cell, occupancy::Cell value) {
    if (occupancy::isUnknown(value)) return;
    both->set(cell, value);
    for_paths->set(cell, value);
  });
  grid_ = std::move(both);
  for_paths_ = std::move(for_paths);
}

}  // namespace swiftlet::autonomy
