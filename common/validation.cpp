#include "common/validation.hpp"

#include <fmt/format.h>

namespace swiftlet::common {

Validation& Validation::atMost(std::string_view name, double value, std::string_view limit_name, double limit) {
  if (!(value <= limit))
    problems_.push_back(fmt::format("{}: {} is more than {}, which is {}", name, value, limit_name, limit));
  return *this;
}

Validation& Validation::require(bool condition, std::string_view name, std::string_view message) {
  if (!condition) problems_.push_back(fmt::format("{}: {}", name, message));
  return *this;
}

}  // namespace swiftlet::common
