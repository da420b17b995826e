#include "control/identification/gain_search.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet::control {
namespace {

constexpr double kLeastFactor = 1.05;  ///< Smaller changes of a gain do not show in a flight.

class Search {
 public:
  Search(const std::vector<Gain>& start, const GainSearchOptions& options, const GainCost& cost)
      : start_(start), options_(options), cost_(cost), upward_(start.size(), true) {
    result_.gains = start;
    result_.before = result_.after = evaluated(start);
  }

  GainSearch run() {
    for (double factor = options_.factor; factor >= kLeastFactor && !spent();)
      if (!sweep(factor)) factor = std::sqrt(factor);
    return result_;
  }

 private:
  bool spent() const { return result_.evaluations >= options_.evaluations; }

  double evaluated(const std::vector<Gain>& gains) {
    ++result_.evaluations;
    return cost_(gains);
  }

  bool sweep(double factor) {
    bool helped = false;
    for (std::size_t i = 0; i < start_.size() && !spent(); ++i) {
      const bool first = upward_[i];
      if (tryGain(i, first ? factor : 1.0 / factor)) {
        helped = true;
      } else if (!spent() && tryGain(i, first ? 1.0 / factor : factor)) {
        upward_[i] = !first;
        helped = true;
      }
    }
    return helped;
  }

  bool tryGain(std::size_t i, double factor) {
    std::vector<Gain> gains = result_.gains;
    const Gain& start = start_[i];
    const double low = std::max(start.bounds.low, start.value / options_.reach);
    const double high = std::min(start.bounds.high, start.value * options_.reach);
    const double value = std::clamp(gains[i].value * factor, low, high);
    if (value == gains[i].value) return false;
    gains[i].value = value;
    const double cost = evaluated(gains);
    if (!(cost < result_.after)) return false;
    result_.gains = std::move(gains);
    result_.after = cost;
    return true;
  }

  const std::vector<Gain>& start_;
  const GainSearchOptions& options_;
  const GainCost& cost_;
  std::vector<bool> upward_;  ///< For each gain, the direction that is tried first.
  GainSearch result_;
};

}  // namespace

GainSearch searchGains(const std::vector<Gain>& start, const GainSearchOptions& options, const GainCost& cost) {
  return Search(start, options, cost).run();
}

}  // namespace swiftlet::control
