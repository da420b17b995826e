// Compares figures with their bounds and describes each miss in words.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace swiftlet::evaluation {

class Judge {
 public:
  /// An infinite bound checks nothing; otherwise a value that is missing or not a number is a miss.
  void atMost(const char* name, const std::optional<double>& value, double bound);
  /// A bound of 0 or less checks nothing. `missing` says why there is no value.
  void atLeast(const char* name, const std::optional<double>& value, double bound, const std::string& missing = {});
  void fail(std::string text) { failures.push_back(std::move(text)); }

  std::vector<std::string> failures;
};

}  // namespace swiftlet::evaluation
