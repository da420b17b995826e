// What is wrong between the fields of one Config; what is wrong with each alone follows from its bounds:
// `Validation().atMost("near_m", near_m, "far_m", far_m).problems()`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swiftlet::common {

class Validation {
 public:
  /// value <= limit, which is another field.
  Validation& atMost(std::string_view name, double value, std::string_view limit_name, double limit);
  /// Any condition with its own words, after "name: ".
  Validation& require(bool condition, std::string_view name, std::string_view message);

  std::vector<std::string> problems() const { return problems_; }

 private:
  std::vector<std::string> problems_;
};

}  // namespace swiftlet::common
