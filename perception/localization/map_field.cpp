#include "perception/localization/map_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swiftlet::perception {
namespace {

/// Room for reading four bytes at once at the last cell.
constexpr std::size_t kFieldOverread = 16;
/// Number of cells per entry of free_before_; within them a free cell is searched for one by one.
constexpr std::size_t kStretch = 256;

/// Marks a column without an occupied cell, in the distances of the first pass.
constexpr std::uint16_t kNone = std::numeric_limits<std::uint16_t>::max();

/// The second pass of the exact Euclidean distance transform (Felzenszwalb and Huttenlocher 2012): the lower envelope
/// of the parabolas in[i] + (x - i)^2, in squared cells.
class DistancePass {
 public:
  explicit DistancePass(std::size_t length) : in_(length), roots_(length), borders_(length + 1) {}

  std::vector<float>& line() { return in_; }

  template <typename Write>
  void run(std::size_t length, Write&& write) {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    std::size_t count = 0;
    for (std::size_t i = 0; i < length; ++i) {
      if (in_[i] == kFar) continue;
      float border = -kFar;
      while (count > 0) {
        border = crossing(roots_[count - 1], i);
        if (border > borders_[count - 1]) break;
        --count;
      }
      if (count == 0) border = -kFar;
      roots_[count] = i;
      borders_[count++] = border;
    }
    for (std::size_t x = 0, k = 0; x < length; ++x) {
      if (count == 0) {
        write(x, kFar);
        continue;
      }
      while (k + 1 < count && borders_[k + 1] <= static_cast<float>(x)) ++k;
      const float off = static_cast<float>(x) - static_cast<float>(roots_[k]);
      write(x, in_[roots_[k]] + off * off);
    }
  }

 private:
  float crossing(std::size_t a, std::size_t b) const {
    const auto x = static_cast<float>(a), y = static_cast<float>(b);
    return (in_[b] - in_[a] + y * y - x * x) / (2.0F * (y - x));
  }

  std::vector<float> in_;
  std::vector<std::size_t> roots_;
  std::vector<float> borders_;
};

}  // namespace

double beamValue(double distance_m, double sigma_m, double random_share) {
  const double ratio = distance_m / sigma_m;
  const double on_wall = (1.0 - random_share) / random_share;
  return std::log1p(on_wall * std::exp(-0.5 * ratio * ratio)) / std::log1p(on_wall);
}

MapField::MapField(const common::OccupancyGrid& map) : resolution_m_(map.resolution_m()) {
  readMap(map);
  measureDistances();
  fillValues();
}

void MapField::readMap(const common::OccupancyGrid& map) {
  const common::CellRect known = common::knownExtent(map);
  width_ = std::max(known.width(), 0) + 2 * kBorder;
  height_ = std::max(known.height(), 0) + 2 * kBorder;
  begin_ = {known.begin.x - kBorder, known.begin.y - kBorder};
  origin_m_ = Eigen::Vector2d(begin_.x, begin_.y) * resolution_m_;
  kinds_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), kUnknown);
  for (int y = known.begin.y; y < known.end.y; ++y) {
    for (int x = known.begin.x; x < known.end.x; ++x) {
      const common::occupancy::Cell cell = map.at({x, y});
      if (common::occupancy::isUnknown(cell)) continue;
      const bool occupied = common::occupancy::isOccupied(cell);
      kinds_[indexOf(x - begin_.x, y - begin_.y)] = occupied ? kOccupied : kFree;
      has_walls_ |= occupied;
    }
  }
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    if (i % kStretch == 0) free_before_.push_back(static_cast<std::uint32_t>(free_cells_));
    free_cells_ += kinds_[i] == kFree ? 1U : 0U;
  }
}

Eigen::Vector2d MapField::freeCell_m(std::size_t n) const {
  const auto stretch = std::upper_bound(free_before_.begin(), free_before_.end(), n) - free_before_.begin() - 1;
  std::size_t i = static_cast<std::size_t>(stretch) * kStretch;
  for (std::size_t before = free_before_[static_cast<std::size_t>(stretch)];; ++i)
    if (kinds_[i] == kFree && before++ == n) break;
  const auto width = static_cast<std::size_t>(width_);
  return {(begin_.x + static_cast<int>(i % width) + 0.5) * resolution_m_,
          (begin_.y + static_cast<int>(i / width) + 0.5) * resolution_m_};
}

