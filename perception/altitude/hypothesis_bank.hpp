// All explanations of what the beams down have measured that are still possible, each with its weight: which of the
// known levels is below, or another surface; whether the ground slopes; whether the accelerometer's bias has changed.
// A decision is made when the evidence is there, and is taken back when it was wrong. Private to altitude.
//
// It rests on a few sentences. The ground below is a function of the place and not of the time: where the vehicle does
// not move, what is below does not change its height. The bias of an accelerometer is a function of the time and not of
// the place. Slopes have a greatest gradient, and begin and end where the vehicle flies along. Surfaces have edges, at
// which the distance jumps.
//
// For each scan the hypotheses are predicted (Kalman), branch into what may have begun, are weighed by the likelihood
// of the distances (multiple hypothesis tracking: Reid 1979; Blackman 2004), merged where they say the same, and
// pruned.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/time.hpp"
#include "perception/altitude/ground_hypothesis.hpp"
#include "perception/altitude/ground_scan.hpp"
#include "perception/altitude/level_store.hpp"
#include "perception/altitude/multilevel_config.hpp"

namespace swiftlet::perception::altitude {

/// A level known within this distance is near: as wide as a table.
inline constexpr double kNeighbourhood_m = 0.8;
/// What was seen for less time is a small surface: no level, and no part of one that is known near by. What was not
/// seen for as long is forgotten (docs/decisions/altitude.md#095).
inline constexpr double kConfirmed_s = 0.3;

/// The vehicle's way from the scan before to this one.
struct ScanStep {
  common::Time before, now;
  Eigen::Vector2d from_map_m, to_map_m;

  double seconds() const { return (now - before).seconds(); }
  double moved_m() const { return (to_map_m - from_map_m).norm(); }
};

class HypothesisBank {
 public:
  /// Refers to the levels, which must outlive it.
  HypothesisBank(const MultilevelConfig& config, const LevelStore& levels) : config_(config), levels_(levels) {}

  /// One hypothesis: over the take-off floor, in this state.
  void start(const VerticalState& state, common::Time now);
  /// To the time of the next scan, by the accelerometer. Without `climb`, or after some time without anything below,
  /// the state is `known`. `gradient_map`: that of the ground, where a camera saw it.
  void predict(const ScanStep& step, const std::optional<InertialClimb>& climb, const VerticalState& known,
               bool at_rest, const std::optional<Eigen::Vector2d>& gradient_map);
  /// Weighs the hypotheses by what the scan saw (Grzonka 2012, Algorithm 1, lines 5 to 11).
  void weigh(std::span<const SurfaceSight> sights);

  const GroundHypothesis& best() const { return bank_.front(); }
  /// Of the best hypothesis; that others disagree makes it less certain.
  VerticalState state() const;
  /// Whether those that agree with the best one on the height are likelier than all others together, so that the map of
  /// levels may learn from it.
  bool isSure() const;
  /// The surface has become a level.
  void nameLevel(int serial, int level);
  /// The levels near the largest surface of the last scan, and the cell of its middle.
  std::vector<int>& near() { return near_; }
  common::CellIndex center() const { return center_; }

 private:
  void branch();
  void look(const SurfaceSight& sight);
  void associate(const GroundHypothesis& h, const SurfaceSight& sight, int number);
  void meetAnother(const GroundHypothesis& h, const SurfaceSight& sight, int number, double share);
  double slopeBegins() const;
  void recognize();
  void prune();
  bool mayBe(int level, bool small) const;
  double unknownDensity_1_m(double vehicle_m, double height_m) const;
  double variance_m2(int beams) const;

  MultilevelConfig config_;
  const LevelStore& levels_;
  /// The likeliest first; never empty after start(). After prune() the weights sum to one.
  std::vector<GroundHypothesis> bank_, next_;
  int serials_ = 0;
  common::Time seen_;  ///< When something was below.
  // Of the present scan.
  ScanStep step_;
  std::optional<Eigen::Vector2d> gradient_;
  std::vector<int> near_;
  common::CellIndex center_;
};

}  // namespace swiftlet::perception::altitude
