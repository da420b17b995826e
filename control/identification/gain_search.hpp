// Searches the gains of a controller by flying them: pattern search along one gain after the other (Hooke and Jeeves
// 1961, "Direct search", without the pattern move), on the logarithms of the gains.
#pragma once

#include <functional>
#include <vector>

#include "control/gains.hpp"

namespace swiftlet::control {

struct GainSearchOptions {
  int evaluations = 40;  ///< Sets of gains that may be flown, the start among them; at least 1.
  double factor = 1.5;   ///< By which a gain is first multiplied or divided; above 1.
  double reach = 6.0;    ///< Greatest factor between a gain and its start.
};

struct GainSearch {
  std::vector<Gain> gains;  ///< The best that were flown: never worse than the start.
  double before = 0.0, after = 0.0;
  int evaluations = 0;
};

/// The cost of a set of gains: smaller is better, never NaN. It must be a function of its argument: the same flights
/// for each set.
using GainCost = std::function<double(const std::vector<Gain>& gains)>;

/// Each gain is tried larger, then smaller; the cheaper one is kept. The direction that helped is tried first the next
/// time. After a sweep over all gains in which none helped, the factor becomes its square root; below 1.05 the search
/// ends. Deterministic.
GainSearch searchGains(const std::vector<Gain>& start, const GainSearchOptions& options, const GainCost& cost);

}  // namespace swiftlet::control