void MapField::measureDistances() {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  const auto width = static_cast<std::size_t>(width_), height = static_cast<std::size_t>(height_);
  // The first pass: distances along the columns, in whole cells.
  std::vector<std::uint16_t> along(kinds_.size(), kNone);
  const auto next = [](std::uint16_t cells) { return cells == kNone ? kNone : static_cast<std::uint16_t>(cells + 1); };
  for (std::size_t i = 0; i < along.size(); ++i)
    along[i] = kinds_[i] == kOccupied ? std::uint16_t{0} : i < width ? kNone : next(along[i - width]);
  for (std::size_t i = along.size() - width; i-- > 0;) along[i] = std::min(along[i], next(along[i + width]));
  DistancePass pass(width);
  distances_cm_.resize(kinds_.size());
  const double cm_per_cell = 100.0 * resolution_m_;
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const auto cells = static_cast<float>(along[y * width + x]);
      pass.line()[x] = along[y * width + x] == kNone ? kFar : cells * cells;
    }
    pass.run(width, [&](std::size_t x, float value) {
      const double distance_cm = value == kFar ? 255.0 : std::sqrt(static_cast<double>(value)) * cm_per_cell;
      distances_cm_[y * width + x] = static_cast<std::uint8_t>(std::lround(std::min(distance_cm, 255.0)));
    });
  }
}

void MapField::fillValues() {
  top_nats_ = std::log1p((1.0 - kRandomShare) / kRandomShare);
  // The walls of the map are only known to within one cell.
  const double sigma_m = std::max(kSigma_m, resolution_m_);
  std::vector<std::uint8_t> by_distance(256);
  for (std::size_t cm = 0; cm < by_distance.size(); ++cm)
    by_distance[cm] = static_cast<std::uint8_t>(
        std::lround(255.0 * beamValue(0.01 * static_cast<double>(cm), sigma_m, kRandomShare)));
  const auto unknown = static_cast<std::uint8_t>(std::lround(255.0 * kUnknownValue));
  values_.assign(kinds_.size() + kFieldOverread, unknown);
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    const std::uint8_t value = by_distance[distances_cm_[i]];
    values_[i] = kinds_[i] == kUnknown ? std::max(value, unknown) : value;
  }
}

MapField::Place MapField::at(const Eigen::Vector2d& point_m) const {
  const Eigen::Vector2d cell = (point_m - origin_m_) / resolution_m_;
  if (!(cell.x() >= 0.0 && cell.y() >= 0.0 && cell.x() < width_ && cell.y() < height_)) return {};
  const std::size_t index = indexOf(static_cast<int>(cell.x()), static_cast<int>(cell.y()));
  const std::uint8_t kind = kinds_[index];
  return {0.01 * distances_cm_[index], kind != kUnknown, kind == kOccupied, kind == kFree};
}

double MapField::rayLength_m(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) const {
  const double length_m = (to_m - from_m).norm();
  const Eigen::Vector2d direction =
      length_m > 0.0 ? Eigen::Vector2d((to_m - from_m) / length_m) : Eigen::Vector2d(1, 0);
  // The ray may have any length; outside the circle around the field there are no cells.
  const double away_m = (0.5 * (low_m() + high_m()) - from_m).norm(), radius_m = 0.5 * (high_m() - low_m()).norm();
  const double end_m = std::min(length_m, away_m + radius_m);
  // Sphere tracing: no occupied cell is nearer than the nearest wall, so the ray can advance by that distance.
  for (double along_m = std::max(0.0, away_m - radius_m); along_m <= end_m;) {
    const Place place = at(from_m + along_m * direction);
    if (place.occupied) return along_m;
    along_m += std::max(0.5 * resolution_m_, place.wall_distance_m - 1.5 * resolution_m_);
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace swiftlet::perception
