// All inputs of a fusion filter, in order: a listener gets them in flight, and another filter with the same inputs has
// the same state. By this the noise parameters are learned from recorded flights (Bachrach 2009, 5.2).
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <tl/expected.hpp>

#include "common/sensor_event.hpp"
#include "perception/fusion/error_state_filter.hpp"
#include "perception/fusion/measurement.hpp"

namespace swiftlet::perception {

struct TapedStart {
  double height_m = 0.0;
};
struct TapedRest {
  bool at_rest = false;
};
struct TapedPredicted {
  bool predicted = false;
};
using FilterInput = std::variant<common::ImuSample, TapedStart, TapedRest, TapedPredicted, Measurement>;

class FilterListener {
 public:
  virtual ~FilterListener() = default;
  /// Called in the filter's thread, before the filter gets the input.
  virtual void heard(const FilterInput& input) = 0;
};

/// Gives the input to the filter. Returns what became of a measurement or a clone, and kTaken for other inputs; the
/// reason if the filter was to start and did not.
tl::expected<Insertion, std::string> tell(ErrorStateFilter& filter, const FilterInput& input);

/// One line with its newline: a word that names the input, and its numbers, times in nanoseconds.
std::string toLine(const FilterInput& input);
/// The input of a line; none if it is not one.
std::optional<FilterInput> filterInputOf(const std::vector<std::string_view>& words);

}  // namespace swiftlet::perception
