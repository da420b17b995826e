#include "perception/slam2d/sliced_map.hpp"

#include <algorithm>
#include <cmath>

#include "perception/slam2d/grid_ray.hpp"
#include "perception/slam2d/grid_update.hpp"

namespace swiftlet::perception {
namespace {

using common::CellIndex;
using common::occupancy::Cell;
namespace occupancy = common::occupancy;

/// Height of the horizontal slices in which the map is kept (measured: docs/decisions/grid_map.md#006).
constexpr double kSliceHeight_m = 0.05;
/// Log-odds steps that a slice loses where one near it is seen free.
constexpr int kFadeSteps = 1;
/// Height difference up to which a slice that is seen free makes another one fade (measured:
/// docs/decisions/grid_map.md#006).
constexpr double kFadeHeight_m = 0.10;
/// Height difference up to which a slice that is seen free makes another one fade slowly; at least kFadeHeight_m.
constexpr double kSlowFadeHeight_m = 0.25;
/// Scans of which one lets slices up to kSlowFadeHeight_m away fade.
constexpr int kSlowFadeScans = 4;

/// Longest time for which one scan stands: what happened in a longer gap between two was not seen.
constexpr double kLasts_s = 0.3;
/// The height of a beam is known to this share of its range: 1 deg of the attitude.
constexpr double kHeightShare = 0.02;
/// Beams this many slices below the top of a low obstacle go through; nearer ones may pass above. They hit what is
/// there now and then as the vehicle sways, and so count, but less by this factor.
constexpr int kThrough = 2, kMayPassAbove = 4;
/// A beam that crosses less of a cell than this, in cells, may pass beside something thin that stands in it.
constexpr double kInside_cells = 0.5;
/// A beam that ends nearer behind a cell may have been meant to end there: noise in range, and walls at 10 deg to it.
constexpr double kBeyond_m = 0.30;

/// A mark counts the beams that crossed a cell in its low half and the beams that ended there above it. Its highest bit
/// says that one crossed it well inside.
constexpr std::uint32_t kCrossed = 1;
constexpr std::uint32_t kEnded = 1U << 16;
constexpr std::uint32_t kInside = 1U << 31;
/// A smaller change of the flight height is ignored.
constexpr double kHeightHysteresis_m = 0.10;

/// Two slices combined: occupied where one is, free where one is free and none is occupied.
Cell merged(Cell a, Cell b) {
  if (occupancy::isUnknown(a) || occupancy::isUnknown(b)) return std::max(a, b);
  return occupancy::isFree(a) && occupancy::isFree(b) ? std::min(a, b) : std::max(a, b);
}

bool rowByRow(const CellIndex& a, const CellIndex& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }

/// The ray from (0, 0, `from_m`) to `end`, cut to the fraction `share` of its length if that is below 1.
Eigen::Vector3f shortened(const Eigen::Vector3f& end, float share, float from_m) {
  const Eigen::Vector3f from(0.0F, 0.0F, from_m);
  return share < 1.0F ? from + (end - from) * share : end;
}

/// How beam `i` met the surface on which the returns beside it lie as well. Its direction is that of the line between
/// the outermost of them within reach, as long as none is farther from the next than a step in depth.
Incidence incidenceAt(const std::vector<Eigen::Vector2f>& points_level_m, std::size_t i) {
  // With the ranges' noise of a centimetre, such a line is right within some 5 deg.
  constexpr float kBeside_m = 0.10F, kLeast_m = 0.12F, kStep_m = 0.06F;
  constexpr float kAlong = 0.985F, kAslant = 0.87F;  // Cosines of 10 and 30 deg.
  constexpr std::size_t kMostBeams = 40;             // Bounds the time where the beams are dense.
  const Eigen::Vector2f& hit = points_level_m[i];
  const auto near = [&](std::size_t from, std::size_t to) {
    return (points_level_m[to] - points_level_m[from]).squaredNorm() < kStep_m * kStep_m &&
           (points_level_m[to] - hit).squaredNorm() < kBeside_m * kBeside_m;
  };
  std::size_t low = i, high = i;
  while (low > 0 && i - low < kMostBeams && near(low, low - 1)) --low;
  while (high + 1 < points_level_m.size() && high - i < kMostBeams && near(high, high + 1)) ++high;
  const Eigen::Vector2f along = points_level_m[high] - points_level_m[low];
  const float length_m = along.norm(), range_m = hit.norm();
  if (!(length_m >= kLeast_m) || !(range_m > 0.0F)) return Incidence::kUnknown;
  const float cosine = std::abs(along.x() * hit.y() - along.y() * hit.x()) / (length_m * range_m);
  return cosine > kAlong ? Incidence::kAlongNormal : cosine < kAslant ? Incidence::kAslant : Incidence::kUnknown;
}

}  // namespace

DrawnScan thinForDrawing(const ProjectedScan& scan, const GridDrawingConfig& config) {
  DrawnScan drawn;
  drawn.stamp = scan.stamp;
  drawn.body_height_m = scan.T_odom_body.position_m.z();
  const float from_m = drawn.laser_height_m = scan.laser_height_level_m;
  const auto spacing = static_cast<float>(0.4 * config.resolution_m);
  const auto add = [&](std::vector<Eigen::Vector3f>& list, const Eigen::Vector3f& p) {
    const bool apart = list.empty() || (p - list.back()).head<2>().squaredNorm() > spacing * spacing;
    if (apart) list.push_back(p);
    return apart;
  };
  const auto range = [](const Eigen::Vector3f& p) { return p.head<2>().norm(); };
  const auto withinRange = [&](const Eigen::Vector3f& p, double range_m) {
    return shortened(p, static_cast<float>(range_m) / std::max(range(p), 1e-6F), from_m);
  };
  for (std::size_t i = 0; i < scan.points_level_m.size(); ++i) {
    const float height_m = i < scan.heights_level_m.size() ? scan.heights_level_m[i] : 0.0F;
    const Eigen::Vector3f end(scan.points_level_m[i].x(), scan.points_level_m[i].y(), height_m);
    if (!end.allFinite()) continue;
    const auto band_m = static_cast<float>(height_m > 0.0F ? config.max_height_above_m : -config.max_height_below_m);
    // A beam that ended above or below the band shows free space up to where it left the band.
    if (std::abs(height_m) > std::abs(band_m))
      add(drawn.free_level_m,
          withinRange(shortened(end, (band_m - from_m) / (height_m - from_m), from_m), config.max_hit_range_m));
    else if (range(end) > static_cast<float>(config.max_hit_range_m))
      add(drawn.free_level_m, withinRange(end, config.max_hit_range_m));
    else if (add(drawn.hits_level_m, end)) {
      drawn.incidences.push_back(incidenceAt(scan.points_level_m, i));
      if (!scan.moves.empty()) drawn.moves.push_back(i < scan.moves.size() && scan.moves[i]);
    }
  }
  for (const Eigen::Vector3f& end : scan.misses_level_m)
    if (end.allFinite()) add(drawn.free_level_m, withinRange(end, config.max_free_range_m));
  for (const Eigen::Vector3f& end : scan.no_returns_level_m)
    if (end.allFinite()) add(drawn.no_returns_level_m, withinRange(end, config.max_free_range_m));
  return drawn;
}

SlicedMap::SlicedMap(const GridDrawingConfig& config)
    : config_(config),
      combined_(common::makeOccupancyGrid(config.resolution_m)),
      glass_(config.resolution_m),
      low_(config.resolution_m),
      columns_(config.resolution_m) {}

SlicedMap SlicedMap::snapshot() {
  for (auto& [slice, grid] : slices_) grid = grid.snapshot();
  combined_ = combined_.snapshot();
  glass_ = glass_.snapshot();
  low_ = low_.snapshot();
  columns_ = columns_.snapshot();
  return *this;
}

void SlicedMap::draw(const DrawnScan& scan, const common::Pose2& T_map_body) {
  if (highest_ < lowest_) (void)setFlightHeight(scan.body_height_m);
  const double since_s = drawn_ > 0 ? (scan.stamp - drawn_stamp_).seconds() : 0.0;
  scan_.lasts = common::Duration::fromSeconds(std::clamp(since_s, 0.0, kLasts_s));
  drawn_stamp_ = scan.stamp;
  ++drawn_;
  split(scan, T_map_body);
  for (const auto& [slice, rays] : scan_.rays)
    if (!rays.empty()) drawSlice(slice, rays, scan.stamp);
}

/// Slices are centred on multiples of their height, because missions usually fly at such heights.
int SlicedMap::sliceAt(double height_m) const { return static_cast<int>(std::floor(height_m / kSliceHeight_m + 0.5)); }

bool SlicedMap::setFlightHeight(double height_m) {
  if (!std::isfinite(height_m)) return false;
  if (highest_ >= lowest_ && std::abs(height_m - flight_height_m_) <= kHeightHysteresis_m) return false;
  flight_height_m_ = height_m;
  const int lowest = sliceAt(height_m - config_.max_height_below_m);
  const int highest = sliceAt(height_m + config_.max_height_above_m);
  if (lowest == lowest_ && highest == highest_) return false;
  lowest_ = lowest;
  highest_ = highest;
  combineAll();
  return true;
}

/// Cuts each ray where it passes from one slice into the next.
void SlicedMap::split(const DrawnScan& scan, const common::Pose2& T_map_body) {
  for (auto& [slice, rays] : scan_.rays) rays.clear();
  const double c = std::cos(T_map_body.yaw_rad), s = std::sin(T_map_body.yaw_rad);
  const Eigen::Vector2d body = scan_.body = T_map_body.position_m() / config_.resolution_m;
  const double laser_m = scan.body_height_m + static_cast<double>(scan.laser_height_m);
  scan_.laser_slice = sliceAt(laser_m);
  const auto inCells = [&](const Eigen::Vector3f& end) {
    return Eigen::Vector2d((T_map_body.x_m + c * end.x() - s * end.y()) / config_.resolution_m,
                           (T_map_body.y_m + s * end.x() + c * end.y()) / config_.resolution_m);
  };
  const auto add = [&](const Eigen::Vector2d& to, double height_m, bool ended,
                       Incidence incidence = Incidence::kUnknown) {
    const double rise_m = scan.body_height_m + height_m - laser_m;
    const int last = sliceAt(laser_m + rise_m);
    const int step = last > scan_.laser_slice ? 1 : -1;
    Eigen::Vector2d from = body;
    for (int slice = scan_.laser_slice; slice != last; slice += step) {
      const double boundary_m = (slice + 0.5 * step) * kSliceHeight_m - laser_m;
      const Eigen::Vector2d cut = body + (to - body) * std::clamp(boundary_m / rise_m, 0.0, 1.0);
      scan_.rays[slice].push_back({from, cut, (to - cut).norm()});
      from = cut;
    }
    scan_.rays[last].push_back({from, to, 0.0, ended, incidence});
  };
  for (const Eigen::Vector3f& end : scan.free_level_m) add(inCells(end), end.z(), false);
  scan_.ended.clear();
  for (std::size_t i = 0; i < scan.hits_level_m.size(); ++i) {
    const Eigen::Vector3f& end = scan.hits_level_m[i];
    const Eigen::Vector2d to = inCells(end);
    scan_.ended.push_back(cellOf(to));
    // Level beams hit moving people too, and see when the place is free again; a tilted beam leaves a trace below.
    const bool moves = i < scan.moves.size() && scan.moves[i];
    if (moves && sliceAt(scan.body_height_m + static_cast<double>(end.z())) < scan_.laser_slice) continue;
    add(to, end.z(), true, i < scan.incidences.size() ? scan.incidences[i] : Incidence::kUnknown);
  }
  std::sort(scan_.ended.begin(), scan_.ended.end(), rowByRow);
  for (const Eigen::Vector3f& end : scan.no_returns_level_m) {
    const Eigen::Vector2d to = inCells(end);
    const Eigen::Vector2d seen = beforeWall(body, to, [&](CellIndex cell) { return isWall(cell); });
    const auto share = static_cast<float>((seen - body).norm() / std::max((to - body).norm(), 1e-9));
    add(seen, shortened(end, share, scan.laser_height_m).z(), false);
  }
}

bool SlicedMap::isWall(CellIndex cell) const {
  return occupancy::isOccupied(combined_.at(cell)) ||
         std::binary_search(scan_.ended.begin(), scan_.ended.end(), cell, rowByRow);
}

/// A cell in which some beams of a scan end and others cross gains confidence if at least as many end there, so that
/// noise in range does not thicken walls. If any beam ends there, the cell does not lose confidence, so that a wall
/// seen at a grazing angle gets no holes.
void SlicedMap::drawSlice(int slice, const std::vector<SliceRay>& rays, common::Time stamp) {
  const CellIndex first = cellOf(rays.front().from);
  common::CellRect rect{first, {first.x + 1, first.y + 1}};
  for (const SliceRay& ray : rays) {
    for (const CellIndex& c : {cellOf(ray.from), cellOf(ray.to)}) {
      rect.begin = {std::min(rect.begin.x, c.x), std::min(rect.begin.y, c.y)};
      rect.end = {std::max(rect.end.x, c.x + 1), std::max(rect.end.y, c.y + 1)};
    }
  }
  scan_.marks.assign(static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height()), 0);
  const auto markAt = [&](CellIndex c) -> std::uint32_t& {
    return scan_.marks[static_cast<std::size_t>(c.y - rect.begin.y) * static_cast<std::size_t>(rect.width()) +
                       static_cast<std::size_t>(c.x - rect.begin.x)];
  };
  for (const SliceRay& ray : rays) {
    const double length = std::max((ray.to - ray.from).norm(), 1e-9), inside = kInside_cells / length;
    const double far_enough = 1.0 - (kBeyond_m / config_.resolution_m - ray.beyond) / length;
    visitCrossed(ray.from, ray.to, [&](const CellIndex& cell, double enters, double leaves) {
      std::uint32_t& mark = markAt(cell);
      mark += kCrossed;
      if (leaves - enters >= inside && leaves <= far_enough) mark |= kInside;
      return true;
    });
    markAt(cellOf(ray.to)) += ray.ended ? kEnded : kCrossed;
    if (ray.ended) glass_.hit(cellOf(ray.to), ray.to - scan_.body, ray.incidence);
  }
  common::OccupancyGrid& grid =
      slices_.try_emplace(slice, common::makeOccupancyGrid(config_.resolution_m)).first->second;
  const std::uint32_t* mark = scan_.marks.data();
  for (int y = rect.begin.y; y < rect.end.y; ++y) {
    for (int x = rect.begin.x; x < rect.end.x; ++x, ++mark) {
      const std::uint32_t ended = (*mark & ~kInside) >> 16, crossed = *mark & 0xFFFF;
      if (ended > 0 && ended >= crossed) apply(slice, grid, {x, y}, Met::kEnded, stamp);
      if (*mark != 0 && ended == 0)
        apply(slice, grid, {x, y}, (*mark & kInside) != 0 ? Met::kPassedInside : Met::kPassed, stamp);
    }
  }
}

