// Collects the problems between fields of one Config. The bounds of a single field are checked elsewhere
// (common/config_fields.hpp). Example: `Validation().atMost("near_m", near_m, "far_m", far_m).problems()`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/error.hpp"

namespace swiftlet::common {

class Validation {
 public:
  /// Requires value <= limit, where the limit is another field.
  Validation& atMost(std::string_view name, double value, std::string_view limit_name, double limit);
  /// Requires any condition; the element of the problem is `name`.
  Validation& require(bool condition, std::string_view name, Message message, std::string hint = "");
  /// Requires that a setting is given at all.
  Validation& given(bool is_given, std::string_view name);
  /// Takes over a problem, if there is one, as one of `name`.
  Validation& refuse(std::string_view name, const std::optional<Problem>& problem);

  std::vector<Problem> problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

}  // namespace swiftlet::common
