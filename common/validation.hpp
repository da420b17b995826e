// Collects what is wrong with the values of a config: `Validation().within("rate_hz", rate_hz, 1, 100).problems()`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swiftlet::common {

class Validation {
 public:
  /// low <= value <= high; NaN is a problem.
  Validation& within(std::string_view name, double value, double low, double high);
  /// value > 0; NaN is a problem.
  Validation& positive(std::string_view name, double value);
  /// Any condition with its own words, after "name: ".
  Validation& require(bool condition, std::string_view name, std::string_view message);

  std::vector<std::string> problems() const { return problems_; }

 private:
  std::vector<std::string> problems_;
};

}  // namespace swiftlet::common