void SlicedMap::apply(int slice, common::OccupancyGrid& grid, CellIndex cell, Met met, common::Time stamp) {
  const bool ended = met == Met::kEnded;
  if (!ended && isGlass(cell)) return;
  const Cell old = grid.at(cell);
  const int sum = (occupancy::isUnknown(old) ? 0 : old) + (ended ? config_.hit_steps : -config_.free_steps);
  const auto value = static_cast<Cell>(std::clamp(sum, -config_.max_steps, config_.max_steps));
  // A single end may be noise of a height or a range.
  const bool confirmed = ended && value > config_.hit_steps;
  const bool outline = ended && isOutline(cell);
  const bool low_changed = ended ? confirmed && meetLow(slice, cell, outline, stamp) : low_.passed(cell, slice, stamp);
  if (ended) columns_.ended(cell, metExtent(slice, cell, outline));
  // An unchanged cell is not written, so that its tile stays shared with the snapshots.
  if (value != old) grid.set(cell, value);
  if (low_changed)
    combine(cell);
  else if (value != old && isCombined(slice))
    combine(cell, old, value);
  if (!ended) pass(slice, cell, met);
}

/// Whether the beams of this scan that cross the cell do not clear it. What is no glass, such as a person
/// who has left, is cleared by beams along its normal, and slowly by all others.
bool SlicedMap::isGlass(CellIndex cell) const {
  if (drawn_ % config_.glass_fade_scans == 0 || !occupancy::isOccupied(combined_.at(cell))) return false;
  return glass_.passesThrough(cell, Eigen::Vector2d(cell.x + 0.5, cell.y + 0.5) - scan_.body);
}

