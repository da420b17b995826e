// Finds all places of a map where a set of points fits, by branch and bound over every free position and direction
// (Olson 2009) on a coarse likelihood field. Particles are drawn from the result: this is the sensor-based proposal of
// mixture Monte Carlo localization (Thrun, Fox, Burgard, Dellaert 2001). It finds the pose even when particles spread
// at random are too few to lie near it. It returns every distinct place that fits about as well as the best, so it also
// shows whether a pose is ambiguous.
//
// Frame: the map's grid.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "perception/localization/map_field.hpp"
#include "perception/scan_matching/window_sums.hpp"

namespace swiftlet::perception {

struct GlobalSearchConfig {
  static constexpr double cell_m = 0.10;  ///< Side of a cell of the positions searched, not finer than the map's.
  static constexpr double sigma_m =
      0.20;  ///< Width of the search's likelihood field, which covers what lies between the poses searched.
  static constexpr double lever_m =
      8.0;  ///< From one direction searched to the next, points at this distance move by twice sigma_m.
  static constexpr double least_fit =
      0.55;  ///< Mean value of the likelihood field, relative to that on a wall, below which a place does not fit: two
             ///< thirds of the points within sigma_m of a wall give 0.55.
  static constexpr double distinct_m =
      0.5;  ///< Places nearer than this are one, if they are also turned less than distinct_deg.
  static constexpr double distinct_deg =
      15.0;                    ///< Places turned less than this are one, if they are also nearer than distinct_m.
  int max_blocks = 1'000'000;  ///< Blocks of poses after which the search is given up; it keeps twice as many.
};

struct FittingPlace {
  common::Pose2 T_grid_points;
  double fit = 0.0;  ///< Mean field value at the points, in [0, 1].
};

struct GlobalSearchResult {
  std::vector<FittingPlace> places;  ///< Best first.
  bool complete = true;              ///< False if there may be more places.
};

/// Immutable; may be called from any thread. Deterministic.
class GlobalSearch {
 public:
  GlobalSearch(std::shared_ptr<const MapField> map, const GlobalSearchConfig& config,
               Instructions instructions = bestInstructions());

  /// Takes at most kMaxWindowPoints points, in a frame whose origin is a former position of the vehicle and therefore
  /// must lie on a free cell. Leaves out places whose mean value is lower than that of the best by `margin` or more.
  /// The places are the local maxima of the fit, after non-maximum suppression with the distances of the configuration.
  GlobalSearchResult search(const std::vector<Eigen::Vector2f>& points_m, double margin) const;

 private:
  // Blocks of 4 positions per side: coarser blocks have bounds too loose to be worth their cost.
  static constexpr int kTopLevel = 2;
  static constexpr int kLevels = kTopLevel + 1;

  class Descent;

  void layOut();
  void buildFinestLevel();
  void buildCoarserLevels();
  bool isFree(int level, int x, int y) const;

  std::shared_ptr<const MapField> map_;
  GlobalSearchConfig config_;
  Instructions instructions_;
  double cell_m_ = 0.1;
  int columns_ = 0, rows_ = 0;  // Number of positions searched.
  // Size of the field. The border is as wide as points can reach beyond the positions.
  int border_ = 0, width_ = 0, height_ = 0;
  double reach_m_ = 0.0;
  std::array<std::vector<std::uint8_t>, kLevels> fields_;
  std::array<std::vector<std::uint8_t>, kLevels> free_;  // Whether any position of a block is free.
};

}  // namespace swiftlet::perception
