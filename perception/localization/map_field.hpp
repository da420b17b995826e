// A given map in the form that localization needs: how likely a beam ends in each cell, in bytes (the likelihood field
// of Thrun, Burgard and Fox, Probabilistic Robotics, 6.4), the distance to the nearest wall, and the free cells.
//
// A value is 255 ln(p(d) / p(far)) / ln(p(0) / p(far)). Here p(d) is a Gaussian of the distance d to the nearest
// occupied cell plus a constant density of random beams. The sum of the values over the beams of a scan is its
// log-likelihood, up to a factor and a constant. A cell that was never observed should be neutral, so its value is at
// least the mean value of a beam at a wrong pose.
//
// Frame: the grid. Immutable; may be read from any thread.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "common/occupancy_grid.hpp"

namespace swiftlet::perception {

/// Bytes row by row, with a border on all sides, so that a clamped look-up falls on the border.
struct FieldView {
  const std::uint8_t* cells = nullptr;
  int width = 0;
  int height = 0;
  double resolution_m = 0.0;
  Eigen::Vector2d origin_m = Eigen::Vector2d::Zero();  ///< Corner of cell (0, 0) in the grid's frame.
};

class MapField {
 public:
  /// Greatest distance to a wall that is kept: 255 steps of 1 cm fit into a byte.
  static constexpr double kMaxDistance_m = 2.55;
  /// Limit on the cells of the known part. Cell counts have 32 bits; searching a map of this size takes 5 GB.
  static constexpr std::int64_t kMaxCells = 1'000'000'000;

  /// Standard deviation of a beam's end about the wall: noise, the map's cells, the pose between particles.
  static constexpr double kSigma_m = 0.10;
  /// Density of beams that end anywhere, relative to that on a wall.
  static constexpr double kRandomShare = 0.10;
  /// Value of an unknown cell, relative to that on a wall.
  static constexpr double kUnknownValue = 0.20;

  explicit MapField(const common::OccupancyGrid& map);

  FieldView view() const { return {values_.data(), width_, height_, resolution_m_, origin_m_}; }
  /// Difference in log-likelihood between a value of 255 and a value of 0.
  double topNats() const { return top_nats_; }

  struct Place {
    double wall_distance_m = kMaxDistance_m;  ///< Distance to the centre of the nearest occupied cell, capped.
    bool known = false;
    bool occupied = false;
    bool free = false;
  };
  Place at(const Eigen::Vector2d& point_m) const;

  /// Distance along the ray from one point towards another at which it meets an occupied cell; infinity if it meets
  /// none before the second point.
  double rayLength_m(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) const;

  double resolution_m() const { return resolution_m_; }
  std::size_t freeCells() const { return free_cells_; }
  /// Centre of the n-th free cell, counted row by row; n < freeCells().
  Eigen::Vector2d freeCell_m(std::size_t n) const;
  bool hasWalls() const { return has_walls_; }
  /// Lower corner of the known part; high_m() is the upper one.
  Eigen::Vector2d low_m() const { return origin_m_ + Eigen::Vector2d::Constant(resolution_m_ * kBorder); }
  Eigen::Vector2d high_m() const {
    return origin_m_ + Eigen::Vector2d(width_ - kBorder, height_ - kBorder) * resolution_m_;
  }

 private:
  static constexpr int kBorder = 2;
  enum CellKind : std::uint8_t { kUnknown, kFree, kOccupied };

  std::size_t indexOf(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  void readMap(const common::OccupancyGrid& map);
  void measureDistances();
  void fillValues();

  double resolution_m_;
  common::CellIndex begin_;  ///< The cell of the map that is the first cell of the field.
  Eigen::Vector2d origin_m_ = Eigen::Vector2d::Zero();
  int width_ = 0, height_ = 0;
  double top_nats_ = 0.0;
  bool has_walls_ = false;
  std::vector<std::uint8_t> values_;
  std::vector<std::uint8_t> kinds_;
  std::vector<std::uint8_t> distances_cm_;
  std::size_t free_cells_ = 0;
  /// Number of free cells before each stretch of kStretch cells. For a large map, a list of all free cells would be
  /// larger than the field.
  std::vector<std::uint32_t> free_before_;
};

/// Log-likelihood ratio of a beam that ends `distance_m` from a wall and one that ends far from any, as a share of the
/// greatest ratio.
double beamValue(double distance_m, double sigma_m, double random_share);

}  // namespace swiftlet::perception
