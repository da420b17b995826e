#include "planning/clearance/distance_field.hpp"

#include <algorithm>
#include <cstdlib>

#include "common/check.hpp"

namespace swiftlet::planning {
namespace {

using common::VoxelIndex;

int along(int value, int side_bits) { return (value + (1 << side_bits) - 1) >> side_bits; }

/// From the nearest cell of one half-open interval to that of another: 0 if they overlap, 1 if they touch.
int gapBetween(int a_begin, int a_end, int b_begin, int b_end) {
  return std::max({0, b_begin - a_end + 1, a_begin - b_end + 1});
}

// These loops have a fixed number of steps, and arrays that do not overlap, so that they are compiled to vectors.
constexpr std::size_t kRowCells = DistanceField::kRow;

/// values[x] = the least of itself, a[x] + add and b[x] + add.
void takeLess(std::int16_t* __restrict values, const std::int16_t* __restrict a, const std::int16_t* __restrict b,
              std::int16_t add) {
  for (std::size_t x = 0; x < kRowCells; ++x)
    values[x] = std::min(values[x], static_cast<std::int16_t>(std::min(a[x], b[x]) + add));
}

template <std::size_t kCells>
std::int16_t greatestOf(const std::int16_t* values) {
  std::int16_t greatest = INT16_MIN;
  for (std::size_t x = 0; x < kCells; ++x) greatest = std::max(greatest, values[x]);
  return greatest;
}

/// One step away from the occupied cells before a row: 0 in the occupied ones, whose value is 0.
void growRuns(std::uint8_t* __restrict row, std::uint8_t* __restrict run, std::uint8_t most) {
  for (std::size_t x = 0; x < kRowCells; ++x) {
    const auto grown = static_cast<std::uint8_t>(std::min<std::uint8_t>(run[x], most - 1) + 1);
    run[x] = row[x] == 0 ? std::uint8_t{0} : grown;
    row[x] = run[x];
  }
}

/// The same from the other side, where the first side is nearer.
void joinRuns(std::uint8_t* __restrict row, std::uint8_t* __restrict run, std::uint8_t most) {
  for (std::size_t x = 0; x < kRowCells; ++x) {
    const auto grown = static_cast<std::uint8_t>(std::min<std::uint8_t>(run[x], most - 1) + 1);
    run[x] = std::min(row[x], grown);
    row[x] = run[x];
  }
}

/// Whether a cell is occupied whose run is not 0, or the other way around.
bool differ(const std::uint8_t* __restrict occupied, const std::uint8_t* __restrict runs) {
  std::uint8_t any = 0;
  for (std::size_t x = 0; x < kRowCells; ++x)
    any = static_cast<std::uint8_t>(any | ((occupied[x] != 0) == (runs[x] != 0) ? 1 : 0));
  return any != 0;
}

void squareEuclidean(const std::uint8_t* __restrict runs, std::int16_t* __restrict squares, std::int16_t most) {
  for (std::size_t x = 0; x < kRowCells; ++x) squares[x] = std::min(static_cast<std::int16_t>(runs[x] * runs[x]), most);
}

void squareUpright(const std::uint8_t* __restrict runs, std::int16_t* __restrict squares, std::int16_t most,
                   std::int16_t half_height) {
  for (std::size_t x = 0; x < kRowCells; ++x)
    squares[x] = static_cast<std::int16_t>(runs[x]) <= half_height ? std::int16_t{0} : most;
}

}  // namespace

/// One update: what changed, and the tiles that are made anew for it.
class DistanceField::Repair {
 public:
  Repair(DistanceField& field, const RowReader& read)
      : field_(field),
        read_(read),
        own_(field.runs_.size(), nullptr),
        cap_(static_cast<std::uint8_t>(field.reach_ + 1)) {}

  void readBox(CellBox box) {
    box.begin = {std::max(0, box.begin.x), std::max(0, box.begin.y), std::max(0, box.begin.z)};
    box.end = {std::min(field_.size_.x, box.end.x), std::min(field_.size_.y, box.end.y),
               std::min(field_.size_.z, box.end.z)};
    if (box.empty()) return;
    for (int tz = box.begin.z >> field_.z_bits_; tz <= (box.end.z - 1) >> field_.z_bits_; ++tz)
      for (int ty = box.begin.y >> field_.y_bits_; ty <= (box.end.y - 1) >> field_.y_bits_; ++ty)
        for (int tx = box.begin.x >> kRowBits; tx <= (box.end.x - 1) >> kRowBits; ++tx) readTile(tx, ty, tz, box);
  }