/// Beams ended in the cell in that slice. Returns true if what is known of low obstacles there has changed.
bool SlicedMap::meetLow(int slice, CellIndex cell, bool outline, common::Time stamp) {
  if (slice < scan_.laser_slice) return !outline && low_.hit(cell, slice, stamp);
  low_.reachesUp(cell);
  return false;
}

/// Whether the cell is beside what level beams met: the outline of what reaches up, a wall or a person, is met in the
/// cells beside, too.
bool SlicedMap::isOutline(CellIndex cell) const {
  const auto level = slices_.find(scan_.laser_slice);
  if (level == slices_.end()) return false;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if (occupancy::isOccupied(level->second.at({cell.x + dx, cell.y + dy}))) return true;
  return false;
}

/// What a beam that ended in the cell in that slice tells of the heights of what stands there.
Columns::Extent SlicedMap::metExtent(int slice, CellIndex cell, bool outline) const {
  const int top = outline ? std::max(slice, columns_.topAround(cell)) : slice;
  return {slice, top, slice - unsureSlices(cell)};
}

/// By how many slices the height of a beam in the cell may be off.
int SlicedMap::unsureSlices(CellIndex cell) const {
  const double range_m = (Eigen::Vector2d(cell.x + 0.5, cell.y + 0.5) - scan_.body).norm() * config_.resolution_m;
  return static_cast<int>(std::lround(kHeightShare * range_m / kSliceHeight_m));
}

