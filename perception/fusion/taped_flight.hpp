// A recorded flight, given again to a filter, with the truth beside it: what consistency, noise and drift are judged
// by.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "perception/fusion/filter_tape.hpp"
#include "perception/fusion/fusion_config.hpp"

namespace swiftlet::perception {

struct TrueMotion {
  common::Time stamp;
  double yaw_map_rad = 0.0;
  Eigen::Vector3d velocity_map_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d position_map_m = Eigen::Vector3d::Zero();  ///< Of the body origin; z above the take-off floor.
};

/// The inputs of one flight's filter, and the truth while it flew, in the order of time.
struct TapedFlight {
  std::vector<FilterInput> inputs;
  std::vector<TrueMotion> truth;
};

/// Replays a flight to a filter, from one instant of its truth to the next. One thread; the flight must outlive it.
class TapedReplay {
 public:
  using Told = std::function<void(const FilterInput&)>;

  TapedReplay(const TapedFlight& flight, const FusionConfig& config) : flight_(flight), filter_(config) {}

  /// Gives the filter its inputs until the next instant of the truth, and returns that instant; null at the end.
  /// `told`, if it is set, gets each input after the filter.
  const TrueMotion* next(const Told& told = nullptr);
  /// The truth at the time of the filter's state, which is that of its newest sample: samples arrive late. Only after
  /// next().
  TrueMotion truthOfState() const;
  const ErrorStateFilter& filter() const { return filter_; }

 private:
  const TapedFlight& flight_;
  ErrorStateFilter filter_;
  std::size_t next_input_ = 0, next_truth_ = 0;
};

/// A velocity in the level body frame, whose heading is `yaw_rad` in the velocity's own frame. Velocities in frames
/// without a common heading are compared there.
Eigen::Vector3d inLevelBody(double yaw_rad, const Eigen::Vector3d& velocity_m_s);

}  // namespace swiftlet::perception
