// The best place to see a frontier from: what the explorers that weigh gains against travel times choose among.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "planning/exploration/frontier_survey.hpp"
#include "planning/exploration/viewpoints.hpp"

namespace swiftlet::planning {

/// Speed, yaw rate and acceleration from which travel times are estimated.
inline constexpr double kTravelSpeed_m_s = 0.8, kTravelYawRate_rad_s = 1.0, kTravelAcceleration_m_s2 = 0.8;

/// It turns while it flies. `path_m` is the cost of a path in metres of open space.
double travelTime_s(double path_m, double from_yaw_rad, double to_yaw_rad);
/// What a stop at a viewpoint takes in addition.
inline constexpr double kBrake_s = kTravelSpeed_m_s / kTravelAcceleration_m_s2;

/// A frontier with a place to see it from.
struct ViewpointOption {
  std::size_t frontier = 0;
  Lookout lookout;
  View view;
  /// Grows with the gain and with how well the laser fixes the pose there, and falls with the travel time.
  double utility = 0.0;
};

/// Of one call of an explorer; refers to its arguments, which must outlive it. Not thread-safe.
class ViewpointOptions {
 public:
  /// Less unknown area is not worth a view. A frontier behind which less is expected is left as too small.
  static constexpr double kMinGain_m2 = 0.03;

  ViewpointOptions(const ExplorationInput& input, const ExplorerConfig& config, FrontierSurvey& survey,
                   const Scout& scout)
      : input_(input), config_(config), survey_(survey), scout_(scout) {}

  /// The place of greatest utility, where an attempt was made only if there is no other. A frontier of which no
  /// reachable place sees enough is closed.
  std::optional<ViewpointOption> bestOf(const SeenFrontier& seen);
  /// The same for the place nearest to the frontier, which sees most of what is behind it.
  std::optional<ViewpointOption> nearestOf(const SeenFrontier& seen);
  /// The current viewpoint, if it is for one of the given frontiers and something is left to be seen from it.
  std::optional<ViewpointOption> current(const std::vector<std::size_t>& frontiers) const;
  /// The greatest utility that a viewpoint at least this far away can have: it sees the unknown at the end of its range
  /// in the whole field of view.
  double utilityBound(double path_m) const;

  Viewpoint viewpointOf(const ViewpointOption& option) const;

 private:
  template <typename IsBetter>
  std::optional<ViewpointOption> chosenOf(const SeenFrontier& seen, IsBetter&& is_better);
  ViewpointOption optionAt(std::size_t frontier, const Lookout& lookout) const;
  void leaveUnseen(std::size_t frontier, double greatest_gain_m2);

  const ExplorationInput& input_;
  const ExplorerConfig& config_;
  FrontierSurvey& survey_;
  const Scout& scout_;
};

}  // namespace swiftlet::planning