/// Beams passed the cell in that slice. Only a cell that is occupied at flight height matters to the hull.
void SlicedMap::pass(int slice, CellIndex cell, Met met) {
  if (!occupancy::isOccupied(combined_.at(cell))) return;
  forgetLow(cell, columns_.surelyAround(cell));
  if (met != Met::kPassedInside || !hasGone(slice, cell)) fadeAround(slice, cell);
}

void SlicedMap::forgetLow(CellIndex cell, int surely) {
  const auto top = low_.top(cell);
  if (!top || surely <= *top) return;
  low_.forget(cell);
  combine(cell);
}

/// Frees the slices of what stood in the cell, if beams have passed where they would have hit it for long enough.
/// Returns true if it did.
bool SlicedMap::hasGone(int slice, CellIndex cell) {
  const int unsure = unsureSlices(cell);
  Columns::Pass pass{static_cast<std::uint16_t>(drawn_), slice - unsure, slice + unsure, scan_.lasts};
  if (const auto top = low_.top(cell); top && pass.highest > *top - kThrough) {
    if (slice > *top) return false;
    pass.lasts = pass.lasts / kMayPassAbove;
  }
  const auto gone = columns_.passed(cell, pass);
  if (!gone) return false;
  gone_.push_back({combined_.centerOf(cell), slice * kSliceHeight_m});
  free(cell, *gone);
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) goesAlong({cell.x + dx, cell.y + dy}, gone->surely);
  return true;
}

