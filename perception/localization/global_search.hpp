// All places of a map where a set of points fits: branch and bound over every free position and direction (Olson 2009),
// on a coarse likelihood field. From its answer particles are drawn: the sensor's own proposal of mixture Monte Carlo
// localization (Thrun, Fox, Burgard, Dellaert 2001), which finds the pose where particles spread at random are too few
// to lie near it. Since it finds every distinct place that fits about as well as the best, it also tells when a pose is
// ambiguous.
//
// Frame: that of the map's grid.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/config_fwd.hpp"
#include "common/geometry.hpp"
#include "perception/localization/map_field.hpp"
#include "perception/scan_matching/window_sums.hpp"

namespace swiftlet::perception {

struct GlobalSearchConfig {
  double cell_m = 0.10;
  double sigma_m = 0.20;
  double lever_m = 8.0;
  double least_fit = 0.55;
  double distinct_m = 0.5;
  double distinct_deg = 15.0;
  int max_places = 400;
  int max_blocks = 1'000'000;

  void describe(common::config::Fields& fields);
};

struct FittingPlace {
  common::Pose2 T_grid_points;
  double fit = 0.0;  ///< Mean value of the points, in [0, 1].
};

struct GlobalSearchResult {
  std::vector<FittingPlace> places;  ///< The best first.
  bool complete = true;              ///< False: there may be more.
};

/// Immutable; may be asked from any thread. Deterministic.
class GlobalSearch {
 public:
  GlobalSearch(std::shared_ptr<const MapField> map, const GlobalSearchConfig& config,
               Instructions instructions = bestInstructions());

  /// At most kMaxWindowPoints points in a frame whose origin was once the vehicle's: it lies on a free cell. Places
  /// that fit worse than the best by `margin` (of the mean value) are left out. The places are what is left of all
  /// poses that fit, the best first, when each takes away those after it that are no place distinct from it.
  GlobalSearchResult search(const std::vector<Eigen::Vector2f>& points_m, double margin) const;

 private:
  static constexpr int kTopLevel = 2;  // Blocks of 4 positions a side: coarser ones bound too loosely to pay.
  static constexpr int kLevels = kTopLevel + 1;

  class Descent;

  void buildLevels();
  bool isFree(int level, int x, int y) const;

  std::shared_ptr<const MapField> map_;
  GlobalSearchConfig config_;
  Instructions instructions_;
  double cell_m_ = 0.1;
  int columns_ = 0, rows_ = 0;               // Positions.
  int border_ = 0, width_ = 0, height_ = 0;  // Of the field: as far as points reach beyond the positions.
  double reach_m_ = 0.0;
  std::array<std::vector<std::uint8_t>, kLevels> fields_;
  std::array<std::vector<std::uint8_t>, kLevels> free_;  // Whether any position of the block is free.
};

}  // namespace swiftlet::perception
