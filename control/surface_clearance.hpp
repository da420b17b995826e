// Keeps the vehicle above what it flies over: where a table leaves too little air under a path, the path is lifted. It
// uses the distance that is measured straight down, so that it also works while the height is not known well.
#pragma once

#include <optional>

#include "common/config_fwd.hpp"
#include "common/time.hpp"
#include "control/emergency_descent.hpp"

namespace swiftlet::control {

/// One thread.
class SurfaceClearance {
 public:
  struct Config {
    double least_m = 0.40;
    static constexpr double climb_m_s = 0.4;  ///< Climb speed over an edge.
    static constexpr double sink_m_s = 0.2;   ///< Descent speed behind an edge.
    static constexpr double behind_s = 1.0;   ///< Time for which the hull is still over what its middle has passed.

    void describe(common::config::Fields& fields);
  };

  explicit SurfaceClearance(const Config& config) : config_(config) {}

  /// A distance to what is below, and the height of the body over the take-off floor when it was measured.
  void observe(const RawHeight& below, double height_m);
  /// Call it once a tick while paths are flown, with the height of the path.
  void advance(common::Time now, double wanted_m, double dt_s);
  void reset();

  /// To be added to the path's height, and its rate of change.
  double lift_m() const { return lift_m_; }
  double rate_m_s() const { return rate_m_s_; }

 private:
  struct Surface {
    common::Time seen;
    double height_m;  ///< Over the take-off floor.
  };

  Config config_;
  std::optional<Surface> highest_;  ///< Of what is, or was just now, below the hull.
  double lift_m_ = 0.0;
  double rate_m_s_ = 0.0;
};

}  // namespace swiftlet::control