  std::vector<CellBox> finish() {
    repairRuns();
    return repairSquares();
  }

 private:
  void readTile(int tx, int ty, int tz, const CellBox& box) {
    const CellBox tile = field_.tileBox(tx, ty, tz);
    CellBox changed{tile.end, tile.begin};
    std::array<std::uint8_t, kRow> occupied;
    for (int z = std::max(tile.begin.z, box.begin.z); z < std::min(tile.end.z, box.end.z); ++z)
      for (int y = std::max(tile.begin.y, box.begin.y); y < std::min(tile.end.y, box.end.y); ++y) {
        const VoxelIndex first{tile.begin.x, y, z};
        read_(first, occupied);
        const std::uint8_t* known = runsAt(first);
        if (!differ(occupied.data(), known)) continue;
        for (int x = 0; x < kRow; ++x) {
          if ((occupied[static_cast<std::size_t>(x)] != 0) == (known[x] == 0)) continue;
          std::uint8_t* own = ownRuns(first);
          known = own;
          own[x] = occupied[static_cast<std::size_t>(x)] != 0 ? 0 : 1;
          changed.begin = {std::min(changed.begin.x, first.x + x), std::min(changed.begin.y, y),
                           std::min(changed.begin.z, z)};
          changed.end = {std::max(changed.end.x, first.x + x + 1), std::max(changed.end.y, y + 1),
                         std::max(changed.end.z, z + 1)};
        }
      }
    if (!changed.empty()) changes_.push_back(changed);
  }

  const std::uint8_t* runsAt(VoxelIndex cell) const {
    return field_.runs_[field_.tileOf(cell)]->data() + field_.offsetOf(cell);
  }
  /// The same in a tile that no copy of the field shares.
  std::uint8_t* ownRuns(VoxelIndex cell) {
    const std::size_t tile = field_.tileOf(cell);
    if (own_[tile] == nullptr) {
      auto made = std::make_shared<RunTile>(*field_.runs_[tile]);
      own_[tile] = made.get();
      field_.runs_[tile] = std::move(made);
    }
    return own_[tile]->data() + field_.offsetOf(cell);
  }

  /// The changes of a column of tiles together: the runs of all its rows of 32 columns are made again.
  void repairRuns() {
    const auto& tiles = field_.tiles_;
    std::vector<CellBox> strips(static_cast<std::size_t>(tiles.x) * static_cast<std::size_t>(tiles.y));
    for (const CellBox& change : changes_) {
      CellBox& strip =
          strips[static_cast<std::size_t>(change.begin.y >> field_.y_bits_) * static_cast<std::size_t>(tiles.x) +
                 static_cast<std::size_t>(change.begin.x >> kRowBits)];
      if (strip.empty()) {
        strip = change;
        continue;
      }
      strip.begin.y = std::min(strip.begin.y, change.begin.y);
      strip.begin.z = std::min(strip.begin.z, change.begin.z);
      strip.end.y = std::max(strip.end.y, change.end.y);
      strip.end.z = std::max(strip.end.z, change.end.z);
    }
    for (const CellBox& strip : strips)
      for (int y = strip.begin.y; y < strip.end.y; ++y)
        repairRunsAt(strip.begin.x & ~(kRow - 1), y, std::max(0, strip.begin.z - field_.reach_),
                     std::min(field_.size_.z, strip.end.z + field_.reach_));
  }

  /// Along z, up and down again. What lies beyond the two ends has not changed: no change is within reach of it.
  void repairRunsAt(int x, int y, int z_begin, int z_end) {
    std::array<std::uint8_t, kRow> run;
    const auto begin = [&](int z) {
      if (z < 0 || z >= field_.size_.z)
        run.fill(cap_);
      else
        std::copy_n(runsAt({x, y, z}), kRow, run.begin());
    };
    begin(z_begin - 1);
    for (int z = z_begin; z < z_end; ++z) growRuns(ownRuns({x, y, z}), run.data(), cap_);
    begin(z_end);
    for (int z = z_end - 1; z >= z_begin; --z) joinRuns(ownRuns({x, y, z}), run.data(), cap_);
  }