/// What is beside something that reached up to `surely` and has gone, and is lower, was its outline.
void SlicedMap::goesAlong(CellIndex cell, int surely) {
  forgetLow(cell, surely);
  if (const auto outline = columns_.takeBelow(cell, surely)) free(cell, *outline);
}

/// Nothing is left of what stood there, at any height that the hull may touch.
void SlicedMap::free(CellIndex cell, const Columns::Extent& stood) {
  const int reach = static_cast<int>(std::lround(kSlowFadeHeight_m / kSliceHeight_m));
  const int from = std::min(lowest_, stood.bottom - reach), to = std::max(highest_, stood.top + reach);
  low_.forget(cell);
  for (auto near = slices_.lower_bound(from); near != slices_.end() && near->first <= to; ++near)
    if (occupancy::isOccupied(near->second.at(cell))) near->second.set(cell, 0);
  combine(cell);
}

/// It is drawn elsewhere within a cell when the map is drawn again.
void SlicedMap::forget(const Eigen::Vector2d& place_map_m) {
  const CellIndex middle = combined_.cellAt(place_map_m);
  for (const CellIndex& cell : {middle, CellIndex{middle.x - 1, middle.y}, CellIndex{middle.x + 1, middle.y},
                                CellIndex{middle.x, middle.y - 1}, CellIndex{middle.x, middle.y + 1}}) {
    if (!occupancy::isOccupied(combined_.at(cell))) continue;
    columns_.forget(cell);
    free(cell, {lowest_, highest_});
  }
}

