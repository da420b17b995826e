// Frontiers: where known free space borders on unknown space, and why a frontier was not explored.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/tiled_grid.hpp"

namespace swiftlet::common {

/// Why a frontier is not (yet) explored.
/// kBlocked: something that may go, such as a person, is in the only way, or in the view; it is come back to.
/// kPositionUncertain: too few walls are around it to know the position there, or the position became uncertain on an
/// earlier flight there.
enum class FrontierReason { kOpen, kTooSmall, kUnreachable, kBlocked, kOutOfBounds, kBlacklisted, kPositionUncertain };
/// All of them, in their order.
inline constexpr std::array kFrontierReasons{FrontierReason::kOpen,
                                             FrontierReason::kTooSmall,
                                             FrontierReason::kUnreachable,
                                             FrontierReason::kBlocked,
                                             FrontierReason::kOutOfBounds,
                                             FrontierReason::kBlacklisted,
                                             FrontierReason::kPositionUncertain};
const char* toString(FrontierReason reason);

/// A connected run of free cells that touch unknown ones.
struct Frontier {
  std::vector<CellIndex> cells;
  Eigen::Vector2d centroid_map_m = Eigen::Vector2d::Zero();
  double length_m = 0.0;
  double score = 0.0;  ///< Higher is better; only for open ones.
  FrontierReason reason = FrontierReason::kOpen;
  int attempts = 0;         ///< Number of attempts to explore it.
  std::string explanation;  ///< "unreachable at clearance 0.10 m", for people.
};

}  // namespace swiftlet::common