  std::vector<CellBox> repairSquares() {
    const std::vector<std::uint8_t> reached = tilesReached();
    std::vector<CellBox> changed;
    const auto& tiles = field_.tiles_;
    std::size_t first = 0;
    for (int tz = 0; tz < tiles.z; ++tz)
      for (int ty = 0; ty < tiles.y; ++ty, first += static_cast<std::size_t>(tiles.x))
        for (int begin = 0; begin < tiles.x; ++begin) {
          if (!reached[first + static_cast<std::size_t>(begin)]) continue;
          int end = begin + 1;
          while (end < tiles.x && reached[first + static_cast<std::size_t>(end)]) ++end;
          repairLine(begin, end, ty, tz, changed);
          begin = end;
        }
    return changed;
  }

  /// A distance changes only where an occupied cell came nearer than it, or one went that was as far.
  std::vector<std::uint8_t> tilesReached() const {
    std::vector<std::uint8_t> reached(field_.squares_.size(), 0);
    const auto& tiles = field_.tiles_;
    const int reach = field_.reach_, up = field_.half_height_.value_or(reach);
    for (const CellBox& change : changes_)
      for (int tz = std::max(0, change.begin.z - up) >> field_.z_bits_;
           tz < tiles.z && tz << field_.z_bits_ < change.end.z + up; ++tz)
        for (int ty = std::max(0, change.begin.y - reach) >> field_.y_bits_;
             ty < tiles.y && ty << field_.y_bits_ < change.end.y + reach; ++ty)
          for (int tx = std::max(0, change.begin.x - reach) >> kRowBits;
               tx < tiles.x && tx << kRowBits < change.end.x + reach; ++tx) {
            const CellBox tile = field_.tileBox(tx, ty, tz);
            const std::size_t index = field_.tileOf(tile.begin);
            const int dx = gapBetween(tile.begin.x, tile.end.x, change.begin.x, change.end.x);
            const int dy = gapBetween(tile.begin.y, tile.end.y, change.begin.y, change.end.y);
            const int dz = field_.half_height_ ? 0 : gapBetween(tile.begin.z, tile.end.z, change.begin.z, change.end.z);
            if (dx * dx + dy * dy + dz * dz <= field_.squares_[index]->greatest) reached[index] = 1;
          }
    return reached;
  }

  /// The tiles from `begin` to before `end` of a line along x.
  void repairLine(int begin, int end, int ty, int tz, std::vector<CellBox>& changed) {
    std::vector<std::shared_ptr<SquareTile>> made(static_cast<std::size_t>(end - begin));
    for (auto& tile : made) tile = std::make_shared<SquareTile>();
    const CellBox first = field_.tileBox(begin, ty, tz);
    for (int z = first.begin.z; z < first.end.z; ++z)
      for (int y = first.begin.y; y < first.end.y; ++y) {
        overY(begin, end, y, z);
        for (int tile = begin; tile < end; ++tile)
          overX(halo() + static_cast<std::size_t>(tile - begin) * kRow,
                made[static_cast<std::size_t>(tile - begin)]->squares.data() + field_.offsetOf({first.begin.x, y, z}));
      }
    for (int tile = begin; tile < end; ++tile)
      keep(std::move(made[static_cast<std::size_t>(tile - begin)]), field_.tileBox(tile, ty, tz), changed);
  }

  void keep(std::shared_ptr<SquareTile> made, const CellBox& box, std::vector<CellBox>& changed) {
    auto& kept = field_.squares_[field_.tileOf(box.begin)];
    if (made->squares == kept->squares) return;
    made->greatest = greatestOf<kTileCells>(made->squares.data());
    changed.push_back(box);
    kept = made->squares == field_.far_->squares ? field_.far_ : std::move(made);
  }

  /// Cells before the first tile of a line in `line_`: the reach, in whole rows.
  std::size_t halo() const { return static_cast<std::size_t>(along(field_.reach_, kRowBits)) * kRow; }

