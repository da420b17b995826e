// Keeps the vehicle above what it flies over: where a table leaves too little air under a path, the path is lifted. It
// uses the distance that is measured straight down, so that it also works while the height is not known well.
#pragma once

#include <optional>

#include "common/config_fwd.hpp"
#include "common/time.hpp"
#include "control/emergency_descent.hpp"
#include "control/reference.hpp"

namespace swiftlet::control {

/// One thread.
class SurfaceClearance {
 public:
  struct Config {
    double least_m = 0.40;

    void describe(common::config::Fields& fields);
  };

  explicit SurfaceClearance(const Config& config) : least_m_(config.least_m) {}

  /// A distance to what is below, and the height of the body over the take-off floor when it was measured.
  void observe(const RawHeight& below, double height_m);
  /// The reference, raised over what is below as far as `max_height_m` allows; never lowered. Call it once a tick while
  /// paths are flown.
  Reference raised(Reference path, common::Time now, double max_height_m, double dt_s);
  void reset();
  /// How much the last reference was raised.
  double lift_m() const { return lift_m_; }

 private:
  struct Surface {
    common::Time seen;
    double height_m;  ///< Over the take-off floor.
  };

  double least_m_;
  std::optional<Surface> highest_;  ///< Of what is, or was just now, below the hull.
  double wanted_lift_m_ = 0.0;      ///< Without the greatest height.
  double lift_m_ = 0.0;
};

}  // namespace swiftlet::control