/// Most things are upright: a free cell is weak evidence that the cells above and below it are free. This removes the
/// traces of people who have passed. A trace that was met once, at whatever height the hull may touch, is no more.
void SlicedMap::fadeAround(int slice, CellIndex cell) {
  const bool slow = drawn_ % kSlowFadeScans == 0;
  const double height_m = slow ? kSlowFadeHeight_m : kFadeHeight_m;
  const int reach = static_cast<int>(std::lround(height_m / kSliceHeight_m));
  const int from = std::min(slice - reach, slow ? lowest_ : slice),
            to = std::max(slice + reach, slow ? highest_ : slice);
  bool faded = false;
  for (auto near = slices_.lower_bound(from); near != slices_.end() && near->first <= to; ++near) {
    const Cell old = near->second.at(cell);
    if (near->first == slice || !occupancy::isOccupied(old)) continue;
    if (std::abs(near->first - slice) > reach && old > config_.hit_steps) continue;
    near->second.set(cell, static_cast<Cell>(std::max(old - kFadeSteps, 0)));
    faded = true;
  }
  if (faded) combine(cell);
}

/// Updates the combined cell after it changed in one slice from `before` to `now`. The other slices are read only if
/// the cell lost confidence.
void SlicedMap::combine(CellIndex cell, Cell before, Cell now) {
  const bool lost_weight = occupancy::isOccupied(before)
                               ? now < before
                               : occupancy::isFree(before) && occupancy::isFree(now) && now > before;
  if (lost_weight) return combine(cell);
  const Cell old = combined_.at(cell), value = merged(old, now);
  if (value != old) combined_.set(cell, value);
}

void SlicedMap::combine(CellIndex cell) {
  Cell value = occupancy::kUnknown;
  for (auto slice = slices_.lower_bound(lowest_); slice != slices_.end() && slice->first <= highest_; ++slice)
    value = merged(value, slice->second.at(cell));
  if (const auto top = low_.top(cell); top && isCombined(*top))
    value = std::max(value, static_cast<Cell>(config_.max_steps));
  if (value != combined_.at(cell)) combined_.set(cell, value);
}

void SlicedMap::combineAll() {
  common::OccupancyGrid fresh = common::makeOccupancyGrid(config_.resolution_m);
  for (auto slice = slices_.lower_bound(lowest_); slice != slices_.end() && slice->first <= highest_; ++slice) {
    slice->second.forEachCell([&](CellIndex c, Cell here) {
      if (occupancy::isUnknown(here)) return;
      Cell& value = fresh.mutableAt(c);
      value = merged(value, here);
    });
  }
  low_.forEach([&](CellIndex c, int top) {
    if (isCombined(top)) fresh.set(c, static_cast<Cell>(config_.max_steps));
  });
  makeEqual(combined_, fresh);
}

}  // namespace swiftlet::perception
