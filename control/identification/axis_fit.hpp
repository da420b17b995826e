// Least squares of one degree of freedom (Bachrach 2009, equations 1 and 2), with the lag behind which a command takes
// effect.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "control/identification/flight_samples.hpp"
#include "control/vehicle_model.hpp"

namespace swiftlet::control {

/// A flight as one axis sees it: equally spaced, in flight.
struct AxisSeries {
  double period_s = 0.01;
  std::vector<double> command;
  std::vector<double> velocity;  ///< Its changes count; for the yaw: the angle, unwrapped.
  std::vector<double> damped;    ///< The velocity that damps, of equation 2; empty: `velocity` itself.
};

struct AxisFitOptions {
  double window_s = 0.3;  ///< The change of velocity over such a time is one equation.
  double longest_lag_s = 0.4;
  /// Of the yaw rate. Propellers turn a vehicle by their drag alone, so a small one takes 0.6 s and more to follow;
  /// with a lag that is cut off the gain comes out too small.
  double longest_rate_lag_s = 1.5;
  double lag_step_s = 0.01;
  double shortest_s = 15.0;      ///< Less flight is not enough.
  double widest_interval = 0.3;  ///< A gain whose interval is a greater share of it is not identified.
};

/// Over each window T: v(t + T) - v(t) = k1 int(u) + k2 int(v) + b T, with u behind the lag of least residual. `damped`
/// fits k2 (equation 2), otherwise it is 0 (equation 1). A b that does not differ from 0 is left out, and the rest is
/// fitted without it; its interval stays. The intervals are of 95 %, and wider where the residuals of
/// neighbouring windows are correlated. Fails, with the reason, for flights that are too short or that moved the
/// command too little.
tl::expected<AxisModel, std::string> fitAxis(const std::vector<AxisSeries>& flights, bool damped,
                                             const AxisFitOptions& options = {});

/// Whether the residual was least at the longest lag that was tried: the lag may be longer, or cannot be determined.
bool lagIsAtBound(const AxisModel& axis, double longest_lag_s, const AxisFitOptions& options = {});

/// As fitAxis without damping for a rate that follows its command: angle(t + T) - angle(t) = k int(u) + b T.
tl::expected<AxisModel, std::string> fitRate(const std::vector<AxisSeries>& flights,
                                             const AxisFitOptions& options = {});

}  // namespace swiftlet::control