  /// The squared distances over y and z into `line_`, for the tiles and what is within reach of them.
  void overY(int begin, int end, int y, int z) {
    const int before = static_cast<int>(halo() / kRow);
    line_.assign(static_cast<std::size_t>(end - begin + 2 * before) * kRow, static_cast<std::int16_t>(field_.beyond()));
    for (int tile = std::max(0, begin - before); tile < std::min(field_.tiles_.x, end + before); ++tile) {
      std::int16_t* row = line_.data() + static_cast<std::size_t>(tile - begin + before) * kRow;
      squareRuns({tile * kRow, y, z}, row);
      for (int dy = 1; dy <= field_.reach_ && field_.size_.y > 1; ++dy) {
        if (dy * dy >= greatestOf<kRowCells>(row)) break;
        std::array<std::int16_t, kRow> below, above;
        below.fill(static_cast<std::int16_t>(field_.beyond()));
        above = below;
        if (y - dy >= 0) squareRuns({tile * kRow, y - dy, z}, below.data());
        if (y + dy < field_.size_.y) squareRuns({tile * kRow, y + dy, z}, above.data());
        takeLess(row, below.data(), above.data(), static_cast<std::int16_t>(dy * dy));
      }
    }
  }

  void squareRuns(VoxelIndex first, std::int16_t* squares) const {
    const auto most = static_cast<std::int16_t>(field_.beyond());
    if (field_.half_height_)
      squareUpright(runsAt(first), squares, most, static_cast<std::int16_t>(*field_.half_height_));
    else
      squareEuclidean(runsAt(first), squares, most);
  }

  /// The squared distances of a row of a tile, from those of `line_`.
  void overX(std::size_t at, std::int16_t* squares) const {
    std::array<std::int16_t, kRow> least;
    std::copy_n(line_.data() + at, kRow, least.begin());
    constexpr int kBetweenLooks = 4;
    for (int dx = 1; dx <= field_.reach_; ++dx) {
      const auto add = static_cast<std::int16_t>(dx * dx);
      if (dx % kBetweenLooks == 1 && add >= greatestOf<kRowCells>(least.data())) break;
      const std::int16_t* middle = line_.data() + at;
      takeLess(least.data(), middle - dx, middle + dx, add);
    }
    std::copy_n(least.begin(), kRow, squares);
  }

  DistanceField& field_;
  const RowReader& read_;
  std::vector<RunTile*> own_;  ///< By tile: made by this update; null otherwise.
  std::uint8_t cap_;
  std::vector<CellBox> changes_;  ///< Each within one tile.
  std::vector<std::int16_t> line_;
};

DistanceField::DistanceField(VoxelIndex size, int reach_cells, std::optional<int> half_height_cells)
    : y_bits_(size.y == 1 ? 0 : 3), z_bits_(size.y == 1 ? 6 : 3), reach_(reach_cells), half_height_(half_height_cells) {
  SWIFTLET_CHECK(size.x > 0 && size.y > 0 && size.z > 0 && reach_cells >= 1 && reach_cells <= kMostReach, reach_cells);
  tiles_ = {along(size.x, kRowBits), along(size.y, y_bits_), along(size.z, z_bits_)};
  size_ = {tiles_.x << kRowBits, tiles_.y << y_bits_, tiles_.z << z_bits_};
  auto nothing = std::make_shared<RunTile>();
  nothing->fill(static_cast<std::uint8_t>(reach_ + 1));
  auto far = std::make_shared<SquareTile>();
  far->greatest = static_cast<std::int16_t>(beyond());
  far->squares.fill(far->greatest);
  far_ = std::move(far);
  const std::size_t tiles =
      static_cast<std::size_t>(tiles_.x) * static_cast<std::size_t>(tiles_.y) * static_cast<std::size_t>(tiles_.z);
  runs_.assign(tiles, std::move(nothing));
  squares_.assign(tiles, far_);
}

std::vector<CellBox> DistanceField::update(std::span<const CellBox> boxes, const RowReader& read) {
  Repair repair(*this, read);
  for (const CellBox& box : boxes) repair.readBox(box);
  return repair.finish();
}

CellBox DistanceField::tileBox(int x, int y, int z) const {
  const VoxelIndex begin{x << kRowBits, y << y_bits_, z << z_bits_};
  return {begin, {begin.x + kRow, begin.y + (1 << y_bits_), begin.z + (1 << z_bits_)}};
}

}  // namespace swiftlet::planning
