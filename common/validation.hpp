// Collects the problems between fields of one Config. The bounds of a single field are checked elsewhere
// (common/config_fields.hpp). Example: `Validation().atMost("near_m", near_m, "far_m", far_m).problems()`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swiftlet::common {

class Validation {
 public:
  /// Requires value <= limit, where the limit is another field.
  Validation& atMost(std::string_view name, double value, std::string_view limit_name, double limit);
  /// Requires any condition; the problem is reported as "name: message".
  Validation& require(bool condition, std::string_view name, std::string_view message);

  std::vector<std::string> problems() const { return problems_; }

 private:
  std::vector<std::string> problems_;
};

}  // namespace swiftlet::common
