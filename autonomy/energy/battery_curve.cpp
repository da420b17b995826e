#include "autonomy/energy/battery_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace swiftlet::autonomy {
namespace {

struct Knot {
  double remaining;
  double voltage;  ///< 0: the empty battery's, 1: the full one's.
};

/// Of a cell that has 4.20 V when full and 3.40 V when it counts as empty; typical values of data sheets.
constexpr std::array<Knot, 10> kCurve{{{0.0, 0.0},
                                       {0.05, 0.14},
                                       {0.1, 0.25},
                                       {0.2, 0.33},
                                       {0.4, 0.45},
                                       {0.6, 0.57},
                                       {0.8, 0.73},
                                       {0.9, 0.83},
                                       {0.95, 0.90},
                                       {1.0, 1.0}}};

}  // namespace

double BatteryCurve::openCircuit_v(double remaining) const {
  const double charge = std::clamp(remaining, 0.0, 1.0);
  std::size_t k = 1;
  while (kCurve[k].remaining < charge) ++k;
  const Knot &below = kCurve[k - 1], &above = kCurve[k];
  const double share = (charge - below.remaining) / (above.remaining - below.remaining);
  return empty_v_ + (full_v_ - empty_v_) * std::lerp(below.voltage, above.voltage, share);
}

double BatteryCurve::chargeAtMargin(const Now& now, double least_margin, double exponent) const {
  // The charge that is found is too low by at most a step. The least voltage only keeps the division defined.
  constexpr double kStep = 0.005, kLeast_v = 1.0;
  if (now.thrust_margin <= least_margin) return now.remaining;
  const double sag_v = std::max(0.0, openCircuit_v(now.remaining) - now.voltage_v);
  const double loaded_v = std::max(kLeast_v, openCircuit_v(now.remaining) - sag_v);
  for (double charge = now.remaining; charge > 0.0; charge -= kStep) {
    const double there_v = std::max(0.0, openCircuit_v(charge) - sag_v);
    if (now.thrust_margin * std::pow(there_v / loaded_v, exponent) <= least_margin) return charge;
  }
  return 0.0;
}

}  // namespace swiftlet::autonomy
